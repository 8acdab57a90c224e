"""``cast``: rays that the caller brings, answered with t, status, normal and steps."""

from __future__ import annotations

import math
import operator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.errors import ArrayShapeError, ParameterError
from zeroset.kernel.types import F32
from zeroset.rendering.buffers import PART
from zeroset.rendering.drawn import as_drawn
from zeroset.rendering.materials import opaque_parts
from zeroset.rendering.render import world_tolerance
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import Device, get_device
from zeroset.scene.scene import Shown, as_scene
from zeroset.solve import Method, resolve_method
from zeroset.solve.names import OPAQUE
from zeroset.solve.status import MISS

MOST_HITS = 1024
"""Hits that one ray may be asked for."""
FARTHEST = 1e30
"""What stands for an infinite t: kernels know no infinity."""


@dataclass(frozen=True)
class Hits:
    """What rays found, N of them; after ``cast(..., max_hits=n)`` each shape has n after N, in order along the ray.

    Attributes:
        t: (N,) float32, distance in units of \\|direction\\|; nan where nothing is hit.
        status: (N,) uint8: MISS 0, HIT 1, UNRESOLVED 2.
        normal: (N, 3) float32, unit gradient at the hit, towards growing f; zero where there is none.
        steps: (N,) uint32, evaluations of f or of its extension.
        certified: whether the method proves its answers.
        part: (N,) uint32, which of several surfaces, isovalues (in rising order) or surfaces of a solid was met; 0
            where there is one alone, and on misses.
    """

    t: npt.NDArray[np.float32]
    status: npt.NDArray[np.uint8]
    normal: npt.NDArray[np.float32]
    steps: npt.NDArray[np.uint32]
    certified: bool
    part: npt.NDArray[np.uint32]

    def __len__(self) -> int:
        return len(self.t)


def cast(
    surface: Shown,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    t_min: float = 0.0,
    t_max: float = math.inf,
    method: str | Method = "auto",
    device: str | Device = "auto",
    tolerance: float | None = None,
    max_hits: int | None = None,
) -> Hits:
    """Cast rays at a surface, a solid or a scene and give each one's first hits inside the bounds.

    Args:
        surface: what to hit.
        origins: (N, 3) or (3,) for one origin of all rays; rounded to float32.
        directions: (N, 3) or (3,), of any length but 0; rounded to float32.
        t_min: where the rays start.
        t_max: where they end.
        method: a name or an instance of a method.
        device: where to run.
        tolerance: world length to which roots are found; None takes 2^-14 of the bounds' extent.
        max_hits: how many hits a ray may have, in order along it; None gives the first one alone. Roots closer to each
            other than the tolerance, or than 2^-22 of t, are one hit.

    Returns:
        The hits; with ``max_hits`` each array has a second axis of that length, filled up with misses. A search that
        gives up after 32,768 evaluations ends its ray's list with an unresolved hit: what lies behind it is not known.

    Raises:
        ArrayShapeError: wrong shapes, non-finite numbers, or a direction of length 0.
        ParameterError: a tolerance, t_min, t_max or max_hits that cannot be used.
        MethodError: the method cannot treat this surface.

    Example:
        >>> import zeroset as zs
        >>> ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5)
        >>> hits = zs.cast(ball, [0, 0, 5], [[0, 0, -1], [0, 1, 0]])
        >>> hits.status.tolist(), bool(abs(hits.t[0] - 4) < 1e-3)
        ([1, 0], True)
        >>> zs.cast(ball, [0, 0, 5], [[0, 0, -1], [0, 1, 0]], max_hits=3).status.tolist()
        [[1, 1, 0], [0, 0, 0]]
    """
    most = _most(max_hits)
    chosen = resolve_method(method)
    scene = as_scene(surface)
    shown = as_drawn(scene.surface)
    shown.check(chosen)
    shown = shown.with_fitted_bounds()
    target = get_device(device)
    starts, ways = _rays(origins, directions)
    uniforms = shown.limits() | shown.parameters(chosen)
    uniforms |= {
        "tolerance": world_tolerance(tolerance, shown.smallest),
        "near": _end(t_min, "t_min"),
        "far": _end(t_max, "t_max"),
        OPAQUE: opaque_parts(scene.materials),
    }
    tracer = Tracer(shown, chosen, target, pixels=False, layered=most is not None)
    buffers = tracer.buffers(len(starts), 0) | _ray_buffers(target, starts, ways)
    bound = tracer.begin(shown, uniforms, buffers, 0)
    if most is not None:
        found = tracer.layers(shown, uniforms, bound, len(starts), most)
        return _in_layers([_hits(target, layer, chosen.certified) for layer in found])
    tracer.first_look(uniforms, bound, 0, len(starts))
    tracer.second_look(shown, uniforms, bound)
    return _hits(target, buffers, chosen.certified)


def _most(max_hits: int | None) -> int | None:
    if max_hits is None:
        return None
    try:
        most = operator.index(max_hits)
    except TypeError:
        raise ParameterError(f"max_hits must be a whole number, not {max_hits!r}") from None
    if not 1 <= most <= MOST_HITS:
        raise ParameterError(f"max_hits must be from 1 to {MOST_HITS}, not {max_hits!r}")
    return most


def _in_layers(layers: list[Hits]) -> Hits:
    """Hits of several layers as arrays with a second axis."""
    names = ("t", "status", "normal", "steps", "part")
    t, status, normal, steps, part = (np.stack([getattr(layer, name) for layer in layers], axis=1) for name in names)
    return Hits(t, status, normal, steps, layers[0].certified, part)


def _end(t: float, what: str) -> float:
    """An end of the rays as kernels take it; infinity becomes ``FARTHEST``."""
    try:
        value = float(t)
    except (TypeError, ValueError, OverflowError):
        raise ParameterError(f"{what} must be a number, not {t!r}") from None
    if math.isnan(value):
        raise ParameterError(f"{what} must be a number, not nan")
    return min(max(value, -FARTHEST), FARTHEST)


def _rays(origins: npt.ArrayLike, directions: npt.ArrayLike) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    starts, ways = _points(origins, "origins"), _points(directions, "directions")
    if len(starts) != len(ways):
        if 1 not in (len(starts), len(ways)):
            raise ArrayShapeError(
                f"there are {len(starts)} origins but {len(ways)} directions",
                hint="give as many of both, or one of either",
            )
        starts, ways = np.broadcast_arrays(starts, ways)
    lengths = np.max(np.abs(ways), axis=1) if len(ways) else np.ones(0)
    if np.any(lengths < 1e-15) or np.any(lengths > 1e15):
        bad = int(np.flatnonzero((lengths < 1e-15) | (lengths > 1e15))[0])
        what = "zero" if lengths[bad] == 0 else "too short or too long"
        raise ArrayShapeError(
            f"direction {bad} is {what}: {ways[bad].tolist()}", hint="directions may have any length from 1e-15 to 1e15"
        )
    return starts, ways


def _points(values: npt.ArrayLike, what: str) -> npt.NDArray[np.float32]:
    try:
        exact = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ArrayShapeError(f"{what} must be numbers") from None
    if exact.ndim == 1 and exact.shape == (3,):
        exact = exact[None, :]
    if exact.ndim != 2 or exact.shape[1] != 3:
        raise ArrayShapeError(f"{what} must have the shape (N, 3), not {exact.shape}")
    bad = np.flatnonzero(~np.all(np.abs(exact) < 1e30, axis=1))
    if len(bad):
        wanted = "below 1e30 in size" if np.all(np.isfinite(exact[bad[0]])) else "finite"
        raise ArrayShapeError(f"{what} must be {wanted}: number {bad[0]} is {exact[bad[0]].tolist()}")
    return exact.astype(np.float32)


def _ray_buffers(device: Device, starts: npt.NDArray[np.float32], ways: npt.NDArray[np.float32]) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for name, data in (("o", starts), ("d", ways)):
        for i, axis in enumerate("xyz"):
            made[f"{name}{axis}"] = device.allocate(F32, len(data))
            device.write(made[f"{name}{axis}"], np.ascontiguousarray(data[:, i]))
    return made


def _hits(device: Device, buffers: dict[str, Any], certified: bool) -> Hits:
    read = {name: device.read(buffers[name]) for name in ("t", "nx", "ny", "nz", "status", "steps")}
    status = read["status"].astype(np.uint8)
    t = np.where(status == MISS, np.float32(np.nan), read["t"])
    normal = np.stack([read["nx"], read["ny"], read["nz"]], axis=-1)
    part = device.read(buffers[PART]).copy() if PART in buffers else np.zeros(len(t), np.uint32)
    return Hits(t, status, normal, read["steps"].copy(), certified, part)
