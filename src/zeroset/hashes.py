"""Hashes of texts and bytes: what compiled code, formulas and pictures that are kept go by.

BLAKE2 comes from CPython's own module where there is one. ``hashlib`` gives the same one, but loads all of OpenSSL
first, which takes as long as drawing a small picture does.
"""

from __future__ import annotations

try:
    from _blake2 import blake2b
except ImportError:  # another Python
    from hashlib import blake2b

__all__ = ["SIZE", "blake2b", "digest", "hexdigest"]

SIZE = 32
"""Bytes of a digest: no two contents that anybody ever sees have the same one."""


def digest(data: bytes) -> bytes:
    """The hash of some bytes, 32 bytes.

    Example:
        >>> digest(b"a") == digest(b"b"), len(digest(b""))
        (False, 32)
    """
    return blake2b(data, digest_size=SIZE).digest()


def hexdigest(text: str) -> str:
    """The hash of a text, 64 hexadecimal digits.

    Example:
        >>> hexdigest("x")[:8]
        'd161d711'
    """
    return blake2b(text.encode(errors="surrogateescape"), digest_size=SIZE).hexdigest()
