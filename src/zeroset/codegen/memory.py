"""Loads, stores and atomics of W lanes at once.

A uniform index is one scalar access. The dispatch index itself, or it plus something uniform, is one vector access;
any other index is a gather or scatter. Where packets read one stretch of a buffer after the other, what those to come
will read is asked for in time: a frame's arrays are too long for the near caches, and a packet's first load waited for
memory a tenth of a pass. Whatever the lanes that are not active hold as an index, they touch no memory
that is not the buffer's: vector accesses carry the mask, and a gather reads the first element for them. Indices are
signed 32-bit, so a buffer holds fewer than 2^31 elements.
"""

from __future__ import annotations

from zeroset.codegen.writer import SCALARS, Writer, is_constant, literal_text
from zeroset.kernel.types import Buffer
from zeroset.kernel.value import Instruction, Value

_AHEAD = 256
"""Bytes by which a load's place is ahead of what is being read when it is asked for: a few packets' time."""
_COMBINE = {
    "atomic_add": {"i": "add", "u": "add"},
    "atomic_min": {"i": "min", "u": "umin"},
    "atomic_max": {"i": "max", "u": "umax"},
}


class Memory:
    """The buffers of the function being written; ``used`` holds the ids of the values that something reads."""

    def __init__(self, writer: Writer, buffers: tuple[Buffer, ...], used: frozenset[int]) -> None:
        self.writer = writer
        self.used = used
        self.pointers = {buffer.name: f"%buffer{i}" for i, buffer in enumerate(buffers)}
        self.types = {buffer.name: buffer.type for buffer in buffers}
        self.writable = {buffer.name: buffer.writable for buffer in buffers}

    def load(self, instruction: Instruction) -> None:
        """Write a load; lanes that are not active get zero."""
        writer, name = self.writer, instruction.attributes[0]
        (index,), (result,) = instruction.operands, instruction.results
        type_ = self.types[name]
        if not writer.is_varying(result):
            text = writer.assign(f"load {SCALARS[type_.name]}, ptr {self._place(name, index)}, align {type_.size}")
        elif (start := self._contiguous(index)) is not None:
            place = self._start(name, start)
            if not self._beside(index):
                self._ask_for(place)
            text = self._masked("load", name, ("ptr", place))
        elif (shared := self._shared(index)) is not None:
            text = self._load_shared(name, index, shared)
        else:
            text = self._gather(name, index)
        writer.define(result, text)

    def store(self, instruction: Instruction) -> None:
        """Write a store of the active lanes."""
        writer, name = self.writer, instruction.attributes[0]
        index, value = instruction.operands
        start = self._contiguous(index)
        if start is not None:
            self._store_row(name, self._start(name, start), writer.vector(value))
        else:
            self._masked("scatter", name, (f"<{writer.width} x ptr>", self._places(name, index)), writer.vector(value))

    def _beside(self, index: Value) -> bool:
        """Whether an index is some lanes away from another that will have been read, or soon is: a constant of them."""
        definition = index.definition
        while definition is not None and definition.op in ("add", "sub"):
            a, b = definition.operands
            if is_constant(a) or is_constant(b):
                return True
            definition = (a if self.writer.is_varying(a) else b).definition
        return False

    def _ask_for(self, place: str) -> None:
        """Fetch what lies ahead of a place into the caches; past a buffer's end that does nothing."""
        writer = self.writer
        writer.declarations.add("declare void @llvm.prefetch.p0(ptr, i32, i32, i32)")
        ahead = writer.assign(f"getelementptr i8, ptr {place}, i64 {_AHEAD}")
        writer.line(f"call void @llvm.prefetch.p0(ptr {ahead}, i32 0, i32 3, i32 1)")

    def _gather(self, name: str, index: Value) -> str:
        """One load a lane; those that are not active read the first element, which is there if any is.

        Processors gather hardly faster than they load, and a load that must not be done costs a branch in each lane.
        """
        writer, type_ = self.writer, self.types[name]
        vector, pointers = writer.vectors[type_.name], f"<{writer.width} x ptr>"
        intrinsic = f"llvm.masked.gather.{writer.suffix(type_, True)}.v{writer.width}p0"
        writer.declarations.add(f"declare {vector} @{intrinsic}({pointers}, {writer.bits_type}, {vector})")
        lanes = f"<{writer.width} x i32>"
        safe = writer.choose(writer.mask, index.type, writer.vector(index), "zeroinitializer")
        places = writer.assign(f"getelementptr {SCALARS[type_.name]}, ptr {self.pointers[name]}, {lanes} {safe}")
        everywhere = f"{writer.bits_type} splat (i1 true)"
        aligned = f"{pointers} align {type_.size} {places}"
        return writer.assign(f"call {vector} @{intrinsic}({aligned}, {everywhere}, {vector} zeroinitializer)")

    def _shared(self, index: Value) -> tuple[str, str] | None:
        """The first and the last lane's index where lanes in a row share one each 2^k, no fewer than there are lanes:
        mostly it is the same for all of them."""
        definition = index.definition
        if definition is None or definition.op != "shr" or index.type.kind != "u":
            return None
        row, by = definition.operands
        if by.definition is None or not is_constant(by):
            return None
        writer, shift = self.writer, literal_text(by.definition)
        start = self._contiguous(row) if writer.width <= 1 << int(shift) else None
        if start is None:
            return None
        end = writer.assign(f"add i32 {start}, {writer.width - 1}")
        return writer.assign(f"lshr i32 {start}, {shift}"), writer.assign(f"lshr i32 {end}, {shift}")

    def _load_shared(self, name: str, index: Value, ends: tuple[str, str]) -> str:
        """One load for all lanes where they share the index, else a gather."""
        writer, type_ = self.writer, self.types[name]
        vector, scalar = writer.vectors[type_.name], SCALARS[type_.name]
        one, each, done = (writer.fresh(label) for label in ("one", "each", "done"))
        writer.branch(writer.assign(f"icmp eq i32 {ends[0]}, {ends[1]}"), one, each)
        writer.label(one)
        # Some lane is active where code runs, and its place is in range.
        number = writer.assign(f"load {scalar}, ptr {self._start(name, ends[0])}, align {type_.size}")
        first = writer.assign(f"insertelement {vector} poison, {scalar} {number}, i64 0")
        lanes = f"<{writer.width} x i32>"
        all_ = writer.assign(f"shufflevector {vector} {first}, {vector} poison, {lanes} zeroinitializer")
        writer.jump(done)
        writer.label(each)
        gathered = self._gather(name, index)
        writer.jump(done)
        writer.label(done)
        return writer.assign(f"phi {vector} [ {all_}, %{one} ], [ {gathered}, %{each} ]")

    def _store_row(self, name: str, place: str, value: str) -> None:
        """Store to places in a row; all lanes at once where all are active, for a masked store takes ten times as long
        on some CPUs."""
        writer, type_ = self.writer, self.types[name]
        every = writer.every(writer.mask)
        whole, part, done = (writer.fresh(label) for label in ("whole", "part", "done"))
        writer.branch(every, whole, part)
        writer.label(whole)
        writer.line(f"store {writer.vectors[type_.name]} {value}, ptr {place}, align {type_.size}")
        writer.jump(done)
        writer.label(part)
        self._masked("store", name, ("ptr", place), value)
        writer.jump(done)
        writer.label(done)

    def _masked(self, what: str, name: str, place: tuple[str, str], value: str | None = None) -> str:
        """One of LLVM's masked intrinsics; a store gives back nothing worth reading."""
        writer, type_ = self.writer, self.types[name]
        vector, bits = writer.vectors[type_.name], writer.bits(writer.mask)
        pointer = f"v{writer.width}p0" if place[0] != "ptr" else "p0"
        intrinsic = f"llvm.masked.{what}.{writer.suffix(type_, True)}.{pointer}"
        aligned = f"{place[0]} align {type_.size} {place[1]}"
        if value is None:
            writer.declarations.add(f"declare {vector} @{intrinsic}({place[0]}, {writer.bits_type}, {vector})")
            otherwise = f"{vector} zeroinitializer"
            return writer.assign(f"call {vector} @{intrinsic}({aligned}, {writer.bits_type} {bits}, {otherwise})")
        writer.declarations.add(f"declare void @{intrinsic}({vector}, {place[0]}, {writer.bits_type})")
        writer.line(f"call void @{intrinsic}({vector} {value}, {aligned}, {writer.bits_type} {bits})")
        return ""

    def _place(self, name: str, index: Value) -> str:
        return self._start(name, self.writer.scalar(index))

    def _start(self, name: str, index: str) -> str:
        scalar = SCALARS[self.types[name].name]
        return self.writer.assign(f"getelementptr {scalar}, ptr {self.pointers[name]}, i32 {index}")

    def _places(self, name: str, index: Value) -> str:
        scalar = SCALARS[self.types[name].name]
        lanes = f"<{self.writer.width} x i32> {self.writer.vector(index)}"
        return self.writer.assign(f"getelementptr {scalar}, ptr {self.pointers[name]}, {lanes}")

    def _contiguous(self, index: Value) -> str | None:
        """The first lane's index where the lanes' indices follow one another, else None."""
        definition = index.definition
        if definition is None:
            return None
        if definition.op == "index":
            return "%packet"
        if definition.op in ("convert", "bitcast") and definition.operands[0].type.kind in "iu":
            return self._contiguous(definition.operands[0])
        if definition.op not in ("add", "sub"):
            return None
        a, b = definition.operands
        if definition.op == "add" and not self.writer.is_varying(a):
            a, b = b, a
        if self.writer.is_varying(b):
            return None
        start = self._contiguous(a)
        return None if start is None else self.writer.assign(f"{definition.op} i32 {start}, {self.writer.scalar(b)}")

    def atomic(self, instruction: Instruction) -> None:
        """Write an atomic: lanes take their turns in order, first lane first."""
        if instruction.op == "atomic_add" and not self.writer.is_varying(instruction.operands[0]):
            self._add_together(instruction)
        else:
            self._one_by_one(instruction)

    def _add_together(self, instruction: Instruction) -> None:
        """All lanes add to one element: add their sum, and give each what was there plus the lanes before it."""
        writer, width = self.writer, self.writer.width
        index, value = instruction.operands
        (result,) = instruction.results
        lanes = f"<{width} x i32>"
        added = writer.choose(writer.mask, value.type, writer.vector(value), "zeroinitializer")
        total = writer.call(f"llvm.vector.reduce.add.v{width}i32", "i32", (lanes, added))
        place = self._place(instruction.attributes[0], index)
        was = writer.assign(f"atomicrmw add ptr {place}, i32 {total} monotonic, align 4")
        if id(result) not in self.used:
            return
        upto, step = added, 1
        while step < width:
            picks = ", ".join(f"i32 {width if lane < step else lane - step}" for lane in range(width))
            moved = writer.assign(f"shufflevector {lanes} {upto}, {lanes} zeroinitializer, <{width} x i32> <{picks}>")
            upto = writer.assign(f"add {lanes} {upto}, {moved}")
            step *= 2
        before = writer.assign(f"sub {lanes} {upto}, {added}")
        writer.define(result, writer.assign(f"add {lanes} {before}, {writer.everywhere(was)}"))

    def _one_by_one(self, instruction: Instruction) -> None:
        """A loop over the active lanes, one ``atomicrmw`` each."""
        writer, name = self.writer, instruction.attributes[0]
        index, value = instruction.operands
        (result,) = instruction.results
        operation = _COMBINE[instruction.op][result.type.kind]
        width, lanes = writer.width, f"<{writer.width} x i32>"
        indices, values = writer.vector(index), writer.vector(value)
        packed = writer.assign(f"bitcast {writer.bits_type} {writer.bits(writer.mask)} to i{width}")
        todo = writer.assign(f"zext i{width} {packed} to i32")
        before, loop, after = writer.block, writer.fresh("lanes"), writer.fresh("done")
        left, given, rest, old = (f"%{writer.fresh()}" for _ in range(4))
        # Some lane is always active where code runs, so the loop may test at its end.
        writer.jump(loop)
        writer.label(loop)
        writer.line(f"{left} = phi i32 [ {todo}, %{before} ], [ {rest}, %{loop} ]")
        writer.line(f"{given} = phi {lanes} [ zeroinitializer, %{before} ], [ {old}, %{loop} ]")
        lane = writer.call("llvm.cttz.i32", "i32", ("i32", left), ("i1", "true"))
        at = writer.assign(f"extractelement {lanes} {indices}, i32 {lane}")
        what = writer.assign(f"extractelement {lanes} {values}, i32 {lane}")
        place = self._start(name, at)
        was = writer.assign(f"atomicrmw {operation} ptr {place}, i32 {what} monotonic, align 4")
        writer.line(f"{old} = insertelement {lanes} {given}, i32 {was}, i32 {lane}")
        less = writer.assign(f"sub i32 {left}, 1")
        writer.line(f"{rest} = and i32 {left}, {less}")
        writer.branch(writer.assign(f"icmp eq i32 {rest}, 0"), after, loop)
        writer.label(after)
        writer.define(result, old)
