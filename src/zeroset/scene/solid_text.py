"""Solids as text over named surfaces: ``(a & b) - c``, read and written with Python's own precedences.

A name that is no word, such as one with a hyphen, stands between quotes: ``'barth-sextic' & ball``.
"""

from __future__ import annotations

import ast
import keyword
from collections.abc import Mapping

from zeroset.errors import ParameterError, did_you_mean
from zeroset.scene.solid import Solid, join, subtract
from zeroset.scene.surface import Surface

LONGEST = 4000
"""Characters of a solid's text."""
SHAPE = 'solid = "(a & b) - c": & both, | either, - without, ~ all but'

_OR, _AND, _MINUS, _NOT = 1, 2, 3, 4


def parse_solid(text: str, named: Mapping[str, Surface | Solid]) -> Surface | Solid:
    """The solid that a text means.

    Args:
        text: names with ``&``, ``|``, ``-``, ``~`` and parentheses.
        named: what the names mean.

    Raises:
        ParameterError: the text is no such thing, or has a name that is not known.

    Example:
        >>> import zeroset as zs
        >>> ball, hole = zs.surface("x^2 + y^2 + z^2 = 1"), zs.surface("x^2 + y^2 = 0.2")
        >>> parse_solid("ball - hole", {"ball": ball, "hole": hole}) == ball - hole
        True
    """
    if not text.strip():
        raise ParameterError("the solid is empty", hint=SHAPE)
    if len(text) > LONGEST:
        raise ParameterError(f"the solid's text is longer than {LONGEST} characters")
    try:
        return _read(ast.parse(text.strip(), mode="eval").body, text, named)
    except ParameterError:
        raise
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ParameterError(f"this is no solid: {text!r}", hint=SHAPE) from None


def names_in(text: str) -> frozenset[str]:
    """The names in the text of a solid."""
    nodes = list(ast.walk(ast.parse(text.strip(), mode="eval")))
    names = (node.id for node in nodes if isinstance(node, ast.Name))
    return frozenset((*names, *(str(node.value) for node in nodes if isinstance(node, ast.Constant))))


def _read(node: ast.expr, text: str, named: Mapping[str, Surface | Solid]) -> Surface | Solid:
    match node:
        case ast.Name(id=str(name)) | ast.Constant(value=str(name)):
            return _known(name, named)
        case ast.UnaryOp(op=ast.Invert(), operand=inner):
            return Solid("not", (_read(inner, text, named),))
        case ast.BinOp(left=left, op=op, right=right):
            a, b = _read(left, text, named), _read(right, text, named)
            match op:
                case ast.BitAnd():
                    return join("and", a, b)
                case ast.BitOr():
                    return join("or", a, b)
                case ast.Sub():
                    return subtract(a, b)
    raise ParameterError(f"{ast.get_source_segment(text.strip(), node)!r} cannot be part of a solid", hint=SHAPE)


def _known(name: str, named: Mapping[str, Surface | Solid]) -> Surface | Solid:
    found = named.get(name)
    if found is None:
        known = f"there are {', '.join(named)}" if named else "give surfaces a name each"
        raise ParameterError(
            f"there is no surface named {name!r} before this", hints=(*did_you_mean(name, named), known)
        )
    return found


def solid_text(thing: Surface | Solid, names: Mapping[Surface, str]) -> str:
    """The text of a solid; ``parse_solid`` gives the same solid back."""
    return _written(thing, names, 0)


def _written(thing: Surface | Solid, names: Mapping[Surface, str], least: int) -> str:
    """The text, between parentheses where what is around it binds more tightly."""
    if isinstance(thing, Surface):
        name = names[thing]
        return name if name.isidentifier() and not keyword.iskeyword(name) else repr(name)
    match thing:
        case Solid(op="and", of=(left, Solid(op="not", of=(right,)))):
            level, made = _MINUS, f"{_written(left, names, _MINUS)} - {_written(right, names, _NOT)}"
        case Solid(op="not", of=(inner,)):
            level, made = _NOT, f"~{_written(inner, names, _NOT)}"
        case _:
            level = _AND if thing.op == "and" else _OR
            left, right = (_written(part, names, level + i) for i, part in enumerate(thing.of))  # type: ignore[assignment]
            made = f"{left} {'&' if thing.op == 'and' else '|'} {right}"
    return f"({made})" if level < least else made
