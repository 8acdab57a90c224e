import numpy as np
import pytest

from zeroset.arith import F32, F64, AffineSystem, IntervalSystem, NotPolynomialError, PolySystem, RealSystem
from zeroset.errors import MethodError

REALS = RealSystem(F64)


def coefficients(p):
    return [p.coefficient(i).value for i in range(p.degree + 1)]


def test_coefficients_are_those_of_the_expansion():
    t = PolySystem(REALS, 12).unknown()
    p = (t.sqr() - 2.0) * (t + 1.0).powi(3) - (3.0 * t).sqr() / 2.0 + -t
    expected = np.polynomial.Polynomial([-2, 0, 1]) * np.polynomial.Polynomial([1, 1]) ** 3
    expected = expected - np.polynomial.Polynomial([0, 0, 4.5]) - np.polynomial.Polynomial([0, 1])
    assert coefficients(p) == pytest.approx(expected.coef.tolist())


def test_a_square_is_the_product_with_itself():
    system = PolySystem(REALS, 8)
    p = system.linear(REALS.exact(0.5), REALS.exact(-1.5)).powi(3) + 2.0
    assert coefficients(p.sqr()) == pytest.approx(coefficients(p * p))
    assert coefficients(p.powi(2)) == coefficients(p.sqr())


def test_interval_coefficients_enclose():
    system = PolySystem(IntervalSystem(F32), 4)
    inner = system.inner
    ray = system.linear(inner.bounds(np.float32(0.1), np.float32(0.1)), inner.bounds(np.float32(0.3), np.float32(0.3)))
    p = ray.sqr() * ray - ray
    third = p.coefficient(3)
    exact = float(np.float32(0.3)) ** 3
    assert third.lo < exact < third.hi
    assert third.hi - third.lo < 20 * F32.eps * exact


def test_what_is_absent_is_absent():
    system = PolySystem(REALS, 6)
    p = system.unknown().powi(4) + 1.0
    assert [c is None for c in p.coefficients] == [False, True, True, True, False]
    assert system.constant(0.0, 0.0).degree == 0


@pytest.mark.parametrize(
    "operation",
    [
        lambda t: t.sin(), lambda t: 1.0 / t, lambda t: t.powi(-1), lambda t: t.powr((1, 2)), lambda t: t.sqrt(), abs,
        lambda t: t.lt(t), lambda t: t.max(t * 0.5), lambda t: t.mod(t), lambda t: t.pow(t), lambda t: t.atan2(t),
    ],
)  # fmt: skip
def test_what_is_no_polynomial_is_refused(operation):
    with pytest.raises(NotPolynomialError) as caught:
        operation(PolySystem(REALS, 4).unknown())
    assert isinstance(caught.value, MethodError)
    assert "auto" in caught.value.hint


def test_a_degree_too_high_is_refused():
    with pytest.raises(NotPolynomialError, match="degree 8"):
        PolySystem(REALS, 4).unknown().powi(4).sqr()


def test_functions_of_what_does_not_vary_are_taken():
    system = PolySystem(REALS, 3)
    a = system.lift(REALS.exact(4.0))
    p = system.unknown() * a.sqrt() + a.powi(-1) + a.max(system.constant(5.0, 5.0)) + a.powr((1, 2)).exp()
    assert coefficients(p) == pytest.approx([5.25 + np.exp(2.0), 2.0])
    picked = a.lt(system.constant(5.0, 5.0)).and_(a.le(a).not_().or_(a.le(a))).select(system.unknown(), a)
    assert coefficients(picked) == [0.0, 1.0]


def test_components_go_round():
    system = PolySystem(AffineSystem(F64), 3)
    p = system.unknown().sqr() + 1.0
    flat = system.components(system.general(p))
    assert len(flat) == 4 * 5
    assert system.rebuild(flat).coefficient(2).centre == 1.0
