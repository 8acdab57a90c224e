"""A surface's formula as a list of steps, unrolled once, run on any numbers: the judge's own way through the DAG.

``zeroset.expr.evaluate`` hands constants over as pairs of doubles. The judge wants them exactly: a double root of a
polynomial with rational coefficients is a fact, and no enclosure of a coefficient shows it. So it walks the DAG
itself, with parameters and array elements as the exact doubles that the user gave and sums unrolled.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from flint import arb, fmpq, fmpq_poly

from zeroset import Surface
from zeroset.expr import OPS, Expr, postorder

from .jets import ZERO, Jet, precise
from .surds import Beyond, Surd

Step = tuple[str, tuple[int, ...], tuple[Any, ...]]
AXES = ("x", "y", "z")


def rational(value: float | Fraction | int) -> fmpq:
    """The exact rational of a Python number."""
    exact = Fraction(value)
    return fmpq(exact.numerator, exact.denominator)


class Tape:
    """The steps of one surface: places 0, 1, 2 are x, y, z; the last place is f."""

    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._steps: list[Step] = []
        self._constants: dict[int, fmpq | str] = {}
        self._known: dict[tuple[Expr, tuple[tuple[str, int], ...]], int] = {}
        self.result = self._emit(surface.field.expr, {})
        exact = not any(isinstance(value, str) for value in self._constants.values())
        self._algebraic = exact and all(method == "const" or hasattr(Surd, method) for method, _, _ in self._steps)

    def _place(self, step: Step) -> int:
        self._steps.append(step)
        return len(self._steps) + 2

    def _constant(self, value: fmpq | str) -> int:
        place = self._place(("const", (), ()))
        self._constants[place] = value
        return place

    def _emit(self, expr: Expr, indices: Mapping[str, int]) -> int:
        """Steps for a node, with each sum's index at a value; the place of its result."""

        def key(part: Expr) -> tuple[Expr, tuple[tuple[str, int], ...]]:
            return part, tuple(sorted((name, indices[name]) for name in part.indices))

        def needs(part: Expr) -> tuple[Expr, ...]:
            return () if part.op == "sum" or key(part) in self._known else part.args

        for part in postorder(expr, needs):
            if key(part) not in self._known:
                args = () if part.op == "sum" else part.args
                self._known[key(part)] = self._step(part, [self._known[key(arg)] for arg in args], indices)
        return self._known[key(expr)]

    def _step(self, part: Expr, args: Sequence[int], indices: Mapping[str, int]) -> int:
        data: tuple[Any, ...] = part.data
        match part.op:
            case "const":
                return self._constant(data[0] if isinstance(data[0], str) else rational(data[0]))
            case "variable" if data[0] in AXES:
                return AXES.index(data[0])
            case "variable" | "parameter":
                return self._constant(rational(self._surface.params[data[0]]))
            case "element":
                return self._constant(rational(float(self._surface.arrays[data[0]][indices[data[1]]])))
            case "sum":
                return self._sum(part, indices)
        return self._place((OPS[part.op].method, tuple(args), (data,) if part.op == "powr" else data))

    def _sum(self, part: Expr, indices: Mapping[str, int]) -> int:
        index, first = str(part.data[0]), str(part.data[1])
        total = self._constant(rational(0))
        for i in range(len(self._surface.arrays[first])):
            total = self._place(("add", (total, self._emit(part.args[0], {**indices, index: i})), ()))
        return total

    def run(self, point: Sequence[Any], constants: Mapping[int, Any]) -> Any:
        """f at three numbers of some system, with the tape's constants as numbers of it."""
        values: list[Any] = list(point)
        for method, args, data in self._steps:
            if method == "const":
                values.append(constants[len(values)])
            else:
                values.append(getattr(values[args[0]], method)(*(values[a] for a in args[1:]), *data))
        return values[self.result]

    def jets(self) -> dict[int, Jet]:
        """The constants as balls."""
        precise()
        balls = {place: arb.pi() if isinstance(value, str) else arb(value) for place, value in self._constants.items()}
        return {place: Jet(ball, ZERO, positive=bool(ball >= 0)) for place, ball in balls.items()}

    def polynomial(self, origin: Sequence[fmpq], direction: Sequence[fmpq]) -> Surd | None:
        """f along a ray, exactly; None where f is no polynomial over the rationals and one square root."""
        if not self._algebraic:
            return None
        constants = {place: Surd(fmpq_poly([value])) for place, value in self._constants.items()}
        try:
            found = self.run([Surd(fmpq_poly([o, d])) for o, d in zip(origin, direction, strict=True)], constants)
        except Beyond:
            return None
        assert isinstance(found, Surd)
        return found
