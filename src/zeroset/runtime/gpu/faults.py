"""What wgpu raises, as errors of our own: which GPU, what it was doing, and what to do now."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from zeroset.errors import DeviceError, DeviceLostError

CPU_HINT = 'device="cpu" draws the same pictures'
SMALLER_HINT = f"draw a smaller picture; {CPU_HINT}"


class Faults:
    """Turns what wgpu raises into ``DeviceError``, and remembers whether the GPU is gone.

    Args:
        name: of the GPU.

    Attributes:
        lost: whether the GPU was reset, taken away or switched off; what was made on it is of no use any more.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.lost = False

    @contextmanager
    def at(self, doing: str, hint: str = CPU_HINT) -> Iterator[None]:
        """Raise a ``DeviceError`` for what wgpu raises inside.

        Args:
            doing: what the GPU fails at, as a verb with its object.
            hint: what a user can do about it.
        """
        import wgpu

        try:
            yield
        except (wgpu.GPUError, RuntimeError) as error:
            if isinstance(error, DeviceError):
                raise
            raise self._named(doing, error, hint) from error

    def _named(self, doing: str, error: Exception, hint: str) -> DeviceError:
        import wgpu

        if "device is lost" in str(error):
            self.lost = True
            text = f"{self.name} cannot {doing}: it was lost (reset, switched off, or taken away)"
            return DeviceLostError(text, hints=("try again: it is opened anew", CPU_HINT))
        if isinstance(error, wgpu.GPUOutOfMemoryError):
            return DeviceError(f"{self.name} cannot {doing}: it has no more memory", hint=SMALLER_HINT)
        return DeviceError(f"{self.name} cannot {doing}: {first_line(error)}", hint=hint)


def first_line(error: Exception) -> str:
    """What an error of wgpu's is about: the last line of the chain that it prints, which names the cause."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    causes = [line for line in lines if line not in ("Validation Error", "Caused by:") and not line.startswith("In ")]
    return (causes or lines or [type(error).__name__])[0]
