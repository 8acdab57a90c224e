"""The kernels of rays beyond the first hit: one ray a pixel from what the camera's have met, and many rays a pixel.

Each lane has a pixel for itself and follows its rays to their ends (``chain``), so that colours are sums in registers
and no two lanes ever meet in memory.
"""

from __future__ import annotations

from functools import partial

from zeroset.kernel import BOOL, F32, F64, U32, Kernel, KernelBuilder, Value, constant, for_, if_, load, store
from zeroset.rendering.buffers import CLEAR, EDGES, END, NORMAL, PART, PICTURE, VALUE
from zeroset.rendering.chain import Chain, Traveller, Values
from zeroset.rendering.layout import frame_coordinates, pixel_coordinates, pixel_place, tile_of
from zeroset.rendering.measure import Measure
from zeroset.rendering.response import Color, Found, Response
from zeroset.rendering.shade import background
from zeroset.rendering.shading import Optics
from zeroset.rendering.tint import Tint
from zeroset.rendering.view import pixel_ray
from zeroset.shade.tone import encode, pack
from zeroset.solve.shape import Shape
from zeroset.solve.status import MISS
from zeroset.solve.subject import Subject

SPREAD = 0.7548776662466927, 0.5698402909980532
"""Steps of a sequence that covers a square evenly, however many of its points are taken (M. Roberts' R2)."""


def path_kernel(shape: Shape, offset: bool, optics: Optics, tint: Tint | None = None, exact: bool = False) -> Kernel:
    """The colour of every pixel, from what its ray has met on.

    ``exact``: what f32 leaves unresolved is searched again in f64.

    Uniforms beside the frame's and the material's: ``first``, the first lane; ``depth``, surfaces that a ray may meet
    after its first; ``lights``, how many there are; ``shadow_tolerance``; ``plane``, the most lanes of a run.
    """
    with KernelBuilder("path") as builder:
        place = builder.index()
        lane = place + builder.uniform("first", U32)
        column, row = pixel_place(builder, lane)
        inside = (column < builder.uniform("width", U32)) & (row < builder.uniform("height", U32))
        hit = load(builder.buffer("status", U32), lane).ne(MISS) & inside
        follow = partial(_followed, builder, _chain(builder, shape, offset, optics, tint, exact, place), lane)
        if optics.sky:
            # What is all around is seen by rays that meet nothing, too.
            color = follow(hit, inside)
        else:
            color = if_(hit, lambda: follow(constant(True, BOOL), constant(True, BOOL)), lambda: background(builder))
        _draw(builder, column, row, inside, color)
    return builder.kernel


def _followed(builder: KernelBuilder, chain: Chain, lane: Value, hit: Value, wanted: Value) -> Values:
    """The encoded colour of a pixel, from what its ray has met on."""
    ray = pixel_ray(builder, *pixel_coordinates(builder, lane))
    t = load(builder.buffer("t", F32), lane)
    clear, end = (load(builder.buffer(name, F32), lane) if name in chain.ends else t for name in (CLEAR, END))
    normal = [load(builder.buffer(name, F32), lane) for name in NORMAL]
    part = load(builder.buffer(PART, U32), lane) if chain.parts else None
    value = load(builder.buffer(VALUE, F32), lane) if chain.measures else None
    first = Traveller(ray, constant(0.0, F32), constant(1.0, F32), builder.uniform("depth", U32))
    return _encoded(chain.color(first, Found(hit, t, normal, clear, end, part, value), wanted))


def sample_kernel(
    shape: Shape, offset: bool, optics: Optics, beams: bool, tint: Tint | None = None, exact: bool = False
) -> Kernel:
    """The colour of listed pixels, from many rays each.

    Args:
        shape: what is seen.
        offset: of the method.
        optics: what light does.
        beams: whether rays start where their tile's beam ended.
        tint: what surfaces are coloured by.
        exact: whether what f32 leaves unresolved is searched again in f64.

    Uniforms beside those of ``path_kernel``: ``samples``, rays a pixel.
    """
    with KernelBuilder("sample") as builder:
        place = builder.index()
        lane = load(builder.buffer(EDGES, U32), place)
        column, row = pixel_place(builder, lane)
        start, step = constant(0.0, F32), None
        if beams:
            start, step = (load(builder.buffer(name, F32), tile_of(lane)) for name in ("tile_start", "tile_step"))
        chain = _chain(builder, shape, offset, optics, tint, exact, place, step)
        samples = builder.uniform("samples", U32)
        weight, depth = 1.0 / samples.convert(F32), builder.uniform("depth", U32)

        def one(j: Value, *so_far: Value) -> tuple[Value, ...]:
            u, v = ((j.convert(F32) + 0.5) * step for step in SPREAD)
            across, down = column.convert(F32) + (u - u.floor()), row.convert(F32) + (v - v.floor())
            ray = pixel_ray(builder, *frame_coordinates(builder, across, down))
            seen = chain.color(Traveller(ray, start, constant(1.0, F32), depth), None, constant(True, BOOL))
            return tuple(c.fma(weight, s) for c, s in zip(seen, so_far, strict=True))

        zero = constant(0.0, F32)
        _draw(builder, column, row, constant(True, BOOL), _encoded(for_(samples, one, zero, zero, zero)))
    return builder.kernel


def _chain(
    builder: KernelBuilder,
    shape: Shape,
    offset: bool,
    optics: Optics,
    tint: Tint | None,
    exact: bool,
    place: Value,
    step: Value | None = None,
) -> Chain:
    doubles = Subject(shape, builder, F64, offset) if exact else None
    response = Response(Subject(shape, builder, offset=offset), optics, doubles)
    measure = None if tint is None else Measure(builder, offset, tint)
    return Chain(response, measure, place, step, doubles)


def _encoded(color: Color) -> Values:
    return tuple(encode(c) for c in color)


def _draw(builder: KernelBuilder, column: Value, row: Value, inside: Value, color: Color) -> None:
    """Put a pixel's encoded colour into the picture."""
    packed = pack(color)
    picture = builder.buffer(PICTURE, U32, writable=True)
    if_(inside, lambda: store(picture, row * builder.uniform("width", U32) + column, packed))
