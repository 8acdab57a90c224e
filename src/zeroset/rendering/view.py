"""The camera inside kernels: its six vectors as uniforms, rays of pixels and of whole tiles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.kernel import F32, KernelBuilder, Type, Value
from zeroset.scene.camera import VECTORS
from zeroset.scene.clip import outside
from zeroset.solve.beam import Patch
from zeroset.solve.field import Ray
from zeroset.solve.shape import Body
from zeroset.solve.subject import Subject
from zeroset.solve.systems import automatic_system


def vector(builder: KernelBuilder, name: str) -> list[Value]:
    """One of the camera's vectors."""
    return [builder.uniform(f"{name}_{axis}", F32) for axis in "xyz"]


def pixel_ray(builder: KernelBuilder, u: Value, v: Value) -> Ray:
    """The ray through one point of the frame."""
    eye, across, upwards, forward, right, up = (vector(builder, name) for name in VECTORS)
    origin = tuple(u.fma(a, v.fma(b, e)) for e, a, b in zip(eye, across, upwards, strict=True))
    direction = tuple(u.fma(a, v.fma(b, f)) for f, a, b in zip(forward, right, up, strict=True))
    return Ray(origin, direction)


def beam_rays(builder: KernelBuilder, system: Any, u: Any, v: Any, type_: Type = F32) -> tuple[list[Any], list[Any]]:
    """Origins and directions of a patch's rays as numbers in u and v, covering how ``pixel_ray`` rounds in a type."""
    vectors = ([x.convert(type_) for x in vector(builder, name)] for name in VECTORS)
    eye, across, upwards, forward, right, up = vectors

    def affine(base: list[Value], a: list[Value], b: list[Value]) -> list[Any]:
        # Two fused steps on numbers no larger than |base| + |a| + |b| (u and v are at most 1): four roundings cover it.
        slack = [(abs(p) + abs(q) + abs(r)) * (4 * system.fmt.eps) for p, q, r in zip(base, a, b, strict=True)]
        return [
            system.enclose(p, s) + system.exact(q) * u + system.exact(r) * v
            for p, q, r, s in zip(base, a, b, slack, strict=True)
        ]

    return affine(eye, across, upwards), affine(forward, right, up)


def frame_patch(builder: KernelBuilder, subject: Subject, u: Value, v: Value, half: Value) -> Patch:
    """The rays through the frame's patch of half the side ``half`` around (u, v), all of the subject's type."""
    fmt = FORMAT32 if subject.type == F32 else FORMAT64
    system = automatic_system(subject.shape, fmt, symbols=3)
    across, upwards = system.symbol(0, u, half), system.symbol(1, v, half)
    origin, direction = beam_rays(builder, system, across, upwards, subject.type)

    def beyond(body: Body, point: Sequence[Any]) -> Value:
        return outside(builder, body.kind, system, point, body.prefix)

    return Patch(subject, system, origin, direction, beyond)
