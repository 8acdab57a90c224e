"""The small typed language that every algorithm of zeroset is written in once and compiled from for every device.

Values and instructions (``value``), control flow (``build``), what is legal (``verify``), what it means (``ops`` and
``interp``), which values are the same on every lane (``uniformity``) and named passes (``passes``). The package knows
nothing of formulas, of number systems or of any target.
"""

from zeroset.kernel.build import Kernel, KernelBuilder, any_, atomic, for_, if_, load, store, while_
from zeroset.kernel.types import BOOL, F32, F64, I32, U32, Buffer, Type, Uniform
from zeroset.kernel.value import Scalar, Value, constant, lift
from zeroset.kernel.verify import verify

__all__ = [
    "BOOL",
    "F32",
    "F64",
    "I32",
    "U32",
    "Buffer",
    "Kernel",
    "KernelBuilder",
    "Scalar",
    "Type",
    "Uniform",
    "Value",
    "any_",
    "atomic",
    "constant",
    "for_",
    "if_",
    "lift",
    "load",
    "store",
    "verify",
    "while_",
]
