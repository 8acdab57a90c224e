"""What is done to every kernel between tracing and code: five named passes, each from a legal kernel to a legal kernel.

    fold     computes what is constant and drops what changes nothing (x*1, not not c), bit for bit
    flatten  turns a branch of a few pure operations into selects
    hoist    moves what a loop does not change in front of it
    cse      computes equal things once
    dce      drops what nobody reads, carried state included

Each takes time linear in the kernel. They make up for the passes of LLVM that zeroset does not run: those cost more
than all the rest of a compilation, and GPU drivers differ in theirs.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.kernel.build import Kernel
from zeroset.kernel.passes.cse import cse
from zeroset.kernel.passes.dce import dce
from zeroset.kernel.passes.flatten import flatten
from zeroset.kernel.passes.fold import fold
from zeroset.kernel.passes.hoist import hoist
from zeroset.kernel.verify import verify

Pass = Callable[[Kernel], Kernel]

PASSES: dict[str, Pass] = {"fold": fold, "flatten": flatten, "hoist": hoist, "cse": cse, "dce": dce}
"""The passes by name, in the order they run."""

__all__ = ["PASSES", "Pass", "optimise"]


def optimise(kernel: Kernel, observe: Callable[[str, Kernel], None] | None = None) -> Kernel:
    """Run every pass, verifying before the first and after the last; the kernel given stays as it is.

    Args:
        kernel: any legal kernel.
        observe: called with each pass's name and its kernel, for ``zeroset explain``; every one is verified then.

    Raises:
        KernelError: the kernel is not legal.

    Example:
        >>> from zeroset.kernel import F32, KernelBuilder, store
        >>> with KernelBuilder("k") as k:
        ...     store(k.buffer("x", F32, writable=True), k.index(), k.uniform("a", F32) * 1.0)
        >>> [i.op for i in optimise(k.kernel).body.instructions]
        ['index', 'uniform', 'store']
    """
    # Verifying costs as much as a pass. What goes to the code generator is verified all the same; which pass broke a
    # kernel is the question of those who watch: ``explain`` and the tests.
    verify(kernel)
    for name, run in PASSES.items():
        kernel = run(kernel)
        if observe is not None:
            observe(name, verify(kernel))
    return kernel if observe is not None else verify(kernel)
