"""Memory over frames: what moves, and what is counted."""

from __future__ import annotations

import zeroset as zs
from zeroset.bench.devices import Devices
from zeroset.bench.memory import measure_memory, resident


def test_nothing_is_compiled_while_parameters_and_camera_move() -> None:
    shares: list[float] = []
    cost = measure_memory(zs.gallery["tangle"], 12, 32, "auto", Devices("cpu", 1), shares.append)
    assert (cost.name, cost.frames, cost.size, cost.moved) == ("tangle", 12, 32, ("r",))
    assert cost.compilations == 0
    assert len(shares) == 12
    assert shares == sorted(shares)


def test_resident_memory_follows_the_process() -> None:
    before = resident()
    held = bytearray(b"\x01") * (64 << 20)
    after = resident()
    assert before is None or after is None or after - before > 32
    assert len(held) == 64 << 20
