"""Which entry of a scene file is to blame for an error, and how a cure is written there."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from typing import Any

from zeroset.errors import ArrayShapeError, ParameterError, ZerosetError
from zeroset.scene.bounds import Ball, vector
from zeroset.scene.lines import Path
from zeroset.scene.parameters import array, scalar


def blamed(cls: type[Any], values: Mapping[str, Any]) -> Path:
    """The one of several values that is not taken even by itself, or nothing where each is."""
    needed = [f.name for f in dataclasses.fields(cls) if f.name in values and not _has_default(f)]
    for key in (*needed, *values):
        try:
            cls(**{name: values[name] for name in (*needed, key)})
        except ZerosetError:
            return (key,)
    return ()


def _has_default(field: dataclasses.Field[Any]) -> bool:
    return field.default is not dataclasses.MISSING or field.default_factory is not dataclasses.MISSING


def blamed_params(params: Mapping[str, Any], error: ZerosetError) -> Path:
    """The parameter that is to blame for an error, or else the formula."""
    for name, value in params.items():
        try:
            (array if isinstance(value, list) else scalar)(name, value)
        except ZerosetError:
            return ("params", name)
    if isinstance(error, ParameterError):
        named = [name for name in params if repr(name) in error.message]
        return ("params", named[0]) if named else ("formula",)
    return ("params",) if isinstance(error, ArrayShapeError) else ("formula",)


def blamed_bounds(limits: Any) -> Path:
    """The entry of bounds that is not taken by itself."""
    checks = {"radius": Ball, "center": lambda v: Ball(1.0, v), "min": _corner, "max": _corner}
    for key, value in limits.items() if isinstance(limits, Mapping) else ():
        if key not in checks:
            return (key,)
        try:
            checks[key](value)
        except ZerosetError:
            return (key,)
    return ()


def _corner(value: Any) -> Any:
    return vector(value, "a corner")


def blamed_coloring(data: Mapping[str, Any]) -> Path:
    """Where a file says to colour by something, if it cannot: the first place, or the first that says otherwise."""
    tables: list[tuple[Path, Any]] = [((), data)]
    tables += [(("surfaces", i), table) for i, table in enumerate(data.get("surfaces", ()))]
    given = [((*path, "material", "coloring"), table.get("material", {}).get("coloring")) for path, table in tables]
    said = [(path, value) for path, value in given if value is not None]
    path, value = next((each for each in said if each[1] != said[0][1]), said[0])
    return (*path, "by") if isinstance(value, Mapping) else path


def in_toml(hint: str) -> str:
    """A hint that speaks of Python's arguments, as a scene file has them.

    Example:
        >>> in_toml("give it one: params={'a': ...}"), in_toml("try up=(0, 0, 1)")
        ('give it one: params = {a = 1.0}', 'try up = [0, 0, 1]')
    """
    hint = re.sub(r"params=\{'(\w+)': [^}]*\}", r"params = {\1 = 1.0}", hint)
    lists = str.maketrans("()", "[]")
    return re.sub(r"\b(bounds|up)=(\(.*\)|[^()]*)", lambda m: f"{m[1]} = {m[2].translate(lists)}", hint)
