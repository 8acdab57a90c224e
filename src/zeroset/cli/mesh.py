"""``zeroset mesh``: a formula, a gallery name or a scene file becomes a file of triangles."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from zeroset.cli.progress import Progress
from zeroset.cli.source import FormulaCommand, existing_folder, find_scene, with_isovalues

if TYPE_CHECKING:
    from zeroset.export.triangles import Mesh


@click.command("mesh", cls=FormulaCommand)
@click.argument("source", metavar="FORMULA|NAME|FILE")
@click.option("-p", "--param", "params", multiple=True, metavar="NAME=VALUE", help="Value of a parameter.")
@click.option("-b", "--bounds", metavar="R|X0,...,Z1", help="Ball radius, or x0,y0,z0,x1,y1,z1.")
@click.option("-d", "--device", default="auto", show_default=True, help="Where to run.")
@click.option("-o", "--output", default="zeroset.stl", show_default=True, help="File: .stl, .obj, .ply or .glb.")
@click.option("-r", "--resolution", type=int, default=128, show_default=True, help="Cells along the bounds.")
@click.option("--isovalues", metavar="V,V,...", help="Mesh f = v for each of these values, instead of f = 0.")
@click.option("--cap/--open", default=False, help="Close the mesh where the bounds cut it, or leave it open there.")
@click.option("--precision", default="auto", show_default=True, help="What f is evaluated in: f32, f64 or auto.")
def command(
    source: str,
    params: tuple[str, ...],
    bounds: str | None,
    device: str,
    output: str,
    resolution: int,
    isovalues: str | None,
    cap: bool,
    precision: str,
) -> None:
    """Mesh SOURCE: a formula such as "x^2 + y^2 = z", a gallery name, or a scene file.

    Every vertex lies on the surface. A surface that is closed inside its bounds gives a watertight mesh; where the
    bounds cut it, --cap closes it as the solid f <= 0.
    """
    from zeroset.export.mesh import mesh

    path = _mesh_path(output)
    scene = with_isovalues(find_scene(source, params, bounds), isovalues)
    begin = time.perf_counter()
    with Progress("meshing") as progress:
        made = mesh(scene, resolution, cap, device, precision, progress)
    spent = time.perf_counter() - begin
    made.save(path)
    _tell(made, path, spent)


def _mesh_path(output: str) -> Path:
    """The path, if it names a mesh format that can be written there: found out before the work."""
    from zeroset.export.mesh_files import mesh_format

    mesh_format(output)
    return existing_folder(output)


def _tell(made: Mesh, path: Path, spent: float) -> None:
    closed = f"watertight, volume {abs(made.volume):.6g}" if made.watertight else "open"
    size = f"{len(made.vertices):,} vertices, {len(made.faces):,} triangles"
    click.echo(f"{path}: {size}, {closed}, area {made.area:.6g}, {spent * 1e3:.0f} ms")
    if made.watertight and made.volume < 0:
        # Printers and viewers take the side that normals point to for the outside.
        click.echo("its faces look inwards, for f is positive inside: turn the formula's sign around", err=True)
