"""Draws all golden pictures anew."""

from tests.golden import goldens

for golden in goldens():
    print(golden.draw().save(golden.path))
