"""Random expressions on all enclosing systems, at random points, in all kinds of arithmetic."""

import math
import random

import flint
import numpy as np
import pytest

from zeroset.arith import F32, F64, AffineSystem, IntervalSystem
from zeroset.arith.budget import repaid

from .scalars import Flushed, Fused, plain
from .truth import BINARY, POWERS, UNARY, cases, outside, within

CASES = cases()
LANES = 16


def tree(chance, depth):
    if depth == 0 or chance.random() < 0.1:
        constant = ("constant", chance.uniform(-3, 3))
        return chance.choice([("x",), ("x",), ("y",), ("y",), constant])
    if chance.random() < 0.6:
        names = ["add", "sub", "mul"] if chance.random() < 0.6 else list(BINARY)
        return (chance.choice(names), tree(chance, depth - 1), tree(chance, depth - 1))
    if chance.random() < 0.15:
        return ("select", *(tree(chance, depth - 1) for _ in range(4)))
    names = ["sqr", "neg", "abs", "powi3", "powi4"] if chance.random() < 0.5 else [*UNARY, *POWERS]
    return (chance.choice(names), tree(chance, depth - 1))


def on_numbers(node, system, leaves):
    name, *rest = node
    if name in leaves:
        return leaves[name]
    if name == "constant":
        return system.constant(rest[0], math.nextafter(rest[0], 9.0))
    args = [on_numbers(part, system, leaves) for part in rest]
    return args[0].lt(args[1]).select(args[2], args[3]) if name == "select" else CASES[name][1](*args)


def in_truth(node, leaves, big):
    """The value, or None where it or an intermediate one is undefined, beyond big, or not settled."""
    name, *rest = node
    if name in leaves:
        return leaves[name]
    if name == "constant":
        return (flint.arb(rest[0]) + flint.arb(math.nextafter(rest[0], 9.0))) / 2
    if name == "select":
        left, right = (in_truth(part, leaves, big) for part in rest[:2])
        if left is None or right is None or not (left < right or left >= right):
            return None
        return in_truth(rest[2] if left < right else rest[3], leaves, big)
    args = [in_truth(part, leaves, big) for part in rest]
    if any(a is None for a in args):
        return None
    value = CASES[name][2](*args)
    return value if within(value, big) and value.rad() < 1e-20 else None


@pytest.mark.parametrize("curved", [False, True], ids=["straight", "curved"])
@pytest.mark.parametrize("seed", range(60))
def test_a_random_expression_is_enclosed(seed, curved):
    chance = random.Random(seed)
    fmt = chance.choice([F32, F32, F64])
    kind = chance.choice([np.asarray, Fused, Flushed]) if fmt is F32 else np.asarray
    system = AffineSystem(fmt, symbols=chance.choice([1, 3]), intersect=chance.random() < 0.4, curved=curved)
    generator = np.random.default_rng(seed)
    node = tree(chance, chance.randint(2, 6))
    second = min(1, system.symbols - 1)
    centres = [generator.uniform(-3, 3, LANES).astype(fmt.dtype) for _ in "xy"]
    radii = [(10.0 ** generator.uniform(-8, 0.3, LANES)).astype(fmt.dtype) for _ in "xy"]
    x = system.symbol(0, kind(centres[0]), kind(radii[0])) * 0.75 + 0.1
    y = system.symbol(second, kind(centres[1]), kind(radii[1]))
    with np.errstate(all="ignore"):
        form = on_numbers(node, system, {"x": x, "y": y})
        ranges = {"x": x.interval(), "y": y.interval()}
        plain_interval = on_numbers(node, IntervalSystem(fmt), ranges)
        error, box, contracted = repaid(fmt, form.error, form.budget.depth), form.interval(), form.contract()
    lanes = [np.broadcast_to(plain(v).astype(np.float64), LANES) for v in (form.centre, error, *form.terms)]
    bounds = [np.broadcast_to(plain(v), LANES) for v in (box.lo, box.hi, plain_interval.lo, plain_interval.hi)]
    excluded = np.broadcast_to(plain(contracted.excluded), LANES)
    for _ in range(3):
        symbols = generator.uniform(-1, 1, system.symbols).tolist()
        with flint.ctx.workprec(300):
            for i in range(LANES):
                at_x = (flint.arb(float(centres[0][i])) + flint.arb(float(radii[0][i])) * symbols[0]) * 0.75
                at_y = flint.arb(float(centres[1][i])) + flint.arb(float(radii[1][i])) * symbols[second]
                value = in_truth(node, {"x": at_x + flint.arb(0.1), "y": at_y}, fmt.big)
                if value is None:
                    continue
                line = flint.arb(lanes[0][i])
                bend = [2 * flint.arb(symbols[-1]) ** 2 - 1] if curved else []
                for u, e in zip(lanes[2:], symbols + bend, strict=True):
                    line += flint.arb(u[i]) * e
                assert not abs(value - line) > flint.arb(lanes[1][i]), node
                assert not outside(value, bounds[0][i], bounds[1][i]), node
                assert not outside(value, bounds[2][i], bounds[3][i]), node
                assert not (excluded[i] and value.contains(0)), node
