"""Values of parameters: from what users write to floats and arrays, each checked against what the formula asks for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from zeroset.errors import ArrayShapeError, ParameterError, did_you_mean
from zeroset.expr import Expr, postorder

TIME = "w"
"""The fourth variable: a uniform like any parameter, 0 unless it is given."""
LARGEST = 1e30
"""Largest magnitude of a value: kernels in f32 must be able to hold it."""


class ParametricField(Protocol):
    """What is asked of a field here."""

    @property
    def expr(self) -> Expr:
        """The expression."""

    @property
    def parameters(self) -> frozenset[str]:
        """Names of scalar parameters."""

    @property
    def arrays(self) -> frozenset[str]:
        """Names of array parameters."""


def scalar(name: str, value: Any) -> float:
    """The value of a scalar parameter as a float; raises ``ParameterError``."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ParameterError(f"the parameter {name} must be a number, not {value!r}") from None
    if not math.isfinite(number) or abs(number) > LARGEST:
        raise ParameterError(f"the parameter {name} must be finite and below {LARGEST:g}, not {number!r}")
    return number


def array(name: str, value: Any) -> npt.NDArray[np.float64]:
    """The values of an array parameter, read only; raises ``ArrayShapeError``."""
    try:
        values = np.array(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ArrayShapeError(f"the array parameter {name} must hold numbers") from None
    if values.ndim != 1 or not len(values):
        raise ArrayShapeError(f"the array parameter {name} must be one row of numbers, not of shape {values.shape}")
    if not np.all(np.abs(values) <= LARGEST):
        raise ArrayShapeError(f"the array parameter {name} must be finite")
    values.flags.writeable = False
    return values


def check_names(field: ParametricField, params: Mapping[str, float], arrays: Mapping[str, Any]) -> None:
    """Raise unless there is a value for every parameter of a field and none for anything else."""
    for wanted, given, what in ((field.parameters, params, "parameter"), (field.arrays, arrays, "array parameter")):
        missing = sorted(wanted - set(given))
        if missing:
            raise ParameterError(
                f"the {what} {missing[0]} has no value", hint=f"give it one: params={{{missing[0]!r}: ...}}"
            )
        extra = sorted(set(given) - wanted - {TIME})
        if extra:
            raise ParameterError(
                f"the formula has no {what} {extra[0]!r}", hints=did_you_mean(extra[0], field.parameters | field.arrays)
            )
    for group in index_groups(field.expr):
        lengths = {len(arrays[name]) for name in group}
        if len(lengths) > 1:
            raise ArrayShapeError(f"arrays summed over together must be equally long: {', '.join(sorted(group))}")


def index_groups(expr: Expr) -> list[frozenset[str]]:
    """Array parameters that share a sum's index, sum by sum."""
    # A sum's data are its index and the arrays that it runs over.
    return [frozenset(str(name) for name in part.data[1:]) for part in postorder(expr) if part.op == "sum"]
