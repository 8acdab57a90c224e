from __future__ import annotations

import numpy as np
import pytest

from zeroset.errors import ParameterError
from zeroset.scene import colormap
from zeroset.scene.colormap import MAPS, SIMILAR, find_map, table, to_linear


def lab(linear: colormap.Floats) -> colormap.Floats:
    """Oklab of linear sRGB: the inverse of ``to_linear``."""
    cones = np.cbrt(linear @ np.linalg.inv(colormap._TO_RGB).T)
    return np.asarray(cones @ np.linalg.inv(colormap._TO_CONES).T)


def test_oklab_of_known_colours() -> None:
    # White, and pure red as Ottosson's matrices have it.
    assert to_linear(np.array([1.0, 0.0, 0.0])) == pytest.approx([1, 1, 1], abs=1e-6)
    assert to_linear(np.array([0.627955, 0.224863, 0.125846])) == pytest.approx([1, 0, 0], abs=1e-4)


@pytest.mark.parametrize("name", MAPS)
def test_every_map_can_be_shown(name: str) -> None:
    colors = table(name)
    assert colors.shape == (256, 3)
    assert np.all((colors >= 0) & (colors <= 1))
    assert not colors.flags.writeable


@pytest.mark.parametrize("name", MAPS)
def test_equal_steps_look_equally_large(name: str) -> None:
    steps = np.linalg.norm(np.diff(lab(table(name)), axis=0), axis=-1)
    assert steps.max() / steps.min() < 1.25


def test_what_kinds_promise() -> None:
    for name, found in MAPS.items():
        light = lab(table(name))[:, 0]
        if found.kind == "sequential":
            assert np.all(np.diff(light) > 0), name
            assert light[-1] - light[0] > 0.6
        elif found.kind == "diverging":
            assert np.all(np.diff(light[:128]) > 0), name
            assert np.all(np.diff(light[128:]) < 0), name
            assert np.ptp(table(name)[127:129].mean(axis=0)) < 0.02, name
            assert abs(light[0] - light[-1]) < 0.05, name
        else:
            assert np.ptp(light) < 0.02, name
            assert table(name)[0] == pytest.approx(table(name)[-1], abs=1e-6)


def test_names_that_are_none() -> None:
    with pytest.raises(ParameterError, match="lagoon is much like it"):
        find_map("viridis")
    with pytest.raises(ParameterError, match="did you mean coolwarm") as caught:
        find_map("coolwarn")
    assert "there are lagoon" in str(caught.value)
    assert set(SIMILAR.values()) <= set(MAPS)
    assert not set(SIMILAR) & set(MAPS)
