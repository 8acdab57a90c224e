"""How many pixels a picture gets while something moves, so that it comes within its budget of time.

A small controller: it keeps an estimate of what a pixel costs and picks a step of a short ladder of scales. It goes
down at once when pictures take too long and up one step at a time, and only if the next step would fit with room to
spare; between the two it stays. So the resolution does not flicker, and only a few sizes of buffers are ever made.
"""

from __future__ import annotations

from dataclasses import dataclass

LADDER = (1.0, 0.8, 0.65, 0.5, 0.4, 0.3, 0.22, 0.16, 0.11)
"""Scales of width and height."""
SMOOTHING = 0.35
"""Weight of the newest picture in the estimate."""
TOO_LONG = 1.15
"""Times the budget above which the resolution drops."""
ROOM = 0.8
"""Times the budget that the next larger picture may be expected to take for the resolution to rise."""
MULTIPLE = 8
"""Widths are multiples of this, the side of a tile."""


@dataclass(frozen=True, slots=True)
class Pace:
    """The controller's memory.

    Attributes:
        step: place on the ladder.
        cost: milliseconds a pixel, smoothed; 0 before the first picture.

    Example:
        >>> pace = Pace()
        >>> slow = pace.after(200.0, 1_000_000, 1_000_000, 33.0)
        >>> slow.size(1000, 1000)
        (400, 400)
    """

    step: int = 0
    cost: float = 0.0

    def size(self, width: int, height: int) -> tuple[int, int]:
        """The size of a moving picture that will fill so many pixels."""
        return scaled(width, height, LADDER[self.step])

    def after(self, milliseconds: float, pixels: int, full: int, budget: float) -> Pace:
        """The controller after a picture.

        Args:
            milliseconds: how long it took.
            pixels: how many it had.
            full: how many a picture of the full size has.
            budget: milliseconds that a picture may take.
        """
        measured = milliseconds / max(pixels, 1)
        # Smoothed, so that one hiccup does not throw it down the whole ladder.
        cost = measured if not self.cost else self.cost + SMOOTHING * (measured - self.cost)

        def expected(step: int) -> float:
            return cost * full * LADDER[step] ** 2

        step = self.step
        if expected(step) > TOO_LONG * budget:
            while step + 1 < len(LADDER) and expected(step) > budget:
                step += 1
        elif step and expected(step - 1) < ROOM * budget:
            step -= 1
        return Pace(step, cost)


def scaled(width: int, height: int, scale: float) -> tuple[int, int]:
    """A smaller size of nearly the same shape, the width a multiple of 8; the full size as it is.

    Example:
        >>> scaled(1003, 777, 0.5), scaled(1003, 777, 1.0)
        ((504, 390), (1003, 777))
    """
    if scale >= 1.0:
        return max(1, width), max(1, height)
    wide = min(max(MULTIPLE, round(width * scale / MULTIPLE) * MULTIPLE), max(1, width))
    return wide, max(1, round(height * wide / max(1, width)))
