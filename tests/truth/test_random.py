"""Random formulas, held to Arb like the gallery: polynomials, elementary functions, kinks, jumps and domain edges.

``ZEROSET_TRUTH_EXAMPLES`` sets how many; by hand a few thousand.
"""

from __future__ import annotations

import os
from collections.abc import Iterable

from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.methods import Affine, Auto, Interval, Method, Mitchell

from .formulas import aimed, formulas
from .held import held
from .judge import Judge

EXAMPLES = int(os.environ.get("ZEROSET_TRUTH_EXAMPLES", "60"))
WORK = 400
"""Evaluations that the judge may spend on a ray: some formulas jump everywhere, and cannot be settled."""

OTHERS: tuple[Method, ...] = (Interval(), Affine(), Mitchell(), Affine(axis="k"), Interval(axis="k"))


SETTINGS = settings(
    max_examples=EXAMPLES,
    derandomize=True,
    deadline=None,
    database=None,
    # Every example compiles kernels: shrinking a failure would take longer than reading it.
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large],
)


@SETTINGS
@given(formula=formulas(), seed=st.integers(0, 2**32 - 1))
def test_answers_about_any_formula_are_true(formula: str, seed: int) -> None:
    hold(formula, seed, (Auto(), OTHERS[seed % len(OTHERS)]), "cpu")


@needs_gpu
@settings(SETTINGS, max_examples=max(EXAMPLES // 4, 1))
@given(formula=formulas(), seed=st.integers(0, 2**32 - 1))
def test_answers_of_a_gpu_about_any_formula_are_true(formula: str, seed: int) -> None:
    hold(formula, seed, (Auto(), OTHERS[seed % len(OTHERS)]), "gpu")


def hold(formula: str, seed: int, methods: Iterable[Method], device: str) -> None:
    """Aim rays at a formula's surface and hold what the methods answer to Arb."""
    case = aimed(formula, seed)
    assume(case is not None)
    assert case is not None
    judge = Judge(case.surface, WORK)
    rays = list(zip(case.origins.tolist(), case.directions.tolist(), strict=True))
    verdicts = [judge.first_root(origin, direction) for origin, direction in rays]
    for method in methods:
        hits = zs.cast(case.surface, case.origins, case.directions, method=method, device=device)
        account = held(verdicts, hits, case.origins, case.directions)
        assert not account.broken, f"{case.surface.formula} by {method}:\n" + "\n".join(account.broken)
