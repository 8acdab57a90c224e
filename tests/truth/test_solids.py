"""Solids and isovalues against Arb: nothing missed, nothing invented, and the right part met."""

from __future__ import annotations

import random
from functools import cache

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset import Surface
from zeroset.methods import Affine, Interval, Method
from zeroset.scene.solid import Solid

from .booleans import Met, Skin, aimed
from .held import broken_promise

BALL = zs.surface("x^2 + y^2 + z^2 = 1")
SHIFTED = zs.surface("(x - s)^2 + y^2 + z^2 = 0.7", {"s": 0.6})
TUBE = zs.surface("x^2 + y^2 = 0.2")
HALF = zs.surface("x + 2y - z = 0.3")
WAVES = zs.surface("sin(4x) + sin(4y) + sin(4z)")
TANGLE = zs.gallery["tangle"]
STEEP = zs.surface("x^24 + y^24 + z^24 = 1")
FAST = zs.surface("exp(x) + y^2 - z^3 = 1.2")

THINGS: dict[str, Solid | Surface] = {
    "lens": BALL & SHIFTED,
    "bite": BALL - SHIFTED,
    "two balls": BALL | SHIFTED,
    "either but not both": (BALL - SHIFTED) | (SHIFTED - BALL),
    "outside": (~BALL & HALF).with_bounds(1.6),
    "bead": BALL - TUBE - HALF,
    "waves in a ball": (WAVES & BALL).with_bounds(1.2),
    "tangle with holes": (TANGLE - zs.surface("(x-1)^2 + (y+2)^2 + (z-1)^2 = 4") - TUBE).with_bounds(3.0),
    "steep": STEEP - zs.surface("x^2 + y^2 + z^2 = 1.6"),
    "mixed": ((FAST | BALL) & ~TUBE).with_bounds(1.5),
    "shells": zs.surface("x^2 + y^2 + z^2", bounds=2.0).with_isovalues((0.1, 0.9, 1.0, 2.5)),
    "tangle levels": TANGLE.with_isovalues((-6.0, -0.3, 0.0, 7.3)),
    "wave levels": zs.surface(WAVES.formula, bounds=1.5).with_isovalues((-2.0, 0.1, 1.7)),
    "one level": zs.surface(FAST.formula, bounds=1.5).with_isovalues(0.25),
}
METHODS: dict[str, str | Method] = {
    "auto": "auto",
    "affine": "affine",
    "interval": "interval",
    "affine-k": Affine(axis="k"),
    "interval-d": Interval(delta=0.01),
}


@cache
def judged(thing: Solid | Surface, count: int) -> tuple[np.ndarray, np.ndarray, list[Met | None]]:
    """Rays and what they certainly meet first, once for all methods."""
    skin = Skin(thing)
    origins, directions = aimed(thing, count, seed=count)
    pairs = zip(origins.tolist(), directions.tolist(), strict=True)
    return origins, directions, [skin.first(o, d) for o, d in pairs]


def hold(thing: Solid | Surface, count: int, method: str | Method, device: str) -> tuple[list[str], int, int]:
    """Broken promises, how many rays were settled, and how many of those were left unresolved."""
    origins, directions, truth = judged(thing, count)
    hits = zs.cast(thing, origins, directions, method=method, device=device)
    broken, settled, unresolved = [], 0, 0
    for i, (o, d, met) in enumerate(zip(origins.tolist(), directions.tolist(), truth, strict=True)):
        if met is None:
            continue
        settled += 1
        status, t = int(hits.status[i]), float(hits.t[i])
        wrong = broken_promise(met.verdict, status, t)
        unresolved += status == zs.UNRESOLVED
        if not wrong and status == zs.HIT and met.part is not None and hits.part[i] != met.part:
            # A hit at an edge of the bounds may come before the root that must be found.
            at_root = met.verdict.root is not None and abs(t - met.verdict.root.a) < 4 * met.verdict.tolerance
            wrong = f"part {hits.part[i]} instead of {met.part}" if at_root else ""
        if wrong:
            broken.append(f"from {o} towards {d}: {wrong}")
    return broken, settled, unresolved


@pytest.mark.parametrize("name", THINGS)
@pytest.mark.parametrize("method", METHODS)
def test_solids_and_isovalues_against_arb(name: str, method: str) -> None:
    broken, settled, unresolved = hold(THINGS[name], 120 if method == "auto" else 50, METHODS[method], "cpu")
    assert broken == []
    assert settled > 25
    # In f64 hardly any ordinary root stays open.
    assert unresolved <= 0.05 * settled


def random_solid(rng: random.Random, depth: int = 3) -> Solid | Surface:
    """A tree of joins over surfaces of several kinds, somewhere around the middle."""
    if depth == 0 or rng.random() < 0.15:
        x, y, z = (f"({axis} - ({rng.uniform(-0.8, 0.8):.2f}))" for axis in "xyz")
        formulas = (
            f"{x}^2 + {y}^2 + {z}^2 = {rng.uniform(0.1, 1):.2f}",
            f"{x} + {rng.uniform(-2, 2):.1f}*{y} - {z}",
            f"{x}^2 + {y}^2 = 0.2",
            f"sin(4*{x}) + sin(4*{y})*{z}",
            f"{x}*{y}*{z} = 0.03",
        )
        return zs.surface(rng.choice(formulas))
    a, b = random_solid(rng, depth - 1), random_solid(rng, depth - 1)
    return rng.choice([lambda: a & b, lambda: a | b, lambda: a - b, lambda: ~a])()


@pytest.mark.parametrize("seed", range(8))
def test_random_solids_against_arb(seed: int) -> None:
    thing = random_solid(random.Random(seed))
    solid = (thing if isinstance(thing, Solid) else ~thing).with_bounds(1.5)
    broken, settled, unresolved = hold(solid, 80, "interval" if seed % 4 == 3 else "auto", "cpu")
    assert broken == []
    assert settled > 50
    assert unresolved <= 0.05 * settled


@needs_gpu
@pytest.mark.parametrize("name", ["bite", "bead", "tangle levels"])
def test_the_gpu_too(name: str) -> None:
    broken, settled, _ = hold(THINGS[name], 60, "auto", "gpu")
    assert broken == []
    assert settled > 25


def test_the_judge_sees_what_is_wrong() -> None:
    thing = THINGS["bite"]
    origins, directions = aimed(thing, 60, seed=1)
    hits = zs.cast(BALL | SHIFTED, origins, directions, device="cpu")
    found = [Skin(thing).first(o, d) for o, d in zip(origins.tolist(), directions.tolist(), strict=True)]
    wrong = [
        broken_promise(met.verdict, int(s), float(t))
        for met, s, t in zip(found, hits.status, hits.t, strict=True)
        if met is not None
    ]
    assert np.count_nonzero([bool(w) for w in wrong]) > 5
