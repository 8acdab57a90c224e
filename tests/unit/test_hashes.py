"""Hashes: the standard library's, whichever module they come from."""

from __future__ import annotations

import hashlib
import subprocess
import sys

from zeroset.hashes import digest, hexdigest


def test_they_are_blake2() -> None:
    assert digest(b"zero set") == hashlib.blake2b(b"zero set", digest_size=32).digest()
    assert hexdigest("\u03c6") == hashlib.blake2b("\u03c6".encode(), digest_size=32).hexdigest()
    assert hexdigest("\udc80") != hexdigest("\udc81")


def test_a_picture_loads_no_openssl() -> None:
    drawn = "zs.render('x^2 + y^2 + z^2 = 1', 16, device='cpu').png()"
    code = f"import sys, zeroset as zs; {drawn}; print('_hashlib' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "False", said.stdout
