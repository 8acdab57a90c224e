"""The pure operations of the kernel language as WGSL expressions.

Each gives what ``kernel.ops`` defines, as far as WGSL's arithmetic can; ``legalise`` has seen to the rest. The parts of
floats are taken from their bits. Minimum and maximum are written as selections: which zero, or which of a number and a
NaN, comes back from WGSL's own is left open there.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.kernel.types import BOOL, F32, I32, Type
from zeroset.kernel.value import Instruction

Texts = tuple[str, ...]
Rule = Callable[[Instruction, Texts], str]
_SUFFIX = {"f32": "f", "f64": "lf", "i32": "i", "u32": "u"}


def literal(text: str, type_: Type) -> str:
    """A constant of the kernel language; negative ones in brackets, so that no two signs meet."""
    if type_ == BOOL:
        return text.lower()
    if type_ == I32 and text == "-2147483648":
        return "(-2147483647i - 1i)"
    digits = f"{text.removeprefix('-')}{_SUFFIX[type_.name]}"
    return f"(-{digits})" if text.startswith("-") else digits


def _infix(symbol: str) -> Rule:
    return lambda instruction, t: f"{t[0]} {symbol} {t[1]}"


def _call(name: str) -> Rule:
    return lambda instruction, t: f"{name}({', '.join(t)})"


def _extreme(symbol: str) -> Rule:
    return lambda instruction, t: f"select({t[1]}, {t[0]}, {t[0]} {symbol} {t[1]})"


def _shift(symbol: str) -> Rule:
    return lambda instruction, t: f"{t[0]} {symbol} (u32({t[1]}) & 31u)"


def _not(instruction: Instruction, t: Texts) -> str:
    return f"!{t[0]}" if instruction.results[0].type == BOOL else f"~{t[0]}"


def _differ(instruction: Instruction, t: Texts) -> str:
    # Of two floats wgpu makes "less or greater", which a NaN is not.
    return f"!({t[0]} == {t[1]})" if instruction.operands[0].type.kind == "f" else f"{t[0]} != {t[1]}"


def _xor(instruction: Instruction, t: Texts) -> str:
    return f"{t[0]} {'!=' if instruction.results[0].type == BOOL else '^'} {t[1]}"


def _convert(instruction: Instruction, t: Texts) -> str:
    source, to = instruction.operands[0].type, instruction.results[0].type
    if source == BOOL:
        one, zero = ("1.0", "0.0") if to.kind == "f" else ("1", "0")
        return f"select({literal(zero, to)}, {literal(one, to)}, {t[0]})"
    if to == BOOL:
        return _differ(instruction, (t[0], literal("0.0" if source.kind == "f" else "0", source)))
    return f"{to}({t[0]})"


class _Parts:
    """Where the parts of an IEEE format lie."""

    def __init__(self, type_: Type) -> None:
        self.type = type_
        self.bits, self.mantissa, self.bias = ("u32", 23, 127) if type_ == F32 else ("u64", 52, 1023)

    def word(self, value: int) -> str:
        return f"{value}{'u' if self.bits == 'u32' else 'lu'}"


def _pow2(instruction: Instruction, t: Texts) -> str:
    p = _Parts(instruction.results[0].type)
    return f"bitcast<{p.type}>({p.bits}(i32({t[0]}) + {p.bias}i) << {p.mantissa}u)"


def _mantissa(instruction: Instruction, t: Texts) -> str:
    p = _Parts(instruction.results[0].type)
    fraction, one = p.word((1 << p.mantissa) - 1), p.word(p.bias << p.mantissa)
    return f"bitcast<{p.type}>((bitcast<{p.bits}>({t[0]}) & {fraction}) | {one})"


def _exponent(instruction: Instruction, t: Texts) -> str:
    p = _Parts(instruction.results[0].type)
    return f"{p.type}(i32(bitcast<{p.bits}>({t[0]}) >> {p.mantissa}u) - {p.bias}i)"


EXPRESSIONS: dict[str, Rule] = {
    **{name: _infix(sign) for name, sign in (("add", "+"), ("sub", "-"), ("mul", "*"), ("div", "/"))},
    **{name: _infix(sign) for name, sign in (("lt", "<"), ("le", "<="), ("gt", ">"), ("ge", ">="))},
    **{name: _infix(sign) for name, sign in (("eq", "=="), ("and", "&"), ("or", "|"))},
    **{name: _call(name) for name in ("abs", "floor", "ceil", "trunc", "sqrt", "fma")},
    "rint": _call("round"),
    "neg": lambda instruction, t: f"-{t[0]}",
    "min": _extreme("<"),
    "max": _extreme(">"),
    "shl": _shift("<<"),
    "shr": _shift(">>"),
    "ne": _differ,
    "not": _not,
    "xor": _xor,
    "select": lambda instruction, t: f"select({t[2]}, {t[1]}, {t[0]})",
    "pow2": _pow2,
    "mantissa": _mantissa,
    "exponent": _exponent,
    "convert": _convert,
    "bitcast": lambda instruction, t: f"bitcast<{instruction.results[0].type}>({t[0]})",
}
"""What each operation is in WGSL, given its operands as text."""

__all__ = ["EXPRESSIONS", "literal"]
