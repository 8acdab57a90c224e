"""How a GPU calculates, measured when it is opened: a few thousand operations beside the host's.

The proofs of ``arith`` need sums and products rounded to nearest, and quotients and roots within less than one unit in
the last place. WGSL promises neither; a GPU that does not keep the first is refused, and one that does not keep the
second gets a correction step (``codegen.legalise``) and is measured again. So does one whose f64 numbers are rounded to
whole ones wrongly; where that does not help it goes without f64.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from zeroset.errors import DeviceError
from zeroset.kernel import F32, F64, Kernel, KernelBuilder, load, store

if TYPE_CHECKING:
    from zeroset.runtime.device import Device

Floats = npt.NDArray[np.float32]
_LANES = 1 << 13
_RESULTS = ("sum", "product", "quotient", "root", "rest")
_ROUNDINGS = {"floored": np.floor, "raised": np.ceil, "cut": np.trunc, "rounded": np.rint}
NEAR = 0.51
"""Units in the last place by which a corrected quotient or root may be off."""


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """What was measured, in units in the last place of the exact result.

    Attributes:
        sums: largest error of a sum or a product.
        quotients: of a quotient.
        roots: of a square root.
        fused: whether ``fma`` rounds once.
    """

    sums: float
    quotients: float
    roots: float
    fused: bool

    @property
    def division(self) -> bool:
        """Whether quotients are rounded to nearest."""
        return self.quotients <= 0.5

    @property
    def root(self) -> bool:
        """Whether square roots are rounded to nearest."""
        return self.roots <= 0.5

    def __str__(self) -> str:
        fused = "fused" if self.fused else "separate"
        return (
            f"errors up to {self.sums:.2f} (sums, products), {self.quotients:.2f} (quotients), {self.roots:.2f} "
            f"(roots) units in the last place; multiply-add {fused}"
        )


def probe_kernel() -> Kernel:
    """Sum, product, quotient, root and the rest of a product, of two numbers a lane."""
    with KernelBuilder("probe") as k:
        i = k.index()
        a, b = load(k.buffer("a", F32), i), load(k.buffer("b", F32), i)
        product = a * b
        made = (a + b, product, a / b, a.sqrt(), a.fma(b, -product))
        for name, value in zip(_RESULTS, made, strict=True):
            store(k.buffer(name, F32, writable=True), i, value)
    return k.kernel


def operands() -> tuple[Floats, Floats]:
    """Positive numbers of many sizes, the same ones each time."""
    random = np.random.default_rng(1)
    sizes = random.uniform(-20, 20, (2, _LANES))
    a, b = (random.uniform(1, 2, (2, _LANES)) * np.exp2(sizes)).astype(np.float32)
    return a, b


def run_probe(device: Device) -> Arithmetic:
    """Measure a device."""
    a, b = operands()
    buffers = {name: device.allocate(F32, _LANES) for name in ("a", "b", *_RESULTS)}
    device.write(buffers["a"], a)
    device.write(buffers["b"], b)
    device.compile(probe_kernel()).run(_LANES, {}, buffers)
    return judge(a, b, {name: device.read(buffers[name]) for name in _RESULTS})


def rounding_kernel() -> Kernel:
    """An f64 number rounded to a whole one in every way."""
    with KernelBuilder("roundings") as k:
        i = k.index()
        a = load(k.buffer("a", F64), i)
        for name, way in _ROUNDINGS.items():
            store(k.buffer(name, F64, writable=True), i, getattr(a, way.__name__)())
    return k.kernel


def rounds_doubles(device: Device) -> bool:
    """Whether a device rounds f64 numbers to whole ones as it should, the sign of a zero aside."""
    sizes = np.exp2(np.arange(-2.0, 54.0))
    near = np.concatenate([sizes, sizes + 0.5, sizes - 0.5, sizes + 0.25, sizes - 0.75, [0.0]])
    numbers = np.concatenate([near, -near])
    buffers = {name: device.allocate(F64, len(numbers)) for name in ("a", *_ROUNDINGS)}
    device.write(buffers["a"], numbers)
    device.compile(rounding_kernel()).run(len(numbers), {}, buffers)
    return all(np.array_equal(device.read(buffers[name]), way(numbers)) for name, way in _ROUNDINGS.items())


def judge(a: Floats, b: Floats, given: Mapping[str, Floats]) -> Arithmetic:
    """What results tell of the arithmetic that made them; products of f32 and their rests are exact in f64."""
    x, y = a.astype(np.float64), b.astype(np.float64)
    rest = x * y - given["product"].astype(np.float64)
    sums = max(_error(given["sum"], x + y), _error(given["product"], x * y))
    fused = bool(np.any(rest)) and np.array_equal(given["rest"].astype(np.float64), rest)
    return Arithmetic(sums, _error(given["quotient"], x / y), _error(given["root"], np.sqrt(x)), fused)


def _error(given: Floats, exact: npt.NDArray[np.float64]) -> float:
    """The largest error in units in the last place; f64's own roundings, 2^-29 of them, are taken off."""
    unit = np.spacing(exact.astype(np.float32)).astype(np.float64)
    error = np.abs(given.astype(np.float64) - exact) / unit
    return float(max(np.max(error) - 2.0**-28, 0.0)) if np.all(np.isfinite(given)) else float("inf")


def check(name: str, measured: Arithmetic, limit: float) -> None:
    """Raise ``DeviceError`` where proofs would not hold in the arithmetic measured."""
    if measured.sums > 0.5 or max(measured.quotients, measured.roots) > limit:
        raise DeviceError(
            f"{name} calculates too coarsely for proofs: {measured}", hint='use device="cpu", whose pictures are proven'
        )
