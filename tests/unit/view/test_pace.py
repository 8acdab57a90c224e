"""The resolution controller: it reaches its budget, it does not flicker, it makes few sizes."""

from __future__ import annotations

import random

import pytest

from zeroset.view.pace import LADDER, MULTIPLE, Pace, scaled

WIDTH, HEIGHT = 1003, 777
FULL = WIDTH * HEIGHT


def drawn(pace: Pace, cost: float, overhead: float = 0.0) -> Pace:
    """The controller after a picture at so many milliseconds a megapixel."""
    width, height = pace.size(WIDTH, HEIGHT)
    return pace.after(cost * width * height * 1e-6 + overhead, width * height, FULL, 33.0)


@pytest.mark.parametrize("cost", [5.0, 40.0, 100.0, 400.0, 1500.0])
def test_it_settles_within_its_budget_and_stays(cost: float) -> None:
    pace, steps = Pace(), []
    for _ in range(60):
        pace = drawn(pace, cost)
        steps.append(pace.step)
    assert len(set(steps[10:])) == 1, "a steady load, a steady size"
    width, height = pace.size(WIDTH, HEIGHT)
    assert cost * width * height * 1e-6 <= 33.0 * 1.2
    if pace.step:
        wider, higher = scaled(WIDTH, HEIGHT, LADDER[pace.step - 1])
        assert cost * wider * higher * 1e-6 > 33.0 * 0.7, "no smaller than need be"


def test_it_comes_back_when_the_load_is_gone() -> None:
    pace = Pace()
    for _ in range(20):
        pace = drawn(pace, 1000.0)
    assert pace.step > 3
    for _ in range(40):
        pace = drawn(pace, 10.0)
    assert pace.step == 0


def test_noise_does_not_make_it_flicker() -> None:
    noise, pace, changes = random.Random(1), Pace(), 0
    for i in range(300):
        after = drawn(pace, 100.0 * noise.uniform(0.85, 1.15))
        changes += i > 20 and after.step != pace.step
        pace = after
    assert changes <= 6


def test_sizes_are_few_and_of_the_same_shape() -> None:
    sizes = [scaled(WIDTH, HEIGHT, scale) for scale in LADDER]
    assert sizes[0] == (WIDTH, HEIGHT)
    for width, height in sizes[1:]:
        assert width % MULTIPLE == 0
        assert width / height == pytest.approx(WIDTH / HEIGHT, rel=0.02)
    assert scaled(3, 2, 0.1) == (3, 2)
    assert scaled(1, 900, 0.5) == (1, 900)
