"""The buffers of a frame by name and type: the G-buffer, and the lists that passes make for later ones."""

from __future__ import annotations

from typing import NamedTuple

from zeroset.kernel.types import F32, U32, Type

NORMAL = ("nx", "ny", "nz")
FIELDS: dict[str, Type] = {"t": F32, "nx": F32, "ny": F32, "nz": F32, "status": U32, "steps": U32}
"""The G-buffer's arrays, one element a ray."""
PART = "part"
"""Which part was met; only where a shape has more than one."""
SECOND = {"second_lane": U32, "second_clear": F32}
"""Rays left unresolved: which, and from where on."""
FROM, ONWARD = "from", "onward"
"""Where the search for a ray's next layer starts, and where the one after it will."""
FORMER = "former_status"
"""The status of a ray's last layer."""
NOTHING = -1e30
"""Where it starts along a ray on which nothing was found yet: before every bounds."""
EMPTY_TILE = 1e30
"""Start of the rays of a tile that its beam has shown to be empty: beyond every bounds."""
OPEN = "block_open"
"""For blocks of 4x4 pixels: whether one of its rays has gone on for long where its tile's beam has ended."""


IN_TILES, IN_BLOCKS, IN_QUARTERS, IN_PIXELS, IN_PARTS = 0, 1, 2, 3, 4
"""What beams are traced through (``cells``): values of the uniform ``level``."""


class CellList(NamedTuple):
    """A list of cells that may hold something thinner than a pixel.

    Attributes:
        counter: where its length is counted.
        lanes: the buffer of their first pixels.
        reach: the buffer of where the first such thing may be.
    """

    counter: int
    lanes: str
    reach: str


THIN = {"block": CellList(1, "thin_block", "block_reach"), "quarter": CellList(2, "thin_quarter", "quarter_reach")}
"""The lists of blocks, and of quarters of blocks."""
THIN_PIXEL = "thin_pixel"
"""The list of pixels that may hold such a thing."""
THIN_REACH = "thin_reach"
"""Where it may be, seen as a whole."""
PARTS = {"thin_left": U32, "thin_parts": U32}
"""Places on that list: of pixels that f32 has left parts of; and for each place which parts of its pixel, as bits."""
COUNTERS = "counters"
"""How long the lists are: the second look's; of blocks, quarters and pixels with thin parts; and with parts left."""
LISTS = 5
"""How many lists are counted."""
CLEAR, END = "clear", "end"
"""Up to where a ray met nothing, and where what it met is behind it; for frames whose rays go on."""
Ends = tuple[str, ...]
"""Which of these two a frame has."""
STACK = "stack"
"""Rays that wait for their turn, of each lane its own."""
STACK_WORDS = 9
"""Words of one of them: origin, direction, start, weight, and how many surfaces it may still meet."""
EDGES = "edges"
"""The pixels that many rays are to be traced for."""
LIGHTS = "light_data"
"""The lights' places and colours."""
LIGHT_WORDS = 8
"""Numbers of a light: its place, or a vector towards it; which of the two; colour; one over the vector's length."""
TEXELS = "texels"
"""The environment's cube map."""
LIT = "lit"
"""Which lights reach a pixel's point, a bit each."""
VALUE = "value"
"""The quantity that the surface is coloured by, one element a ray."""
COLORS = "colors"
"""The colour map, and the colour of points without a value."""
PICTURE = "rgba"
"""The picture, packed bytes in rows."""
BLOCK = 16
"""Pixels in a block of 4x4."""
MATERIALS = "materials"
"""The numbers of every part's material, where there is more than one part."""


def fields(parts: int) -> dict[str, Type]:
    """The G-buffer's arrays for a shape of so many parts."""
    return FIELDS if parts == 1 else FIELDS | {PART: U32}
