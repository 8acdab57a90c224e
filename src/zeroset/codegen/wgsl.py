"""Kernel to WGSL: one compute shader whose invocations are the kernel's lanes.

Control flow is structured on both sides, so a loop becomes a loop and a branch a branch; carried values are variables,
everything else is a ``let``, named in the order of its making. Lanes past the dispatch's count leave at once. How many
there are, and the uniforms, come in one struct, whose first four words are also what an indirect dispatch reads: an
earlier pass may have written them.
"""

from __future__ import annotations

from zeroset.codegen.gpu_target import CONSTANT_BYTES, GpuTarget
from zeroset.codegen.legalise import legalise
from zeroset.codegen.wgsl_operations import EXPRESSIONS, literal
from zeroset.kernel.build import Kernel
from zeroset.kernel.passes.rewriter import regions_of
from zeroset.kernel.types import BOOL, U32, Buffer
from zeroset.kernel.value import Block, Instruction, Value

GROUP = 0
"""The bind group: the uniforms at binding 0, the buffers in the kernel's order from 1."""


def to_wgsl(kernel: Kernel, target: GpuTarget) -> str:
    """The WGSL of a verified kernel.

    Example:
        >>> from zeroset.kernel import F32, KernelBuilder, store
        >>> with KernelBuilder("fill") as k:
        ...     store(k.buffer("x", F32, writable=True), k.index(), k.uniform("value", F32))
        >>> print(to_wgsl(k.kernel, GpuTarget()).splitlines()[-2].strip())
        x_[lane] = call.value_;
    """
    return _Shader(legalise(kernel, target), target).text()


class _Shader:
    """One kernel being written."""

    def __init__(self, kernel: Kernel, target: GpuTarget) -> None:
        self.kernel = kernel
        self.target = target
        self.names: dict[int, str] = {}
        self.literals: set[int] = set()
        self.lines: list[str] = []
        self.depth = 1
        self.made = 0
        instructions = [i for block in regions_of(kernel) for i in block.instructions]
        self.atomic = {i.attributes[0] for i in instructions if i.op.startswith("atomic_")}
        self.constant = {b.name: 16 // b.type.size for b in kernel.buffers if b.name in target.constant(kernel.buffers)}
        self.votes = target.subgroups and any(i.op == "any" for i in instructions)
        self.handlers = {
            "const": self._const,
            "uniform": self._uniform,
            "index": self._index,
            "any": self._any,
            "load": self._load,
            "store": self._store,
            "while": self._while,
            "for": self._for,
            "if": self._if,
        }

    # ------------------------------------------------------------ the whole

    def text(self) -> str:
        """The shader."""
        self.block(self.kernel.body)
        size = self.target.workgroup
        head = [
            f"// {self.kernel.name}: one invocation a lane",
            "struct Call {",
            "    groups: vec3<u32>,",
            "    count: u32,",
            *(f"    {_safe(u.name)}: {U32 if u.type == BOOL else u.type}," for u in self.kernel.uniforms),
            "}",
            f"@group({GROUP}) @binding(0) var<uniform> call: Call;",
            *(self._declaration(i + 1, buffer) for i, buffer in enumerate(self.kernel.buffers)),
            f"@compute @workgroup_size({size})",
            "fn main(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {",
            f"    let lane = at.y * (groups.x * {size}u) + at.x;",
            "    if (lane >= call.count) { return; }",
        ]
        return "\n".join([*head, *self.lines, "}"]) + "\n"

    def _declaration(self, binding: int, buffer: Buffer) -> str:
        access = "read_write" if buffer.writable else "read"
        element = f"atomic<{buffer.type}>" if buffer.name in self.atomic else str(buffer.type)
        name = _safe(buffer.name)
        if buffer.name in self.constant:
            # Rows of 16 bytes are how WGSL lays constants out.
            row = f"vec{self.constant[buffer.name]}<{buffer.type}>"
            return f"@group({GROUP}) @binding({binding}) var<uniform> {name}: array<{row}, {CONSTANT_BYTES // 16}>;"
        return f"@group({GROUP}) @binding({binding}) var<storage, {access}> {name}: array<{element}>;"

    # ----------------------------------------------------- names and lines

    def line(self, text: str) -> None:
        self.lines.append("    " * self.depth + text)

    def fresh(self, letter: str = "v") -> str:
        self.made += 1
        return f"{letter}{self.made}"

    def name(self, value: Value) -> str:
        return self.names[id(value)]

    def let(self, value: Value, expression: str) -> None:
        """A new name for what an expression gives."""
        made = self.fresh()
        self.names[id(value)] = made
        self.line(f"let {made} = {expression};")

    def block(self, block: Block) -> None:
        """Write a region's instructions."""
        for instruction in block.instructions:
            handler = self.handlers.get(instruction.op)
            if handler is not None:
                handler(instruction)
            elif instruction.op.startswith("atomic_"):
                self._atomic(instruction)
            else:
                self._pure(instruction)

    def inside(self, block: Block) -> None:
        self.depth += 1
        self.block(block)
        self.depth -= 1

    # --------------------------------------------------------- instructions

    def _pure(self, instruction: Instruction) -> None:
        texts = [self.name(v) for v in instruction.operands]
        if all(id(v) in self.literals for v in instruction.operands):
            # What constants alone give here is not finite; WGSL would refuse to compute it beforehand.
            first, texts[0] = texts[0], self.fresh("k")
            self.line(f"var {texts[0]} = {first};")
        self.let(instruction.results[0], EXPRESSIONS[instruction.op](instruction, tuple(texts)))

    def _const(self, instruction: Instruction) -> None:
        (result,) = instruction.results
        self.names[id(result)] = literal(instruction.attributes[0], result.type)
        self.literals.add(id(result))

    def _uniform(self, instruction: Instruction) -> None:
        (result,) = instruction.results
        name = f"call.{_safe(instruction.attributes[0])}"
        # What the host shares with a shader has no bools.
        self.names[id(result)] = f"({name} != 0u)" if result.type == BOOL else name

    def _index(self, instruction: Instruction) -> None:
        self.names[id(instruction.results[0])] = "lane"

    def _any(self, instruction: Instruction) -> None:
        vote = self.name(instruction.operands[0])
        self.let(instruction.results[0], f"subgroupAny({vote})" if self.votes else vote)

    def _place(self, instruction: Instruction) -> str:
        buffer, place = instruction.attributes[0], self.name(instruction.operands[0])
        if buffer in self.constant:
            row = self.constant[buffer]
            return f"{_safe(buffer)}[{place} / {row}u][{place} % {row}u]"
        return f"{_safe(buffer)}[{place}]"

    def _load(self, instruction: Instruction) -> None:
        place = self._place(instruction)
        shared = instruction.attributes[0] in self.atomic
        self.let(instruction.results[0], f"atomicLoad(&{place})" if shared else place)

    def _store(self, instruction: Instruction) -> None:
        place, value = self._place(instruction), self.name(instruction.operands[1])
        shared = instruction.attributes[0] in self.atomic
        self.line(f"atomicStore(&{place}, {value});" if shared else f"{place} = {value};")

    def _atomic(self, instruction: Instruction) -> None:
        what = {"atomic_add": "atomicAdd", "atomic_min": "atomicMin", "atomic_max": "atomicMax"}[instruction.op]
        self.let(instruction.results[0], f"{what}(&{self._place(instruction)}, {self.name(instruction.operands[1])})")

    # --------------------------------------------------------- control flow

    def _while(self, instruction: Instruction) -> None:
        head, body = instruction.regions
        state = self._carry(instruction.operands, head.parameters, body.parameters, instruction.results)
        self.line("loop {")
        self.inside(head)
        self.depth += 1
        self.line(f"if (!{self.name(head.yields[0])}) {{ break; }}")
        self.block(body)
        self._give(state, body.yields)
        self.depth -= 1
        self.line("}")

    def _for(self, instruction: Instruction) -> None:
        (body,) = instruction.regions
        count = self.name(instruction.operands[0])
        state = self._carry(instruction.operands[1:], body.parameters[1:], instruction.results)
        step = self.fresh("i")
        self.names[id(body.parameters[0])] = step
        self.line(f"for (var {step} = 0u; {step} < {count}; {step}++) {{")
        self.inside(body)
        self.depth += 1
        self._give(state, body.yields)
        self.depth -= 1
        self.line("}")

    def _carry(self, start: tuple[Value, ...], *names: tuple[Value, ...]) -> list[str]:
        """Variables for carried values, under each name that the kernel has for them."""
        state = []
        for i, value in enumerate(start):
            made = self.fresh("s")
            state.append(made)
            self.line(f"var {made}: {value.type} = {self.name(value)};")
            for values in names:
                self.names[id(values[i])] = made
        return state

    def _give(self, state: list[str], values: tuple[Value, ...]) -> None:
        """Set variables, all at once: what one takes from another is put aside first."""
        given = [self.name(v) for v in values]
        for i, text in enumerate(given):
            if text in state and text != state[i]:
                given[i] = self.fresh()
                self.line(f"let {given[i]} = {text};")
        for variable, text in zip(state, given, strict=True):
            if variable != text:
                self.line(f"{variable} = {text};")

    def _if(self, instruction: Instruction) -> None:
        yes, no = instruction.regions
        state = []
        for result in instruction.results:
            made = self.fresh("s")
            state.append(made)
            self.names[id(result)] = made
            self.line(f"var {made}: {result.type};")
        self.line(f"if ({self.name(instruction.operands[0])}) {{")
        self._side(yes, state)
        if no.instructions or state:
            self.line("} else {")
            self._side(no, state)
        self.line("}")

    def _side(self, region: Block, state: list[str]) -> None:
        self.inside(region)
        self.depth += 1
        self._give(state, region.yields)
        self.depth -= 1


def _safe(name: str) -> str:
    """A kernel's name for a uniform or buffer as WGSL can have it: not a keyword, not a builtin, not a ``v1``."""
    return "".join(c if c.isascii() and (c.isalnum() or c == "_") else f"_{ord(c):x}" for c in name) + "_"
