"""The counting device counts what is compiled, and nothing that is remembered."""

from __future__ import annotations

from pathlib import Path

import zeroset as zs
from zeroset.bench.meter import Meter
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice


def test_compilations_are_counted_once(tmp_path: Path) -> None:
    surface = zs.surface("x^2 + y^2 + 2z^2 = 1", bounds=1.5)
    meter = Meter(CpuDevice(cache=Cache(tmp_path)))
    zs.render(surface, 16, device=meter)
    first, spent = meter.compilations, meter.milliseconds
    assert first >= 3
    assert spent > 0
    zs.render(surface, 16, device=meter)
    assert meter.compilations == first

    loading = Meter(CpuDevice(cache=Cache(tmp_path)))
    zs.render(surface, 16, device=loading)
    assert loading.compilations == 0
    assert loading.milliseconds > 0


def test_pictures_are_those_of_the_wrapped_device() -> None:
    surface = zs.surface("x^2 + y^2 + 2z^2 = 1", bounds=1.5)
    device = CpuDevice(cache=Cache(None))
    assert (zs.render(surface, 32, device=Meter(device)).pixels == zs.render(surface, 32, device=device).pixels).all()
    assert Meter(device).name == "cpu"
