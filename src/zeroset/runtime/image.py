"""Object code as an image that runs wherever it is put, and putting it there.

Kernels call nothing and refer only to their own constants, relative to the code. So their ELF object can be laid out
once, with every reference resolved, and a later process only copies it into executable memory: no linker, no LLVM.
That saves a warm start the loading of LLVM, the largest part of it. Linux on x86-64 only; elsewhere, and for an object
with anything unexpected in it, LLVM's own linker does the work.

Reference: Tool Interface Standard, Executable and Linking Format; System V ABI, AMD64 supplement, section 4.4.
"""

from __future__ import annotations

import ctypes
import mmap
import os
import struct
import sys
from typing import NamedTuple

_PROGBITS, _SYMTAB, _RELA = 1, 2, 4
_ALLOCATED = 0x2
_PC32, _PLT32 = 2, 4
_PAGE = 4096


class _Section(NamedTuple):
    kind: int
    flags: int
    offset: int
    size: int
    link: int
    info: int
    align: int


def can_place() -> bool:
    """Whether this system runs images."""
    return sys.platform == "linux" and os.uname().machine == "x86_64"


def link(code: bytes, symbol: str) -> bytes | None:
    """Lay out an x86-64 ELF object as an image; its first 8 bytes say where ``symbol`` is.

    Returns:
        None where the object refers to anything outside itself, or is of another kind.
    """
    try:
        return _link(code, symbol.encode())
    except (struct.error, IndexError, ValueError):
        return None


def _link(code: bytes, symbol: bytes) -> bytes | None:
    if code[:6] != b"\x7fELF\x02\x01" or struct.unpack_from("<H", code, 18) != (62,):
        return None
    (table,) = struct.unpack_from("<Q", code, 40)
    size, count = struct.unpack_from("<HH", code, 58)
    sections = [_section(code, table + i * size) for i in range(count)]
    image, places = _lay_out(code, sections)
    symbols = _symbols(code, sections, places)
    for section in sections:
        if section.kind == _RELA and section.info in places and not _resolve(code, section, places, symbols, image):
            return None
    entry = next((at for name, at in symbols if name == symbol and at is not None), None)
    if entry is None:
        return None
    struct.pack_into("<Q", image, 0, entry)
    return bytes(image)


def _section(code: bytes, at: int) -> _Section:
    _, kind, flags, _, offset, size, link_, info, align, _ = struct.unpack_from("<IIQQQQIIQQ", code, at)
    return _Section(kind, flags, offset, size, link_, info, align)


def _lay_out(code: bytes, sections: list[_Section]) -> tuple[bytearray, dict[int, int]]:
    """The sections that are loaded, one after the other, and where each begins."""
    image, places = bytearray(8), {}
    for i, section in enumerate(sections):
        if not section.flags & _ALLOCATED:
            continue
        if section.kind != _PROGBITS:
            raise ValueError("a section that is not plain data")
        image.extend(bytes(-len(image) % max(section.align, 1)))
        places[i] = len(image)
        image.extend(code[section.offset : section.offset + section.size])
    return image, places


def _symbols(code: bytes, sections: list[_Section], places: dict[int, int]) -> list[tuple[bytes, int | None]]:
    """Name and place of every symbol; None for those that are not in the image."""
    found: list[tuple[bytes, int | None]] = []
    for section in sections:
        if section.kind != _SYMTAB:
            continue
        names = sections[section.link].offset
        for at in range(section.offset, section.offset + section.size, 24):
            name, _, _, where, value, _ = struct.unpack_from("<IBBHQQ", code, at)
            text = code[names + name : code.index(b"\0", names + name)]
            found.append((text, places[where] + value if where in places else None))
    return found


def _resolve(
    code: bytes,
    section: _Section,
    places: dict[int, int],
    symbols: list[tuple[bytes, int | None]],
    image: bytearray,
) -> bool:
    for at in range(section.offset, section.offset + section.size, 24):
        offset, info, addend = struct.unpack_from("<QQq", code, at)
        target = symbols[info >> 32][1]
        if info & 0xFFFFFFFF not in (_PC32, _PLT32) or target is None:
            return False
        place = places[section.info] + offset
        struct.pack_into("<i", image, place, target + addend - place)
    return True


def place(image: bytes) -> tuple[int, object]:
    """Put an image into executable memory.

    Returns:
        The address of its entry, and what must be kept for as long as that is used.

    Raises:
        OSError: the system forbids executable memory.
    """
    memory = mmap.mmap(-1, -(-len(image) // _PAGE) * _PAGE, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    memory.write(image)
    start = ctypes.addressof(ctypes.c_char.from_buffer(memory))
    library = ctypes.CDLL(None, use_errno=True)
    protect = library.mprotect
    protect.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]
    if protect(start, len(memory), mmap.PROT_READ | mmap.PROT_EXEC):
        raise OSError(ctypes.get_errno(), "executable memory is forbidden here")
    return start + int.from_bytes(image[:8], "little"), memory
