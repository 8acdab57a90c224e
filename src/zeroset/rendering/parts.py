"""Parts of pixels that f32 could not clear, once more in f64.

Beside cusps, nodes and multiple lines f is smaller than its rounding in f32 over several pixels, or than what its
enclosure is too wide by, and every part of them may hold something. Here a part is drawn only if f64 cannot exclude one
of its quarters. What is drawn shows the side on which the pixel's own ray passes it.
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.kernel import BOOL, F32, F64, U32, Kernel, KernelBuilder, Value, constant, if_, load, while_
from zeroset.rendering.beams import thin_answer
from zeroset.rendering.buffers import IN_PARTS, THIN_PIXEL, Ends
from zeroset.rendering.cells import FINENESS, HALF, WIDTHS, part_offset, place_of, reached, shortest
from zeroset.rendering.front import free_up_to
from zeroset.rendering.gbuffer import write
from zeroset.rendering.layout import frame_coordinates, pixel_place, tile_of
from zeroset.rendering.primary import camera_ray, exact_ray, t_range
from zeroset.rendering.view import frame_patch
from zeroset.solve.beam import Beam, find_anything
from zeroset.solve.shape import Shape
from zeroset.solve.subject import Subject

QUARTERS = 4
"""Pieces that a part is taken to."""
WINDOW = 8.0
"""Finest steps that are looked through quarter by quarter before a part is looked at as a whole again."""
MOST = 2000
"""Searches that a pixel may cost; what is left then is drawn."""


class _State(NamedTuple):
    """Where a pixel's search is.

    Attributes:
        left: parts that are not done with, as bits; the lowest is being looked at.
        whole: whether that is looked at as a whole.
        quarter: else which quarter of it.
        t: from where on.
        found: whether something was found.
        searches: how many there were.
    """

    left: Value
    whole: Value
    quarter: Value
    t: Value
    found: Value
    searches: Value


def parts_kernel(shape: Shape, offset: bool, ends: Ends = ()) -> Kernel:
    """One pixel of which parts are left; ``ends``: what lies around the find is kept, for rays that go on.

    Uniform: ``listed``, where on the list the run begins.
    """
    with KernelBuilder("parts") as builder:
        place = load(builder.buffer("thin_left", U32), builder.index() + builder.uniform("listed", U32))
        lane = load(builder.buffer(THIN_PIXEL, U32), place)
        subject = Subject(shape, builder, F64, offset)
        pixel = _Pixel(builder, subject, lane, place)

        def running(*state: Value) -> Value:
            now = _State(*state)
            return now.left.ne(0) & ~now.found & (now.searches < MOST)

        def turn(*state: Value) -> tuple[Value, ...]:
            return _turn(pixel, _State(*state))

        none, no = constant(0, U32), constant(False, BOOL)
        parts = load(builder.buffer("thin_parts", U32), place)
        end = _State(*while_(running, turn, *_State(parts, ~no, none, pixel.near, no, none)))
        where, ray = place_of(builder, place).convert(F64), exact_ray(camera_ray(builder, lane))
        if_(end.left.ne(0), lambda: write(builder, subject, lane, ray, thin_answer(subject, where, ray), ends))
    return builder.kernel


def _turn(pixel: _Pixel, now: _State) -> _State:
    """One search and what follows from it."""
    lowest = now.left & (constant(0, U32) - now.left)
    thin = pixel.search(_bit(lowest), now)
    stuck, clear = now.whole & thin.found, now.whole & ~thin.found
    # No quarter holds anything: on with the whole part, behind the window.
    free = ~now.whole & ~thin.found & now.quarter.eq(QUARTERS - 1)
    t = clear.select(pixel.near, free.select(now.t + pixel.window, now.t))
    return _State(
        clear.select(now.left ^ lowest, now.left),
        clear | free,
        (now.whole | free).select(constant(0, U32), now.quarter + 1),
        thin.found.select(stuck.select(thin.t - pixel.finest, thin.t), t),
        ~now.whole & thin.found,
        now.searches + 1,
    )


def _bit(lowest: Value) -> Value:
    """Which of sixteen bits is set: a float of that value has it as its exponent."""
    return (lowest.convert(F32).bitcast(U32) >> 23) - 127


class _Pixel:
    """One pixel of the list.

    Attributes:
        near: up to there it is clear.
        finest: the shortest step along one of its parts.
        window: so far quarters are looked through.
    """

    def __init__(self, builder: KernelBuilder, subject: Subject, lane: Value, place: Value) -> None:
        self._builder = builder
        self._subject = subject
        # In f64 from the start: quarters of parts are not much wider than coordinates are rounded by in f32.
        self._column, self._row = (place.convert(F64) + 0.5 for place in pixel_place(builder, lane))
        self._side = builder.uniform("pixel", F32).convert(F64)
        start = load(builder.buffer("tile_start", F32), tile_of(lane))
        self._far = free_up_to(builder, lane, t_range(builder)[1]).convert(F64)
        self.near = start.maximum(reached(builder, place)).convert(F64)
        self.finest = shortest(builder, WIDTHS[IN_PARTS] * FINENESS[IN_PARTS]).convert(F64)
        self.window = self.finest * WINDOW

    def search(self, part: Value, now: _State) -> Beam:
        """Look for anything in one part, or in a quarter of it."""
        right, below = (x.convert(F64) for x in part_offset(part))
        aside = constant(0.25 * WIDTHS[IN_PARTS], F64)
        across = now.whole.select(0.0 * aside, (now.quarter & 1).ne(0).select(aside, -aside))
        down = now.whole.select(0.0 * aside, (now.quarter >> 1).ne(0).select(aside, -aside))
        u, v = frame_coordinates(self._builder, self._column + right + across, self._row + below + down)
        share = now.whole.select(constant(1.0, F64), 0.5)
        patch = frame_patch(self._builder, self._subject, u, v, self._side * (WIDTHS[IN_PARTS] * HALF) * share)
        far = now.whole.select(self._far, self._far.minimum(now.t + self.window))
        step = now.whole.select(self.finest, self.window)
        return find_anything(patch, now.t, far, step, self.finest * share)
