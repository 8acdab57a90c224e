"""``zeroset figure``: the figures of the papers as a list, one of them as a picture, or all of them in a folder."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from zeroset.cli.progress import Progress
from zeroset.cli.source import picture_path
from zeroset.errors import OutputError

if TYPE_CHECKING:
    from zeroset.runtime import Device

ALL = "all"


@click.command("figure")
@click.argument("name", required=False)
@click.option("-o", "--output", metavar="FILE", help="Picture to write; NAME.png if not given. For all: a folder.")
@click.option("-s", "--size", type=click.IntRange(8, 2048), help="Width of a panel in pixels; each figure has its own.")
@click.option("-d", "--device", default="auto", show_default=True, help="Where to run.")
def command(name: str | None, output: str | None, size: int | None, device: str) -> None:
    """Draw the figure NAME of the papers, such as sn10-5 or k09-9; `all` for all of them, nothing for a list."""
    if name is None:
        _list()
    elif name.lower() == ALL:
        _draw_all(output, size, device)
    else:
        _draw_one(name, output, size, device)


def _list() -> None:
    from zeroset.figures import find, names

    width = max(map(len, names()))
    for name in names():
        click.echo(f"{name:{width}}  {find(name).title}")
    click.echo(f"\n{len(names())} figures. Draw one: zeroset figure NAME -o out.png; all: zeroset figure all -o FOLDER")


def _draw_one(name: str, output: str | None, size: int | None, device: str) -> None:
    from zeroset.figures import find
    from zeroset.runtime import get_device

    figure = find(name)
    path = picture_path(output or f"{figure.name}.png")
    with Progress(f"drawing {figure.name}") as progress:
        _write(figure.name, path, size, get_device(device), progress)


def _draw_all(output: str | None, size: int | None, device: str) -> None:
    from zeroset.figures import names
    from zeroset.runtime import get_device

    folder = Path(output or "figures")
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        hint = "give the name of a folder" if folder.exists() else "make the folder above it first"
        raise OutputError(f"cannot make the folder {str(folder)!r}: {error.strerror or error}", hint=hint) from None
    paths = {name: picture_path(str(folder / f"{name}.png")) for name in names()}
    target = get_device(device)
    with Progress("drawing all figures") as progress:
        for i, (name, path) in enumerate(paths.items()):
            _write(name, path, size, target, lambda done, i=i: progress((i + done) / len(paths)))  # type: ignore[misc]


def _write(name: str, path: Path, size: int | None, device: Device, progress: Callable[[float], None]) -> None:
    from zeroset.atomic import replacing
    from zeroset.figures import draw
    from zeroset.rendering.image import encode, picture_format

    begin = time.perf_counter()
    pixels = draw(name, size, device, progress)
    data = encode(pixels, picture_format(path))
    with replacing(path) as file:
        file.write(data)
    height, width = pixels.shape[:2]
    click.echo(f"{path}: {width}x{height}, {time.perf_counter() - begin:.1f} s")
