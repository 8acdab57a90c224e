"""From typed text to surfaces, and complaints that fit the sidebar."""

from __future__ import annotations

import pytest

import zeroset as zs
from zeroset.errors import FormulaError, UnknownNameError
from zeroset.view import formula
from zeroset.view.item import opened


def test_letters_become_parameters_and_known_ones_keep_their_values() -> None:
    reading = formula.read("a x^2 + b y^2 + z^2 = c", {"b": 3.0, "q": 9.0})
    assert dict(reading.surface.params) == {"a": 1.0, "b": 3.0, "c": 1.0}
    assert reading.fresh == ("a", "c")


def test_a_letter_before_brackets_is_a_factor() -> None:
    assert dict(formula.read("s(x) + y", {}).surface.params) == {"s": 1.0}


def test_w_is_a_variable_with_a_slider() -> None:
    reading = formula.read("x^2 + y^2 + z^2 = w + 2", {"w": 0.5})
    assert dict(reading.surface.params) == {"w": 0.5}
    assert dict(formula.read("x + w", {}).surface.params) == {"w": 0.0}


def test_longer_names_are_errors_until_they_are_declared() -> None:
    with pytest.raises(UnknownNameError) as caught:
        formula.read("x^2 + foo*y = 1", {})
    assert formula.complaint(caught.value, "", 40).offer == "foo"
    reading = formula.read("x^2 + foo*y = 1", {}, {"foo"})
    assert reading.surface.params["foo"] == 1.0
    assert reading.fresh == ("foo",)


@pytest.mark.parametrize("text", ["x + foo(y)", "x + r[i]", "x + rr[i]"])
def test_nothing_is_offered_for_what_is_called_or_indexed(text: str) -> None:
    with pytest.raises(FormulaError) as caught:
        formula.read(text, {})
    assert formula.complaint(caught.value, "", 40).offer == ""


def test_arrays_of_the_surface_before_are_known() -> None:
    values = opened(0, zs.gallery["blinn-blobby"], "", zs.Material()).known
    reading = formula.read(zs.gallery["blinn-blobby"].formula + " + 0.001x", values)
    assert set(reading.surface.arrays) == set(zs.gallery["blinn-blobby"].arrays)


@pytest.mark.parametrize(
    "text", ["", "  \n ", "x^", "((", "1/0", "x = y = z", "5", "\0", "é" * 3000, "x" * 100_000, "(" * 5000]
)
def test_anything_else_is_an_error_that_says_so(text: str) -> None:
    with pytest.raises(zs.ZerosetError) as caught:
        formula.read(text, {})
    said = formula.complaint(caught.value, str(caught.value), 42)
    assert said.message
    assert all(len(line) <= 46 for line in said.place)


@pytest.mark.parametrize("position", [0, 3, 19, 20, 21, 150, 297, 299, 300])
def test_the_caret_of_a_cut_excerpt_stands_under_its_spot(position: int) -> None:
    text = "".join(chr(ord("a") + i % 26) for i in range(300))
    said = formula.complaint(FormulaError("m", text=text, position=position), "", 42)
    shown, carets = said.place
    column = carets.index("^")
    assert len(shown) <= 42
    assert shown[column : column + 1] == text[position : position + 1]


def test_hints_that_speak_of_python_are_left_out() -> None:
    with pytest.raises(UnknownNameError) as caught:
        formula.read("x + foo", {})
    assert any("params=" in hint for hint in caught.value.hints)
    assert not any("params=" in hint for hint in formula.complaint(caught.value, "", 40).hints)


def test_errors_that_are_not_ours_are_told_as_they_are() -> None:
    assert formula.complaint(ValueError("x"), "told", 40) == formula.Complaint("told")
