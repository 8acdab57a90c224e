"""What the code generator must know of a CPU: instruction set, lanes, and the few habits that differ.

The same kernel text comes out for every CPU but for the number of lanes, the shape of a lane mask, and whether fused
multiply-add and rounding are instructions. Everything else is left to LLVM. The levels are those of x86 (baseline
SSE2, SSE4.2, AVX2 with FMA, AVX-512) and AArch64's NEON; any other CPU is compiled for generically with four lanes.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from zeroset.kernel.build import Kernel


class Target(NamedTuple):
    """A CPU as the code generator sees it.

    Attributes:
        name: the level: ``sse2``, ``sse4``, ``avx2``, ``avx512``, ``neon`` or ``generic``.
        triple: LLVM's name for architecture and system.
        cpu: LLVM's name of the processor model.
        features: LLVM's feature list, comma separated, each with ``+`` or ``-``.
        width: lanes that run in lockstep, one packet.
        bit_masks: whether a lane mask is one bit a lane (AVX-512) rather than a 32-bit lane of ones or zeros.
        fused: whether multiply-add with one rounding is an instruction.
        rounds: whether floor, ceil, trunc and rint are instructions.
        saturates: whether conversion to integers saturates by itself.
        contract: whether a product and a sum may be fused into one multiply-add where ``fused``.
    """

    name: str
    triple: str
    cpu: str
    features: str
    width: int
    bit_masks: bool
    fused: bool
    rounds: bool
    saturates: bool
    contract: bool = True

    def uncontracted(self) -> Target:
        """The same target without contraction: each operation then rounds as the interpreter's does."""
        return self._replace(contract=False)

    def suited(self, kernel: Kernel) -> Target:
        """The same target with as many lanes as fill its registers: half as many for a kernel that is mostly in f64.

        Twice as many run no faster, and take almost twice as long to compile.
        """
        types = Counter(result.type.name for i in kernel.body.walk() for result in i.results)
        return self._replace(width=max(self.width // 2, 1)) if types["f64"] > types["f32"] else self

    @property
    def identity(self) -> str:
        """Everything that decides the code, as one line; part of every cache key."""
        return "|".join((self.name, self.triple, self.cpu, self.features, f"w{self.width}", f"c{int(self.contract)}"))


_LEVELS = ("avx512", "avx2", "sse4", "sse2")
_NEEDS = {
    "avx512": ("avx512f", "avx512bw", "avx512dq", "avx512vl", "fma"),
    "avx2": ("avx2", "fma"),
    "sse4": ("sse4.1", "sse4.2"),
    "sse2": ("sse2",),
}
_LIMITED = {
    "avx2": ("x86-64-v3", ""),
    "sse4": ("x86-64-v2", ""),
    "sse2": ("x86-64", ""),
}
_WIDTHS = {"avx512": 16, "avx2": 8, "sse4": 4, "sse2": 4, "neon": 4, "generic": 4}


def host_targets(triple: str, cpu: str, features: dict[str, bool]) -> tuple[Target, ...]:
    """Every target that this CPU can run, the best first.

    Args:
        triple: LLVM's triple of the process.
        cpu: LLVM's name of the host CPU.
        features: LLVM's feature names and whether the host has them.
    """
    flat = ",".join(f"{'+' if on else '-'}{name}" for name, on in sorted(features.items()))
    if triple.startswith(("aarch64", "arm64")):
        return (_target("neon", triple, cpu, flat),)
    if not triple.startswith("x86_64"):
        return (_target("generic", triple, cpu, flat),)
    levels = [level for level in _LEVELS if all(features.get(need, False) for need in _NEEDS[level])]
    # LLVM would rather use half of an AVX-512 register on many CPUs; a packet here fills one.
    best = _target(levels[0], triple, cpu, f"{flat},-prefer-256-bit")
    return (best, *(_target(level, triple, *_LIMITED[level]) for level in levels[1:]))


def _target(name: str, triple: str, cpu: str, features: str) -> Target:
    return Target(
        name,
        triple,
        cpu,
        features,
        _WIDTHS[name],
        bit_masks=name == "avx512",
        fused=name in ("avx512", "avx2", "neon"),
        rounds=name in ("avx512", "avx2", "sse4", "neon"),
        saturates=name == "neon",
    )
