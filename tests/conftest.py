"""What every test shares: a cache folder of its own, so that no test reads or writes the user's."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile

if "ZEROSET_CACHE_DIR" not in os.environ:
    os.environ["ZEROSET_CACHE_DIR"] = tempfile.mkdtemp(prefix="zeroset-tests-")
    atexit.register(shutil.rmtree, os.environ["ZEROSET_CACHE_DIR"], ignore_errors=True)
