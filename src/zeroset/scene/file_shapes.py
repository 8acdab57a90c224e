"""What a scene file draws: one formula, ``[[surfaces]]``, and solids over named ones; read and written.

    [[surfaces]]
    name = "ball"
    formula = "x^2 + y^2 + z^2 = 1"
    material = {front = [0.8, 0.1, 0.1]}

    [[surfaces]]
    name = "hole"
    formula = "x^2 + y^2 = r^2"
    params = {r = 0.4}

    [[surfaces]]
    solid = "ball - hole"
    bounds = 1.1

What is part of a solid is not drawn by itself. A solid names surfaces that stand before it, so that none can be part of
itself. Where there is only one, ``solid = "ball - hole"`` may also stand at the top.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager
from typing import Any, Protocol

from zeroset.errors import SceneFileError
from zeroset.scene.bounds import Ball, Bounds, parse_bounds
from zeroset.scene.light import Material
from zeroset.scene.scene import Scene
from zeroset.scene.several import Drawable, Several, as_drawable
from zeroset.scene.solid import Solid
from zeroset.scene.solid_text import names_in, parse_solid, solid_text
from zeroset.scene.surface import Surface, surface

KEYS = ("formula", "name", "bounds", "params", "isovalues", "colors")
"""What one surface is made of."""
TOP = (*KEYS, "solid", "surfaces")
"""What of a scene file says what is drawn."""
OWN = ("params", "isovalues", "colors")
"""What only a surface with a formula has."""
NAMELESS = "_"
"""Begins the names that surfaces without a name get in a file, where a solid needs them."""


class Reader(Protocol):
    """What reads a file, and says where it is wrong."""

    def fail(self, message: str, key: str, hints: tuple[str, ...] = ()) -> SceneFileError:
        """An error at the line of a key."""

    def known(self, data: Any, keys: tuple[str, ...], where: str) -> Mapping[str, Any]:
        """A table that has only these keys."""

    def table(self, data: Mapping[str, Any], key: str) -> Mapping[str, Any]:
        """A table in a table; an empty one where there is none."""

    def material(self, data: Any) -> Any:
        """A material from a table."""

    def placing(self, key: str) -> AbstractContextManager[None]:
        """Errors inside get the line of a key."""

    def inside(self, what: str, index: int) -> AbstractContextManager[None]:
        """Lines are looked for in one of several tables."""


def read_shapes(reader: Reader, data: Mapping[str, Any]) -> Drawable:
    """What a scene file draws."""
    listed = data.get("surfaces", [])
    if not isinstance(listed, list):
        raise reader.fail("surfaces must be a list of tables", "surfaces", ("write each as [[surfaces]]",))
    if "formula" in data and (listed or "solid" in data):
        both = "surfaces" if listed else "solid"
        raise reader.fail(
            f"a scene has a formula or {both}, not both", "formula", ("put the formula into [[surfaces]]",)
        )
    if "surfaces" not in data and "solid" not in data:
        return _surface(reader, data)
    for key in (*OWN, "name", "bounds") if "solid" not in data else ():
        if key in data:
            raise reader.fail(f"{key} belongs to one surface", key, ("put it below [[surfaces]]",))
    shapes = _Shapes(reader)
    for i, table in enumerate(listed):
        with reader.inside("surfaces", i):
            shapes.add(reader.known(table, (*KEYS, "solid", "material"), "a surface"))
    if "solid" in data:
        whole = shapes.solid(data)
        for name in shapes.alone:
            hints = ("leave it out, or join it",)
            raise reader.fail(f"the surface {name.strip()!r} is no part of the solid", "solid", hints)
        return whole
    with reader.placing("surfaces"):
        made = as_drawable([*shapes.alone.values()])
        # A scene knows how much it can show.
        return Scene(made).surface


def _surface(reader: Reader, data: Mapping[str, Any]) -> Surface:
    """A surface from its keys."""
    if not isinstance(data.get("formula"), str):
        raise reader.fail("a scene needs a formula as text", "formula", ('formula = "x^2 + y^2 + z^2 = 1"',))
    params = reader.table(data, "params")
    with reader.placing("formula"):
        made = surface(data["formula"], params, name=str(data.get("name", "")))
    with reader.placing("bounds"):
        made = dataclasses.replace(made, bounds=parse_bounds(data.get("bounds")))
    if "colors" in data and "isovalues" not in data:
        raise reader.fail("colors are those of isovalues, and there are none", "colors", ("isovalues = [0.0, 0.5]",))
    if "isovalues" in data:
        with reader.placing("isovalues"):
            made = made.with_isovalues(data["isovalues"], data.get("colors"))
    return made


class _Shapes:
    """The surfaces and solids of a file, one after the other."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self._named: dict[str, Surface | Solid] = {}
        self._count = 0
        self.alone: dict[str, Surface | Solid] = {}
        """What is drawn by itself."""

    def add(self, table: Mapping[str, Any]) -> None:
        """One more table."""
        reader = self._reader
        name = str(table.get("name", ""))
        if name in self._named:
            raise reader.fail(f"there are two surfaces named {name!r}", "name", ("give one another name",))
        if ("formula" in table) == ("solid" in table):
            raise reader.fail(
                "a surface has a formula or a solid, and not both", "name", ('formula = "x^2 + y^2 = 1"',)
            )
        made = self.solid(table) if "solid" in table else self._surface(table)
        if name:
            self._named[name] = made
        self._count += 1
        # No name has a line break in it, so these are no names.
        self.alone[name or f"\n{self._count}"] = made

    def _surface(self, table: Mapping[str, Any]) -> Surface:
        made = _surface(self._reader, table)
        if "material" in table:
            made = made.with_material(self._reader.material(table["material"]))
        return dataclasses.replace(made, name=_without_number(made.name))

    def solid(self, table: Mapping[str, Any]) -> Surface | Solid:
        """A solid from its text, its bounds and its name; what it is made of is not drawn by itself."""
        reader = self._reader
        # At the top of a file the material is the scene's.
        for key in OWN if "surfaces" in table else (*OWN, "material"):
            if key in table:
                raise reader.fail(f"a solid has no {key} of its own", key, ("give its surfaces theirs",))
        if not isinstance(table["solid"], str):
            raise reader.fail("a solid is a text", "solid", ('solid = "(a & b) - c"',))
        with reader.placing("solid"):
            made = parse_solid(table["solid"], self._named)
        with reader.placing("bounds"):
            limits = parse_bounds(table.get("bounds"))
        used = names_in(table["solid"])
        self.alone = {key: thing for key, thing in self.alone.items() if key not in used}
        if isinstance(made, Surface):
            return dataclasses.replace(made, bounds=limits or made.bounds)
        return dataclasses.replace(made, bounds=limits, name=_without_number(str(table.get("name", ""))))


def _without_number(name: str) -> str:
    """A name as it was before ``_Names`` made one up."""
    return "" if name.startswith(NAMELESS) and name[1:].isdigit() else name


# ---------------------------------------------------------- writing


def shapes_data(thing: Drawable) -> dict[str, Any]:
    """What is drawn, as a scene file has it; ``read_shapes`` gives the same back, without cameras."""
    if isinstance(thing, Surface) and thing.material is None:
        return _surface_data(thing, thing.name)
    things = thing.things if isinstance(thing, Several) else (thing,)
    names = _Names(things)
    tables = [_surface_data(part, names.of[part]) for part in names.parts]
    for each in things:
        if isinstance(each, Surface):
            tables.append(_surface_data(each, each.name))
        else:
            table: dict[str, Any] = {"name": each.name} if each.name else {}
            table["solid"] = solid_text(each, names.of)
            tables.append(table if each.bounds is None else {**table, "bounds": bounds_data(each.bounds)})
    return {"surfaces": tables}


class _Names:
    """A name for every surface that is part of a solid.

    Attributes:
        parts: those surfaces.
        of: their names.
    """

    def __init__(self, things: tuple[Surface | Solid, ...]) -> None:
        solids = (thing for thing in things if isinstance(thing, Solid))
        self.parts = tuple(dict.fromkeys(part for solid in solids for part in solid.surfaces))
        taken = {thing.name for thing in things}
        self.of: dict[Surface, str] = {}
        for part, made_up in zip(self.parts, self._numbers(), strict=False):
            self.of[part] = made_up if part.name in taken or not part.name else part.name
            taken.add(self.of[part])

    @staticmethod
    def _numbers() -> Iterator[str]:
        number = 0
        while True:
            number += 1
            yield f"{NAMELESS}{number}"


def _surface_data(shape: Surface, name: str) -> dict[str, Any]:
    data: dict[str, Any] = {"formula": shape.formula}
    if name:
        data["name"] = name
    if shape.bounds is not None:
        data["bounds"] = bounds_data(shape.bounds)
    if shape.isovalues:
        data |= {"isovalues": list(shape.isovalues), "colors": [list(color) for color in shape.colors]}
    params: dict[str, Any] = dict(shape.params) | {k: [float(v) for v in a] for k, a in shape.arrays.items()}
    if params:
        data["params"] = params
    if shape.material is not None:
        data["material"] = material_data(shape.material)
    return data


def material_data(material: Material) -> dict[str, Any]:
    """A material as a scene file has it."""
    data = given(dataclasses.asdict(material))
    if material.coloring is not None:
        data["coloring"] = given(dataclasses.asdict(material.coloring))
    return data


def given(data: dict[str, Any]) -> dict[str, Any]:
    """What of it is not None, which TOML does not know."""
    return {k: v for k, v in data.items() if v is not None}


def bounds_data(bounds: Bounds) -> Any:
    """Bounds as a scene file has them."""
    if isinstance(bounds, Ball):
        return bounds.radius if not any(bounds.center) else dataclasses.asdict(bounds)
    return dataclasses.asdict(bounds)
