"""What the user means: one hash-consed DAG from formula text, SymPy, NumPy-style callables, or operators.

In reading order: `ops` (the operator table), `dag` (nodes), `rules` and its fellows (exact rewriting), `derived`,
`tokens` / `grammar` / `parse` (text), `trace` / `ufuncs` (callables), `sympy_`; and what can be asked of a DAG:
`evaluate` (on any number system), `constants`, `polynomial`, `text`. Nothing here knows how f is drawn.
"""

from __future__ import annotations

from zeroset.expr.build import build, rewrite, sum_over
from zeroset.expr.closed import closed
from zeroset.expr.constants import enclose
from zeroset.expr.continuity import continuous
from zeroset.expr.dag import PI, Expr, constant, node, postorder, rational
from zeroset.expr.evaluate import Env, evaluate
from zeroset.expr.fraction import fraction
from zeroset.expr.magnitude import Magnitude
from zeroset.expr.names import VARIABLES, variable
from zeroset.expr.ops import FUNCTIONS, OPS, Operator
from zeroset.expr.parse import parse
from zeroset.expr.polynomial import PolynomialView, degree, polynomial
from zeroset.expr.settled import Settled, settled
from zeroset.expr.sympy_ import from_sympy, is_sympy
from zeroset.expr.text import text
from zeroset.expr.trace import Traced, trace

__all__ = [
    "FUNCTIONS",
    "OPS",
    "PI",
    "VARIABLES",
    "Env",
    "Expr",
    "Magnitude",
    "Operator",
    "PolynomialView",
    "Settled",
    "Traced",
    "build",
    "closed",
    "constant",
    "continuous",
    "degree",
    "enclose",
    "evaluate",
    "fraction",
    "from_sympy",
    "is_sympy",
    "node",
    "parse",
    "polynomial",
    "postorder",
    "rational",
    "rewrite",
    "settled",
    "sum_over",
    "text",
    "trace",
    "variable",
]
