"""What leaves zeroset as something else than a picture.

`mesh` (the way to triangles), with `marching/` (how they are found), `triangles` (what they are) and `mesh_files` (how
they are written). `animate` (the way to movies), with `film/` (how they are made).
"""
