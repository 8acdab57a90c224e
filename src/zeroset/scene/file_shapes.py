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
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from typing import Any, Protocol

from zeroset.errors import ParameterError, SceneFileError, ZerosetError
from zeroset.scene.blame import blamed_bounds, blamed_params
from zeroset.scene.bounds import Ball, Bounds, parse_bounds
from zeroset.scene.file_order import Order
from zeroset.scene.isovalues import isovalues_of
from zeroset.scene.light import Material
from zeroset.scene.lines import Path
from zeroset.scene.scene import check_parts
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

    def fail(self, message: str, place: str | Path, hints: tuple[str, ...] = ()) -> SceneFileError:
        """An error at a place."""

    def known(self, data: Any, keys: tuple[str, ...], where: str, path: Path = ()) -> Mapping[str, Any]:
        """A table that has only these keys."""

    def kinds(self, value: Any, path: Path) -> Any:
        """The value, if all in it is of the kind that is meant there."""

    def table(self, data: Mapping[str, Any], key: str, path: Path) -> Mapping[str, Any]:
        """A table of names and values in a table; an empty one where there is none."""

    def material(self, data: Any, path: Path) -> Material:
        """A material from a table."""

    def placing(self, place: Callable[[ZerosetError], Path]) -> AbstractContextManager[None]:
        """Errors inside get the line of a place."""


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
        return _surface(reader, data, ())
    for key in (*OWN, "name", "bounds") if "solid" not in data else ():
        if key in data:
            raise reader.fail(f"{key} belongs to one surface", key, ("put it below [[surfaces]]",))
    shapes = _Shapes(reader, Order(listed))
    for i, table in enumerate(listed):
        path: Path = ("surfaces", i)
        shapes.add(reader.known(table, (*KEYS, "solid", "material"), "a surface", path), path)
    if "solid" in data:
        whole = shapes.solid(data, ())
        for name in shapes.alone:
            hints = ("leave it out, or join it",)
            raise reader.fail(f"the surface {name.strip()!r} is no part of the solid", "solid", hints)
        return whole
    with reader.placing(lambda error: ("surfaces",)):
        made = as_drawable([*shapes.alone.values()])
        check_parts(made)
        return made


def _surface(reader: Reader, data: Mapping[str, Any], path: Path) -> Surface:
    """A surface from its keys."""
    if not isinstance(data.get("formula"), str):
        raise reader.fail("a scene needs a formula as text", (*path, "formula"), ('formula = "x^2 + y^2 + z^2 = 1"',))
    params = reader.table(data, "params", path)
    name = reader.kinds(data.get("name", ""), (*path, "name"))
    with reader.placing(lambda error: (*path, *blamed_params(params, error))):
        made = surface(data["formula"], params, name=name)
    made = dataclasses.replace(made, bounds=_bounds(reader, data, path))
    if "colors" in data and "isovalues" not in data:
        where = (*path, "colors")
        raise reader.fail("colors are those of isovalues, and there are none", where, ("isovalues = [0.0, 0.5]",))
    if "isovalues" in data:
        values, colors = _isovalues(reader, data, path)
        with reader.placing(lambda error: (*path, _blamed_isovalues(values))):
            made = made.with_isovalues(values, colors)
    return made


def _bounds(reader: Reader, data: Mapping[str, Any], path: Path) -> Bounds | None:
    limits = reader.kinds(data["bounds"], (*path, "bounds")) if "bounds" in data else None
    with reader.placing(lambda error: (*path, "bounds", *blamed_bounds(limits))):
        return parse_bounds(limits)


def _isovalues(reader: Reader, data: Mapping[str, Any], path: Path) -> tuple[Any, Any]:
    """The isovalues, and their colours if there are any."""
    values = reader.kinds(data["isovalues"], (*path, "isovalues")) if isinstance(data["isovalues"], list) else None
    if values is None:
        raise reader.fail("isovalues must be a list of numbers", (*path, "isovalues"), ("isovalues = [0.0, 0.5]",))
    return values, reader.kinds(data["colors"], (*path, "colors")) if "colors" in data else None


def _blamed_isovalues(values: Any) -> str:
    """Which key is to blame for isovalues that are not taken."""
    try:
        isovalues_of(values)
    except ParameterError:
        return "isovalues"
    return "colors"


class _Shapes:
    """The surfaces and solids of a file, one after the other."""

    def __init__(self, reader: Reader, order: Order) -> None:
        self._reader = reader
        self._order = order
        self._named: dict[str, Surface | Solid] = {}
        self._count = 0
        self.alone: dict[str, Surface | Solid] = {}
        """What is drawn by itself."""

    def add(self, table: Mapping[str, Any], path: Path) -> None:
        """One more table."""
        reader = self._reader
        name = reader.kinds(table.get("name", ""), (*path, "name"))
        if name in self._named:
            raise reader.fail(f"there are two surfaces named {name!r}", (*path, "name"), ("give one another name",))
        if ("formula" in table) == ("solid" in table):
            wrong = "and not both" if "formula" in table else "and this one has neither"
            raise reader.fail(f"a surface has a formula or a solid, {wrong}", path, ('formula = "x^2 + y^2 = 1"',))
        made = self.solid(table, path) if "solid" in table else self._surface(table, path)
        if name:
            self._named[name] = made
        self._count += 1
        # No name begins with a line break, so these are no names.
        self.alone[name or f"\n{self._count}"] = made

    def _surface(self, table: Mapping[str, Any], path: Path) -> Surface:
        made = _surface(self._reader, table, path)
        if "material" in table:
            made = made.with_material(self._reader.material(table["material"], (*path, "material")))
        return dataclasses.replace(made, name=_without_number(made.name))

    def solid(self, table: Mapping[str, Any], path: Path) -> Surface | Solid:
        """A solid from its text, its bounds and its name; what it is made of is not drawn by itself."""
        reader = self._reader
        # At the top of a file the material is the scene's.
        for key in (*OWN, "material") if path else OWN:
            if key in table:
                raise reader.fail(f"a solid has no {key} of its own", (*path, key), ("give its surfaces theirs",))
        text = reader.kinds(table["solid"], (*path, "solid"))
        with reader.placing(lambda error: (*path, "solid")):
            self._order.check(text, str(table.get("name", "")) if path else "", self._named)
            made = parse_solid(text, self._named)
        limits = _bounds(reader, table, path)
        used = names_in(text)
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
    taken = set(names.of.values())
    for each in things:
        # A name means one thing in a file: what comes later and is called the same goes without.
        name = "" if each.name in taken else each.name
        taken.add(name)
        if isinstance(each, Surface):
            tables.append(_surface_data(each, name))
        else:
            table: dict[str, Any] = {"name": name} if name else {}
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
