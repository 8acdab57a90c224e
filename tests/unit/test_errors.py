from __future__ import annotations

import pickle

import pytest

from zeroset import errors
from zeroset.errors import (
    FormulaError,
    OutputError,
    SceneFileError,
    UnknownNameError,
    UnknownSurfaceError,
    ZerosetError,
    did_you_mean,
    nearest_names,
)


def test_every_public_error_is_a_zeroset_error():
    classes = [value for name in errors.__all__ if isinstance(value := getattr(errors, name), type)]
    assert len(classes) >= 14
    assert all(issubclass(value, ZerosetError) for value in classes)


def test_the_tree_at_the_top_names_every_error():
    assert errors.__doc__ is not None
    drawn = errors.__doc__
    for name in errors.__all__:
        if name.endswith("Error"):
            assert name in drawn


def test_text_is_message_place_and_hints():
    error = FormulaError("no factor", text="x + * y", position=4, hints=("first", "second"))
    assert str(error).splitlines() == ["no factor", "  x + * y", "      ^", "  hint: first", "  hint: second"]
    assert error.hint == "first"


@pytest.mark.parametrize("text", ["", "  "])
def test_nothing_has_no_caret(text):
    assert str(FormulaError("empty", text=text, position=0, hint="h")) == "empty\n  hint: h"


def test_hint_alone_is_first():
    assert ZerosetError("m", hint="a", hints=("b",)).hints == ("a", "b")
    assert ZerosetError("m").hint == ""


@pytest.mark.parametrize("position", [0, 1, 35, 36, 37, 500, 963, 999, 1000])
def test_long_formulas_are_windowed_around_the_spot(position):
    text = "".join(chr(ord("a") + i % 26) for i in range(1000))
    _, excerpt, carets = str(FormulaError("m", text=text, position=position)).splitlines()
    assert len(excerpt) <= errors.WINDOW + 6
    column = carets.index("^")
    shown = excerpt[column : column + 1]
    assert shown == text[position : position + 1]


def test_caret_stays_under_the_spot_beside_tabs_newlines_and_wide_characters():
    _, excerpt, carets = str(FormulaError("m", text="a\t\n\u6f22*", position=4)).splitlines()
    assert excerpt == "  a  \u6f22*"
    assert carets.index("^") == 2 + 3 + 2


def test_carets_underline_the_length_but_not_past_the_end():
    assert str(FormulaError("m", text="abc", position=1, length=9)).splitlines()[2] == "   ^^"


def test_unknown_name_underlines_the_name():
    error = UnknownNameError("m", name="foo", text="x + foo", position=4)
    assert str(error).splitlines()[2] == "      ^^^"


def test_key_and_os_errors_print_their_text():
    assert str(UnknownSurfaceError("no surface", hint="h")) == "no surface\n  hint: h"
    assert str(OutputError("cannot write", hint="h")) == "cannot write\n  hint: h"
    assert isinstance(UnknownSurfaceError("m"), KeyError)
    assert isinstance(OutputError("m"), OSError)


def test_scene_file_error_names_file_and_line():
    assert "a.toml:3" in str(SceneFileError("m", path="a.toml", line=3))
    assert str(SceneFileError("m", path="a.toml")) == "m\n  in a.toml"


def test_errors_survive_pickling():
    error = UnknownNameError("m", name="foo", text="foo", position=0, hints=("h",))
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error)
    assert again.name == "foo"


def test_nearest_names_ignores_case_and_offers_little():
    assert nearest_names("Sin", ["cos", "sin", "tan"])[0] == "sin"
    assert nearest_names("qqq", ["cos", "sin"]) == ()
    assert did_you_mean("coss", ["cos", "sin"]) == ("did you mean cos?",)
    assert did_you_mean("qqq", ["cos"]) == ()
