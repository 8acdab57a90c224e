"""What is seen where nothing is hit: one colour, or a cube map looked up by direction.

A cube map has six square faces, +x -x +y -y +z -z, seen from the inside; ``scene.environment`` makes them of pictures
and of the built-in sky and room. The colour between texels is the bilinear mean within a face.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from zeroset.kernel import F32, U32, Buffer, Value, load

Color = tuple[Value, Value, Value]


def cube_color(texels: Buffer, side: Value, direction: Sequence[Value]) -> Color:
    """The colour of a direction.

    Args:
        texels: linear RGB, three numbers a texel, rows from the top, faces in order.
        side: texels along a face, u32.
        direction: of any length but 0.
    """
    x, y, z = direction
    ax, ay, az = abs(x), abs(y), abs(z)
    across = (ax >= ay) & (ax >= az)
    deep = ~across & (ay >= az)
    major = across.select(x, deep.select(y, z))
    size = 1.0 / abs(major).maximum(1e-30)
    # Coordinates on the face, -1 to 1: across y x x, up z z y.
    u = across.select(y, x) * size
    v = across.select(z, deep.select(z, y)) * size
    axis = across.select(0.0, deep.select(2.0, 4.0))
    face = (major < 0.0).select(axis + 1.0, axis)
    return _bilinear(texels, side, face.convert(U32), u, v)


def _bilinear(texels: Buffer, side: Value, face: Value, u: Value, v: Value) -> Color:
    n = side.convert(F32)
    column, row = (u * 0.5 + 0.5) * n - 0.5, (0.5 - v * 0.5) * n - 0.5
    column, row = (p.maximum(0.0).minimum(n - 1.0) for p in (column, row))
    left, top = column.floor(), row.floor()
    right, bottom = (left + 1.0).minimum(n - 1.0), (top + 1.0).minimum(n - 1.0)
    fx, fy = column - left, row - top

    def texel(at_row: Value, at_column: Value) -> list[Value]:
        place = ((face * side + at_row.convert(U32)) * side + at_column.convert(U32)) * 3
        return [load(texels, place + i) for i in range(3)]

    corners = [texel(r, c) for r in (top, bottom) for c in (left, right)]
    mixed = []
    for a, b, c, d in zip(*corners, strict=True):
        upper, lower = fx.fma(b - a, a), fx.fma(d - c, c)
        mixed.append(fy.fma(lower - upper, upper))
    return mixed[0], mixed[1], mixed[2]


Environment = Callable[[Sequence[Value]], Color]
"""Gives the colour of a direction."""
