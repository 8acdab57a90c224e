"""The GPU device: order of work, counted runs, limits, faults; on a GPU, or on the driver that stands in for one."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from tests.gpus import needs_gpu

from zeroset.errors import DeviceError, DeviceLostError
from zeroset.kernel import F32, F64, U32, Kernel, KernelBuilder, Type, atomic, if_, load, store
from zeroset.kernel.ops import OPS
from zeroset.runtime import Counted, get_device, registry
from zeroset.runtime.cache import Cache
from zeroset.runtime.gpu import adapter
from zeroset.runtime.gpu.calls import ROW, Layout, grid, head
from zeroset.runtime.gpu.device import GpuDevice
from zeroset.runtime.gpu.probe import judge, operands, rounds_doubles, run_probe
from zeroset.runtime.interp import InterpreterDevice


def add(type_: Type = F32, what: float = 1.0) -> Kernel:
    with KernelBuilder("add") as k:
        x, i = k.buffer("x", type_, writable=True), k.index()
        store(x, i, load(x, i) + k.uniform("a", type_) * what)
    return k.kernel


def keep_odd() -> Kernel:
    """Counts the odd lanes and lists them."""
    with KernelBuilder("odd") as k:
        i = k.index()

        def keep() -> None:
            place = atomic("add", k.buffer("counters", U32, writable=True), 1, 1)
            store(k.buffer("list", U32, writable=True), place, i)

        if_((i & 1).eq(1), keep)
    return k.kernel


def gather(type_: Type, arrays: int) -> Kernel:
    """Each lane: the sum of every array's element at its place."""
    with KernelBuilder("gather") as k:
        i = k.index()
        total = load(k.buffer("c0", type_, constant=True), i)
        for n in range(1, arrays):
            total = total + load(k.buffer(f"c{n}", type_, constant=True), i)
        store(k.buffer("out", type_, writable=True), i, total)
    return k.kernel


@pytest.fixture(scope="module")
def gpu() -> GpuDevice:
    device = get_device("gpu")
    assert isinstance(device, GpuDevice)
    return device


# ------------------------------------------------------------- without a GPU


def test_the_grid_holds_every_lane() -> None:
    for lanes in (1, 63, 64, 65, 64 * ROW, 64 * ROW + 1, 2**26, 2**31 - 1):
        x, y, z = grid(lanes, 64)
        assert z == 1
        assert x <= ROW
        assert y <= 65535
        assert x * y * 64 >= lanes
        assert np.frombuffer(head(lanes, 64), np.uint32)[3] == lanes


def test_uniforms_lie_where_wgsl_wants_them() -> None:
    with KernelBuilder("k") as k:
        for name, type_ in (("a", F32), ("b", F64), ("c", U32)):
            k.uniform(name, type_)
    from zeroset.runtime import Signature

    layout = Layout(Signature.of(k.kernel))
    data = layout.pack({"a": 1.5, "b": 2.5, "c": 7})
    assert (np.frombuffer(data[:4], np.float32)[0], np.frombuffer(data[8:16], np.float64)[0]) == (1.5, 2.5)
    assert np.frombuffer(data[16:20], np.uint32)[0] == 7
    assert layout.size == 48
    with pytest.raises(DeviceError, match="needs the uniform b as f64"):
        layout.pack({"a": 1.0, "c": 1})
    with pytest.raises(DeviceError, match="cannot take the uniforms"):
        layout.pack({"a": 1.0, "b": 1.0, "c": -1})


def test_the_probe_sees_what_arithmetic_does() -> None:
    exact = run_probe(InterpreterDevice())
    assert (exact.division, exact.root, exact.fused, exact.sums <= 0.5) == (True, True, True, True)
    a, b = operands()
    with np.errstate(all="ignore"):
        good = {"sum": a + b, "product": a * b, "quotient": a / b, "root": np.sqrt(a), "rest": np.zeros_like(a)}
        rough = judge(a, b, good | {"quotient": np.nextafter(a / b, np.float32(np.inf))})
        cut = judge(a, b, good | {"sum": np.nextafter(a + b, np.float32(0))})
        broken = judge(a, b, good | {"root": np.full_like(a, np.nan)})
    assert not judge(a, b, good).fused
    assert 0.5 < rough.quotients <= 1.5
    assert not rough.division
    assert cut.sums > 0.5
    assert broken.roots == np.inf


def test_the_probe_sees_how_doubles_are_rounded(monkeypatch: pytest.MonkeyPatch) -> None:
    assert rounds_doubles(InterpreterDevice())

    def careless(a: np.ndarray) -> np.ndarray:
        # As a driver does that takes numbers beyond 2^24 for whole ones, as f32 numbers are.
        return np.where(np.abs(a) < 2.0**24, np.trunc(a), a)

    monkeypatch.setitem(OPS, "trunc", OPS["trunc"]._replace(evaluate=careless))
    assert not rounds_doubles(InterpreterDevice())


def test_no_wgpu_is_said_clearly(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "wgpu", None)
    adapter.adapters.cache_clear()
    with pytest.raises(DeviceError, match="wgpu") as error:
        GpuDevice()
    assert "pip install wgpu" in error.value.hint
    adapter.adapters.cache_clear()


def test_a_session_without_a_folder_gets_one_only_while_adapters_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)
    with adapter.quiet_wayland():
        assert os.environ["XDG_RUNTIME_DIR"]
    assert "XDG_RUNTIME_DIR" not in os.environ
    monkeypatch.setenv("XDG_RUNTIME_DIR", "/own")
    with adapter.quiet_wayland():
        assert os.environ["XDG_RUNTIME_DIR"] == "/own"
    assert os.environ["XDG_RUNTIME_DIR"] == "/own"


def test_no_adapter_is_said_clearly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "adapters", tuple)
    with pytest.raises(DeviceError, match="no GPU with a Vulkan") as error:
        GpuDevice()
    assert any('device="cpu"' in hint for hint in error.value.hints)


# ---------------------------------------------------------------- with a GPU


@needs_gpu
def test_a_gpu_that_nobody_has(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZEROSET_GPU", "voodoo")
    with pytest.raises(DeviceError, match="asks for 'voodoo'") as error:
        GpuDevice()
    assert "there are:" in error.value.hint


@needs_gpu
def test_work_is_done_in_order(gpu: GpuDevice) -> None:
    x = gpu.allocate(F32, 100)
    program = gpu.compile(add())
    program.run(100, {"a": 1.0}, {"x": x})
    gpu.write(x, np.full(50, 10, np.float32))
    program.run(70, {"a": 2.0}, {"x": x})
    before = gpu.copy(x)
    gpu.clear(x)
    program.run(3, {"a": 3.0}, {"x": x})
    assert gpu.read(before).tolist() == [12.0] * 50 + [3.0] * 20 + [1.0] * 30
    assert gpu.read(x).tolist() == [3.0] * 3 + [0.0] * 97


@needs_gpu
def test_more_runs_than_a_submission_holds(gpu: GpuDevice) -> None:
    x = gpu.allocate(F32, 4)
    program = gpu.compile(add())
    for _ in range(3000):
        program.run(4, {"a": 1.0}, {"x": x})
    assert gpu.read(x).tolist() == [3000.0] * 4


@needs_gpu
def test_an_earlier_pass_says_how_many_run(gpu: GpuDevice) -> None:
    counters, listed, x = gpu.allocate(U32, 3), gpu.allocate(U32, 5000), gpu.allocate(F32, 9000)
    gpu.compile(keep_odd()).run(5000, {}, {"counters": counters, "list": listed})
    gpu.compile(add()).run(Counted(counters, 1, 3), {"a": 1.0}, {"x": x})
    assert gpu.read(counters).tolist() == [0, 2500, 0]
    assert sorted(gpu.read(listed)[:2500].tolist()) == list(range(1, 5000, 2))
    assert gpu.read(x).sum() == 7500
    assert gpu.read(x)[7499:7501].tolist() == [1.0, 0.0]


@needs_gpu
def test_nothing_counted_nothing_run(gpu: GpuDevice) -> None:
    counters, x = gpu.allocate(U32, 1), gpu.allocate(F32, 10)
    gpu.compile(add()).run(Counted(counters), {"a": 1.0}, {"x": x})
    gpu.compile(add()).run(0, {"a": 1.0}, {"x": x})
    assert not gpu.read(x).any()


@needs_gpu
def test_doubles_where_there_are_any(gpu: GpuDevice) -> None:
    if not gpu.supports(F64):
        pytest.skip("this GPU has no f64")
    x = gpu.allocate(F64, 3)
    gpu.compile(add(F64)).run(3, {"a": 1 / 3}, {"x": x})
    assert gpu.read(x).tolist() == [1 / 3] * 3


@needs_gpu
def test_what_does_not_fit_is_refused(gpu: GpuDevice) -> None:
    with pytest.raises(DeviceError, match="buffers of at most") as error:
        gpu.allocate(F32, gpu.largest // 4 + 1)
    assert "smaller picture" in error.value.hint
    x = gpu.allocate(F32, 2)
    with pytest.raises(DeviceError, match="3 values do not fit"):
        gpu.write(x, np.ones(3, np.float32))
    program = gpu.compile(add())
    with pytest.raises(DeviceError, match="needs the buffer x of f32 on the GPU, not a ndarray"):
        program.run(1, {"a": 1.0}, {"x": np.ones(3, np.float32)})
    with pytest.raises(DeviceError, match="not nothing"):
        program.run(1, {"a": 1.0}, {})
    with pytest.raises(DeviceError, match="uniform a"):
        program.run(1, {}, {"x": x})


@needs_gpu
def test_shaders_come_from_the_disk(tmp_path: Path) -> None:
    def build() -> Kernel:
        made.append(1)
        return add()

    made: list[int] = []
    for _ in range(2):
        device = GpuDevice(cache=Cache(tmp_path))
        x = device.allocate(F32, 1)
        device.compile_cached("key", build).run(1, {"a": 4.0}, {"x": x})
        assert device.read(x).tolist() == [4.0]
    assert made == [1]


@needs_gpu
def test_a_lost_gpu_is_opened_anew(monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture) -> None:
    monkeypatch.setattr(registry, "_made", {})
    device = get_device("gpu")
    assert isinstance(device, GpuDevice)
    x = device.allocate(F32, 1)
    device.handle.destroy()
    with pytest.raises(DeviceLostError, match="was lost") as error:
        device.read(x)
    assert device.lost
    assert "opened anew" in error.value.hint
    again = get_device("gpu")
    assert again is not device
    y = again.allocate(F32, 1)
    again.compile(add()).run(1, {"a": 1.0}, {"x": y})
    assert again.read(y).tolist() == [1.0]


@needs_gpu
def test_the_clock_times_each_pass(gpu: GpuDevice) -> None:
    clock = gpu.stream.clock
    if clock is None:
        pytest.skip("this GPU has no timestamps")
    x, program = gpu.allocate(F32, 1 << 16), gpu.compile(add())
    clock.start()
    for _ in range(3):
        program.run(1 << 16, {"a": 1.0}, {"x": x})
    gpu.read(x)
    times = clock.stop()
    assert [label for label, _, _ in times] == ["add"] * 3
    assert all(end >= begin > 0 for _, begin, end in times)


@needs_gpu
@pytest.mark.parametrize("type_", [F32, U32, F64])
@pytest.mark.parametrize(("arrays", "count"), [(1, 7), (1, 5000), (14, 100)])
def test_constants_short_long_and_many(gpu: GpuDevice, type_: Type, arrays: int, count: int) -> None:
    if not gpu.supports(type_):
        pytest.skip("this GPU has no f64")
    program = gpu.compile(gather(type_, arrays))
    values = np.arange(count).astype(type_.dtype)
    for again in (1, 2):
        bound = {f"c{n}": gpu.allocate(type_, count, constant=True) for n in range(arrays)}
        bound["out"] = gpu.allocate(type_, count)
        for n in range(arrays):
            gpu.write(bound[f"c{n}"], values * again)
        program.run(count, {}, bound)
        assert np.array_equal(gpu.read(bound["out"]), values * (arrays * again))
        assert np.array_equal(gpu.read(gpu.copy(bound["c0"])), values * again)


@needs_gpu
def test_what_was_not_allocated_as_constants_is_refused(gpu: GpuDevice) -> None:
    bound = {name: gpu.allocate(F32, 4) for name in ("c0", "out")}
    with pytest.raises(DeviceError, match="needs the buffer c0 as one of constants"):
        gpu.compile(gather(F32, 1)).run(4, {}, bound)
