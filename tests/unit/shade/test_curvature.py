"""Goldman's formulas against closed forms."""

import math

import numpy as np
import pytest

from zeroset.shade.curvature import gaussian, mean


def test_a_ball_from_either_side() -> None:
    for sign in (1.0, -1.0):
        g, h = [sign * v for v in (2.0, -4.0, 4.0)], [sign * v for v in (2.0, 0.0, 0.0, 2.0, 0.0, 2.0)]
        assert gaussian(g, h) == pytest.approx(1 / 9)
        assert mean(g, h) == pytest.approx(sign / 3)


def test_any_multiple_of_f_has_the_same_curvatures() -> None:
    g, h = (0.3, -1.0, 2.0), (1.0, -0.5, 0.25, 3.0, 0.125, -2.0)
    scaled = [7.0 * v for v in g], [7.0 * v for v in h]
    assert gaussian(*scaled) == pytest.approx(gaussian(g, h))
    assert mean(*scaled) == pytest.approx(mean(g, h))


def test_graphs_of_two_variables() -> None:
    """z = u(x, y) has K = (uxx uyy - uxy^2)/(1 + ux^2 + uy^2)^2 and the mean curvature of every textbook."""
    generator = np.random.default_rng(3)
    p, q, r, s, t = generator.normal(size=(5, 50))
    zero, one = np.zeros(50), np.ones(50)
    g, h = (-p, -q, one), (-r, -s, zero, -t, zero, zero)
    w = 1 + p * p + q * q
    assert gaussian(g, h) == pytest.approx((r * t - s * s) / w**2)
    assert mean(g, h) == pytest.approx(-((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * w**1.5))


def test_turning_space_changes_nothing() -> None:
    generator = np.random.default_rng(4)
    turn, _ = np.linalg.qr(generator.normal(size=(3, 3)))
    g = generator.normal(size=3)
    m = generator.normal(size=(3, 3))
    m = m + m.T
    upper = [m[0, 0], m[0, 1], m[0, 2], m[1, 1], m[1, 2], m[2, 2]]
    n = turn @ m @ turn.T
    turned = [n[0, 0], n[0, 1], n[0, 2], n[1, 1], n[1, 2], n[2, 2]]
    assert gaussian(turn @ g, turned) == pytest.approx(gaussian(g, upper))
    assert mean(turn @ g, turned) == pytest.approx(mean(g, upper))
    # The principal curvatures are what is left of the Hessian in the tangent plane.
    normal = g / np.linalg.norm(g)
    plane = np.linalg.svd(normal[None])[2][1:]
    k = np.linalg.eigvalsh(plane @ m @ plane.T) / np.linalg.norm(g)
    assert gaussian(g, upper) == pytest.approx(math.prod(k))
    assert mean(g, upper) == pytest.approx(sum(k) / 2)
