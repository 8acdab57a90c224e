"""Number systems over any scalar: reals, intervals, affine forms, gradients, polynomials.

Each system makes numbers that have one method for every operator of the expression table. Evaluating a formula on
numbers of kernel Values writes the kernel that computes its extension; on floats it computes the extension itself.
"""

from zeroset.arith.affine import Affine, AffineSystem
from zeroset.arith.contraction import Contraction
from zeroset.arith.dual import Dual, DualSystem
from zeroset.arith.flags import Flags
from zeroset.arith.format import F32, F64, Format
from zeroset.arith.interval import Interval, IntervalSystem
from zeroset.arith.majorant import Majorant, MajorantSystem
from zeroset.arith.number import Condition, Number, System
from zeroset.arith.poly import NotPolynomialError, Poly, PolySystem
from zeroset.arith.real import Real, RealSystem

__all__ = [
    "F32",
    "F64",
    "Affine",
    "AffineSystem",
    "Condition",
    "Contraction",
    "Dual",
    "DualSystem",
    "Flags",
    "Format",
    "Interval",
    "IntervalSystem",
    "Majorant",
    "MajorantSystem",
    "NotPolynomialError",
    "Number",
    "Poly",
    "PolySystem",
    "Real",
    "RealSystem",
    "System",
]
