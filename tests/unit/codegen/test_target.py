from __future__ import annotations

from zeroset.codegen.target import host_targets
from zeroset.kernel import F32, F64, U32, Kernel, KernelBuilder, Type, load, store

AVX512 = dict.fromkeys(("sse2", "sse4.1", "sse4.2", "avx2", "fma", "avx512f", "avx512bw", "avx512dq", "avx512vl"), True)
LINUX = "x86_64-unknown-linux-gnu"


def levels(triple: str, features: dict[str, bool]) -> list[tuple[str, int]]:
    return [(t.name, t.width) for t in host_targets(triple, "cpu", features)]


def test_levels_of_x86() -> None:
    assert levels(LINUX, AVX512) == [("avx512", 16), ("avx2", 8), ("sse4", 4), ("sse2", 4)]
    assert levels(LINUX, {**AVX512, "avx512vl": False}) == [("avx2", 8), ("sse4", 4), ("sse2", 4)]
    assert levels(LINUX, {**AVX512, "avx512f": False, "fma": False}) == [("sse4", 4), ("sse2", 4)]
    assert levels(LINUX, {"sse2": True}) == [("sse2", 4)]


def test_other_architectures() -> None:
    assert levels("aarch64-unknown-linux-gnu", {"neon": True}) == [("neon", 4)]
    assert levels("arm64-apple-darwin", {}) == [("neon", 4)]
    assert levels("riscv64-unknown-linux-gnu", {}) == [("generic", 4)]


def test_the_best_target_knows_the_cpu_and_fills_its_registers() -> None:
    best = host_targets(LINUX, "znver4", AVX512)[0]
    assert best.cpu == "znver4"
    assert best.features.endswith(",-prefer-256-bit")
    assert "+avx512f" in best.features
    assert (best.bit_masks, best.fused, best.rounds, best.contract) == (True, True, True, True)


def test_identities_differ() -> None:
    targets = host_targets(LINUX, "znver4", AVX512)
    identities = {t.identity for t in targets} | {t.uncontracted().identity for t in targets}
    assert len(identities) == 2 * len(targets)


def squares(type_: Type) -> Kernel:
    with KernelBuilder("squares") as k:
        x, i = k.buffer("x", type_, writable=True), k.index()
        y = load(x, i)
        store(x, i, y * y + y)
    return k.kernel


def test_doubles_take_half_as_many_lanes() -> None:
    for target in host_targets(LINUX, "znver4", AVX512):
        assert target.suited(squares(F64)).width == target.width // 2
        assert target.suited(squares(F32)) is target
        assert target.suited(squares(U32)) is target
