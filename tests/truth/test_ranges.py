"""Rays that start inside or end early: only what lies between t_min and t_max is found, and nothing there is missed."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs

from .held import held, proving_methods
from .judge import Judge, Kind

NAMES = ("torus", "barth-sextic", "blobby", "dervish")
RAYS = 48


@pytest.mark.parametrize("name", NAMES)
def test_only_the_asked_stretch_counts(name: str) -> None:
    surface, rng = zs.gallery[name], np.random.default_rng(4)
    center, reach = np.array(surface.fitted.center), surface.fitted.reach
    ways = rng.normal(size=(RAYS, 3))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    origins = (center + 0.4 * reach * rng.uniform(-1, 1, (RAYS, 3)) - 3 * reach * ways).astype(np.float32)
    directions = ways.astype(np.float32)
    near, far = 2.8 * reach, 3.6 * reach
    judge = Judge(surface)
    verdicts = [judge.first_root(o, d, near, far) for o, d in zip(origins.tolist(), directions.tolist(), strict=True)]
    roots = [verdict.root for verdict in verdicts]
    assert any(root is not None and root.kind is Kind.CROSS for root in roots)
    assert any(root is None for root in roots)
    for label, method in proving_methods(surface).items():
        hits = zs.cast(surface, origins, directions, t_min=near, t_max=far, method=method, device="cpu")
        account = held(verdicts, hits, origins, directions)
        assert not account.broken, f"{label}:\n" + "\n".join(account.broken)
