"""``zeroset gallery``: the named surfaces as a list, or all of them on one sheet."""

from __future__ import annotations

import click

from zeroset.cli.progress import Progress
from zeroset.cli.source import picture_path, read_method
from zeroset.errors import ZerosetError

CELL_TEXT = 18
COLUMNS = 8


@click.command("gallery")
@click.argument("name", required=False)
@click.option("--sheet", metavar="FILE", help="Draw every surface into one picture.")
@click.option(
    "--cell", default=192, show_default=True, type=click.IntRange(32, 1024), help="Pixels a surface on the sheet."
)
@click.option("-m", "--method", default="auto", show_default=True, help="Ray method.")
@click.option("-d", "--device", default="auto", show_default=True, help="Where to run.")
def command(name: str | None, sheet: str | None, cell: int, method: str, device: str) -> None:
    """List the surfaces, tell all about NAME, or draw a contact sheet."""
    if name is not None and sheet is not None:
        hints = (f"to draw {name}: zeroset render {name} -o {sheet}", "to draw them all, leave the name out")
        raise ZerosetError("the sheet shows every surface, not one", hints=hints)
    if sheet is not None:
        _draw_sheet(sheet, cell, method, device)
    elif name is not None:
        _describe(name)
    else:
        _list()


def _list() -> None:
    from zeroset.surfaces import entry, names, solids

    width = max(map(len, names()))
    for name in names():
        item = entry(name)
        degree = str(item.degree) if item.degree else "-"
        papers = ", ".join(dict.fromkeys(source.paper for source in item.source))
        click.echo(f"{name:{width}}  {degree:>3}  {papers:10}  {item.title}")
    for solid in solids().values():
        papers = ", ".join(source.paper for source in solid.source)
        click.echo(f"{solid.name:{width}}  {'-':>3}  {papers:10}  {solid.title}, a solid")
    click.echo(f"\n{len(names())} surfaces, {len(solids())} solids; any other Chmutov surface as chmutov-N.")
    click.echo("Draw one: zeroset render NAME -o out.png")


def _describe(name: str) -> None:
    from zeroset.surfaces import GalleryEntry, SolidEntry, entry, solids

    item: GalleryEntry | SolidEntry = solids()[name] if name in solids() else entry(name)
    click.echo(f"{item.title}\n")
    if isinstance(item, SolidEntry):
        click.echo(f"  {item.solid}\n")
        for key, part in item.parts.items():
            click.echo(f"  {key}: {part.formula}")
        values: dict[str, object] = {k: v for part in item.parts.values() for k, v in part.params.items()}
    else:
        click.echo(f"  {item.formula}\n")
        values = {**item.params, **{k: f"{len(v)} numbers" for k, v in item.arrays.items()}}
    for key, value in values.items():
        click.echo(f"  {key} = {value}")
    for source in item.source:
        figures = f", figures {', '.join(source.figures)}" if source.figures else ""
        click.echo(f"  {source.paper}, {source.where}{figures}")
    if item.note:
        click.echo(f"\n{item.note}")


def _draw_sheet(path: str, cell: int, method: str, device: str) -> None:
    import numpy as np
    from PIL import Image, ImageDraw

    from zeroset.atomic import replacing
    from zeroset.rendering.image import encode, picture_format
    from zeroset.rendering.render import render
    from zeroset.shelf import gallery

    target, chosen = picture_path(path), read_method(method)
    things = (*gallery, *gallery.solids)
    rows = -(-len(things) // COLUMNS)
    page = Image.new("RGB", (COLUMNS * cell, rows * (cell + CELL_TEXT)), "white")
    pen = ImageDraw.Draw(page)
    with Progress("drawing the gallery") as progress:
        for i, name in enumerate(things):
            progress(i / len(things))
            picture = render(gallery.find(name), cell, method=chosen, device=device)
            x, y = i % COLUMNS * cell, i // COLUMNS * (cell + CELL_TEXT)
            page.paste(Image.fromarray(np.ascontiguousarray(picture.pixels)), (x, y))
            pen.text((x + cell // 2, y + cell + 2), name, fill="black", anchor="mt")
    data = encode(np.asarray(page), picture_format(target))
    with replacing(target) as file:
        file.write(data)
    click.echo(f"{target}: {len(gallery)} surfaces, {len(gallery.solids)} solids")
