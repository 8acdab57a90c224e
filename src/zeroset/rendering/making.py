"""The programs of one structure, made side by side while the first of them are already running.

Whoever draws asks for a program by its name and waits only for that one. Kernels are traced one after the other, in
the order in which they were asked for, while the compilers of those before are at work on all cores.

For a first picture most of the time goes into compiling, so programs that run but shortly are made in a hurry. Where
more pictures follow, they are made again in the background, well, and take the quick ones' place when they are there.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from functools import partial

from zeroset.kernel import Kernel
from zeroset.runtime import Device, Program, Recipe
from zeroset.runtime.coming import Coming, side_by_side


class Making:
    """Programs by name: made, being made, or to be made.

    Args:
        device: makes them.
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self._recipes: dict[str, tuple[str, Callable[[], Kernel]]] = {}
        self._programs: dict[str, Program] = {}
        self._coming: dict[str, Coming[Program]] = {}
        self._quick: set[str] = set()
        self._better: dict[str, Coming[Program]] = {}

    def add(self, name: str, key: str, build: Callable[[], Kernel]) -> None:
        """Say how a program is made: the key that it is kept under on disk, and what traces its kernel."""
        self._recipes[name] = key, build

    def __contains__(self, name: str) -> bool:
        return name in self._recipes

    def kernel(self, name: str) -> Kernel:
        """The kernel of a program as it is traced."""
        return self._recipes[name][1]()

    def begin(self, names: Iterable[str], at_once: int, quick: Collection[str] = (), apart: Iterable[str] = ()) -> None:
        """Begin to make what is neither there nor coming.

        Args:
            names: of programs, in the order in which they are traced.
            at_once: how many may be under way.
            quick: those of them that are made in a hurry.
            apart: what another process may make: those of them, and then others that may be asked for later.
        """
        missing = [name for name in names if name not in self._programs and name not in self._coming]
        hurried = set(quick).intersection(missing)
        self._quick |= hurried
        if missing:
            known = [name for name in apart if name in self._recipes]
            now, later = (
                [Recipe(*self._recipes[name], name in quick) for name in known if (name in missing) is wanted]
                for wanted in (True, False)
            )
            self._device.begin_apart(now, later)
        self._coming |= side_by_side({name: partial(self._made, name, name in hurried) for name in missing}, at_once)

    def improve(self) -> None:
        """Begin to make again, one by one, what was made in a hurry."""
        self._better |= side_by_side({name: partial(self._made, name, False) for name in sorted(self._quick)}, 1)
        self._quick.clear()

    def best(self, name: str) -> Program:
        """A program made well; waits for it, or makes it here, where it has only been made in a hurry."""
        if name in self._quick:
            self._quick.discard(name)
            self._programs[name] = self._made(name, False)
        better = self._better.pop(name, None)
        if better is not None:
            self._programs[name] = better.result()
        return self.get(name)

    def pending(self, name: str) -> bool:
        """Whether a program is being made and not there yet."""
        coming = self._coming.get(name)
        return coming is not None and not coming.done()

    def ready(self, name: str) -> bool:
        """Whether a program is there."""
        return name in self._programs or (name in self._coming and self._coming[name].done())

    def get(self, name: str) -> Program:
        """A program; waits for it, or makes it here where nobody has begun."""
        waiting = self._coming.pop(name, None)
        if waiting is not None:
            self._programs[name] = waiting.result()
        elif name not in self._programs:
            self._programs[name] = self._made(name, False)
        better = self._better.get(name)
        if better is not None and better.done():
            del self._better[name]
            self._programs[name] = better.result()
        return self._programs[name]

    def settle(self) -> None:
        """Wait until all that is under way is there, and nothing is left that was made in a hurry."""
        self.improve()
        for better in tuple(self._better.values()):
            better.result()
        for name in (*self._coming, *self._better):
            self.get(name)

    def _made(self, name: str, quick: bool) -> Program:
        return self._device.compile_cached(*self._recipes[name], quick)
