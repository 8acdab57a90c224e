"""Marching tetrahedra on every device.

In reading order: `lattice` (where f is sampled), `tetrahedra` (the table of cases), `solid` (f and the bounds inside
kernels), `exclude`, `passes` and `roots` (the kernels), `programs` (compiled for one surface), `extract` (the passes in
order, slab by slab), `weld` and `rim` (from the kernels' pieces to clean triangles), `timing` (for benchmarks).
"""
