from __future__ import annotations

import tomllib
from typing import Any

import pytest

from zeroset.scene.lines import Lines, Path

TEXT = (
    '''# a comment with [[lights]] and a = 1
formula = "x # [no] comment = \\" {"   # a comment
name = """
two [[lines]]
c = 3 \\""" """
"quoted key" = 'raw \\'
camera = {eye = [1, 2,
  3], target = [0, 0, 0]}
params.a = 1
params."b c" = [
  1.5, # one
  2e3,

  -inf,
]
when = 1979-05-27 07:32:00

[[lights]]
color = [1, 1, 1]

[lights.deep]
x = 1
'''
    + """
[[lights]]
direction = [
  0, 0,
  1]
[lights . deep]
x = true
[[lights.more]]
[[lights.more]]
y = '''
'''
z = [{q = 1}, {r = [[], [{s = ''}]]}]
[last]
"""
)


def every(value: Any, path: Path = ()) -> list[Path]:
    """The paths of all values."""
    inside: Any = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [p for key, part in inside for p in ((*path, key), *every(part, (*path, key)))]


WANTED: dict[Path, int] = {
    ("formula",): 2,
    ("name",): 3,
    ("quoted key",): 6,
    ("camera",): 7,
    ("camera", "eye", 0): 7,
    ("camera", "eye", 2): 8,
    ("camera", "target"): 8,
    ("params", "a"): 9,
    ("params", "b c"): 10,
    ("params", "b c", 0): 11,
    ("params", "b c", 2): 14,
    ("when",): 16,
    ("lights",): 18,
    ("lights", 0): 18,
    ("lights", 0, "color"): 19,
    ("lights", 0, "deep"): 21,
    ("lights", 0, "deep", "x"): 22,
    ("lights", 1): 24,
    ("lights", 1, "direction"): 25,
    ("lights", 1, "direction", 2): 27,
    ("lights", 1, "deep", "x"): 29,
    ("lights", 1, "more", 0): 30,
    ("lights", 1, "more", 1): 31,
    ("lights", 1, "more", 1, "y"): 32,
    ("lights", 1, "more", 1, "z", 1, "r", 1, 0, "s"): 34,
    ("last",): 35,
}


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_each_value_is_on_its_line(ends: str) -> None:
    lines = Lines(TEXT.replace("\n", ends))
    assert {path: lines.of(path) for path in WANTED} == WANTED


def test_every_value_has_a_line_of_its_own() -> None:
    lines = Lines(TEXT)
    paths = every(tomllib.loads(TEXT))
    assert len(paths) > 40
    assert [path for path in paths if path not in lines._found] == []
    assert set(lines._found) == set(paths)


def test_what_is_not_there_is_where_it_would_stand() -> None:
    lines = Lines(TEXT)
    assert lines.of(("lights", 1, "color")) == 24
    assert lines.of(("lights", 2)) == 18
    assert lines.of(("bounds", "radius")) is None
    assert lines.of(()) is None


def test_deep_nesting_has_the_line_that_it_begins_on() -> None:
    lines = Lines("a = 1\nb = " + "[" * 5000 + "]" * 5000 + "\nc = 3")
    assert lines.of(("b", *[0] * 5000)) == 2
    assert lines.of(("a",)) == 1


def test_an_empty_text_has_no_lines() -> None:
    assert Lines("").of(("a",)) is None
    assert Lines("# nothing\n\n").of(("a",)) is None
