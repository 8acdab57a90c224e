from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from zeroset.errors import DeviceError
from zeroset.kernel import BOOL, F32, F64, I32, U32, Kernel, KernelBuilder, atomic, load, store, while_
from zeroset.runtime import Device, cpu, image, programs
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice, host


def scale() -> Kernel:
    with KernelBuilder("scale") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        y = k.buffer("y", F32)
        factor = k.uniform("factor", F32) * k.uniform("wide", F64).convert(F32) + k.uniform("n", I32).convert(F32)
        store(x, i, k.uniform("flag", BOOL).select(load(y, i) * factor, k.uniform("u", U32).convert(F32)))
    return k.kernel


UNIFORMS = {"factor": 2.0, "wide": 0.5, "n": -3, "flag": True, "u": 2**32 - 1}


@pytest.fixture(params=[1, 2, 5])
def device(request: pytest.FixtureRequest) -> CpuDevice:
    return CpuDevice(threads=request.param, cache=Cache(None))


def arrays(count: int) -> dict[str, Any]:
    return {"x": np.zeros(count, np.float32), "y": np.arange(count, dtype=np.float32)}


def test_it_keeps_the_contract(device: CpuDevice) -> None:
    assert isinstance(device, Device)
    buffer = device.allocate(F64, 5)
    assert buffer.ctypes.data % 64 == 0
    device.write(buffer, np.ones(3))
    assert device.read(buffer).tolist() == [1, 1, 1, 0, 0]


@pytest.mark.parametrize("count", [0, 1, 15, 16, 17, 1000, 100_001])
def test_every_lane_runs_once(device: CpuDevice, count: int) -> None:
    program, data = device.compile(scale()), arrays(count + 5)
    program.run(count, UNIFORMS, data)
    assert np.array_equal(data["x"][:count], -2 * data["y"][:count])
    assert not data["x"][count:].any()


def test_uniforms_and_buffers_may_change_each_time(device: CpuDevice) -> None:
    program = device.compile(scale())
    for n in range(5):
        data = arrays(100 + n)
        program.run(100, {**UNIFORMS, "n": n, "unused": "x"}, {**data, "unused": 3})
        assert np.array_equal(data["x"][:100], (1 + n) * data["y"][:100])
    program.run(100, {**UNIFORMS, "flag": False}, data)
    assert data["x"][0] == np.float32(2**32)
    data["y"][:] = 7
    program.run(100, {**UNIFORMS, "factor": np.float32(4), "n": np.int64(0)}, data)
    assert data["x"][3] == 14


def test_a_run_compiles_and_keeps_nothing(device: CpuDevice, monkeypatch: pytest.MonkeyPatch) -> None:
    program, data = device.compile(scale()), arrays(64)
    monkeypatch.setattr(CpuDevice, "_translate", None)
    assert device.compile(scale()) is program
    for n in range(50):
        device.compile(scale()).run(64, {**UNIFORMS, "n": n}, data)
    assert data["x"][1] == 50


@pytest.mark.parametrize(
    ("uniforms", "buffers", "message"),
    [
        ({"n": None}, {}, "uniform n as i32, not None"),
        ({"n": 0.5}, {}, "uniform n as i32, not 0.5"),
        ({"n": 2**31}, {}, "uniform n as i32"),
        ({"u": -1}, {}, "uniform u as u32, not -1"),
        ({"factor": "2"}, {}, "uniform factor as f32, not '2'"),
        ({"factor": 1e39}, {}, "uniform factor as f32"),
        ({}, {"x": None}, "buffer x as a contiguous 1-D array of float32, not nothing"),
        ({}, {"x": [0.0]}, "not list"),
        ({}, {"y": np.zeros(9)}, "not float64"),
        ({}, {"y": np.zeros((3, 3), np.float32)}, r"shape \(3, 3\)"),
        ({}, {"y": np.zeros(18, np.float32)[::2]}, "contiguous"),
    ],
)
def test_arguments_that_do_not_fit(uniforms: dict[str, Any], buffers: dict[str, Any], message: str) -> None:
    device = CpuDevice(threads=1, cache=Cache(None))
    with pytest.raises(DeviceError, match=message):
        device.compile(scale()).run(9, {**UNIFORMS, **uniforms}, {**arrays(9), **buffers})


def test_more_that_does_not_fit(device: CpuDevice) -> None:
    program = device.compile(scale())
    with pytest.raises(DeviceError, match="uniform flag as bool, not nothing"):
        program.run(1, {name: v for name, v in UNIFORMS.items() if name != "flag"}, arrays(1))
    frozen = arrays(4)
    frozen["x"].flags.writeable = False
    with pytest.raises(DeviceError, match="may be written"):
        program.run(4, UNIFORMS, frozen)
    for count in (-1, 2**31):
        with pytest.raises(DeviceError, match="cannot run"):
            program.run(count, UNIFORMS, arrays(1))


def test_several_threads_may_use_one_program(device: CpuDevice) -> None:
    with KernelBuilder("count") as k:
        atomic("add", k.buffer("cells", U32, writable=True), k.uniform("place", U32), 1)
    program, cells = device.compile(k.kernel), device.allocate(U32, 4)

    def use(place: int) -> None:
        for _ in range(20):
            program.run(1000, {"place": place}, {"cells": cells})

    users = [threading.Thread(target=use, args=(place,)) for place in range(4)]
    for user in users:
        user.start()
    for user in users:
        user.join()
    assert cells.tolist() == [20_000] * 4


@pytest.fixture
def heard() -> Iterator[None]:
    """Ctrl-C is heard, even by tests that run in the background of a shell, which makes them deaf to it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heard")
@pytest.mark.parametrize("threads", [1, 3])
def test_ctrl_c_stops_a_long_dispatch(threads: int) -> None:
    """Hours of work, ended by the signal; a signal that waits for the end would run into the time limit."""
    with KernelBuilder("slow") as k:
        out, i = k.buffer("out", F32, writable=True), k.index()
        (v,) = while_(lambda v: v < 3e4, lambda v: v + 1.0, i.convert(F32) * 0.0)
        store(out, i & 15, v)
    device = CpuDevice(threads=threads, cache=Cache(None))
    program, out = device.compile(k.kernel), device.allocate(F32, 16)

    def interrupted() -> None:
        threading.Timer(0.2, signal.raise_signal if sys.platform == "win32" else os.kill, _signal()).start()
        program.run(2**31 - 1, {}, {"out": out})

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    program.run(16, {}, {"out": out})
    assert out[0] == 3e4


def _signal() -> tuple[int, ...]:
    return (signal.SIGINT,) if sys.platform == "win32" else (os.getpid(), signal.SIGINT)


def test_programs_come_from_the_disk(tmp_path: Path) -> None:
    built = []

    def build() -> Kernel:
        built.append(1)
        return scale()

    for _ in range(3):
        device = CpuDevice(threads=1, cache=Cache(tmp_path))
        program, data = device.compile_cached("formula", build), arrays(9)
        assert device.compile_cached("formula", build) is program
        program.run(9, UNIFORMS, data)
        assert np.array_equal(data["x"], -2 * data["y"])
    assert len(built) == 1
    assert CpuDevice(threads=1, cache=Cache(None)).compile_cached("formula", build).signature == program.signature
    assert len(built) == 2


@pytest.mark.parametrize("suffix", ["program", "link"])
def test_a_file_that_is_gone_or_damaged_is_made_anew(tmp_path: Path, suffix: str) -> None:
    for damage in (Path.unlink, lambda path: path.write_bytes(b"zeroset"), lambda path: path.write_bytes(b"")):
        CpuDevice(threads=1, cache=Cache(tmp_path)).compile_cached("formula", scale)
        (path,) = tmp_path.glob(f"*.{suffix}")
        damage(path)
        data = arrays(9)
        CpuDevice(threads=1, cache=Cache(tmp_path)).compile_cached("formula", scale).run(9, UNIFORMS, data)
        assert data["x"][8] == -16
        assert path.stat().st_size > 50


def test_other_targets_and_sources_have_other_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    targets = host()
    for target in (*targets, targets[0].uncontracted()):
        CpuDevice(target, threads=1, cache=Cache(tmp_path)).compile(scale())
    assert len(list(tmp_path.glob("*.program"))) == len(targets) + 1
    monkeypatch.setattr(cpu, "source_stamp", lambda: "another state of the sources")
    CpuDevice(targets[0], threads=1, cache=Cache(tmp_path)).compile(scale())
    assert len(list(tmp_path.glob("*.program"))) == len(targets) + 2


@pytest.mark.skipif(not image.can_place(), reason="images run on Linux on x86-64 only")
def test_a_warm_start_neither_traces_nor_loads_llvm(tmp_path: Path) -> None:
    program = f"""
import sys, numpy as np
from collections.abc import Iterator
from pathlib import Path
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice, host
def build():
    assert sys.argv[1] == "cold", "the kernel was traced"
    from zeroset.kernel import F32, KernelBuilder, load, store
    with KernelBuilder("k") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) + k.uniform("a", F32))
    return k.kernel
x = np.ones(5, np.float32)
CpuDevice(cache=Cache(Path({str(tmp_path)!r}))).compile_cached("key", build).run(5, {{"a": 2.0}}, {{"x": x}})
assert x.tolist() == [3.0] * 5
assert ("llvmlite" in sys.modules) == (sys.argv[1] == "cold"), "LLVM was loaded"
"""
    for start in ("cold", "warm"):
        subprocess.run([sys.executable, "-c", program, start], check=True, timeout=60)


def test_llvms_own_linker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What runs where images do not."""
    monkeypatch.setattr(image, "can_place", lambda: False)
    for _ in range(2):
        data = arrays(9)
        CpuDevice(threads=2, cache=Cache(tmp_path)).compile_cached("formula", scale).run(9, UNIFORMS, data)
        assert data["x"][8] == -16


def test_a_system_that_forbids_compiled_code(monkeypatch: pytest.MonkeyPatch) -> None:
    def forbid(code: bytes) -> None:
        raise PermissionError(13, "executable memory is forbidden here")

    monkeypatch.setattr(image, "can_place", lambda: True)
    monkeypatch.setattr(image, "place", forbid)
    monkeypatch.setattr(image, "link", lambda code, symbol: code)
    with pytest.raises(DeviceError, match="does not run compiled code") as error:
        CpuDevice(threads=1, cache=Cache(None)).compile(scale())
    assert "interp" in error.value.hint


def test_llvm_that_cannot_be_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> None:
        raise OSError("libllvmlite.so: cannot open shared object file")

    monkeypatch.setattr("zeroset.codegen.llvm.host", broken)
    with pytest.raises(DeviceError, match="LLVM, which compiles for the CPU, cannot be loaded"):
        CpuDevice(threads=1, cache=Cache(None)).compile(scale())


def test_old_programs_are_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(programs, "_IN_MEMORY", 2)
    device = CpuDevice(threads=1, cache=Cache(None))
    for n in range(4):
        with KernelBuilder(f"k{n}") as k:
            store(k.buffer("x", F32, writable=True), k.index(), 1.0)
        device.compile(k.kernel)
    assert len(device._programs._made) == 2


def test_one_kernel_is_traced_at_a_time() -> None:
    device = CpuDevice(cache=Cache(None))
    inside, most = [0], [0]
    together = threading.Barrier(4)

    def build(name: str) -> Kernel:
        inside[0] += 1
        most[0] = max(most[0], inside[0])
        with KernelBuilder(name) as k:
            x, lane = k.buffer("x", F32, writable=True), k.index()
            for _ in range(300):
                store(x, lane, load(x, lane) + 1.0)
        inside[0] -= 1
        return k.kernel

    def ask(name: str) -> None:
        together.wait(10)
        device.compile_cached(name, lambda: build(name))

    threads = [threading.Thread(target=ask, args=(f"k{i}",)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert most == [1]


def test_no_garbage_is_collected_while_a_kernel_is_traced() -> None:
    seen = []

    def build() -> Kernel:
        seen.append(gc.isenabled())
        return scale()

    assert gc.isenabled()
    device = CpuDevice(cache=Cache(None))
    device.compile_cached("halving", build)
    assert gc.isenabled()
    with pytest.raises(ZeroDivisionError):
        device.compile_cached("broken", lambda: 1 // 0)  # type: ignore[arg-type, return-value]
    assert gc.isenabled()
    assert seen == [False]
