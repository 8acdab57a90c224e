"""How arguments reach compiled code: an array of 8-byte slots, buffers' addresses first, then uniforms.

A uniform lies in the first bytes of its slot, in its own type. The writer of the code and the caller of it agree on
nothing else, and share nothing but this page.
"""

from __future__ import annotations

from zeroset.kernel.types import Uniform

_CODES = {"f32": "f4x", "f64": "d", "i32": "i4x", "u32": "I4x", "bool": "?7x"}


def slot_layout(uniforms: tuple[Uniform, ...], buffers: int) -> str:
    """The slots as a format of the module ``struct``."""
    return "=" + "Q" * buffers + "".join(_CODES[u.type.name] for u in uniforms)
