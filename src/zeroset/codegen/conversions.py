"""Rounding, conversions and the parts of floats: the operations that need more than one instruction somewhere.

LLVM calls the C library, or goes lane by lane, where a CPU lacks one of these (rounding before SSE4.1, saturating
conversion on all of x86), so they are written out. Conversions of numbers out of range are frozen: lanes that are not
active may hold such numbers, and must not poison what they meet.
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.codegen.emit import Emit
from zeroset.codegen.writer import SCALARS
from zeroset.kernel.types import BOOL, I32, Type

ROUNDINGS = {"floor": "llvm.floor", "ceil": "llvm.ceil", "trunc": "llvm.trunc", "rint": "llvm.roundeven"}
"""LLVM's names of the roundings."""


class _Float(NamedTuple):
    """Where the parts of an IEEE format lie."""

    bits: str
    mantissa: int
    bias: int

    @property
    def fraction(self) -> int:
        return (1 << self.mantissa) - 1


_FLOATS = {"f32": _Float("i32", 23, 127), "f64": _Float("i64", 52, 1023)}


def write_rounding(emit: Emit, name: str) -> str:
    """Round to an integral float."""
    (a,) = emit.operands
    if emit.writer.target.rounds:
        return emit.intrinsic(ROUNDINGS[name], a)
    return _round_by_addition(emit, name, a)


def _round_by_addition(emit: Emit, name: str, a: str) -> str:
    """Adding and taking off 2^23 (2^52) rounds to an integer; one step back where that went the wrong way."""
    scalar, form = SCALARS[emit.source.name], _FLOATS[emit.source.name]
    magic = emit.splat(scalar, f"{2.0**form.mantissa:.1f}")
    one, zero = emit.splat(scalar, "1.0"), emit.splat(scalar, "0.0")
    size = emit.intrinsic("llvm.fabs", a)
    nearest = emit.binary("fsub", emit.binary("fadd", size, magic), magic)
    if name == "trunc":
        over = emit.binary("fcmp ogt", nearest, size)
        nearest = emit.binary("fsub", nearest, emit.pick(over, emit.type, one, zero))
    rounded = emit.intrinsic("llvm.copysign", nearest, a)
    if name in ("floor", "ceil"):
        wrong = emit.binary(f"fcmp {'ogt' if name == 'floor' else 'olt'}", rounded, a)
        step = emit.pick(wrong, emit.type, one, zero)
        rounded = emit.intrinsic("llvm.copysign", emit.binary("fsub" if name == "floor" else "fadd", rounded, step), a)
    small = emit.binary("fcmp olt", size, magic)
    return emit.pick(small, emit.type, rounded, a)


def write_pow2(emit: Emit) -> str:
    """2 to an integral float: the exponent field itself."""
    form = _FLOATS[emit.source.name]
    # By way of 32 bits for f64 too: AVX2 and SSE have no conversion to 64-bit integers.
    narrow, wide = emit.lanes("i32"), emit.lanes(form.bits)
    whole = emit.writer.assign(f"freeze {narrow} {emit.cast('fptosi', emit.operands[0], emit.type, narrow)}")
    if form.bits == "i64":
        whole = emit.cast("sext", whole, narrow, wide)
    biased = emit.binary("add", whole, emit.splat(form.bits, form.bias), wide)
    return emit.cast("bitcast", emit.binary("shl", biased, emit.splat(form.bits, form.mantissa), wide), wide, emit.type)


def write_mantissa(emit: Emit) -> str:
    """A float with its exponent replaced by 0."""
    form = _FLOATS[emit.source.name]
    wide = emit.lanes(form.bits)
    bits = emit.cast("bitcast", emit.operands[0], emit.type, wide)
    fraction = emit.binary("and", bits, emit.splat(form.bits, form.fraction), wide)
    one = emit.splat(form.bits, form.bias << form.mantissa)
    return emit.cast("bitcast", emit.binary("or", fraction, one, wide), wide, emit.type)


def write_exponent(emit: Emit) -> str:
    """The exponent field, unbiased, as a float."""
    form = _FLOATS[emit.source.name]
    narrow, wide = emit.lanes("i32"), emit.lanes(form.bits)
    bits = emit.cast("bitcast", emit.operands[0], emit.type, wide)
    biased = emit.binary("lshr", bits, emit.splat(form.bits, form.mantissa), wide)
    if form.bits == "i64":
        biased = emit.cast("trunc", biased, wide, narrow)
    return emit.cast("sitofp", emit.binary("sub", biased, emit.splat("i32", form.bias), narrow), narrow, emit.type)


def write_convert(emit: Emit) -> str:
    """The same number in another type; floats saturate to integers, NaN becomes 0."""
    (a,), source, to = emit.operands, emit.source, emit.result
    target = emit.writer.type_of(to, emit.vector)
    if source == BOOL:
        bits = emit.writer.bits(a) if emit.vector else a
        one, zero = ("1.0", "0.0") if to.kind == "f" else ("1", "0")
        return emit.pick(bits, target, emit.splat(SCALARS[to.name], one), emit.splat(SCALARS[to.name], zero))
    if to == BOOL:
        zero = emit.splat(SCALARS[source.name], "0.0" if source.kind == "f" else "0")
        return emit.truth(emit.binary("fcmp une" if source.kind == "f" else "icmp ne", a, zero))
    if source.kind == "f" and to.kind == "f":
        return emit.cast("fpext" if to.name == "f64" else "fptrunc", a, emit.type, target)
    if source.kind == "f":
        return _saturate(emit, a, to, target)
    return emit.cast("sitofp" if source == I32 else "uitofp", a, emit.type, target)


def _saturate(emit: Emit, a: str, to: Type, target: str) -> str:
    if emit.writer.target.saturates:
        suffix = f"{emit.writer.suffix(to, emit.vector)}.{emit.writer.suffix(emit.source, emit.vector)}"
        name = "llvm.fptosi.sat" if to == I32 else "llvm.fptoui.sat"
        return emit.writer.call(f"{name}.{suffix}", target, (emit.type, a))
    return _saturate_by_hand(emit, a, to, target)


def _saturate_by_hand(emit: Emit, a: str, to: Type, target: str) -> str:
    """Clamp and convert: LLVM's own saturating conversion goes lane by lane on x86."""
    scalar = SCALARS[emit.source.name]
    low, above, top = (-(2.0**31), 2.0**31, "2147483647") if to == I32 else (0.0, 2.0**32, "-1")
    floor, limit = emit.splat(scalar, f"{low:.1f}"), emit.splat(scalar, f"{above:.1f}")
    # A NaN becomes the lower bound, which is already right for unsigned integers.
    clamped = emit.pick(emit.binary("fcmp ogt", a, floor), emit.type, a, floor)
    whole = emit.cast("fptosi" if to == I32 else "fptoui", clamped, emit.type, target)
    whole = emit.writer.assign(f"freeze {target} {whole}")
    whole = emit.pick(emit.binary("fcmp oge", a, limit), target, emit.splat("i32", top), whole)
    if to == I32:
        whole = emit.pick(emit.binary("fcmp uno", a, a), target, emit.splat("i32", "0"), whole)
    return whole


def write_bitcast(emit: Emit) -> str:
    """The same bits in another type."""
    return emit.cast("bitcast", emit.operands[0], emit.type, emit.writer.type_of(emit.result, emit.vector))
