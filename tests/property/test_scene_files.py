"""Random scenes: whatever can be put together is written to a file and read back the same."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import zeroset as zs
from zeroset.errors import SceneFileError
from zeroset.scene.file import dumps, loads
from zeroset.scene.lines import Lines

FEW = settings(deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))


def _numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False)


PLACES = st.tuples(*[_numbers(-1e6, 1e6)] * 3)
COLORS = st.tuples(*[_numbers(0, 100)] * 3)
SHARES = _numbers(0, 1)
UP = PLACES.filter(lambda v: max(map(abs, v)) > 1e-6)
BOUNDS = st.one_of(
    st.none(),
    st.builds(zs.Ball, _numbers(1e-6, 1e6), PLACES),
    st.tuples(PLACES, PLACES)
    .filter(lambda pair: all(abs(a - b) > 1e-6 for a, b in zip(*pair, strict=True)))
    .map(lambda pair: zs.Box(tuple(map(min, *pair)), tuple(map(max, *pair)))),
)
LENSES = st.one_of(
    st.fixed_dictionaries({"fov": _numbers(0.01, 179)}), st.fixed_dictionaries({"height": _numbers(0.01, 1e6)})
)
CAMERAS = st.one_of(
    st.none(),
    st.tuples(PLACES, PLACES, UP, LENSES)
    .filter(lambda made: max(abs(a - b) for a, b in zip(made[0], made[1], strict=True)) > 1e-6)
    .map(lambda made: zs.Camera(made[0], made[1], made[2], **made[3])),
)
FAR = st.builds(zs.Light, UP, COLORS, st.booleans())
NEAR = st.builds(
    lambda color, headlight, place: zs.Light(color=color, headlight=headlight, position=place),
    COLORS,
    st.booleans(),
    PLACES,
)
LIGHTS = st.lists(st.one_of(FAR, NEAR), max_size=32)
MATERIALS = st.builds(
    zs.Material,
    front=COLORS,
    back=COLORS,
    ambient=_numbers(0, 1e6),
    diffuse=_numbers(0, 1e6),
    specular=_numbers(0, 1e6),
    shininess=_numbers(0.001, 1e4),
    opacity=SHARES,
    reflectance=SHARES,
    ior=_numbers(0.1, 10),
)
AROUND = st.one_of(st.none(), st.builds(zs.Environment, st.sampled_from(["sky", "room"]), _numbers(0, 1e6)))
VALUES = _numbers(-1e30, 1e30)


@st.composite
def scenes(draw: Any) -> zs.Scene:
    """Scenes of any kind, but for pictures all around, which must be there."""
    count = draw(st.integers(1, 4))
    params = {"a": draw(VALUES), "w": draw(VALUES), "c": draw(st.lists(VALUES, min_size=count, max_size=count))}
    name = draw(st.text(st.characters(exclude_categories=["Cs"])))
    shape = zs.surface("sum(i, (x - c[i])^2) + a*y + w*z = 1", params, draw(BOUNDS), name=name)
    return zs.Scene(
        shape, draw(CAMERAS), draw(MATERIALS), tuple(draw(LIGHTS)), draw(COLORS), draw(st.booleans()), draw(AROUND)
    )


@settings(FEW, max_examples=150)
@given(scenes())
def test_any_scene_is_read_back_the_same(scene: zs.Scene) -> None:
    written = dumps(scene)
    again = loads(written)
    assert again == scene
    assert dumps(again) == written


@settings(FEW, max_examples=150)
@given(scenes(), st.data())
def test_a_line_that_is_spoilt_is_the_line_that_is_named(scene: zs.Scene, data: st.DataObject) -> None:
    lines = dumps(scene).split("\n")
    found = Lines("\n".join(lines))._found
    # Lines with a value of their own: a text, a number, or true and false.
    plain = [number for path, number in found.items() if path[0] != "name" and " = " in lines[number - 1]]
    at = data.draw(st.sampled_from([n for n in plain if not lines[n - 1].endswith("[")]))
    key = lines[at - 1].partition(" = ")[0]
    lines[at - 1] = f"{key} = 2001-02-03"
    with pytest.raises(SceneFileError) as caught:
        loads("\n".join(lines), "my.toml")
    assert caught.value.line == at


TEXT = dumps(
    zs.Scene(
        zs.surface(
            "sum(i, (x - c[i])^2) + a*y = 1", {"a": 1.0, "c": [1.0, 2.0]}, bounds=zs.Ball(3.0, (1, 2, 3)), name="n"
        ),
        zs.Camera(),
        shadows=True,
        environment=zs.Environment("sky", 2.0),
    )
)
SIGNS = ["[", "]", "{", "}", '"', "'", "=", ",", ".", "\n", "#", "-", '"""', "{}", "[]", "[[1]]", "[" * 400]
WORDS = ["[[lights]]\n", "[lights]\n", "1e999", "nan", "true", "0x", '"sky"', "1979-05-27", "07:32:00", "9" * 5000]
PIECES = st.one_of(st.sampled_from(SIGNS + WORDS), st.text(max_size=3))


def end_of(text: str) -> zs.Scene | SceneFileError:
    """What reading a text ends in; nothing else may come of it."""
    try:
        return loads(text, "my.toml")
    except SceneFileError as error:
        return error


@settings(FEW, max_examples=600)
@given(st.lists(st.tuples(st.integers(0, len(TEXT)), st.integers(0, 12), PIECES), min_size=1, max_size=3))
def test_whatever_is_done_to_a_scene_file_ends_in_a_scene_or_in_words(changes: list[tuple[int, int, str]]) -> None:
    text = TEXT
    for at, cut, piece in changes:
        text = text[:at] + piece + text[at + cut :]
    ended = end_of(text)
    if isinstance(ended, SceneFileError):
        assert ended.line is None or 1 <= ended.line <= text.count("\n") + 1
    else:
        assert loads(dumps(ended)) == ended


@settings(FEW, max_examples=300)
@given(
    st.sampled_from([line.partition(" = ")[0] for line in TEXT.splitlines() if " = " in line]),
    st.sampled_from(
        [
            "3",
            "-1",
            "[]",
            "{}",
            '""',
            '"sky"',
            "[1, 2, 3]",
            "[[1, 2, 3], [4, 5, 6]]",
            "{a = 1}",
            "nan",
            "true",
            "07:32:00",
        ]
    ),
)
def test_other_values_of_a_key_end_in_a_scene_or_in_words(key: str, value: str) -> None:
    lines = TEXT.splitlines()
    # Lists take several lines: all of them go.
    first = next(i for i, line in enumerate(lines) if line.startswith(f"{key} = "))
    last = next(i for i in range(first, len(lines)) if lines[i] == "]") if lines[first].endswith("[") else first
    changed = "\n".join([*lines[:first], f"{key} = {value}", *lines[last + 1 :]])
    ended = end_of(changed)
    if isinstance(ended, SceneFileError):
        # It is named itself, or a formula that lacks it, or what it stands in.
        assert ended.line is not None
        assert ended.line <= first + 1
    else:
        assert loads(dumps(ended)) == ended


@pytest.mark.parametrize("opening", ["[", "{a = "])
@pytest.mark.parametrize("key", ["bounds", "name", "params", "material", "camera", "lights", "environment", "shadows"])
def test_nesting_of_any_depth_ends_in_words(key: str, opening: str) -> None:
    closing = "]" if opening == "[" else "}"
    for depth in range(2, 500, 31):
        inside = "1" if opening == "{a = " else ""
        with pytest.raises(SceneFileError):
            loads(f'formula = "x"\n{key} = {opening * depth}{inside}{closing * depth}', "my.toml")
