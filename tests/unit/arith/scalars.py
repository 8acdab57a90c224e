"""Float32 arrays with the scalar protocol of kernel values, for arithmetic that NumPy does not do by itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np


class Fused:
    """A float32 array with the scalar protocol of kernel values, whose ``fma`` rounds once."""

    __array_ufunc__ = None

    def __init__(self, array: Any) -> None:
        self.array = np.asarray(array, np.float32)

    def fma(self, factor: Any, addend: Any) -> Fused:
        # A product of float32 is exact in float64; its sum rounds twice, which differs from once too rarely to matter.
        a, b, c = (_plain(x).astype(np.float64) for x in (self, factor, addend))
        return type(self)((a * b + c).astype(np.float32))

    def minimum(self, other: Any) -> Fused:
        return type(self)(np.where(self.array < _plain(other), self.array, _plain(other)))

    def maximum(self, other: Any) -> Fused:
        return type(self)(np.where(self.array > _plain(other), self.array, _plain(other)))

    def pow2(self) -> Fused:
        return type(self)(np.ldexp(np.float32(1), self.array.astype(np.int32)))

    def frexp(self) -> tuple[Fused, Fused]:
        mantissa, exponent = np.frexp(self.array)
        return type(self)(2 * mantissa), type(self)(exponent - 1)

    def __neg__(self) -> Fused:
        return type(self)(-self.array)

    def __abs__(self) -> Fused:
        return type(self)(abs(self.array))


class Flushed(Fused):
    """The same, where every subnormal operand or result counts as zero."""

    def __init__(self, array: Any) -> None:
        super().__init__(array)
        self.array = np.where(abs(self.array) < np.float32(2.0**-126), np.float32(0), self.array)


class ArrayMask:
    """A bool array with the scalar protocol."""

    def __init__(self, array: Any, kind: type[Fused]) -> None:
        self.array = np.asarray(array, np.bool_)
        self.kind = kind

    def __and__(self, other: ArrayMask) -> ArrayMask:
        return ArrayMask(self.array & other.array, self.kind)

    def __or__(self, other: ArrayMask) -> ArrayMask:
        return ArrayMask(self.array | other.array, self.kind)

    def __invert__(self) -> ArrayMask:
        return ArrayMask(~self.array, self.kind)

    def select(self, a: Any, b: Any) -> Fused:
        return self.kind(np.where(self.array, _plain(a), _plain(b)))


def _plain(x: Any) -> Any:
    return x.array if isinstance(x, Fused) else np.float32(x)


def plain(x: Any) -> Any:
    """What a scalar or mask of any kind holds, as NumPy sees it."""
    return x.array if isinstance(x, (Fused, ArrayMask)) else np.asarray(x)


def _arithmetic(name: str) -> Callable[..., Fused]:
    return lambda a, b: type(a)(getattr(_plain(a), name)(_plain(b)))


def _comparison(name: str) -> Callable[..., ArrayMask]:
    return lambda a, b: ArrayMask(getattr(_plain(a), name)(_plain(b)), type(a))


def _unary(function: Callable[[Any], Any]) -> Callable[[Fused], Fused]:
    return lambda a: type(a)(function(a.array))


for _name in ("add", "sub", "mul", "truediv", "radd", "rsub", "rmul", "rtruediv"):
    setattr(Fused, f"__{_name}__", _arithmetic(f"__{_name}__"))
for _name in ("lt", "le", "gt", "ge"):
    setattr(Fused, f"__{_name}__", _comparison(f"__{_name}__"))
for _name in ("eq", "ne"):
    setattr(Fused, _name, _comparison(f"__{_name}__"))
for _name in ("sqrt", "floor", "ceil", "trunc", "rint"):
    setattr(Fused, _name, _unary(getattr(np, _name)))
