"""The three ways a ray can end, as numbers: public in ``zeroset`` and stored in every G-buffer."""

from __future__ import annotations

MISS, HIT, UNRESOLVED = 0, 1, 2
