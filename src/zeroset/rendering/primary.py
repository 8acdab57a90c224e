"""The kernels that find surfaces: one ray a pixel, rays that a caller brings, and second looks.

A second look is for rays that a certified method left unresolved in f32, mostly because rounding hid a sign, and for
hits where f is so flat that no slope has proven them, nor tells a normal: the same ray is searched again in f64, from
where the first search had proven it clear. It goes to the few rays on the list alone.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.kernel import F32, F64, U32, Kernel, KernelBuilder, Value, constant, if_, load
from zeroset.rendering.buffers import SECOND, Ends
from zeroset.rendering.front import ask_for_thin
from zeroset.rendering.gbuffer import ask_second_look, write, write_ends
from zeroset.rendering.layout import pixel_coordinates, tile_of
from zeroset.rendering.stages import RESOLUTION, in_stages
from zeroset.rendering.view import pixel_ray
from zeroset.scene.clip import clip
from zeroset.solve.body import LoweredBody
from zeroset.solve.field import Ray
from zeroset.solve.method import Method
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.search import search
from zeroset.solve.shape import Shape
from zeroset.solve.status import HIT, UNRESOLVED
from zeroset.solve.subject import Subject
from zeroset.solve.systems import automatic_system
from zeroset.solve.walk import Striding

FINER = 2.0**-12
"""Tolerance of a second look as a part of the first one's."""
ROOM = 2.0**-4
"""Tolerances that a second look in a picture may go on for behind the bounds: ``HAZE`` of its own, and some more."""
COARSE = 4.0
"""Tolerances that a find may be off by."""


def camera_ray(builder: KernelBuilder, lane: Value) -> Ray:
    """The ray of a lane's pixel."""
    return pixel_ray(builder, *pixel_coordinates(builder, lane))


def given_ray(builder: KernelBuilder, lane: Value) -> Ray:
    """The ray that the caller gave at this place."""
    origin, direction = (tuple(load(builder.buffer(f"{name}{axis}", F32), lane) for axis in "xyz") for name in "od")
    return Ray(origin, direction)


def problem_on(
    body: LoweredBody, ray: Ray, near: Value, far: Value, step: Value | None, strict: bool = False
) -> Problem:
    """The search inside the bounds, from near to far; a step of an eighth of the stretch where none is given."""
    builder = body.builder
    t0, t1 = clip(builder, body.body.kind, ray.origin, ray.direction, body.body.prefix)
    t0, t1 = t0.maximum(near), t1.minimum(far)
    tolerance = tolerance_at(builder, ray, abs(t0).maximum(abs(t1)))
    step = (t1 - t0) * 0.125 if step is None else step
    asked = _asked(builder, ray) if strict else None
    return Problem(body.first, ray, t0, t1, tolerance, step, None if body.body.plain else body, strict, asked)


def tolerance_at(builder: KernelBuilder, ray: Ray, t: Value) -> Value:
    """The tolerance around a place; one below t's own resolution would ask for steps that do not move."""
    return _asked(builder, ray).maximum(abs(t) * RESOLUTION[F32])


def tracing(method: Method) -> Callable[[Problem], Answer]:
    """A method's search, stage by stage where all of a ray shall be known as closely as was asked for."""
    return staged(method.trace) if method.certified else method.trace


def staged(trace: Callable[[Problem], Answer]) -> Callable[[Problem], Answer]:
    """A certified search, stage by stage where a tolerance has been asked for."""
    return lambda problem: trace(problem) if problem.asked is None else in_stages(problem, trace)


def _asked(builder: KernelBuilder, ray: Ray) -> Value:
    """The tolerance in units of the ray's t."""
    d = ray.direction
    return builder.uniform("tolerance", F32) / d[0].fma(d[0], d[1].fma(d[1], d[2] * d[2])).sqrt()


def as_fine_as_asked(builder: KernelBuilder, ray: Ray, answer: Answer) -> Answer:
    """The answer of a search in f32, with what lies so far away that f32 cannot keep the tolerance as unresolved."""
    coarse = abs(answer.t) * RESOLUTION[F32] > _asked(builder, ray) * COARSE
    rough = coarse & answer.status.eq(HIT)
    return answer._replace(status=rough.select(constant(UNRESOLVED, U32), answer.status))


def t_range(builder: KernelBuilder) -> tuple[Value, Value]:
    """The stretch of t that holds the bounds for every ray of the frame."""
    return builder.uniform("near", F32), builder.uniform("far", F32)


def trace_kernel(shape: Shape, method: Method, pixels: bool, beams: bool, second: bool, ends: Ends = ()) -> Kernel:
    """One search a ray.

    Args:
        shape: what is searched.
        method: how to search.
        pixels: whether rays are the camera's.
        beams: whether a ray starts where its tile's beam ended.
        second: whether it may ask for a second look.
        ends: which places around a find are kept, for rays that go on.
    """
    with KernelBuilder("primary" if pixels else "cast") as builder:
        lane = builder.index() + builder.uniform("first", U32)
        subject = Subject(shape, builder, offset=method.offset != 0.0)
        ray = camera_ray(builder, lane) if pixels else given_ray(builder, lane)
        near, far = t_range(builder)
        step = None
        if beams:
            tile = tile_of(lane)
            near = load(builder.buffer("tile_start", F32), tile)
            step = load(builder.buffer("tile_step", F32), tile)
        answer = subject.nearest(lambda body: problem_on(body, ray, near, far, step, not pixels), tracing(method))
        if method.certified:
            answer = as_fine_as_asked(builder, ray, answer)
        write(builder, subject, lane, ray, answer, ends)
        if second:
            ask_second_look(builder, lane, answer, blunt=True)
        if beams:
            ask_for_thin(builder, lane, near)
    return builder.kernel


def second_kernel(shape: Shape, offset: bool, pixels: bool, ends: Ends = (), beams: bool = False) -> Kernel:
    """The rays on the list again, in f64; ``beams``: what they are shown to miss may be thinner than a pixel.

    Uniform: ``listed``, where on the list the run begins.
    """
    with KernelBuilder("second") as builder:
        place = builder.index() + builder.uniform("listed", U32)
        lane, clear = (load(builder.buffer(name, type_), place) for name, type_ in SECOND.items())
        subject = Subject(shape, builder, F64, offset)
        ray = camera_ray(builder, lane) if pixels else given_ray(builder, lane)
        near, far = t_range(builder)
        answer = subject.nearest(
            lambda body: in_doubles(body, problem_on(body, ray, near, far, None, not pixels), clear), staged(stride)
        )
        # What f32 has proven stays. Even where f64 leaves it open, it comes closer to a double root than f32 could.
        proven = load(builder.buffer("status", U32, writable=True), lane).eq(HIT)
        spent = load(builder.buffer("steps", U32, writable=True), lane) + answer.steps
        better = answer._replace(steps=spent)
        if_(~proven | answer.status.eq(HIT), lambda: write(builder, subject, lane, exact_ray(ray), better))
        # Rays that go on do so in f32, which needs the room that it had left around its own find.
        if_(~proven, lambda: write_ends(builder, lane, better, ends))
        if beams:
            ask_for_thin(builder, lane, load(builder.buffer("tile_start", F32), tile_of(lane)))
    return builder.kernel


def stride(problem: Problem, leaving: Value | None = None) -> Answer:
    """The search that all but the primary rays take; ``leaving``: lanes whose rays come from a surface."""
    return search(problem, automatic_system(problem.field, problem.fmt), Striding(), leaving=leaving)


def exact_ray(ray: Ray) -> Ray:
    """The same ray in f64."""
    return Ray(tuple(v.convert(F64) for v in ray.origin), tuple(v.convert(F64) for v in ray.direction))


def in_doubles(body: LoweredBody, rough: Problem, clear: Value) -> Problem:
    """The search that got stuck in f32, once more in f64 and in finer steps.

    Args:
        body: what is searched, in f64.
        rough: the search of it in f32.
        clear: up to where it had proven that there is nothing.
    """
    ray, around, tolerance = exact_ray(rough.ray), rough.tolerance, rough.tolerance.convert(F64)
    if rough.asked is not None:
        # What f32 can tell at the ray's far end says nothing of how closely a place is to be looked at.
        around, tolerance = tolerance_at(body.builder, rough.ray, clear), rough.asked.convert(F64)
    # A little earlier than where the first look got stuck, to learn the sign that f has there.
    earlier = (clear - around * 8.0).maximum(rough.t0)
    start, end = earlier.convert(F64), rough.t1.convert(F64)
    # In f32 a ray from far away goes on beyond the bounds by what is rounded of them.
    near, far = clip(body.builder, body.body.kind, ray.origin, ray.direction, body.body.prefix)
    # Where f jumps right at an end, a picture has to see behind it that there was no more than that.
    room = tolerance * (0.0 if rough.strict else ROOM)
    start, end = start.maximum(near - room), end.minimum(far + room)
    # Where f32 could not tell, roots lie closer together than its tolerance: f64 has room for a finer one.
    finer, step = tolerance * FINER, tolerance * 4.0
    asked = None if rough.asked is None else finer
    return Problem(rough.lowered, ray, start, end, finer, step, rough.body, rough.strict, asked)
