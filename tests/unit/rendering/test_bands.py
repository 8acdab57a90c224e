from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.rendering.bands import bands, fits
from zeroset.rendering.layout import Layout
from zeroset.runtime.cpu import CpuDevice

TILE_BYTES = 8 * 8 * 4


class Cramped(CpuDevice):
    """A CPU that says that its buffers hold 160 tiles."""

    largest = 160 * TILE_BYTES


@pytest.fixture(scope="module")
def cramped() -> Cramped:
    return Cramped()


def test_bands_cover_every_row_once(cramped: Cramped) -> None:
    for size in ((500, 333), (200, 900), (17, 5000), (3000, 9)):
        layout = Layout(*size)
        parts = list(bands(layout, cramped))
        assert sum(band.layout.height for band in parts) == layout.height
        assert [band.top for band in parts] == np.cumsum([0, *(b.layout.height for b in parts)])[:-1].tolist()
        assert all(band.layout.width == layout.width for band in parts)
        assert fits(parts[0].layout, cramped) or parts[0].layout.rows == 1


@pytest.mark.parametrize("size", [(500, 333), (200, 900)], ids=str)
@pytest.mark.parametrize("camera", [None, zs.Camera(eye=(3, -5, 2), height=4.0)], ids=["perspective", "orthographic"])
def test_a_picture_in_bands_is_the_picture(cramped: Cramped, size: tuple[int, int], camera: zs.Camera | None) -> None:
    surface = zs.gallery["barth-sextic"]
    assert not fits(Layout(*size), cramped)
    whole = zs.render(surface, size, camera=camera, device="cpu")
    parts = zs.render(surface, size, camera=camera, device=cramped)
    assert parts.size == whole.size == size
    assert np.asarray(parts).shape == np.asarray(whole).shape
    # The rays of a band are rounded elsewhere: a pixel on the edge may fall to the other side.
    assert np.count_nonzero(whole.aov("status") != parts.aov("status")) <= 4
    off = np.abs(whole.aov("t") - parts.aov("t"))
    assert np.nanmax(off[whole.aov("status") == zs.HIT]) < 1e-3
    # Where something thinner than a pixel lies along a pixel's beam is told within its width.
    assert np.nanmax(off) < surface.fitted.extent / max(size)
    apart = np.abs(np.asarray(whole).astype(int) - np.asarray(parts)).max(axis=-1)
    assert np.count_nonzero(apart > 8) <= 8


def test_progress_of_all_bands(cramped: Cramped) -> None:
    told: list[float] = []
    zs.render("x^2 + y^2 - z^2 = 1", 300, device=cramped, progress=told.append)
    assert told == sorted(told)
    assert told[0] == 0.0
    assert 0.9 < told[-1] <= 1.0


class Narrow(CpuDevice):
    """A CPU whose largest buffer holds 2,048 tiles."""

    largest = 2048 * TILE_BYTES


def test_rays_that_wait_need_no_larger_buffers(monkeypatch: pytest.MonkeyPatch) -> None:
    device = Narrow()
    allocated: list[int] = []
    allocate = CpuDevice.allocate

    def counted(self: CpuDevice, type_: object, count: int, constant: bool = False) -> object:
        allocated.append(count * 4)
        return allocate(self, type_, count, constant)  # type: ignore[arg-type]

    monkeypatch.setattr(Narrow, "allocate", counted)
    look = {"material": zs.Material(opacity=0.3, reflectance=0.2), "depth": 12}
    whole = zs.render(zs.gallery["tangle"], 350, device="cpu", **look)  # type: ignore[arg-type]
    parts = zs.render(zs.gallery["tangle"], 350, device=device, **look)  # type: ignore[arg-type]
    # The stack of rays that wait is larger than the picture, and is used again and again.
    assert 350 * 350 * 4 < max(allocated) <= device.largest
    assert np.array_equal(whole, parts)
