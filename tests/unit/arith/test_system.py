"""What every system promises: constants, run-time scalars, and a flat form for the state of loops."""

import numpy as np
import pytest

from zeroset.arith import F32, F64, AffineSystem, DualSystem, IntervalSystem, PolySystem, RealSystem

from .scalars import Fused, plain

SYSTEMS = {
    "real": RealSystem(F32),
    "interval": IntervalSystem(F32),
    "affine": AffineSystem(F32),
    "beam": AffineSystem(F32, symbols=3),
    "both": AffineSystem(F32, intersect=True),
    "dual": DualSystem(IntervalSystem(F32), 3),
    "dual-affine": DualSystem(AffineSystem(F32), 1),
    "poly": PolySystem(IntervalSystem(F32), 4),
}


def value_of(number):
    while not hasattr(number, "interval") and not hasattr(number, "defined"):
        number = number.value if hasattr(number, "gradient") else number.coefficient(0)
    return number.interval() if hasattr(number, "interval") else number


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_components_have_one_structure_and_go_round(system):
    numbers = [
        system.constant(0.0, 0.0),
        system.constant(0.1, 0.1),
        system.exact(Fused([1.5, 2.5])),
        system.enclose(Fused([1.5, 2.5]), Fused([0.25, 0.25])).sqr() * 3.0 + 1.0,
    ]
    flats = [system.components(system.general(n)) for n in numbers]
    assert len({len(flat) for flat in flats}) == 1
    for number, flat in zip(numbers, flats, strict=True):
        again = value_of(system.rebuild(flat))
        before = value_of(number)
        if hasattr(before, "lo"):
            # Forgetting what was prepaid may only widen, and by rounding alone.
            assert (plain(again.lo) <= plain(before.lo)).all()
            assert (plain(again.hi) >= plain(before.hi)).all()
            assert plain(again.hi) == pytest.approx(plain(before.hi), rel=1e-5, abs=1e-6)
        else:
            assert np.array_equal(plain(again.value), plain(before.value))


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_a_loop_of_rebuilt_sums_holds_the_sum(system):
    terms = np.random.default_rng(1).uniform(-2, 2, (20, 8)).astype(np.float32)
    state = system.components(system.general(system.constant(0.0, 0.0)))
    for term in terms:
        state = system.components(system.general(system.rebuild(state) + system.exact(Fused(term)).sqr()))
    total = value_of(system.rebuild(state))
    exact = (terms.astype(np.float64) ** 2).sum(axis=0)
    if hasattr(total, "lo"):
        low, high = plain(total.lo), plain(total.hi)
        assert (low <= exact).all()
        assert (exact <= high).all()
        assert (high - low < 20 * 20 * F32.eps * 40).all()
    else:
        assert plain(total.value) == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize(
    "system", [s for n, s in SYSTEMS.items() if n != "real"], ids=[n for n in SYSTEMS if n != "real"]
)
def test_a_constant_is_enclosed(system):
    box = value_of(system.constant(1 / 3, np.nextafter(1 / 3, 1)))
    assert box.lo <= 1 / 3
    assert box.hi >= np.nextafter(1 / 3, 1)
    assert box.hi - box.lo < 1e-6
    half = value_of(system.constant(0.5, 0.5))
    assert half.lo == half.hi == 0.5


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
def test_constants_may_be_wide_huge_or_tiny(fmt):
    for system in (IntervalSystem(fmt), AffineSystem(fmt), AffineSystem(fmt, intersect=True)):
        for lo, hi in ((-1.0, 7.0), (1e-320, 1e-310), (-1e-300, 1e-300), (0.0, 1e-40)):
            box = system.constant(lo, hi).interval()
            assert box.lo <= lo
            assert hi <= box.hi
        huge = system.constant(1e305, 1e306).interval()
        assert huge.hi >= fmt.big
        assert huge.lo <= fmt.big


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_arithmetic_of_constants_stays_literal(system):
    number = value_of((system.constant(0.1, 0.1) + system.constant(2.0, 2.0)) * system.constant(3.0, 3.0))
    low = getattr(number, "lo", None)
    assert isinstance(low if low is not None else number.value, float)
    if low is not None:
        assert low < 6.3 < number.hi
