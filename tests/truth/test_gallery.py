"""Each gallery surface, each proving method: rays from everywhere, held to first roots that Arb certifies.

``ZEROSET_TRUTH_RAYS`` sets how many rays a surface gets; ``python -m tests.truth`` does the same at length, in figures.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache

import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.kernel.types import F64
from zeroset.runtime import get_device

from .conftest import Report
from .held import Trial, proving_methods
from .judge import Kind

RAYS = int(os.environ.get("ZEROSET_TRUTH_RAYS", "32"))


@cache
def trial(name: str) -> Trial:
    """A surface's rays, judged once for all methods, devices and tests."""
    return Trial(zs.gallery[name], RAYS)


def cases() -> Iterator[tuple[str, str]]:
    for name in zs.gallery:
        for method in proving_methods(zs.gallery[name]):
            yield name, method


@pytest.mark.parametrize(("name", "method"), list(cases()))
def test_every_answer_is_true(name: str, method: str, report: Report) -> None:
    rays = trial(name)
    report.judged(name, len(rays.verdicts), len(rays.unsettled))
    account = rays.hold(proving_methods(rays.surface)[method])
    report.held(method, account)
    assert not account.broken, "\n".join(account.broken)
    # Nothing is left unresolved more than four tolerances away from any root.
    assert account.false_alarms == 0
    assert account.statuses["hit"] > 0


@needs_gpu
@pytest.mark.parametrize(("name", "number"), [(name, i) for i, name in enumerate(zs.gallery)])
def test_every_answer_of_a_gpu_is_true(name: str, number: int, report: Report) -> None:
    """The default method, and one of the others in turn: every method meets several surfaces."""
    rays = trial(name)
    methods = proving_methods(rays.surface)
    others = [label for label in methods if label != "auto"]
    for method in ("auto", others[number % len(others)]):
        account = rays.hold(methods[method], "gpu")
        report.held(f"{method} on gpu", account)
        assert not account.broken, f"{method}:\n" + "\n".join(account.broken)
        # Without f64 rounding leaves some open.
        assert account.false_alarms <= (0 if get_device("gpu").supports(F64) else 0.15 * len(rays.verdicts))
        assert account.statuses["hit"] > 0


@pytest.mark.parametrize("name", list(zs.gallery))
def test_the_judge_settles_nearly_all(name: str) -> None:
    rays = trial(name)
    assert len(rays.unsettled) <= len(rays.verdicts) // 8
    # The rays are worth their name: they meet the surface, and they miss it or touch it.
    kinds = {verdict.root.kind if verdict.root else None for verdict in rays.verdicts}
    assert Kind.CROSS in kinds
    assert len(kinds) > 1 or name in ("chmutov-14", "sin-blob")
