"""What kind of value stands in a scene file: numbers where numbers are meant, true and false where these are.

The classes of a scene take whatever Python makes a number of, ``"5"`` and ``true`` among them; in a file, it is
a slip.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterator, Mapping
from typing import Any

from zeroset.scene.lines import Path

LONGEST = 60
"""Characters of a value that an error shows."""
TEXTS = ("formula", "name", "solid", "source", "environment", "coloring", "by", "map")
SWITCHES = ("shadows", "headlight", "last_solid")
SINGLE = ("formula", "name", "solid", *SWITCHES)
"""What even an empty list is not."""
CORNERS = ("center", "min", "max")
TRIPLES = ("background", "eye", "target", "up", "front", "back", "direction", "color", "position", *CORNERS)


def wrong_kind(value: Any, path: Path) -> tuple[Path, str] | None:
    """Where the first value of a wrong kind is, and what is to be said of it; None where there is none.

    Args:
        value: a value, a list or a table.
        path: where it stands.

    Example:
        >>> wrong_kind({"ior": "1.5"}, ("material",))
        (('material', 'ior'), "material.ior must be a number, not '1.5'")
    """
    for place, leaf in _leaves(value, path):
        wanted = _wanted(place)
        right = isinstance(leaf, {"text": str, "true or false": bool}.get(wanted, (int, float)))
        if not right or (isinstance(leaf, bool) and wanted != "true or false"):
            return place, f"{dotted(place)} must be {wanted}, not {shown(leaf)}"
    return None


def shown(value: Any) -> str:
    """A value as it stands in a file, cut short where it is long.

    Example:
        >>> shown(True), shown([1, 2])
        ('true', '[1, 2]')
    """
    if isinstance(value, (bool, datetime.date, datetime.time)):
        return str(value).lower() if isinstance(value, bool) else str(value)
    text = repr(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def _leaves(value: Any, path: Path) -> Iterator[tuple[Path, Any]]:
    """Each value that is neither a table nor a list, or must not be, with its path."""
    single = path[-1:] and path[-1] in SINGLE and _own(path)[:1] != ("params",)
    if isinstance(value, (Mapping, list)) and not single:
        for key, part in value.items() if isinstance(value, Mapping) else enumerate(value):
            yield from _leaves(part, (*path, key))
    else:
        yield path, value


def _wanted(path: Path) -> str:
    """What should stand at a path; of parameters, that their names may be any is no matter."""
    names = [part for part in _own(path) if isinstance(part, str)]
    if names[0] == "params":
        return "a number"
    if names[-1] in TEXTS:
        return "text"
    if names[-1] in SWITCHES:
        return "true or false"
    return "three numbers" if names[-1] in TRIPLES and path[-1] == names[-1] else "a number"


def _own(path: Path) -> Path:
    """A path in the table of one of several surfaces, from that table on."""
    return path[2:] if path[:1] == ("surfaces",) else path


def dotted(path: Path) -> str:
    """A path as TOML writes it: ``lights[1].color``."""
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path).removeprefix(".")
