from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tests.gpus import no_gpu

import zeroset as zs
from zeroset.errors import DeviceError
from zeroset.kernel import F32, F64, Kernel, KernelBuilder, load, store
from zeroset.runtime import DEVICES, Device, Signature, get_device, registry
from zeroset.runtime.interp import InterpreterDevice


def double() -> Kernel:
    with KernelBuilder("double") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) * k.uniform("two", F32))
    return k.kernel


@pytest.mark.parametrize("name", DEVICES)
def test_each_device_by_name(name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: object) -> None:
    monkeypatch.setenv("ZEROSET_CACHE_DIR", str(tmp_path))
    if name == "gpu" and (why := no_gpu()):
        pytest.skip(why)
    device = get_device(name)
    assert device.name == name
    assert isinstance(device, Device)
    assert get_device(name) is device
    assert get_device(device) is device
    x = device.allocate(F32, 3)
    device.write(x, np.array([1, 2, 3], np.float32))
    device.compile(double()).run(3, {"two": 2.0}, {"x": x})
    assert device.read(x).tolist() == [2, 4, 6]
    device.compile_cached("double", double).run(2, {"two": 2.0}, {"x": x})
    assert device.read(x).tolist() == [4, 8, 6]


@pytest.fixture
def looked_up_anew() -> Iterator[None]:
    registry._best.cache_clear()
    yield
    registry._best.cache_clear()


@pytest.mark.usefixtures("looked_up_anew")
def test_auto_is_the_cpu_where_there_is_no_gpu(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "why_not_gpu", lambda: "none here")
    assert get_device("auto") is get_device("cpu")
    assert get_device() is get_device("cpu")
    registry._best.cache_clear()
    monkeypatch.setattr(registry, "find_spec", lambda name: None)
    assert get_device("auto").name == "interp"


@pytest.mark.usefixtures("looked_up_anew")
def test_auto_falls_back_to_the_cpu_when_the_gpu_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    def gone() -> Device:
        raise DeviceError("it was taken away")

    monkeypatch.setattr(registry, "why_not_gpu", lambda: "")
    monkeypatch.setitem(DEVICES, "gpu", gone)
    monkeypatch.setattr(registry, "_made", {"cpu": get_device("cpu")})
    assert get_device("auto").name == "cpu"
    with pytest.raises(DeviceError, match="taken away"):
        get_device("gpu")


@pytest.mark.parametrize("device", [3, None, 1.5, ["cpu"], object(), zs.gallery])
def test_what_is_no_device(device: Any) -> None:
    with pytest.raises(DeviceError, match=r"a device is a name or a Device, not(.|\n)*there are cpu, gpu, interp"):
        get_device(device)
    with pytest.raises(DeviceError, match="a device is a name"):
        zs.render("x", 16, device=device)


def test_a_device_that_is_not_there() -> None:
    with pytest.raises(DeviceError, match="no device 'cpuu'") as error:
        get_device("cpuu")
    assert "did you mean cpu" in error.value.hints[0]


def test_the_interpreter_refuses_what_the_cpu_refuses() -> None:
    program = InterpreterDevice().compile(double())
    with pytest.raises(DeviceError, match="uniform two"):
        program.run(1, {}, {"x": np.zeros(1, np.float32)})
    with pytest.raises(DeviceError, match="buffer x"):
        program.run(1, {"two": 1.0}, {"x": np.zeros(1)})
    with pytest.raises(DeviceError, match="cannot run"):
        program.run(-1, {"two": 1.0}, {"x": np.zeros(1, np.float32)})


def test_signatures_as_text() -> None:
    with KernelBuilder("k") as k:
        k.uniform("a", F64)
        k.buffer("x", F32, writable=True)
    signature = Signature.of(k.kernel)
    assert Signature.from_json(json.loads(json.dumps(signature.to_json()))) == signature
    with pytest.raises(KeyError):
        Signature.from_json({"name": "k"})
