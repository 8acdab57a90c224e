from __future__ import annotations

from zeroset.kernel import F32, U32, KernelBuilder, Value, any_, for_, if_, load, while_
from zeroset.kernel.uniformity import varying_values


def varies(k: KernelBuilder, **values: Value) -> set[str]:
    found = varying_values(k.kernel)
    return {name for name, value in values.items() if id(value) in found}


def test_straight_code() -> None:
    with KernelBuilder("k") as k:
        a, i, x = k.uniform("a", F32), k.index(), k.buffer("x", F32)
        u = a * 2.0 + 1.0
        named = {"u": u, "loaded": load(x, u.convert(U32)), "i": i, "mixed": u + i.convert(F32), "own": load(x, i)}
        named["vote"] = any_(named["own"] > 0.0)
    assert varies(k, **named) == {"i", "mixed", "own"}


def test_loops_that_lanes_leave_at_different_times_vary() -> None:
    with KernelBuilder("k") as k:
        a, i = k.uniform("a", F32), k.index()
        (same,) = for_(k.uniform("n", U32), lambda j, v: v * 2.0, a)
        (left,) = for_(i & 3, lambda j, v: v * 2.0, a)
        (whiled,) = while_(lambda v: v < 9.0, lambda v: v * 2.0, a)
        (through,) = while_(lambda v: any_(i.convert(F32) < v) & (v > 0.5), lambda v: v * 0.5, a)
    assert varies(k, same=same, left=left, whiled=whiled, through=through) == {"left"}


def test_what_varies_late_varies_from_the_start() -> None:
    """State b takes on a's lane-dependent value only in the second round."""
    seen = {}
    with KernelBuilder("k") as k:
        u, i = k.uniform("u", F32), k.index()

        def body(j: Value, a: Value, b: Value, c: Value) -> tuple[Value, ...]:
            seen["b"], seen["c"] = b, c
            return a + i.convert(F32), a, c * 2.0

        a, b, c = for_(k.uniform("n", U32), body, u, u, u)
    assert varies(k, a=a, b=b, c=c, b_inside=seen["b"], c_inside=seen["c"]) == {"a", "b", "b_inside"}


def test_branches() -> None:
    with KernelBuilder("k") as k:
        u, i = k.uniform("u", F32), k.index()
        (by_lane,) = if_(i > 3, lambda: (u,), lambda: (u + 1.0,))
        (by_all,) = if_(u > 3.0, lambda: (u,), lambda: (u + 1.0,))
        (half,) = if_(u > 3.0, lambda: (u,), lambda: (i.convert(F32),))
    assert varies(k, by_lane=by_lane, by_all=by_all, half=half) == {"by_lane", "half"}
