"""Shadows: one search a lit point and light (SN10 section 5.2, K09 section 6.2).

Along polynomials of low degree the ray from the point to the light is looked over first (``solve.clipping``): mostly
that shows at once that it is free, or that f has the other sign somewhere on it, which is as good as a root. What is
left of it, and rays through other formulas, from the light to the point, are searched. Nothing has to be moved off the
surface by hand: rays keep off the point by some tolerances, and finding that there is something is all that is wanted,
so the tolerance may be far coarser than the picture's. A point is lit where the way is proven to be free.
"""

from __future__ import annotations

from collections.abc import Sequence

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.kernel import BOOL, F32, F64, U32, Kernel, KernelBuilder, Value, constant, if_, load, store
from zeroset.rendering.buffers import LIT, NORMAL
from zeroset.rendering.layout import pixel_coordinates
from zeroset.rendering.view import pixel_ray
from zeroset.scene.clip import clip
from zeroset.shade.reflectance import dot
from zeroset.solve.body import LoweredBody
from zeroset.solve.clipping import can_clip, looked_over
from zeroset.solve.field import Ray
from zeroset.solve.problem import Problem
from zeroset.solve.search import search
from zeroset.solve.shape import Shape
from zeroset.solve.status import MISS
from zeroset.solve.subject import Subject
from zeroset.solve.systems import automatic_system
from zeroset.solve.walk import Striding

FORMATS = {F32: FORMAT32, F64: FORMAT64}
CLEAR = 2.0
"""Tolerances around the point that are not searched."""


def shadow_kernel(shape: Shape, offset: bool, exact: bool = False) -> Kernel:
    """One light; sets the light's ``bit`` of each point that it reaches.

    ``exact``: whether it searches in f64, which is for formulas with numbers that are too large for f32.

    Uniforms beside the frame's own: ``light_x``, ``light_y``, ``light_z``, ``light_w``: the light's place with w = 1,
    with w = 0 a way towards it that leads out of the bounds from anywhere; ``shadow_tolerance``, a length; ``bit``.
    """
    with KernelBuilder("shadow") as builder:
        lane = builder.index()
        subject = Subject(shape, builder, F64 if exact else F32, offset)
        ray = pixel_ray(builder, *pixel_coordinates(builder, lane))
        hit = load(builder.buffer("status", U32), lane).ne(MISS)
        (free,) = if_(hit, lambda: (_is_lit(builder, subject, ray, lane),), lambda: (False,))
        lit = builder.buffer(LIT, U32, writable=True)
        reached = free.select(builder.uniform("bit", U32), constant(0, U32))
        store(lit, lane, load(lit, lane) | reached)
    return builder.kernel


def _is_lit(builder: KernelBuilder, subject: Subject, ray: Ray, lane: Value) -> Value:
    """Whether the light reaches what a lane's ray has met."""
    t = load(builder.buffer("t", F32), lane)
    point = [t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
    place, near = [builder.uniform(f"light_{axis}", F32) for axis in "xyz"], builder.uniform("light_w", F32)
    toward = [p - x * near for p, x in zip(place, point, strict=True)]
    normal = [load(builder.buffer(name, F32), lane) for name in NORMAL]
    # A side that is turned away from the light is dark by itself; a point without a normal faces everything.
    turned = dot(normal, toward) * dot(normal, ray.direction) > 0.0
    return way_is_free(subject, point, toward, ~turned)


def way_is_free(subject: Subject, point: Sequence[Value], toward: Sequence[Value], wanted: Value) -> Value:
    """Whether it is proven that nothing lies between a light and a point.

    Args:
        subject: all that throws shadows; its kernel has the uniform ``shadow_tolerance``.
        point: on the surface.
        toward: from there to the light.
        wanted: lanes that ask; the others search nothing.
    """
    (free,) = if_(wanted, lambda: (_free(subject, point, toward),), lambda: (False,))
    return free


def _free(subject: Subject, point: Sequence[Value], toward: Sequence[Value]) -> Value:
    length = dot(toward, toward).maximum(1e-30).sqrt()
    tolerance = subject.builder.uniform("shadow_tolerance", F32) / length
    free: Value | None = None
    for body in subject.bodies:
        # What one body hides no other one needs to be searched for.
        asked = constant(True, BOOL) if free is None else free
        clear = _free_of(body, point, toward, tolerance, asked)
        free = clear if free is None else free & clear
    assert free is not None
    return free


def _free_of(
    body: LoweredBody, point: Sequence[Value], toward: Sequence[Value], tolerance: Value, asked: Value
) -> Value:
    """Whether nothing of one body lies between a light and a point."""
    system = automatic_system(body.body if not body.body.plain else body.first.field, FORMATS[body.type])
    own = None if body.body.plain else body
    point, toward = ([v.convert(body.type) for v in vector] for vector in (point, toward))
    tolerance = tolerance.convert(body.type)

    def problem(ray: Ray, first: Value, last: Value) -> Problem:
        start, end = clip(body.builder, body.body.kind, ray.origin, ray.direction, body.body.prefix)
        start, end = start.maximum(first), end.minimum(last)
        return Problem(body.first, ray, start, end, tolerance, (end - start) * 0.125, own)

    zero, one, gap = constant(0.0, body.type), constant(1.0, body.type), tolerance * CLEAR
    away = problem(Ray(tuple(point), tuple(toward)), gap, one)
    if can_clip(away):
        rest, hidden = looked_over(away, asked)
        return ~hidden & search(rest, system, Striding(), asked & ~hidden).status.eq(MISS)
    way = Ray(tuple(x + v for x, v in zip(point, toward, strict=True)), tuple(-v for v in toward))
    return search(problem(way, zero, one - gap), system, Striding(), asked).status.eq(MISS)
