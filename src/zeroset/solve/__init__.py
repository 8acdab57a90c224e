"""Ray meets f = 0: every method written once, on the kernel language and the number systems.

``Method`` and ``resolve_method`` are what the rest of the program uses; ``METHODS`` is the table of all of them.
"""

from zeroset.solve.method import METHODS, Method, resolve_method

__all__ = ["METHODS", "Method", "resolve_method"]
