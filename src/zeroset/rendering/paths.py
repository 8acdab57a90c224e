"""Rays beyond the first hit: what is seen through a surface, in it, and around it.

Each hit adds its own colour to its pixel and may send on two rays, mirrored and transmitted, which wait in a queue. One
run of the same kernel takes a whole queue: it searches, shades, and fills the next one. So reflections, refraction and
layers of transparency are one thing, in any order, and a run is as large as the rays that are left.

A mirrored or bent ray starts where the search proved its own ray clear before the hit, or where it had the hit behind
it: nothing has to be moved off the surface by hand. A straight one goes on along the same ray. Colours are added up as
whole numbers, so that the order in which lanes come does not matter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from zeroset.kernel import BOOL, F32, U32, Kernel, KernelBuilder, Value, atomic, constant, for_, if_, load, store
from zeroset.rendering.buffers import (
    ACCUMULATED,
    COUNTERS,
    END,
    LIGHT_WORDS,
    LIGHTS,
    NORMAL,
    PART,
    QUEUE_WORDS,
    QUEUED,
    QUEUEING,
    TEXELS,
    VALUE,
)
from zeroset.rendering.gbuffer import behind, meet
from zeroset.rendering.layout import pixel_coordinates, pixel_place
from zeroset.rendering.materials import material_at
from zeroset.rendering.primary import problem_on, stride
from zeroset.rendering.quantity import Measure, Met
from zeroset.rendering.shade import by_value
from zeroset.rendering.shading import Optics
from zeroset.rendering.shadow import way_is_free
from zeroset.rendering.tint import Tint
from zeroset.rendering.view import pixel_ray
from zeroset.shade.environment import cube_color
from zeroset.shade.reflectance import Face, dot, face, normalised
from zeroset.shade.tone import encode, pack
from zeroset.solve.clipping import clipped
from zeroset.solve.field import Ray
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.shape import Shape
from zeroset.solve.status import MISS
from zeroset.solve.subject import Subject

UNIT = float(1 << 20)
"""What a full channel counts in a pixel's sum; 4,096 times as much fits."""
BRIGHTEST = 1024.0
FAINTEST = 1.0 / 512
"""Weight under which a ray is not followed."""


@dataclass(frozen=True, slots=True)
class Found:
    """What a ray met.

    Attributes:
        hit: whether it met anything.
        t: where.
        normal: unit gradient.
        clear: nothing was met up to here.
        end: what was met is behind the ray here.
        part: which part it is, where there is more than one.
        value: what it is coloured by; None where it is not.
    """

    hit: Value
    t: Value
    normal: Sequence[Value]
    clear: Value
    end: Value
    part: Value | None = None
    value: Value | None = None


@dataclass(frozen=True, slots=True)
class _Carried:
    """A ray with what it means for a pixel."""

    pixel: Value
    ray: Ray
    start: Value
    weight: tuple[Value, Value, Value]


def first_path_kernel(shape: Shape, offset: bool, optics: Optics, colored: bool = False) -> Kernel:
    """Shade what the camera's rays have met, and send on what comes of it."""
    with KernelBuilder("path_first") as builder:
        lane = builder.index()
        ray = pixel_ray(builder, *pixel_coordinates(builder, lane))
        t, clear, end = (load(builder.buffer(name, F32), lane) for name in ("t", *END))
        normal = [load(builder.buffer(name, F32), lane) for name in NORMAL]
        part = load(builder.buffer(PART, U32), lane) if shape.parts > 1 else None
        value = load(builder.buffer(VALUE, F32), lane) if colored else None
        found = Found(load(builder.buffer("status", U32), lane).ne(MISS), t, normal, clear, end, part, value)
        one = constant(1.0, F32)
        respond = _Response(Subject(shape, builder, offset=offset), optics, alone=True)
        respond.to(_Carried(lane, ray, constant(0.0, F32), (one, one, one)), found)
    return builder.kernel


def path_kernel(shape: Shape, offset: bool, optics: Optics, tint: Tint | None = None) -> Kernel:
    """One run: the rays of a queue are traced and shaded, and what they send on goes to the next queue."""
    with KernelBuilder("path") as builder:
        place = builder.index()
        # More rays may have been counted than there was room for.
        # Only a plain surface is coloured by a quantity.
        field = shape.bodies[0].leaves[0][0].field
        measure = None if tint is None else Measure(builder, field, offset, tint)
        room = place < builder.uniform("capacity", U32)
        if_(room, lambda: _follow(builder, place, (shape, offset), optics, measure))
    return builder.kernel


def _follow(
    builder: KernelBuilder, place: Value, traced: tuple[Shape, bool], optics: Optics, measure: Measure | None
) -> None:
    shape, offset = traced
    queue = builder.buffer(QUEUED, U32)
    words = [load(queue, place * QUEUE_WORDS + i) for i in range(QUEUE_WORDS - 1)]
    numbers = [word.bitcast(F32) for word in words[1:]]
    ray = Ray(tuple(numbers[:3]), tuple(numbers[3:6]))
    start, weight = numbers[6], (numbers[7], numbers[8], numbers[9])
    subject = Subject(shape, builder, offset=offset)
    farthest = builder.uniform("farthest", F32)

    def ahead(problem: Problem) -> Answer:
        return stride(clipped(problem)[0])

    answer = subject.nearest(lambda body: problem_on(body, ray, start, farthest, None), ahead)
    hit = answer.status.ne(MISS)
    zero = constant(0.0, F32)
    nothing = (zero, zero, zero, *([] if shape.parts == 1 else [constant(0, U32)]))
    normal = if_(hit, lambda: meet(subject, ray, answer), lambda: nothing)
    part, value = normal[3] if shape.parts > 1 else None, None
    if measure is not None:
        met, known = Met(ray, answer.t, answer.steps), measure
        (value,) = if_(hit, lambda: (known.at(met),), lambda: (zero,))
    respond = _Response(subject, optics)
    found = Found(hit, answer.t, normal[:3], answer.clear, behind(answer), part, value)
    respond.to(_Carried(words[0], ray, start, weight), found)


class _Response:
    """What comes of a ray: colour for its pixel, and further rays."""

    def __init__(self, subject: Subject, optics: Optics, alone: bool = False) -> None:
        # Whether no other lane of this run has the same pixel.
        self.alone = alone
        self.builder = subject.builder
        self.subject = subject
        self.optics = optics

    def uniform(self, name: str) -> Value:
        return self.builder.uniform(name, F32)

    def to(self, carried: _Carried, found: Found) -> None:
        """Emit it."""
        if_(found.hit, lambda: self._at(carried, found), lambda: self._add(carried, self._sky(carried.ray.direction)))

    def _sky(self, direction: Sequence[Value]) -> Sequence[Value]:
        if self.optics.sky:
            return cube_color(self.builder.buffer(TEXELS, F32), self.builder.uniform("face_side", U32), direction)
        return [self.uniform(f"sky_{c}") for c in "rgb"]

    def _add(self, carried: _Carried, color: Sequence[Value]) -> None:
        sums, plane = self.builder.buffer(ACCUMULATED, U32, writable=True), self.builder.uniform("plane", U32)
        for i, (c, w) in enumerate(zip(color, carried.weight, strict=True)):
            amount = ((c * w).maximum(0.0).minimum(BRIGHTEST) * UNIT + 0.5).floor().convert(U32)
            place = carried.pixel + plane * i
            if self.alone:
                store(sums, place, load(sums, place) + amount)
            else:
                atomic("add", sums, place, amount)

    # ---------------------------------------------------------- at a hit

    def _at(self, carried: _Carried, found: Found) -> None:
        ray, optics = carried.ray, self.optics
        point = [found.t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
        toward_eye = [-d for d in normalised(ray.direction)]
        number = material_at(self.builder, found.part)
        albedo = None if found.value is None else by_value(self.builder, found.value)
        seen = face(number, found.normal, toward_eye, albedo)
        color = self._lights(point, seen)
        opacity = number("opacity") if optics.through else constant(1.0, F32)
        mirror = number("reflectance") if optics.mirror else constant(0.0, F32)
        passing = (1.0 - opacity) * (1.0 - mirror)
        self._add(carried, [c * (opacity * (1.0 - mirror)) for c in color])
        if optics.bends:
            bent, total = self._bent(number("ior"), found.normal, toward_eye, seen.normal)
            mirror, passing = total.select(mirror + passing, mirror), total.select(0.0, passing)
            self._send(carried, self._from(carried, found.end, bent), passing)
        elif optics.through:
            self._send(carried, replace(carried, start=found.end), passing)
        if optics.mirror or optics.bends:
            cosine = dot(seen.normal, toward_eye)
            mirrored = [n * (cosine * 2.0) - e for n, e in zip(seen.normal, toward_eye, strict=True)]
            self._send(carried, self._from(carried, found.clear, mirrored), mirror)

    def _lights(self, point: Sequence[Value], seen: Face) -> Sequence[Value]:
        data = self.builder.buffer(LIGHTS, F32)

        def one(i: Value, *color: Value) -> tuple[Value, ...]:
            x, y, z, near, *tint = (load(data, i * LIGHT_WORDS + k) for k in range(LIGHT_WORDS - 1))
            toward = [p - q * near for p, q in zip((x, y, z), point, strict=True)]
            light = normalised(toward)
            if self.optics.shadows:
                facing = dot(seen.normal, light) > 0.0
                reached = way_is_free(self.subject, point, toward, facing)
                tint = [reached.select(c, 0.0) for c in tint]
            lit: tuple[Value, ...] = seen.lit(color, light, tint)
            return lit

        return for_(self.builder.uniform("lights", U32), one, *seen.ambient)

    def _bent(
        self, index: Value, normal: Sequence[Value], toward_eye: Sequence[Value], seen: Sequence[Value]
    ) -> tuple[list[Value], Value]:
        """The refracted direction by Snell's law, and where there is none but total reflection."""
        # Solid is where f < 0: a ray that sees the side towards growing f goes in.
        entering = dot(normal, toward_eye) >= 0.0
        ratio = entering.select(1.0 / index, index)
        cosine = dot(seen, toward_eye)
        rest = 1.0 - ratio * ratio * (1.0 - cosine * cosine)
        along = ratio * cosine - rest.maximum(0.0).sqrt()
        return [n * along - e * ratio for n, e in zip(seen, toward_eye, strict=True)], rest < 0.0

    def _from(self, carried: _Carried, t: Value, direction: Sequence[Value]) -> _Carried:
        """A ray from a place on another."""
        ray = carried.ray
        origin = tuple(t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True))
        return replace(carried, ray=Ray(origin, tuple(direction)), start=constant(0.0, F32))

    def _send(self, carried: _Carried, onward: _Carried, share: Value) -> None:
        """Put a ray on the next queue; where it is too faint, too late or there is no room, it sees the sky."""
        r, g, b = (w * share for w in carried.weight)
        weight = (r, g, b)
        onward = replace(onward, weight=weight)
        strongest = weight[0].maximum(weight[1]).maximum(weight[2])
        go_on = (strongest >= FAINTEST) & self.builder.uniform("goes_on", U32).ne(0)
        counters = self.builder.buffer(COUNTERS, U32, writable=True)

        def put() -> tuple[Value, ...]:
            slot = atomic("add", counters, self.builder.uniform("next", U32), 1)
            room = slot < self.builder.uniform("capacity", U32)
            if_(room, lambda: self._store(slot, onward))
            return (room,)

        (kept,) = if_(go_on, put, lambda: (constant(False, BOOL),))
        if_(~kept & (strongest > 0.0), lambda: self._add(onward, self._sky(onward.ray.direction)))

    def _store(self, slot: Value, onward: _Carried) -> None:
        queue = self.builder.buffer(QUEUEING, U32, writable=True)
        numbers = (*onward.ray.origin, *onward.ray.direction, onward.start, *onward.weight)
        store(queue, slot * QUEUE_WORDS, onward.pixel)
        for i, number in enumerate(numbers):
            store(queue, slot * QUEUE_WORDS + i + 1, number.bitcast(U32))


def resolve_kernel(marked: bool) -> Kernel:
    """From sums to the picture's bytes; ``marked``: only of pixels whose sums were begun anew."""
    with KernelBuilder("resolve") as builder:
        lane = builder.index()
        sums = builder.buffer(ACCUMULATED, U32)
        plane = builder.uniform("plane", U32)
        color = [encode(load(sums, lane + plane * i).convert(F32) * (1.0 / UNIT)) for i in range(3)]
        column, row = pixel_place(builder, lane)
        width = builder.uniform("width", U32)
        inside = (column < width) & (row < builder.uniform("height", U32))
        if marked:
            inside = inside & load(sums, lane + plane * 3).ne(0)
        rgba = builder.buffer("rgba", U32, writable=True)
        packed = pack(color)
        if_(inside, lambda: store(rgba, row * width + column, packed))
    return builder.kernel
