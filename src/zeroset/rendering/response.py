"""What comes of a ray where it meets a surface: a colour, and the rays that it goes on as.

Light is reflected by the surface itself, mirrored by it, and let through it, straight on or bent. A mirrored ray starts
where the search proved its own ray clear before the hit, a bent one where it had the hit behind it, both beyond what
rounding their origins may do: no epsilon has to be guessed. A straight one goes on along the same ray.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from zeroset.kernel import F32, U32, Value, constant, for_, if_, load
from zeroset.rendering.buffers import LIGHT_WORDS, LIGHTS, TEXELS
from zeroset.rendering.materials import material_at
from zeroset.rendering.shade import by_value
from zeroset.rendering.shading import Optics
from zeroset.rendering.shadow import way_is_free
from zeroset.shade.environment import cube_color
from zeroset.shade.reflectance import Face, dot, face, normalised
from zeroset.solve.field import Ray
from zeroset.solve.subject import Subject

Color = Sequence[Value]
BRIGHTEST = 1024.0
"""The most that one ray adds to a channel; no number is more than this, and what is none is nothing."""


class Found(NamedTuple):
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


class Backing(NamedTuple):
    """The colour of a surface that is solid where nothing lies behind it.

    Attributes:
        known: whether there is one.
        color: red, green and blue.
    """

    known: Value
    color: Color


class Onward(NamedTuple):
    """A ray that goes on.

    Attributes:
        ray: the ray.
        start: where on it.
        share: of the colour that the ray before it counts for.
        backing: what is seen instead of the surroundings where the ray meets nothing; None for these.
    """

    ray: Ray
    start: Value
    share: Value
    backing: Backing | None = None


class Response:
    """Answers for one kernel's rays.

    Args:
        subject: what they meet.
        optics: what light does.
        exact: the same in f64, where there is one.
    """

    def __init__(self, subject: Subject, optics: Optics, exact: Subject | None = None) -> None:
        self._hiding = subject if exact is None or not subject.shape.large else exact
        self.builder = subject.builder
        self.subject = subject
        self.optics = optics

    def sky(self, direction: Sequence[Value]) -> Color:
        """What a ray sees that meets nothing."""
        if self.optics.sky:
            return cube_color(self.builder.buffer(TEXELS, F32), self.builder.uniform("face_side", U32), direction)
        return [self.builder.uniform(f"sky_{c}", F32) for c in "rgb"]

    def of(self, ray: Ray, start: Value, found: Found) -> tuple[Color, list[Onward]]:
        """The colour of what was met, as much of it as is seen, and at most two rays that go on.

        A ray that is let through comes before one that is mirrored.

        Args:
            ray: the ray.
            start: where on it the search began.
            found: what it met.
        """
        optics = self.optics
        point = [found.t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
        toward_eye = [-d for d in normalised(ray.direction)]
        number = material_at(self.builder, found.part)
        several = None if found.part is None else number
        albedo = None if found.value is None else by_value(self.builder, found.value, several)
        seen = face(number, found.normal, toward_eye, albedo)
        opacity = number("opacity") if optics.through else constant(1.0, F32)
        mirror = number("reflectance") if optics.mirror else constant(0.0, F32)
        passing = (1.0 - opacity) * (1.0 - mirror)
        lit = self._lights(point, seen)
        backing = Backing(number("last_solid") > 0.0, lit) if optics.backed else None
        color = [c * (opacity * (1.0 - mirror)) for c in lit]
        # Before the end of what is clear by the rounding of the new origin, which would put some of them behind the
        # surface; never before the ray's own start.
        before = (found.clear - _blur(ray, found.clear)).maximum(start.minimum(found.clear))
        if not optics.bends:
            straight = [Onward(ray, found.end, passing, backing)] if optics.through else []
            mirrored = [_mirrored(ray, before, seen, toward_eye, mirror)] if optics.mirror else []
            return color, straight + mirrored
        direction, total = self._bent(number("ior"), found.normal, toward_eye, seen.normal)
        mirror, passing = total.select(mirror + passing, mirror), total.select(0.0, passing)
        bent = _from(ray, found.end + _blur(ray, found.end), direction, passing)._replace(backing=backing)
        reflected = _mirrored(ray, before, seen, toward_eye, mirror)
        # Where nothing mirrors there is still total reflection, and then nothing goes through.
        return color, [bent, reflected] if optics.mirror else [_either(total, reflected, bent)]

    def _lights(self, point: Sequence[Value], seen: Face) -> Color:
        data = self.builder.buffer(LIGHTS, F32, constant=True)

        def one(i: Value, *color: Value) -> tuple[Value, ...]:
            x, y, z, near, *tint, shorter = (load(data, i * LIGHT_WORDS + k) for k in range(LIGHT_WORDS))
            toward = [p - q * near for p, q in zip((x, y, z), point, strict=True)]
            # Far away it is in the same direction from everywhere, and how long the vector is, is known.
            light = if_(near > 0.0, lambda: tuple(normalised(toward)), lambda: tuple(p * shorter for p in (x, y, z)))
            if self.optics.shadows:
                facing = dot(seen.normal, light) > 0.0
                reached = way_is_free(self._hiding, point, toward, facing)
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


def _mirrored(ray: Ray, t: Value, seen: Face, toward_eye: Sequence[Value], share: Value) -> Onward:
    cosine = dot(seen.normal, toward_eye)
    direction = [n * (cosine * 2.0) - e for n, e in zip(seen.normal, toward_eye, strict=True)]
    return _from(ray, t, direction, share)


def _blur(ray: Ray, t: Value) -> Value:
    """How far along a ray its point may be from the true one: each coordinate is rounded by 2^-24 of what goes in."""
    far = [abs(o) + abs(t * d) for o, d in zip(ray.origin, ray.direction, strict=True)]
    return (far[0] + far[1] + far[2]) * 2.0**-22 / dot(ray.direction, ray.direction).maximum(1e-30).sqrt()


def _from(ray: Ray, t: Value, direction: Sequence[Value], share: Value) -> Onward:
    """A ray from a place on another."""
    origin = tuple(t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True))
    return Onward(Ray(origin, tuple(direction)), constant(0.0, F32), share)


def _either(first: Value, a: Onward, b: Onward) -> Onward:
    """One of two rays."""
    origin, direction = (
        tuple(first.select(x, y) for x, y in zip(of_a, of_b, strict=True))
        for of_a, of_b in ((a.ray.origin, b.ray.origin), (a.ray.direction, b.ray.direction))
    )
    # Only what goes through can have a backing; what is reflected has none.
    backing = None if b.backing is None else Backing(b.backing.known & ~first, b.backing.color)
    return Onward(Ray(origin, direction), first.select(a.start, b.start), first.select(a.share, b.share), backing)
