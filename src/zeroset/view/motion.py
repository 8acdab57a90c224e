"""How parameters move through the ranges of their sliders by themselves."""

from __future__ import annotations

from dataclasses import dataclass

from zeroset.view.spans import Span


@dataclass(frozen=True, slots=True)
class Motion:
    """How a parameter plays.

    Attributes:
        playing: whether it moves.
        seconds: time from one end of the range to the other.
        loop: start again at the low end; otherwise it goes to and fro.
        rising: the way it goes now.
    """

    playing: bool = False
    seconds: float = 4.0
    loop: bool = False
    rising: bool = True


def moved(value: float, span: Span, motion: Motion, seconds: float) -> tuple[float, bool]:
    """Where a playing parameter has come to, and which way it goes then.

    Example:
        >>> moved(0.5, Span(0.0, 1.0), Motion(seconds=1.0), 0.75)
        (0.75, False)
        >>> moved(0.5, Span(0.0, 1.0), Motion(seconds=1.0, loop=True), 0.75)
        (0.25, True)
    """
    share = (min(max(value, span.low), span.high) - span.low) / (span.high - span.low)
    step = seconds / max(motion.seconds, 1e-3)
    if motion.loop:
        share = (share + step) % 1.0
        return span.low + share * (span.high - span.low), True
    # To and fro is a turn around a circle of two lengths: up in the first half, down in the second.
    phase = ((share if motion.rising else 2.0 - share) + step) % 2.0
    share = phase if phase <= 1.0 else 2.0 - phase
    return span.low + share * (span.high - span.low), phase < 1.0
