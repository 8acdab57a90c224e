"""The CPU: kernels as SIMD machine code on all cores.

Code comes from memory, from the disk, or from LLVM, in this order; LLVM is imported only in the last case (and where
the system cannot run images, see ``image``). After zeroset's own passes none of LLVM's are run: on ray kernels of 400
to 600 instructions they gained no speed and doubled the time to compile.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from zeroset.errors import DeviceError
from zeroset.kernel.build import Kernel
from zeroset.runtime import image
from zeroset.runtime.cache import Cache, default_cache
from zeroset.runtime.compiled import Compiled
from zeroset.runtime.device import HostMemory, Recipe, Signature
from zeroset.runtime.pool import Pool, thread_count
from zeroset.runtime.program import CpuProgram
from zeroset.runtime.programs import Programs
from zeroset.runtime.stamps import cpu_stamp, llvm_stamp, source_stamp

if TYPE_CHECKING:
    from zeroset.codegen.target import Target

_ENTRY = "drain"


class CpuDevice(HostMemory):
    """This machine's CPU.

    Args:
        target: the instruction set to compile for; the best that this CPU has by default.
        threads: how many threads run a dispatch; ``ZEROSET_THREADS`` or all cores by default.
        cache: where compiled code is kept; the user's cache folder by default.

    Example:
        >>> import numpy as np
        >>> from zeroset.kernel import F32, KernelBuilder, load, store
        >>> with KernelBuilder("double") as k:
        ...     x, i = k.buffer("x", F32, writable=True), k.index()
        ...     store(x, i, load(x, i) * 2.0)
        >>> data = np.arange(4, dtype=np.float32)
        >>> CpuDevice(cache=Cache(None)).compile(k.kernel).run(4, {}, {"x": data})
        >>> data.tolist()
        [0.0, 2.0, 4.0, 6.0]
    """

    name = "cpu"

    def __init__(self, target: Target | None = None, threads: int | None = None, cache: Cache | None = None) -> None:
        self._target = target
        self._pool = Pool(threads or thread_count())
        self.cache = default_cache() if cache is None else cache
        machine = target.identity if target else cpu_stamp() or self.target.identity
        stamp = f"{machine}|{source_stamp()}|{llvm_stamp()}"
        self._programs = Programs(self.cache, stamp, self._write, self._translate, self._place)

    @property
    def target(self) -> Target:
        """The instruction set that kernels are compiled for; asking for it loads LLVM."""
        if self._target is None:
            self._target = host()[0]
        return self._target

    @property
    def threads(self) -> int:
        """How many threads run a dispatch."""
        return self._pool.threads

    def compile(self, kernel: Kernel) -> CpuProgram:
        """The program of a kernel; see ``Device.compile``."""
        return self._programs.of(kernel)

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> CpuProgram:
        """The program under a key; see ``Device.compile_cached``."""
        return self._programs.under(key, build, quick)

    def begin_apart(self, recipes: Iterable[Recipe], perhaps: Iterable[Recipe] = ()) -> None:
        """Have another process make programs; see ``Device.begin_apart``. One core has no time for two."""
        if self.threads > 1:
            self._programs.begin_apart(recipes, perhaps)

    def _write(self, kernel: Kernel) -> str:
        from zeroset.codegen import llvm
        from zeroset.kernel.passes import optimise

        return llvm.to_llvm(optimise(kernel), self.target.suited(kernel))

    def _translate(self, kernel: Kernel, text: str, quick: bool) -> Compiled:
        from zeroset.codegen import llvm

        code = llvm.to_object(text, self.target, 0 if quick else None)
        flat = image.link(code, _ENTRY) if image.can_place() else None
        kind, data = ("object", code) if flat is None else ("image", flat)
        return Compiled(Signature.of(kernel), self.target.suited(kernel).width, kind, data)

    def _place(self, compiled: Compiled) -> CpuProgram:
        try:
            address, keep = image.place(compiled.code) if compiled.kind == "image" else self._link(compiled.code)
        except (OSError, RuntimeError) as error:
            raise DeviceError(
                f"this system does not run compiled code: {error}", hint='use device="interp", which needs none'
            ) from error
        return CpuProgram(compiled.signature, compiled.width, address, keep, self._pool)

    def _link(self, code: bytes) -> tuple[int, object]:
        """Object code in memory, by LLVM's linker."""
        import llvmlite.binding as binding

        from zeroset.codegen import llvm

        engine = binding.create_lljit_compiler(llvm.machine(self.target))
        builder = binding.JITLibraryBuilder().add_object_img(code).export_symbol(_ENTRY)
        library: Any = builder.link(engine, f"zeroset{id(engine)}")
        return library[_ENTRY], (engine, library)


def host() -> tuple[Target, ...]:
    """The targets that this machine runs, the best first.

    Raises:
        DeviceError: LLVM cannot be loaded.
    """
    try:
        from zeroset.codegen import llvm

        return llvm.host()
    except (ImportError, OSError) as error:
        hint = 'reinstall llvmlite (pip install --force-reinstall "llvmlite>=0.50,<0.51"), or use device="interp"'
        raise DeviceError(f"LLVM, which compiles for the CPU, cannot be loaded: {error}", hint=hint) from error
