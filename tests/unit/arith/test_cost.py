"""What the numbers cost a kernel: operations emitted, counted after sharing. Soundness must not double the work."""

from collections import Counter

import pytest

from zeroset.arith import F32, AffineSystem, Interval, IntervalSystem
from zeroset.arith.budget import Budget
from zeroset.kernel import F32 as F32_TYPE
from zeroset.kernel.value import Block, tracing


def operations(build, parameters):
    block = Block((F32_TYPE,) * parameters)
    with tracing(block):
        build(*block.parameters)
    counts = Counter(i.op for i in block.instructions)
    del counts["const"]
    return sum(counts.values())


def affine_cost(call, arity, symbols=1):
    """Operations on numbers that come from earlier arithmetic."""
    system = AffineSystem(F32, symbols)
    size = symbols + 2

    def number(values):
        form = system.form(values[0], tuple(values[1:-1]), values[-1])
        return form.make(form.centre, form.terms, form.error, Budget(4.0, 8000.0, 3))

    return operations(lambda *v: call(*(number(v[i * size : (i + 1) * size]) for i in range(arity))), arity * size)


@pytest.mark.parametrize(
    ("call", "arity", "most"),
    [
        (lambda a, b: a + b, 2, 3),
        (lambda a, b: a - b, 2, 3),
        (lambda a, b: a * b, 2, 12),
        (lambda a: a.sqr(), 1, 10),
        (lambda a: a * 3.0, 1, 3),
        (lambda a: a * 1.0, 1, 0),
        (lambda a: a + 1.0, 1, 2),
        (lambda a: a + 0.0, 1, 0),
        (lambda a: -a, 1, 2),
        (lambda a: a.contains_zero(), 1, 6),
        (lambda a: a.contract(), 1, 30),
        (lambda a: a.sin(), 1, 80),
        (lambda a: a.exp(), 1, 80),
        (lambda a: a.sqrt(), 1, 75),
        (lambda a: 1.0 / a, 1, 80),
        (lambda a: abs(a), 1, 40),
        (lambda a, b: a.max(b), 2, 42),
    ],
)
def test_affine_operations_with_one_symbol(call, arity, most):
    assert affine_cost(call, arity) <= most


def test_affine_operations_with_three_symbols():
    assert affine_cost(lambda a, b: a + b, 2, 3) <= 5
    assert affine_cost(lambda a, b: a * b, 2, 3) <= 24
    assert affine_cost(lambda a: a.sqr(), 1, 3) <= 16


def test_interval_operations():
    system = IntervalSystem(F32)

    def cost(call, arity):
        numbers = 2 * arity
        return operations(lambda *v: call(*(Interval(system, v[2 * i], v[2 * i + 1]) for i in range(arity))), numbers)

    assert cost(lambda a, b: a + b, 2) <= 8
    assert cost(lambda a, b: a * b, 2) <= 20
    assert cost(lambda a: a.sqr(), 1) <= 14
    assert cost(lambda a: a * 2.0, 1) <= 2
    assert cost(lambda a, b: a.sqr() * b.sqr(), 2) <= 38


def test_a_sextic_along_a_ray():
    """Barth's sextic from a ray's origin and direction to the contracted symbol."""
    system = AffineSystem(F32)
    squared = system.constant(2.618033988749894, 2.618033988749896)
    scale = system.constant(4.23606797749978, 4.236067977499791)

    def build(*v):
        t = system.symbol(0, v[6], v[7])
        x, y, z = (system.exact(v[i]) + system.exact(v[i + 3]) * t for i in range(3))
        x, y, z = x.sqr(), y.sqr(), z.sqr()
        product = (squared * x - y) * (squared * y - z) * (squared * z - x)
        (4.0 * product - scale * (x + y + z - 1.0).sqr()).contract()

    assert operations(build, 8) <= 165
