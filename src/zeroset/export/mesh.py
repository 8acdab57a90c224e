"""``mesh``: a surface becomes triangles."""

from __future__ import annotations

import operator
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from zeroset.errors import BoundsError, DeviceError, ParameterError, did_you_mean
from zeroset.export.marching.extract import Pieces, extract
from zeroset.export.marching.lattice import Lattice, make_lattice
from zeroset.export.marching.programs import Programs
from zeroset.export.marching.rim import cut_at_rim
from zeroset.export.marching.roots import BEYOND, WITHIN
from zeroset.export.marching.weld import Indices, compact, torn, weld
from zeroset.export.triangles import Mesh, doubled_normals, joined
from zeroset.kernel.types import F32, F64, Type
from zeroset.rendering.frame import part_of
from zeroset.runtime import Device, get_device
from zeroset.scene.bounds import Ball
from zeroset.scene.plain import plain_surfaces
from zeroset.scene.scene import Shown, as_scene
from zeroset.scene.surface import Surface

FEWEST, MOST = 2, 1024
"""Cells along the longest side of the bounds."""
PRECISIONS = ("auto", "f32", "f64")


def mesh(
    surface: Shown,
    resolution: int = 128,
    cap: bool = False,
    device: str | Device = "auto",
    precision: str = "auto",
    progress: Callable[[float], None] | None = None,
) -> Mesh:
    """Triangles on a surface, by marching tetrahedra; every vertex is moved to a root of f.

    Of a solid the skin is meshed, as one f; its edges are as sharp as the cells are small. Several surfaces, or
    isovalues, become one mesh that is not joined where they cross; those of them that are empty are left out.

    Args:
        surface: a Surface, a Solid, a sequence of both, a Scene, or a formula as text.
        resolution: cells along the longest side of the bounds. What is smaller than a cell may be lost.
        cap: close the mesh where the bounds cut the surface, as the solid f <= 0 inside them. Otherwise it ends there
            in a clean edge. A surface that is closed inside its bounds gives a watertight mesh either way.
        device: ``"auto"``, ``"cpu"``, ``"gpu"``, ``"interp"``, or a Device.
        precision: what f is evaluated in: ``"f32"``, ``"f64"``, or ``"auto"`` for f64 where the device has it.
        progress: called now and then with the share that is done, from 0 to 1.

    Raises:
        ParameterError: a resolution or precision that cannot be used.
        BoundsError: there is no surface inside the bounds.
        DeviceError: the device does not have this precision.

    Example:
        >>> import zeroset as zs
        >>> torus = zs.mesh(zs.surface("(x^2 + y^2 + z^2 + 3/4)^2 = 4(x^2 + y^2)", bounds=1.6), resolution=24)
        >>> torus.watertight, len(torus.vertices) - len(torus.faces) // 2
        (True, 0)
    """
    cells = _resolution(resolution)
    target = get_device(device)
    type_ = _precision(precision, target)
    things = plain_surfaces(as_scene(surface).surface)
    made, nothing = [], None
    for i, thing in enumerate(things):
        try:
            made.append(_meshed(thing, cells, bool(cap), target, type_, part_of(progress, i, len(things))))
        except BoundsError as error:
            nothing = error
    if nothing is not None and not made:
        raise nothing
    if progress is not None:
        progress(1.0)
    return joined(made)


def _meshed(
    shown: Surface, cells: int, cap: bool, target: Device, type_: Type, progress: Callable[[float], None] | None
) -> Mesh:
    """The mesh of one f = 0; raises ``BoundsError`` where there is nothing."""
    shown.check_work()
    programs = Programs(shown, target, cap, type_)
    lattice = make_lattice(shown.fitted, cells, cap)
    if progress is not None:
        progress(0.0)
    pieces = extract(programs, lattice, progress)
    if torn(pieces, cap):
        pieces = extract(programs, lattice, progress, exclude=False)
    result = _assembled(programs, lattice, pieces)
    if not len(result.faces):
        raise _nothing(shown, pieces.kinds, cells)
    return result


def _assembled(programs: Programs, lattice: Lattice, pieces: Pieces) -> Mesh:
    """The mesh of all pieces."""
    corners = weld(pieces)
    vertices = pieces.vertices
    if isinstance(programs.surface.fitted, Ball):
        vertices, corners = cut_at_rim(programs, lattice, vertices, pieces.kinds == BEYOND, corners)
    vertices, corners = compact(vertices, corners)
    points = np.ascontiguousarray(vertices[:, :3])
    return Mesh(points, corners.astype(np.uint32), _filled(points, vertices[:, 3:], corners))


def _filled(
    points: npt.NDArray[np.float32], known: npt.NDArray[np.float32], corners: Indices
) -> npt.NDArray[np.float32]:
    """The normals; where f has no gradient, the mean of the triangles around."""
    normals = known.copy()
    missing: npt.NDArray[np.bool_] = np.all(normals == 0, axis=1)
    if missing.any():
        around = corners[missing[corners].any(axis=1)]
        sums = np.zeros((len(points), 3))
        for i in range(3):
            np.add.at(sums, around[:, i], doubled_normals(points, around))
        lengths = np.linalg.norm(sums[missing], axis=1, keepdims=True)
        normals[missing] = np.divide(sums[missing], lengths, out=np.zeros_like(sums[missing]), where=lengths > 0)
    return normals


def _resolution(value: int) -> int:
    try:
        cells = operator.index(value)
    except TypeError:
        raise ParameterError(f"the resolution must be a whole number of cells, not {value!r}") from None
    if not FEWEST <= cells <= MOST:
        raise ParameterError(f"the resolution must be from {FEWEST} to {MOST} cells, not {cells}", hint="try 128")
    return cells


def _precision(value: str, device: Device) -> Type:
    if value not in PRECISIONS:
        hints = (*did_you_mean(str(value), PRECISIONS), f"there are {', '.join(PRECISIONS)}")
        raise ParameterError(f"there is no precision {value!r}", hints=hints)
    if value == "f64" and not device.supports(F64):
        raise DeviceError(f"the device {device.name} does not calculate in f64", hint='use precision="f32"')
    return F64 if value != "f32" and device.supports(F64) else F32


def _nothing(surface: Surface, kinds: npt.NDArray[np.uint32], cells: int) -> BoundsError:
    """Why there is no mesh; ``kinds``: of the roots that edges have, without a triangle between them."""
    touched = bool((kinds == WITHIN).any())
    if len(kinds) and not touched:
        return BoundsError(f"f changes its sign inside {surface.fitted} at poles and bounds alone: there is no surface")
    # A corner of the lattice where f is 0 counts as inside, whatever f does around it.
    does = "is 0 but does not change its sign" if touched else "does not change its sign"
    return BoundsError(
        f"f {does} inside {surface.fitted} on {cells} cells a side: there is nothing to mesh",
        hints=(
            "try other bounds, as in bounds=3.0, or a finer resolution",
            "a mesh is where f changes its sign: of f = g^2 mesh g",
        ),
    )
