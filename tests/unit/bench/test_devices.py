"""The devices that are measured know nothing that an earlier process has kept."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from tests.gpus import needs_gpu

from zeroset.bench.devices import Devices
from zeroset.bench.drivers import SWITCHES, no_driver_caches
from zeroset.bench.machine import this_machine
from zeroset.runtime.cache import Cache
from zeroset.runtime.gpu.device import GpuDevice


def test_a_cpu_can_be_had_afresh() -> None:
    devices = Devices("cpu", 1)
    assert devices.gpu is None
    assert devices.fresh(Cache(None)) is not devices.steady
    assert devices.fresh(Cache(None)).name == "cpu"
    assert this_machine(devices.steady).gpu == ""


def test_drivers_keep_no_shaders_meanwhile(monkeypatch: pytest.MonkeyPatch) -> None:
    kept, missing = SWITCHES
    monkeypatch.setenv(kept, "as it was")
    monkeypatch.delenv(missing, raising=False)
    with no_driver_caches():
        assert {name: os.environ[name] for name in SWITCHES} == SWITCHES
    assert os.environ[kept] == "as it was"
    assert missing not in os.environ


def test_another_device_is_what_it_is() -> None:
    devices = Devices("interp", None)
    assert devices.fresh(Cache(None)) is devices.steady


@needs_gpu
def test_a_gpu_can_be_had_afresh_with_a_cache_of_its_own(tmp_path: Path) -> None:
    devices = Devices("gpu", None)
    cache = Cache(tmp_path)
    fresh = devices.fresh(cache)
    assert devices.steady is devices.gpu
    assert isinstance(fresh, GpuDevice)
    assert fresh is not devices.gpu
    assert fresh.cache is cache
    assert devices.gpu is not None
    assert fresh.found is devices.gpu.found
    machine = this_machine(fresh)
    assert machine.gpu == fresh.found.title
    assert machine.software == fresh.found.software
    assert ("NO GPU" in str(machine)) == machine.software
