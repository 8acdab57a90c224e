"""Poles, jumps and edges of the domain: what the proving methods promise there.

A MISS is no root, here too. A HIT needs continuity: where f jumps across 0, or passes through a pole, no root is
claimed, and the place may be left UNRESOLVED. A root at the edge of the domain, with f undefined beyond it, is found.
The truth of these few is known by hand, in terms of x.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import zeroset as zs

from .held import proving_methods
from .judge import EDGE, FINE

RADIUS = 4.5


@dataclass(frozen=True)
class Case:
    """f along rays on which x grows from ``start``.

    Attributes:
        root: x of the first root, or None where there is none.
        breaks: x of poles, jumps and edges, where an answer may stay UNRESOLVED.
    """

    formula: str
    start: float
    root: float | None
    breaks: tuple[float, ...] = ()


CASES = (
    Case("1/x", -1.5, None, (0.0,)),
    Case("1/x - 1", -1.5, 1.0, (0.0,)),
    Case("1/x + 1", -1.5, -1.0),
    Case("1/x^2 - 4", -1.5, -0.5),
    Case("1/x^2 + 1", -1.5, None, (0.0,)),
    Case("1/(x - 1/3)", -1.5, None, (1 / 3,)),
    Case("(x - 1)/(x^2 - 1/4)", -1.5, 1.0, (-0.5, 0.5)),
    Case("tan(x) - 1", -1.5, np.pi / 4),
    Case("tan(x) - 1", 1.0, np.pi * 5 / 4, (np.pi / 2,)),
    Case("exp(1/x) - 2", -1.5, float(1 / np.log(2)), (0.0,)),
    Case("floor(x) + 0.5", -1.5, None, (-1.0, 0.0, 1.0)),
    Case("floor(x)", -1.5, 0.0, (0.0,)),
    Case("ceil(x) - 1.5", -1.5, None, (1.0,)),
    Case("sign(x)", -1.5, 0.0, (0.0,)),
    Case("sign(x) - 0.5", -1.5, None, (0.0,)),
    Case("mod(x, 1) - 0.5", -1.75, -1.5),
    Case("mod(x, 1) - 0.5", -1.375, -0.5, (-1.0,)),
    Case("if(x < 0, -1, 1)", -1.5, None, (0.0,)),
    Case("if(x < 0.25, x - 1, x)", -1.5, None, (0.25,)),
    Case("if(x < 0.25, x - 1, x - 0.5)", -1.5, 0.5, (0.25,)),
    Case("x/|x|", -1.5, None, (0.0,)),
    Case("sqrt(x)", -1.5, 0.0, (0.0,)),
    Case("sqrt(x) - 0.5", -1.5, 0.25, (0.0,)),
    Case("sqrt(x) + 0.125", -1.5, None),
    Case("sqrt(-(x^2))", -1.5, 0.0, (0.0,)),
    Case("log(x)", -1.5, 1.0, (0.0,)),
    Case("acos(x)", -1.5, 1.0, (-1.0, 1.0)),
    Case("asin(x) - pi/2", -1.5, 1.0, (-1.0, 1.0)),
    Case("atan2(x, y - 3)", -1.5, None, (0.0,)),
    Case("atan2(x, y + 3)", -1.5, 0.0),
    Case("x^1.5", -1.5, 0.0, (0.0,)),
    Case("min(1/x, 5) - 2", -1.5, 0.5, (0.0,)),
)

METHODS = ("auto", "interval", "affine", "mitchell", "affine-k", "interval-k")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.formula} from {case.start}")
def test_what_is_promised_where_f_breaks(case: Case, method: str) -> None:
    surface = zs.surface(case.formula, bounds=RADIUS)
    directions = np.array([(1, 0, 0), (1, 0.25, -0.125), (1, -0.375, 0.5)], np.float32)
    origins = np.tile(np.array([case.start, 0.125, 0.25], np.float32), (len(directions), 1))
    chosen = proving_methods(surface)[method]
    hits = zs.cast(surface, origins, directions, t_max=3.75, method=chosen, device="cpu")
    reach = EDGE * FINE * 2 * RADIUS
    for status, t in zip(hits.status, hits.t, strict=True):
        x = case.start + float(t)
        at_root = case.root is not None and abs(x - case.root) <= reach
        if status == zs.MISS:
            assert case.root is None
        elif status == zs.HIT:
            assert at_root, f"claims a root at x = {x}"
        else:
            passed = case.root is not None and x > case.root + reach
            assert not passed
            assert at_root or any(abs(x - place) <= reach for place in case.breaks), f"unresolved at x = {x}"
