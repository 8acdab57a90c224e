from __future__ import annotations

import math

import numpy as np
import pytest

from zeroset.errors import ParameterError
from zeroset.export.film.path import Moment, Motion, Swing, as_path, read_motion, read_number


def values(motion: Motion, count: int) -> list[float]:
    return [motion.at(Moment(i, count)) for i in range(count)]


def test_a_linear_motion_ends_at_its_end() -> None:
    assert values(Motion(1, 3), 5) == [1, 1.5, 2, 2.5, 3]
    assert values(Motion(1, 3), 1) == [1]


def test_a_loop_leaves_the_end_to_the_next_round() -> None:
    assert values(Motion(0, 4, "loop"), 4) == [0, 1, 2, 3]
    assert values(Motion(0, 4, "loop", 2), 4) == [0, 2, 0, 2]


def test_there_and_back() -> None:
    assert values(Motion(0, 2, "ping-pong"), 4) == [0, 1, 2, 1]
    assert values(Motion(0, 2, "sine"), 4) == pytest.approx([0, 1, 2, 1])
    assert values(Motion(0, 2, "sine"), 8)[1] < 0.5 < values(Motion(0, 2, "sine"), 8)[2] * 1.5


@pytest.mark.parametrize("shape", ["loop", "ping-pong", "sine"])
@pytest.mark.parametrize("times", [1, 3])
def test_closed_motions_go_on_as_they_began(shape: str, times: int) -> None:
    motion = Motion(-1, 7, shape, times)
    assert motion.at(Moment(24, 24)) == pytest.approx(motion.at(Moment(0, 24)))
    assert motion.at(Moment(25, 24)) == pytest.approx(motion.at(Moment(1, 24)))


@pytest.mark.parametrize(
    ("text", "value"),
    [("2pi", 2 * math.pi), ("pi/3", math.pi / 3), ("-2*pi / 3", -2 * math.pi / 3), ("1e-3", 1e-3), ("3/4", 0.75)],
)
def test_numbers(text: str, value: float) -> None:
    assert read_number(text) == value


@pytest.mark.parametrize("text", ["", "x", "1:", "pi2:3", "/2", "1 2", "--1", "nan", "inf", "pi/0", "1/0.0"])
def test_what_is_no_number(text: str) -> None:
    with pytest.raises(ValueError, match=r".*"):
        read_number(text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1", "cannot read how a moves: '1'"),
        ("1:x", "cannot read how a moves"),
        ("1:2:sine:0", "at least once"),
        ("1:2:sine:1.5", "cannot read how a moves"),
        ("1:2:sine:1:1", "cannot read how a moves"),
        ("1:2/0", "cannot read how a moves"),
        ("1:2:sin", "did you mean sine"),
        ("1:2:linear:2", "loop, ping-pong or sine"),
        ("2:2", "does not move"),
        ("0:1e40", "must be finite"),
    ],
)
def test_what_is_no_motion(text: str, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        read_motion("a", text)


def test_motions_as_python_writes_them() -> None:
    assert as_path("a", (1, 5)) == as_path("a", "1:5") == Motion(1.0, 5.0)
    assert as_path("a", [1, 5, "sine", 2]) == Motion(1.0, 5.0, "sine", 2)
    for wrong in (3.0, (1,), (1, 2, "sine", 1, 1), None):
        with pytest.raises(ParameterError, match="cannot read how a moves"):
            as_path("a", wrong)


def test_a_swing_is_closed_and_stays_within_its_reach() -> None:
    swing = Swing([0.0, 5.0, -1.0], [1.0, 0.5, 2.0], [1, -2, 3], [0.0, 0.3, 0.9])
    assert swing.at(Moment(0, 12)).tolist() == swing.at(Moment(12, 12)).tolist()
    path = np.array([swing.at(Moment(i, 12)) for i in range(12)])
    assert np.all(np.abs(path - [0.0, 5.0, -1.0]) <= [1.0, 0.5, 2.0])
    assert np.all(np.ptp(path, axis=0) > [1.0, 0.5, 2.0])
