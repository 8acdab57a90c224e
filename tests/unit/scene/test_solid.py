"""Solids as a tree of surfaces, and their text."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

import zeroset as zs
from zeroset.errors import ParameterError
from zeroset.scene.solid import Solid
from zeroset.scene.solid_text import parse_solid, solid_text

A, B, C = (zs.surface(f"x^2 + y^2 + z^2 = {r}", name=name) for r, name in ((1, "a"), (2, "b"), (3, "barth-like c")))
NAMED = {"a": A, "b": B, "barth-like c": C}
NAMES = {surface: name for name, surface in NAMED.items()}


def test_operators_make_a_tree() -> None:
    assert (A & B).op == "and"
    assert (A | B).of == (A, B)
    assert A - B == A & ~B
    assert ((A - B) | C).surfaces == (A, B, C)
    assert ((A - B) | (B - A)).surfaces == (A, B)
    assert A & B != B & A
    assert len({A & B, A & B, A | B}) == 2


def test_materials_are_those_of_the_parts() -> None:
    red, usual = zs.Material(front=(1, 0, 0)), zs.Material()
    assert (A.with_material(red) - B).materials(usual) == (red, usual)


def test_parameters_go_to_every_surface_that_has_them() -> None:
    p, q = (zs.surface(f, {"r": 1.0}) for f in ("x^2 + y^2 = r", "x^2 + z^2 = r"))
    changed = (p - q | A).with_params(r=2.0)
    assert [dict(surface.params) for surface in changed.surfaces] == [{"r": 2.0}, {"r": 2.0}, {}]
    with pytest.raises(ParameterError, match="no surface has a parameter 's'"):
        (p - q).with_params(s=1.0)


def test_what_is_no_solid() -> None:
    with pytest.raises(ParameterError, match="made of surfaces"):
        A & 3  # type: ignore[operator]
    with pytest.raises(ParameterError, match="isovalues"):
        A & B.with_isovalues((1, 2))
    many = A
    for i in range(64):
        many = many | zs.surface(f"x = {i}")  # type: ignore[assignment]
        if i == 62:
            assert len(many.surfaces) == 64
            break
    with pytest.raises(ParameterError, match="at most 64"):
        many | B
    with pytest.raises(ParameterError, match="at most 32"):
        zs.Scene(many)


TREES = st.recursive(
    st.sampled_from([A, B, C]),
    lambda inner: st.one_of(
        st.builds(lambda a, b: a & b, inner, inner),
        st.builds(lambda a, b: a | b, inner, inner),
        st.builds(lambda a, b: a - b, inner, inner),
        st.builds(lambda a: ~a, inner),
    ),
    max_leaves=12,
)


@given(TREES)
def test_text_gives_the_same_solid_back(thing: zs.Surface | Solid) -> None:
    assert parse_solid(solid_text(thing, NAMES), NAMED) == thing


def test_text_is_short() -> None:
    assert solid_text((A & B) - C, NAMES) == "(a & b) - 'barth-like c'"
    assert solid_text(A - B | ~A, NAMES) == "a - b | ~a"


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "empty"),
        ("  ", "empty"),
        ("a &", "no solid"),
        ("a + b", "cannot be part"),
        ("a & 3", "'3' cannot be part"),
        ("f(a)", "cannot be part"),
        ("a & d", "no surface named 'd'"),
        ("a.b", "cannot be part"),
        ("a\0", "no solid"),
        ("~" * 3000 + "a", "no solid"),
        ("a" * 5000, "longer"),
    ],
)
def test_text_that_is_no_solid(text: str, complaint: str) -> None:
    with pytest.raises(ParameterError, match=complaint):
        parse_solid(text, NAMED)
