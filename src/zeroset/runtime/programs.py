"""The programs that a device has made: in memory, on disk, or to be made; the same for every device that compiles.

Several may be under way at once. Kernels are traced and written one at a time, for Python does one thing at a time
anyway: so the first is with its compiler while the second is being traced, instead of all being half done. Where two
threads make the same program the first one stays.

A program may be asked for in a hurry: what it costs to compile then counts more than how fast it runs. Whoever asks so
is given the good one where it is there already; the quick one is kept under a name of its own.

A twin of this process may make some of them, where there is a disk on which it can leave them.
"""

from __future__ import annotations

import contextlib
import gc
import threading
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, Generic, TypeVar

from zeroset.kernel.build import Kernel
from zeroset.runtime import twin
from zeroset.runtime.cache import Cache
from zeroset.runtime.compiled import Compiled
from zeroset.runtime.device import Recipe

P = TypeVar("P")
_QUICK = " quick"
_IN_MEMORY = 256
"""Programs that a device remembers; older ones live as long as somebody holds them."""


class Programs(Generic[P]):
    """Programs by kernel and by key.

    Args:
        cache: the disk.
        stamp: what compiled code depends on besides its kernel.
        write: makes the text of a kernel that the target's compiler takes.
        translate: makes code of a kernel's text, in a hurry or not.
        place: makes a program of code.
    """

    def __init__(
        self,
        cache: Cache,
        stamp: str,
        write: Callable[[Kernel], Any],
        translate: Callable[[Kernel, Any, bool], Compiled],
        place: Callable[[Compiled], P],
    ) -> None:
        self._cache = cache
        self._stamp = stamp
        self._write = write
        self._translate = translate
        self._place = place
        self._made: dict[str, P] = {}
        self._twin: twin.Twin | None = None
        self._busy = threading.Lock()
        # A semaphore lets in who came first; a lock lets in anybody.
        self._writing = threading.Semaphore()

    def of(self, kernel: Kernel) -> P:
        """The program of a kernel."""
        return self._of(lambda: kernel, "")[0]

    def under(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> P:
        """The program under a key; ``build`` traces its kernel where no program is known there."""
        if self._twin is not None:
            self._twin.wait(key)
        for variant in _variants(quick):
            name = _named(key, variant)
            known = self._known(name) or self._follow(name, variant)
            if known is not None:
                return self._remember(name, known)
        known, digest = self._of(build, variant)
        self._cache.link(f"{name}|{self._stamp}", digest)
        return self._remember(name, known)

    def begin_apart(self, recipes: Iterable[Recipe], perhaps: Iterable[Recipe] = ()) -> None:
        """Have a twin make what is neither in memory nor on disk, where there can be one; ``under`` waits for it.

        Args:
            recipes: what will be asked for.
            perhaps: what may be: no reason to have a twin, but made when it has nothing else to do.
        """
        if self._twin is not None or not self._cache.usable or not twin.possible():
            return
        work, later = (
            {r.key: partial(self.under, *r) for r in some if not self._has(r.key, r.quick)}
            for some in (recipes, perhaps)
        )
        if work:
            # Where the system allows no further process, everything is made here.
            with contextlib.suppress(OSError):
                self._twin = twin.Twin(work, later)

    def _has(self, key: str, quick: bool) -> bool:
        """Whether a program is known under a key."""
        names = [_named(key, variant) for variant in _variants(quick)]
        return any(self._known(name) or self._cache.follow(f"{name}|{self._stamp}") for name in names)

    def _follow(self, name: str, variant: str) -> P | None:
        digest = self._cache.follow(f"{name}|{self._stamp}")
        return None if digest is None else self._recall(digest + variant)

    def _of(self, build: Callable[[], Kernel], variant: str) -> tuple[P, str]:
        """The program of the kernel that ``build`` traces, and the kernel's digest."""
        with self._writing, _collecting_later():
            kernel = build()
            name = kernel.digest + variant
            known = self._recall(name)
            text = None if known is not None else self._write(kernel)
        if known is None:
            compiled = self._translate(kernel, text, variant == _QUICK)
            self._cache.put(f"{name}|{self._stamp}", compiled)
            known = self._place(compiled)
        return self._remember(name, known), kernel.digest

    def _known(self, name: str) -> P | None:
        with self._busy:
            return self._made.get(name)

    def _remember(self, name: str, program: P) -> P:
        with self._busy:
            program = self._made.pop(name, program)
            self._made[name] = program
            while len(self._made) > _IN_MEMORY:
                del self._made[next(iter(self._made))]
        return program

    def _recall(self, name: str) -> P | None:
        """A program by its kernel's digest, from memory or from disk."""
        known = self._known(name)
        if known is not None:
            return known
        compiled = self._cache.get(f"{name}|{self._stamp}")
        return None if compiled is None else self._place(compiled)


@contextlib.contextmanager
def _collecting_later() -> Iterator[None]:
    """No search for garbage in here: a kernel is ten thousands of objects, all in use, which would start many."""
    wanted = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        # Of several threads in here, each with a device of its own, those that found it enabled enable it again.
        if wanted:
            gc.enable()


def _variants(quick: bool) -> tuple[str, ...]:
    """The variants of a program that will do, the best first."""
    return ("", _QUICK) if quick else ("",)


def _named(key: str, variant: str) -> str:
    return f"key {key}{variant}"
