"""The closed-form factors, on coefficients run through the interpreter."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from zeroset.kernel import F32, KernelBuilder, interp, load, store
from zeroset.solve.raypoly import SYSTEM, as_value, factor

Array = np.ndarray[Any, Any]


def factored(coefficients: Array) -> tuple[Array, Array]:
    """Middles of all candidate roots, nan where not real, and the residual; one row of coefficients a polynomial."""
    count, terms = coefficients.shape
    with KernelBuilder("factor") as builder:
        lane = builder.index()
        loaded = [SYSTEM.exact(load(builder.buffer(f"c{i}", F32), lane)) for i in range(terms)]
        result = factor(loaded)
        for i, (root, real) in enumerate(result.roots()):
            middle = (as_value(root.lo) + as_value(root.hi)) * 0.5
            store(builder.buffer(f"r{i}", F32, writable=True), lane, real.select(middle, 1e30))
        store(builder.buffer("residual", F32, writable=True), lane, result.residual)
    buffers = {f"c{i}": coefficients[:, i].astype(np.float32) for i in range(terms)}
    outputs = {f"r{i}": np.zeros(count, np.float32) for i in range(terms - 1)}
    outputs["residual"] = np.zeros(count, np.float32)
    interp.run(builder.kernel, count, {}, buffers | outputs)
    roots = np.stack([outputs[f"r{i}"] for i in range(terms - 1)], axis=1).astype(float)
    return np.where(roots > 1e29, np.nan, roots), outputs["residual"]


def with_roots(roots: Array) -> Array:
    return np.array([np.polynomial.polynomial.polyfromroots(row) for row in roots])


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_real_roots_come_back(degree: int) -> None:
    roots = np.sort(np.random.default_rng(degree).uniform(-1, 1, size=(300, degree)), axis=1)
    apart = np.ones(300, bool) if degree == 1 else np.diff(roots, axis=1).min(axis=1) > 0.05
    coefficients = with_roots(roots)
    found, residual = factored(coefficients)
    assert np.all(residual[apart] < 1e-3)
    assert np.allclose(np.sort(found[apart], axis=1), roots[apart], atol=2e-3)


@pytest.mark.parametrize("degree", [2, 4])
def test_polynomials_without_roots_have_none(degree: int) -> None:
    pairs = np.random.default_rng(degree).uniform(-1, 1, size=(200, degree // 2, 2))
    coefficients = []
    for row in pairs:
        f = np.polynomial.Polynomial([1.0])
        for middle, rest in row:
            f *= np.polynomial.Polynomial([middle**2 + 0.1 + rest**2, -2 * middle, 1.0])
        coefficients.append(f.coef)
    found, residual = factored(np.array(coefficients))
    sure = residual < 1e-4
    assert sure.mean() > 0.9
    assert np.all(np.isnan(found[sure]))


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_the_residual_bounds_what_the_product_misses(degree: int) -> None:
    random = np.random.default_rng(degree)
    coefficients = random.normal(size=(300, degree + 1)) * 10.0 ** random.uniform(-6, 6, size=(300, degree + 1))
    # Leading coefficients of nothing cannot be divided by.
    coefficients[:20, -1] = 0
    coefficients[20:30, degree // 2 :] = 0
    coefficients = coefficients.astype(np.float32)
    places = (-1.0, -0.3, 0.0, 0.7, 1.0)
    with KernelBuilder("factor") as builder:
        lane = builder.index()
        result = factor([SYSTEM.exact(load(builder.buffer(f"c{i}", F32), lane)) for i in range(degree + 1)])
        store(builder.buffer("residual", F32, writable=True), lane, result.residual)
        for i, e in enumerate(places):
            value = result.over(SYSTEM.constant(e, e))
            store(builder.buffer(f"low{i}", F32, writable=True), lane, as_value(value.lo))
            store(builder.buffer(f"high{i}", F32, writable=True), lane, as_value(value.hi))
    buffers = {f"c{i}": coefficients[:, i].copy() for i in range(degree + 1)}
    names = ["residual", *(f"{end}{i}" for end in ("low", "high") for i in range(len(places)))]
    buffers |= {name: np.zeros(300, np.float32) for name in names}
    interp.run(builder.kernel, 300, {}, buffers)
    usable = np.isfinite(buffers["residual"])
    assert usable.mean() > 0.9
    for i, e in enumerate(places):
        truth = np.polynomial.polynomial.polyval(np.float32(e).astype(float), coefficients.T.astype(float))
        low, high, residual = (buffers[name].astype(float) for name in (f"low{i}", f"high{i}", "residual"))
        assert np.all((low - residual <= truth)[usable])
        assert np.all((truth <= high + residual)[usable])
