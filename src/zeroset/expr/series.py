"""pi, sine, cosine and arctangent to any number of digits, in whole-number fixed point.

A value v is held as an integer near v*10^d. Each function says by how many units its result may be off;
the callers widen by that. Machin's formula gives pi, Taylor's series the rest after a reduction that makes the
argument small.
"""

from __future__ import annotations

from functools import lru_cache

__all__ = ["SLACK", "arctangent", "pi", "sine_cosine"]

SLACK = 1_000
"""Bound, in units of the last place, on the error of each result for an exact argument.

Each series has fewer terms than a third of its digits plus twenty, and each term is off by less than two
units; eight guard digits below the unit that callers see make that far less than this.
"""

_GUARD = 8
_GUARD_UNIT = 100_000_000


@lru_cache(maxsize=16)
def pi(digits: int) -> int:
    """pi * 10^digits, off by less than `SLACK` units (Machin: pi/4 = 4 atan(1/5) - atan(1/239))."""
    unit: int = 10 ** (digits + _GUARD)
    return 4 * (4 * _arctangent_of_reciprocal(5, unit) - _arctangent_of_reciprocal(239, unit)) // _GUARD_UNIT


def sine_cosine(value: int, digits: int) -> tuple[int, int]:
    """sin and cos of value / 10^digits, times 10^digits, each off by less than `SLACK` units."""
    guard = _GUARD + max(0, len(str(abs(value))) - digits)
    fine = digits + guard
    half_pi = pi(fine) // 2
    turns, rest = divmod(value * 10**guard + half_pi // 2, half_pi)
    sine, cosine = _small_sine_cosine(rest - half_pi // 2, 10**fine)
    for _ in range(turns % 4):
        sine, cosine = cosine, -sine
    return sine // 10**guard, cosine // 10**guard


def arctangent(value: int, digits: int) -> int:
    """atan(value / 10^digits) * 10^digits, off by less than `SLACK` units."""
    if value < 0:
        return -arctangent(-value, digits)
    unit: int = 10 ** (digits + _GUARD)
    value *= _GUARD_UNIT
    if value > unit:
        reciprocal = unit * unit // value
        return (pi(digits + _GUARD) // 2 - _halved_arctangent(reciprocal, unit)) // _GUARD_UNIT
    return _halved_arctangent(value, unit) // _GUARD_UNIT


def _halved_arctangent(value: int, unit: int) -> int:
    """atan on [0, 1]: three times atan(x) = 2 atan(x / (1 + sqrt(1 + x^2))), then Taylor."""
    from math import isqrt

    for _ in range(3):
        value = value * unit // (unit + isqrt(unit * unit + value * value))
    square = value * value // unit
    total = term = value
    n = 1
    while term:
        n += 2
        term = -term * square // unit if term > 0 else -(term * square // unit)
        total += term // n
        if abs(term) <= 1:
            break
    return 8 * total


def _small_sine_cosine(value: int, unit: int) -> tuple[int, int]:
    """Taylor's series for |value| below pi/4."""
    sine, cosine = 0, 0
    term, n = unit, 0
    while abs(term) > 1:
        if n % 2:
            sine += term if n % 4 == 1 else -term
        else:
            cosine += term if n % 4 == 0 else -term
        n += 1
        term = term * value // (unit * n)
    return sine, cosine


def _arctangent_of_reciprocal(n: int, unit: int) -> int:
    """atan(1/n) * unit."""
    term = unit // n
    total, k, sign = term, 1, 1
    while term:
        term //= n * n
        k, sign = k + 2, -sign
        total += sign * (term // k)
    return total
