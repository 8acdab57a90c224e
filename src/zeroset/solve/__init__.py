"""Ray meets f = 0: every method written once, on the kernel language and the number systems.

``Method`` and ``resolve_method`` are what the rest of the program uses; ``METHODS`` is the table of all of them, in the
order in which they are listed to users.
"""

from zeroset.solve.certified import Affine, Auto, Interval

from zeroset.solve.analytic import Analytic  # isort: skip
from zeroset.solve.mitchell import Mitchell

from zeroset.solve.exact import MitchellExact  # isort: skip
from zeroset.solve.sampling import AdaptiveMarchingPoints, MarchingPoints

from zeroset.solve.method import METHODS, Method, resolve_method  # isort: skip

__all__ = [
    "METHODS",
    "AdaptiveMarchingPoints",
    "Affine",
    "Analytic",
    "Auto",
    "Interval",
    "MarchingPoints",
    "Method",
    "Mitchell",
    "MitchellExact",
    "resolve_method",
]
