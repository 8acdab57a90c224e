"""What a name in a formula means, and what to say when it means nothing.

A parameter wins over a constant of the same name; the variables and the functions cannot be renamed. A name
made of the letters x y z w alone is their product (`tokens.py` takes it apart).
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from zeroset.errors import ParameterError, UnknownNameError, did_you_mean
from zeroset.expr.dag import Expr, node
from zeroset.expr.derived import CONSTANTS, DERIVED
from zeroset.expr.ops import FUNCTIONS

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["VARIABLES", "Names", "check_name", "variable"]

VARIABLES = ("x", "y", "z", "w")
_WORDS = frozenset({"and", "or", "not"})
_NAME = re.compile(r"[^\W\d]\w*")


def variable(name: str) -> Expr:
    """The node of one of x, y, z, w."""
    return node("variable", (), (name,))


class Names:
    """The names that one formula may use.

    Args:
        text: The formula, for errors.
        params: Names of scalar parameters.
        arrays: Names of array parameters.
        open: Whether unknown names become parameters (and unknown indexed names arrays).

    Raises:
        ParameterError: A parameter has the name of a variable, or what is no name.
    """

    def __init__(self, text: str, params: Collection[str], arrays: Collection[str], open: bool) -> None:
        self.text = text
        self.params = frozenset(params)
        self.arrays = frozenset(arrays)
        self.open = open
        self.indices: set[str] = set()
        for name in self.params | self.arrays:
            check_name(name)

    def is_word(self, name: str) -> bool:
        """Whether a name is `and`, `or`, or `not`."""
        return name in _WORDS and name not in self.params

    def is_function(self, name: str) -> bool:
        """Whether a name followed by `(` is a function call."""
        return name in FUNCTIONS or name in DERIVED or name == "sum"

    def is_value(self, name: str) -> bool:
        """Whether a name stands for a number by itself."""
        return name in self.params or name in CONSTANTS or self.is_letters(name)

    def is_letters(self, name: str) -> bool:
        """Whether a name is a run of variables, such as xy."""
        return not name.strip("xyzw") and name not in self.params

    def becomes_parameter(self, name: str) -> bool:
        """Whether an unknown name is taken for a new parameter."""
        return self.open and not self.is_value(name) and not self.is_function(name)

    def value(self, name: str, position: int) -> Expr:
        """The node that a name stands for.

        Raises:
            UnknownNameError: It stands for nothing.
        """
        if name in self.params or self.becomes_parameter(name):
            return node("parameter", (), (name,))
        if name in CONSTANTS:
            return CONSTANTS[name]
        if name in VARIABLES:
            return variable(name)
        raise self._unknown(name, position)

    def element(self, name: str, index: str, position: int) -> Expr:
        """The node of an array parameter's element.

        Raises:
            UnknownNameError: There is no array parameter of that name.
        """
        if name in self.arrays or self.open:
            return node("element", (), (name, index))
        raise UnknownNameError(
            f"{name} is not an array parameter",
            name=name,
            text=self.text,
            position=position,
            hints=(
                *did_you_mean(name, self.arrays),
                f"give it its values: params={{'{name}': [1.0, 2.0]}}",
            ),
        )

    def unknown_function(self, name: str, position: int) -> UnknownNameError:
        """The error for a name that is called but is no function."""
        hints = [*did_you_mean(name, {*FUNCTIONS, *DERIVED, "sum"})]
        tail = next((cut for cut in range(1, len(name)) if self.is_function(name[cut:])), None)
        if tail is not None and (parts := self._split(name[:tail])):
            hints.insert(0, f"write a product with a space or a star: {'*'.join(parts)}*{name[tail:]}(...)")
        hints.append(f"if {name} is a parameter, give it a value (params={{'{name}': 1.0}}) and write {name}*(...)")
        return UnknownNameError(f"unknown function {name}", name=name, text=self.text, position=position, hints=hints)

    def _unknown(self, name: str, position: int) -> UnknownNameError:
        """The error for a name that stands for nothing."""
        hints = [f"the index of a sum stands in brackets only: r[{name}]"] if name in self.indices else []
        digits = re.fullmatch(r"(\w*?[^\W\d])(\d+)", name)
        if digits and self.is_value(digits[1]):
            hints.append(f"for a power write {digits[1]}^{digits[2]}, for a product {digits[2]}*{digits[1]}")
        parts = self._split(name)
        if len(parts) > 1:
            hints.append(f"for a product write {'*'.join(parts)}")
        called = self._called(name)
        known = {*VARIABLES, *CONSTANTS, *self.params}
        near = did_you_mean(name, {*known, *FUNCTIONS, *DERIVED} if len(name) > 1 else known)
        hints += [f"did you mean {called}?"] if called else near
        if name in self.arrays:
            hints.append(f"{name} is an array: use its elements in a sum, sum(i, ... {name}[i] ...)")
        hints.append(f"give it a value: params={{'{name}': 1.0}}")
        return UnknownNameError(
            f"unknown name {name}: it is no variable (x, y, z, w), constant, or parameter",
            name=name,
            text=self.text,
            position=position,
            hints=hints,
        )

    def _called(self, name: str) -> str:
        """A name that is a function's and what it is of, as in sinx, with the parentheses; or nothing."""
        for cut in range(len(name) - 1, 0, -1):
            digits, rest = re.fullmatch(r"(\d*)(.*)", name[cut:]).groups()  # type: ignore[union-attr]
            if self.is_function(name[:cut]) and self._split(rest):
                return f"{name[:cut]}({digits}{rest})"
        return ""

    def _split(self, name: str) -> list[str]:
        """A run of letters as known names, longest first, or nothing."""
        known = {*VARIABLES, *CONSTANTS, *self.params}
        parts: list[str] = []
        while name:
            part = next((name[:n] for n in range(min(len(name), 30), 0, -1) if name[:n] in known), None)
            if part is None:
                return []
            parts.append(part)
            name = name[len(part) :]
        return parts


def check_name(name: str) -> None:
    """Refuse the name of a parameter that no formula could mean.

    Raises:
        ParameterError: It is that of a variable, or no name at all.
    """
    if name in VARIABLES:
        raise ParameterError(f"{name} is a variable, so no parameter can have that name", hint="rename the parameter")
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ParameterError(
            f"{name!r} cannot be the name of a parameter",
            hint="a name is letters, digits and underscores, and starts with no digit",
        )
