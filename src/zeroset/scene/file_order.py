"""Surfaces of a scene file that a solid names before they are there: later in the file, or never, in a circle."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from zeroset.errors import ParameterError
from zeroset.scene.solid_text import names_in


class Order:
    """Which names a file has, and which of them each is made of.

    Args:
        tables: the file's surfaces, as they were read; not yet checked.
    """

    def __init__(self, tables: Iterable[Any]) -> None:
        named = [table for table in tables if isinstance(table, Mapping) and isinstance(table.get("name"), str)]
        self._uses = {str(table["name"]): _names(table.get("solid")) for table in named if table["name"]}

    def check(self, text: str, own: str, known: Collection[str]) -> None:
        """Raise ``ParameterError`` where a solid names what the file has, but not before it.

        Args:
            text: of the solid.
            own: its name; may be empty.
            known: the names that stand before it.
        """
        for name in sorted(_names(text).difference(known).intersection(self._uses)):
            if own and self._reaches(name, own):
                through = "" if name == own else f", by way of {name!r}"
                raise ParameterError(
                    f"the solid {own!r} would be part of itself{through}", hint="leave it out of one of them"
                )
            raise ParameterError(
                f"the surface {name!r} stands after this solid", hint="put it before: solids are made of what is there"
            )

    def _reaches(self, start: str, goal: str) -> bool:
        """Whether something is the goal, or made of it."""
        seen: set[str] = set()
        front = {start}
        while front:
            seen |= front
            front = {name for each in front for name in self._uses.get(each, ())} - seen
        return goal in seen


def _names(text: Any) -> frozenset[str]:
    """The names in the text of a solid; none where it is no such text, which others complain of."""
    try:
        return names_in(text) if isinstance(text, str) else frozenset()
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return frozenset()
