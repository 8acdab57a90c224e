"""The programs that a device has made: in memory, on disk, or to be made; the same for every device that compiles.

Nothing is held while kernels are traced and compiled: several may be under way at once, and where two threads make the
same program the first one stays.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from zeroset.kernel.build import Kernel
from zeroset.runtime.cache import Cache
from zeroset.runtime.compiled import Compiled

P = TypeVar("P")
_IN_MEMORY = 256
"""Programs that a device remembers; older ones live as long as somebody holds them."""


class Programs(Generic[P]):
    """Programs by kernel and by key.

    Args:
        cache: the disk.
        stamp: what compiled code depends on besides its kernel.
        translate: makes code of a kernel.
        place: makes a program of code.
    """

    def __init__(
        self, cache: Cache, stamp: str, translate: Callable[[Kernel], Compiled], place: Callable[[Compiled], P]
    ) -> None:
        self._cache = cache
        self._stamp = stamp
        self._translate = translate
        self._place = place
        self._made: dict[str, P] = {}
        self._busy = threading.Lock()

    def of(self, kernel: Kernel) -> P:
        """The program of a kernel."""
        known = self._known(kernel.digest) or self._recall(kernel.digest)
        if known is None:
            compiled = self._translate(kernel)
            self._cache.put(f"{kernel.digest}|{self._stamp}", compiled)
            known = self._place(compiled)
        return self._remember(kernel.digest, known)

    def under(self, key: str, build: Callable[[], Kernel]) -> P:
        """The program under a key; ``build`` traces its kernel where no program is known there."""
        name = f"key {key}"
        known = self._known(name)
        if known is None:
            digest = self._cache.follow(f"{name}|{self._stamp}")
            known = None if digest is None else self._known(digest) or self._recall(digest)
        if known is None:
            kernel = build()
            known = self.of(kernel)
            self._cache.link(f"{name}|{self._stamp}", kernel.digest)
        return self._remember(name, known)

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

    def _recall(self, digest: str) -> P | None:
        compiled = self._cache.get(f"{digest}|{self._stamp}")
        return None if compiled is None else self._place(compiled)
