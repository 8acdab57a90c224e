"""The scalar protocol: one set of functions over Python floats, NumPy floats and arrays, and kernel Values.

Everything in ``arith`` is written with these functions, so the same code computes a number, an array of numbers, or a
piece of a kernel. What is known while tracing costs nothing: a literal (Python float, int or bool) 0 or 1 folds away,
and so do masks that are literally True or False. A Value is recognised by its methods, never by its class.
"""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np

__all__ = [
    "Mask", "Scalar", "absolute", "add", "and_", "ceil", "div", "eq", "floor", "fma", "frexp", "ge", "gt", "is_literal",
    "is_one", "is_zero", "le", "lt", "maximum", "minimum", "mul", "ne", "neg", "not_", "or_", "pow2", "rint",
    "select", "sign", "sqrt", "sub", "trunc", "typed",
]  # fmt: skip

Scalar: TypeAlias = Any
"""A Python float, a NumPy float or float array, or a kernel Value of a floating type."""
Mask: TypeAlias = Any
"""A Python bool (known while tracing), a NumPy bool or bool array, or a kernel Value of type bool."""


def _traced(x: Any) -> bool:
    return hasattr(type(x), "fma")


def is_literal(*values: Scalar) -> bool:
    """Whether all the values are plain Python numbers, known while tracing."""
    return all(isinstance(v, (float, int)) for v in values)


def is_zero(x: Scalar) -> bool:
    """Whether ``x`` is literally zero."""
    return isinstance(x, (float, int)) and x == 0


def is_one(x: Scalar) -> bool:
    """Whether ``x`` is literally one."""
    return isinstance(x, (float, int)) and x == 1


def add(a: Scalar, b: Scalar) -> Scalar:
    """``a + b``."""
    return b if is_zero(a) else a if is_zero(b) else a + b


def sub(a: Scalar, b: Scalar) -> Scalar:
    """``a - b``."""
    return neg(b) if is_zero(a) else a if is_zero(b) else a - b


def mul(a: Scalar, b: Scalar) -> Scalar:
    """``a * b``; a literal zero wins over everything."""
    if is_zero(a) or is_zero(b):
        return 0.0
    return b if is_one(a) else a if is_one(b) else a * b


def div(a: Scalar, b: Scalar) -> Scalar:
    """``a / b``, with IEEE results for Python floats too."""
    if is_zero(a) and not is_zero(b):
        return 0.0
    if is_literal(a, b) and b == 0:
        return math.nan if a == 0 else math.copysign(math.inf, a) * math.copysign(1.0, b)
    return a / b


def neg(a: Scalar) -> Scalar:
    """``-a``."""
    return a if is_zero(a) else -a


def fma(a: Scalar, b: Scalar, c: Scalar) -> Scalar:
    """``a * b + c``, rounded once or twice."""
    if is_zero(a) or is_zero(b):
        return c
    if is_zero(c) or is_one(a) or is_one(b):
        return add(mul(a, b), c)
    if _traced(a):
        return a.fma(b, c)
    return b.fma(a, c) if _traced(b) else a * b + c


def absolute(a: Scalar) -> Scalar:
    """``|a|``."""
    return abs(a)


def minimum(a: Scalar, b: Scalar) -> Scalar:
    """``a if a < b else b``: with a NaN, ``b``."""
    return _extreme(a, b, "minimum")


def maximum(a: Scalar, b: Scalar) -> Scalar:
    """``a if a > b else b``: with a NaN, ``b``."""
    return _extreme(a, b, "maximum")


def _extreme(a: Scalar, b: Scalar, name: str) -> Scalar:
    if a is b:
        return a
    if _traced(a):
        return getattr(a, name)(b)
    condition = a < b if name == "minimum" else a > b
    return select(condition, a, b)


def typed(value: float, like: Scalar) -> Scalar:
    """The literal ``value`` as a scalar of the kind that ``like`` is, whatever ``like`` holds."""
    if _traced(like):
        return like.minimum(value).maximum(value)
    return np.full_like(like, value) if isinstance(like, np.ndarray) else value


def sqrt(a: Scalar) -> Scalar:
    """The square root, correctly rounded; NaN below zero."""
    if is_literal(a):
        return math.sqrt(a) if a >= 0 else math.nan
    return a.sqrt() if _traced(a) else np.sqrt(a)


def _round(a: Scalar, method: str) -> Scalar:
    if _traced(a):
        return getattr(a, method)()
    rounded = getattr(np, method)(a)
    return float(rounded) if is_literal(a) else rounded


def floor(a: Scalar) -> Scalar:
    """The largest integer at or below ``a``."""
    return _round(a, "floor")


def ceil(a: Scalar) -> Scalar:
    """The smallest integer at or above ``a``."""
    return _round(a, "ceil")


def trunc(a: Scalar) -> Scalar:
    """The integer part of ``a``."""
    return _round(a, "trunc")


def rint(a: Scalar) -> Scalar:
    """The nearest integer, halves to even."""
    return _round(a, "rint")


def pow2(n: Scalar) -> Scalar:
    """2**n for an integral float n inside the normal exponent range, exactly."""
    if is_literal(n):
        return math.ldexp(1.0, int(n))
    return n.pow2() if _traced(n) else np.ldexp(np.ones_like(n), n.astype(np.int32))


def frexp(a: Scalar) -> tuple[Scalar, Scalar]:
    """``(m, e)`` with a = m * 2**e, m in [1, 2), for positive normal ``a``."""
    if _traced(a):
        m, e = a.frexp()
        return m, e
    if is_literal(a):
        mantissa, exponent = math.frexp(a)
        return 2.0 * mantissa, float(exponent - 1)
    mantissas, exponents = np.frexp(a)
    return 2 * mantissas, exponents.astype(mantissas.dtype) - 1


def _compare(result: Mask) -> Mask:
    return bool(result) if isinstance(result, np.bool_) else result


def lt(a: Scalar, b: Scalar) -> Mask:
    """``a < b``."""
    return _compare(a < b)


def le(a: Scalar, b: Scalar) -> Mask:
    """``a <= b``."""
    return _compare(a <= b)


def gt(a: Scalar, b: Scalar) -> Mask:
    """``a > b``."""
    return _compare(a > b)


def ge(a: Scalar, b: Scalar) -> Mask:
    """``a >= b``."""
    return _compare(a >= b)


def eq(a: Scalar, b: Scalar) -> Mask:
    """``a == b``; the Value, if there is one, comes first."""
    return a.eq(b) if _traced(a) else _compare(a == b)


def ne(a: Scalar, b: Scalar) -> Mask:
    """``a != b``; the Value, if there is one, comes first."""
    return a.ne(b) if _traced(a) else _compare(a != b)


def and_(*masks: Mask) -> Mask:
    """Whether all masks hold; literals fold."""
    result: Mask = True
    for mask in masks:
        if mask is False or result is False:
            return False
        if mask is not True:
            result = mask if result is True else result & mask
    return result


def or_(*masks: Mask) -> Mask:
    """Whether any mask holds; literals fold."""
    result: Mask = False
    for mask in masks:
        if mask is True or result is True:
            return True
        if mask is not False:
            result = mask if result is False else result | mask
    return result


def not_(mask: Mask) -> Mask:
    """The opposite mask; literals fold."""
    return (not mask) if isinstance(mask, (bool, np.bool_)) else ~mask


def select(condition: Mask, a: Scalar, b: Scalar, like: Scalar = None) -> Scalar:
    """``a`` where the condition holds, else ``b``.

    Args:
        condition: a mask; a literal one picks at once.
        a: a scalar.
        b: a scalar.
        like: gives the type where both ``a`` and ``b`` are literals.
    """
    if isinstance(condition, (bool, np.bool_)):
        return a if condition else b
    if a is b or (is_literal(a, b) and a == b):
        return a
    if like is not None and is_literal(a, b):
        b = typed(b, like)
    return condition.select(a, b) if hasattr(type(condition), "select") else np.where(condition, a, b)


def sign(x: Scalar) -> Scalar:
    """-1, 0 or 1."""
    return select(gt(x, 0.0), 1.0, select(lt(x, 0.0), -1.0, 0.0, like=x), like=x)
