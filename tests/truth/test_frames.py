"""Whole frames held to Arb: here beams skip ahead for a tile's pixels at once, and thin parts between rays are drawn.

A pixel's ray is known up to the last place of its float32 direction. So an answer counts as wrong only where it
breaks its promise on the rays a hair to every side as well. Thin parts may fill pixels that their middle ray misses:
UNRESOLVED is held to nothing but what comes before it.
"""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.scene.camera import Camera, fit_camera

from .held import STATUS, broken_promise
from .judge import EDGE, Judge, Kind, Verdict

SIZE = 32
HAIR = 3e-7
NAMES = ("torus", "steiner", "ding-dong", "kiss", "barth-sextic", "teardrop", "heart", "blobby", "superquadric-half")


def frame_rays(camera: Camera) -> tuple[np.ndarray, np.ndarray]:
    """Origins and directions of all pixels, row by row from the top."""
    eye, across, upwards, forward, right, up = (np.array(v) for v in camera.rays(SIZE, SIZE))
    middles = (np.arange(SIZE) + 0.5) * 2 / SIZE - 1
    u, v = (grid.reshape(-1, 1) for grid in np.meshgrid(middles, -middles))
    return eye + u * across + v * upwards, forward + u * right + v * up


def verdicts_around(judge: Judge, origin: np.ndarray, direction: np.ndarray) -> list[Verdict]:
    """Of rays that differ by more than a pixel's rounding, to every side."""
    rng = np.random.default_rng(0)
    shifts = rng.choice([-HAIR, HAIR], (8, 3)) * np.linalg.norm(direction)
    return [judge.first_root(origin.tolist(), (direction + shift).tolist()) for shift in shifts]


@pytest.mark.parametrize("flat", [False, True], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("name", NAMES)
def test_no_pixel_lies(name: str, flat: bool) -> None:
    surface = zs.gallery[name]
    camera = surface.camera or fit_camera(surface.fitted)
    if flat:
        camera = Camera(camera.eye, camera.target, camera.up, fov=None, height=2.0 * surface.fitted.reach)
    image = zs.render(surface, size=SIZE, camera=camera, device="cpu")
    judge = Judge(surface)
    statuses, places = image.aov("status").ravel(), image.aov("t").ravel()
    wrong, found = [], 0
    for i, (origin, direction) in enumerate(zip(*frame_rays(camera), strict=True)):
        status, t = int(statuses[i]), float(places[i])
        found += status != zs.MISS
        verdict = judge.first_root(origin.tolist(), direction.tolist())
        if not _lies(verdict, status, t):
            continue
        if all(_lies(other, status, t) for other in verdicts_around(judge, origin, direction)):
            wrong.append(f"pixel {divmod(i, SIZE)}: {STATUS[status]} at {t}, but {broken_promise(verdict, status, t)}")
    assert not wrong, "\n".join(wrong)
    assert 0.02 < found / SIZE**2 < 0.98


def _lies(verdict: Verdict, status: int, t: float) -> bool:
    root = verdict.root
    if status == zs.MISS:
        # The ray a hair beside may miss what is infinitely thin; thin parts are a pixel's, and have tests of their own.
        return root is not None and root.kind is Kind.CROSS
    if status == zs.UNRESOLVED:
        return root is not None and root.b < t - EDGE * verdict.tolerance
    return bool(broken_promise(verdict, status, t))
