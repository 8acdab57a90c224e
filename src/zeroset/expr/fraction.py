"""A formula as one fraction N/D: N has to vanish where f does, and is defined where f has a pole.

Sums are brought to a common denominator, products and quotients are multiplied out, and whatever is no fraction stays
as it is. Where f is defined D is not 0, so f = 0 means N = 0, and f = v means N = v D. An enclosure of f says nothing
over a pole; one of N says there that f has no zero: 1/x^2 + 1 is (1 + x^2)/x^2.
"""

from __future__ import annotations

from zeroset.expr.build import ONE, build
from zeroset.expr.dag import Expr, postorder

__all__ = ["fraction"]

Fraction = tuple[Expr, Expr]


def fraction(expr: Expr) -> Fraction | None:
    """N and D of f = N/D, which share so many parts with f that they are hardly longer; None where D is 1.

    Args:
        expr: f.

    Example:
        >>> from zeroset.expr import parse, text
        >>> [text(part) for part in fraction(parse("1/x^2 + 1"))]
        ['1 + x^2', 'x^2']
        >>> fraction(parse("x^2 + y/3")) is None
        True
    """
    parts = list(postorder(expr))
    if not any(part.op in ("div", "tan") for part in parts):
        return None
    made: dict[Expr, Fraction] = {}
    for part in parts:
        made[part] = _fraction(part, tuple(made[arg] for arg in part.args))
    top, bottom = made[expr]
    return None if bottom is ONE else (top, bottom)


def _fraction(part: Expr, args: tuple[Fraction, ...]) -> Fraction:
    """A node as a fraction of its arguments' ones; as one over 1 where it is none."""
    match part.op, args:
        case "div", ((a, b), (c, d)):
            return a * d, b * c
        case "mul", ((a, b), (c, d)):
            return a * c, b * d
        case "add", ((a, b), (c, d)):
            return (a + c, b) if b is d else (a * d + c * b, b * d)
        case "sub", ((a, b), (c, d)):
            return (a - c, b) if b is d else (a * d - c * b, b * d)
        case "neg", ((a, b),):
            return -a, b
        case "sqr", ((a, b),):
            return a**2, b**2
        case "powi", ((a, b),) if int(part.data[0]) > 0 and b is not ONE:
            return a ** int(part.data[0]), b ** int(part.data[0])
        case "abs", ((a, b),) if b is not ONE:
            return build("abs", (a,)), build("abs", (b,))
        case "tan", ((a, b),) if b is ONE:
            return build("sin", (a,)), build("cos", (a,))
    return part, ONE
