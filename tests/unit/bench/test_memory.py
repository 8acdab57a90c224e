"""Memory over frames: what moves, and what is counted."""

from __future__ import annotations

import mmap

from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.bench.devices import Devices
from zeroset.bench.memory import measure_memory, resident
from zeroset.kernel import U32
from zeroset.runtime import get_device
from zeroset.runtime.gpu.census import live_objects


def test_nothing_is_compiled_while_parameters_and_camera_move() -> None:
    shares: list[float] = []
    cost = measure_memory(zs.gallery["tangle"], 12, 32, "auto", Devices("cpu", 1), shares.append)
    assert (cost.name, cost.frames, cost.size, cost.moved) == ("tangle", 12, 32, ("r",))
    assert cost.compilations == 0
    assert cost.objects is None
    assert len(shares) == 12
    assert shares == sorted(shares)


@needs_gpu
def test_objects_of_a_gpu_are_counted() -> None:
    gpu = get_device("gpu")
    before = live_objects()
    held = [gpu.allocate(U32, 16) for _ in range(5)]
    assert live_objects() == before + 5
    held.clear()
    assert live_objects() == before


def test_resident_memory_follows_the_process() -> None:
    before = resident()
    # Fresh pages of the system's: memory that the process had and gave back would not count anew.
    with mmap.mmap(-1, 64 << 20) as held:
        for _ in range(64):
            held.write(bytes([1]) * (1 << 20))
        after = resident()
    assert before is None or after is None or after - before > 32
