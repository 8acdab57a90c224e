"""What parameters alone decide, taken out of a formula: `cos(2*a)*x + floor(b)` is `s*x + t`.

Whoever draws calculates such parts once a picture, exactly or between two neighbouring doubles, and hands them to
kernels as further parameters. There they would be calculated by every packet, in f32, with a rounding at each step;
and where a parameter stands exactly where something jumps, rounding would leave both sides possible.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from zeroset.expr.build import ONE, ZERO, build
from zeroset.expr.constants import enclose
from zeroset.expr.dag import Expr, constant, node, postorder

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["Settled", "settled"]

TIME = ("variable", "w")
"""The variable that is a parameter of a picture."""


class Settled(NamedTuple):
    """A formula without parts that parameters alone decide.

    Attributes:
        expr: The formula; each such part is a parameter.
        parts: What those parameters are, by name.
    """

    expr: Expr
    parts: Mapping[str, Expr]

    def values(self, params: Mapping[str, float]) -> dict[str, tuple[float, float]]:
        """Doubles lo <= value <= hi for each part; lo == hi iff the value is that double exactly.

        Raises:
            FormulaError: A part is undefined, or beyond the range of doubles.
        """
        known: dict[Expr, Expr] = {}
        return {name: enclose(_with_values(part, params, known)) for name, part in self.parts.items()}


def settled(expr: Expr) -> Settled:
    """Take out of a formula what its parameters and `w` alone decide, as long as it is defined whatever they are.

    Factors that are such parts come together, and so do terms: `2*(a*(b*x))` is `s*x`.

    Args:
        expr: The formula.

    Example:
        >>> from zeroset.expr import parse, text
        >>> found = settled(parse("2a b x + sin(w) y + floor(a) = b", ["a", "b"]))
        >>> text(found.expr)
        'part 0*x + part 1*y + part 2'
        >>> {name: text(part) for name, part in found.parts.items()}
        {'part 0': '2*a*b', 'part 1': 'sin(w)', 'part 2': 'floor(a) - b'}
        >>> found.values({"a": 1.5, "b": 0.25, "w": 0.0})
        {'part 0': (0.75, 0.75), 'part 1': (0.0, 0.0), 'part 2': (0.75, 0.75)}
    """
    if not expr.parameters and TIME not in expr.symbols:
        return Settled(expr, {})
    gathered = _gathered(expr)
    names: dict[Expr, str] = {}
    made: dict[Expr, Expr] = {}
    for part in postorder(gathered, lambda item: () if _settles(item) else item.args):
        if _settles(part):
            names[part] = f"part {len(names)}"
            made[part] = node("parameter", (), (names[part], part.flags))
        else:
            made[part] = node(part.op, tuple(made[arg] for arg in part.args), part.data)
    if not names:
        return Settled(expr, {})
    return Settled(made[gathered], {name: part for part, name in names.items()})


def _decided(part: Expr) -> bool:
    """Whether parameters alone give a node's value: a number, whatever they are."""
    return (
        bool(part.symbols)
        and part.is_total
        and not part.is_condition
        and all(symbol == TIME or symbol[0] == "parameter" for symbol in part.symbols)
    )


def _settles(part: Expr) -> bool:
    """Whether a node is decided, and more than a parameter itself."""
    return bool(part.args) and _decided(part)


def _with_values(part: Expr, params: Mapping[str, float], known: dict[Expr, Expr]) -> Expr:
    """A part with numbers in its parameters' places, rewritten: a rational number where it is one."""
    for item in postorder(part, lambda item: () if item in known else item.args):
        if item not in known:
            leaf = item.op in ("parameter", "variable")
            known[item] = (
                constant(Fraction(params[str(item.data[0])]))
                if leaf
                else build(item.op, tuple(known[arg] for arg in item.args), item.data)
            )
    return known[part]


# ------------------------------------------------------------ gathering


def _gathered(expr: Expr) -> Expr:
    """The same formula with all that is decided in a product as its first factor, and in a sum as its last term."""
    made: dict[Expr, Expr] = {}
    for part in postorder(expr):
        args = tuple(made[arg] for arg in part.args)
        match part.op:
            case "mul":
                made[part] = _product(args[0], args[1])
            case "add" | "sub":
                made[part] = _sum(args[0], args[1], -1 if part.op == "sub" else 1)
            case _:
                made[part] = part if args == part.args else node(part.op, args, part.data)
    return made[expr]


def _ours(part: Expr) -> bool:
    """Whether a number comes together with what is decided."""
    return part.is_constant or _decided(part)


def _product(a: Expr, b: Expr) -> Expr:
    """a * b."""
    (p, r), (q, s) = _factors(a), _factors(b)
    return _times(_times(p, q), _times(r, s))


def _factors(part: Expr) -> tuple[Expr, Expr]:
    """The decided factor of a gathered product, and the rest."""
    if _ours(part):
        return part, ONE
    return (part.args[0], part.args[1]) if part.op == "mul" and _ours(part.args[0]) else (ONE, part)


def _times(a: Expr, b: Expr) -> Expr:
    return b if a is ONE else a if b is ONE else _joined("mul", a, b)


def _sum(a: Expr, b: Expr, sign: int) -> Expr:
    """a + b, or a - b."""
    (p, r, m), (q, s, n) = _terms(a), _terms(b)
    return _plain(*_plus(*_plus(r, m, s, n * sign), *_plus(p, 1, q, sign)))


def _terms(part: Expr) -> tuple[Expr, Expr, int]:
    """The decided term of a gathered sum, the rest, and the sign of that."""
    if _ours(part):
        return part, ZERO, 1
    if part.op == "add" and _ours(part.args[1]):
        return part.args[1], part.args[0], 1
    if part.op == "sub" and _ours(part.args[0]):
        return part.args[0], part.args[1], -1
    return ZERO, part, 1


def _plus(a: Expr, m: int, b: Expr, n: int) -> tuple[Expr, int]:
    """m a + n b for signs m and n, as an expression and its sign."""
    if a is ZERO or b is ZERO:
        return (b, n) if a is ZERO else (a, m)
    if m == n:
        return _joined("add", a, b), m
    return _joined("sub", a, b) if m > 0 else _joined("sub", b, a), 1


def _plain(a: Expr, sign: int) -> Expr:
    return a if sign > 0 else build("neg", (a,)) if _ours(a) else node("neg", (a,))


def _joined(op: str, a: Expr, b: Expr) -> Expr:
    """a and b joined; what is decided is rewritten."""
    return build(op, (a, b)) if _ours(a) and _ours(b) else node(op, (a, b))
