"""What a scene shows as surfaces f = 0 and nothing more, for what knows no solids: meshes, the window.

A solid becomes one f, with max for *and*, min for *or* and -f for *not* (K09 6.3 and HyperFun have solids so): the same
skin, but one material, and creases where f has no gradient. Rays are traced through solids as they are.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping
from itertools import chain, count
from typing import Any

import numpy as np

from zeroset.expr import Expr, closed
from zeroset.expr.dag import node
from zeroset.expr.renaming import renamed
from zeroset.scene.exprfield import ExprField
from zeroset.scene.several import Drawable, Several
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface


def plain_surfaces(thing: Drawable) -> tuple[Surface, ...]:
    """The surfaces f = 0 that something consists of: of a surface itself, or one for each isovalue; of a solid one.

    Example:
        >>> import zeroset as zs
        >>> ball = zs.surface("x^2 + y^2 + z^2", bounds=2.0)
        >>> [s.formula for s in plain_surfaces(ball.with_isovalues((1, 2)))]
        ['x^2 + y^2 + z^2 - isovalue', 'x^2 + y^2 + z^2 - isovalue']
    """
    if isinstance(thing, Several):
        return tuple(surface for part in thing for surface in plain_surfaces(part))
    if isinstance(thing, Solid):
        return (merged(thing),)
    if not thing.isovalues:
        return (thing,)
    name = _level_name(thing)
    field = ExprField(thing.field.expr - node("parameter", (), (name,)))
    bare = dataclasses.replace(thing, isovalues=(), colors=(), bounds=thing.fitted)
    return tuple(
        dataclasses.replace(bare, field=field, params={**thing.params, name: value}) for value in thing.isovalues
    )


def merged(solid: Solid) -> Surface:
    """A solid as one f <= 0.

    Parameters of several surfaces that have the same name and value are one; others are told apart by a number.

    Example:
        >>> import zeroset as zs
        >>> ball, hole = zs.surface("x^2 + y^2 + z^2 = r^2", params={"r": 1}), zs.surface("x^2 = r", params={"r": 0.1})
        >>> one = merged(ball - hole)
        >>> one.formula, dict(one.params)
        ('max(x^2 + y^2 + z^2 - r^2, r_2 - x^2)', {'r': 1.0, 'r_2': 0.1})
    """
    params: dict[str, float] = {}
    arrays: dict[str, Any] = {}
    made = {surface: _joined(surface, params, arrays) for surface in solid.surfaces}
    field = ExprField(_tree(solid, made))
    material = solid.surfaces[0].material
    return Surface(field, params, arrays, solid.fitted, solid.camera, solid.name, material)


def _tree(part: Surface | Solid, made: Mapping[Surface, Expr]) -> Expr:
    if isinstance(part, Surface):
        return made[part]
    of = [_tree(each, made) for each in part.of]
    return -of[0] if part.op == "not" else node("min" if part.op == "or" else "max", tuple(of))


def _joined(surface: Surface, params: dict[str, float], arrays: dict[str, Any]) -> Expr:
    """A surface's formula, defined everywhere, with what it asks for put among what others ask for."""
    names: dict[str, str] = {}
    pairs: tuple[tuple[dict[str, Any], Mapping[str, Any]], ...] = (params, surface.params), (arrays, surface.arrays)
    for kept, own in pairs:
        for name, value in own.items():
            names[name] = _place(name, value, kept, {*params, *arrays})
            kept[names[name]] = value
    return renamed(closed(surface.field.expr), {old: new for old, new in names.items() if old != new})


def _place(name: str, value: Any, kept: Mapping[str, Any], taken: Collection[str]) -> str:
    """The name under which a value goes: its own where that is free, or has this very value already."""
    candidates = chain((name,), (f"{name}_{i}" for i in count(2)))
    return next(c for c in candidates if c not in taken or (c in kept and np.array_equal(kept[c], value)))


def _level_name(surface: Surface) -> str:
    """What the isovalue is called in a formula that may have such a name already."""
    return _place("isovalue", None, {}, {*surface.params, *surface.arrays})
