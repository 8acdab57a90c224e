"""``zeroset explain``: what a formula was understood to mean, and what becomes of it on the way to machine code."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

import click

from zeroset.cli.source import FormulaCommand, find_scene, read_method, surface_options
from zeroset.errors import DeviceError, ZerosetError, did_you_mean
from zeroset.scene.several import Several
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface

if TYPE_CHECKING:
    from zeroset.expr import Expr
    from zeroset.kernel import Kernel
    from zeroset.runtime.gpu.device import GpuDevice
    from zeroset.scene.scene import Scene
    from zeroset.scene.several import Drawable
    from zeroset.solve import Method

SHORT = 24
"""Operations of a formula that are listed without being asked for."""
TRACED = "traced"
"""The name of a kernel's state before the first pass."""


@click.command("explain", cls=FormulaCommand)
@surface_options
@click.option("--dag", is_flag=True, help="List all operations of the formula.")
@click.option("--kernel", metavar="NAME", help="Show one kernel: beams, primary, second, parts or shade.")
@click.option("--pass", "pass_name", metavar="NAME", help="Show it after this pass ('traced': before the first).")
@click.option("--passes", is_flag=True, help="Show it after each pass that changes it.")
@click.option("--target", metavar="CODE", help="Show the code made of it: llvm, asm or wgsl.")
def command(
    source: str,
    params: tuple[str, ...],
    bounds: str | None,
    method: str,
    device: str,
    dag: bool,
    kernel: str | None,
    pass_name: str | None,
    passes: bool,
    target: str | None,
) -> None:
    """Explain SOURCE: the formula as understood, its operations, its kernels after each pass, the target code."""
    from zeroset.rendering.drawn import as_drawn

    scene = find_scene(source, params, bounds)
    chosen = read_method(method)
    as_drawn(scene.surface).check(chosen)
    made = kernels(scene, chosen)
    if dag and not (kernel or pass_name or passes or target):
        lines: Iterable[str] = (line for each in scene.surface.surfaces for line in operations(each.field.expr))
    elif kernel or pass_name or passes or target:
        wanted = made[_one_of(kernel or "primary", made, f"kernel of the method {chosen.name}")]()
        lines = _target_code(wanted, target, device) if target else _stages(wanted, pass_name, passes)
    else:
        lines = (*_drawn(scene.surface, chosen), *_counts(made), *_more())
    for line in lines:
        click.echo(line)


def kernels(scene: Scene, method: Method) -> Mapping[str, Callable[[], Kernel]]:
    """What traces each kernel of a frame, by name, in the order they run."""
    from zeroset.rendering.shade import shade_kernel
    from zeroset.rendering.shading import Lighting
    from zeroset.rendering.tracer import Tracer
    from zeroset.runtime import get_device

    # Nothing is run, so any device will do.
    tracer = Tracer(scene.surface, method, get_device("interp"), pixels=True)
    passes = {"beams": "beams", "primary": "first", "second": "second", "parts": "parts"}
    if not method.certified:
        passes = {"primary": "first"}
    made: dict[str, Callable[[], Kernel]] = {
        name: lambda own=own: tracer.kernel(own)  # type: ignore[misc]
        for name, own in passes.items()
    }
    return made | {"shade": lambda: shade_kernel(Lighting("d" * len(scene.lights)), len(scene.materials))}


def _one_of(name: str, known: Iterable[str], what: str) -> str:
    names = tuple(known)
    if name not in names:
        raise ZerosetError(
            f"there is no {what} named {name!r}", hints=(*did_you_mean(name, names), f"there are {', '.join(names)}")
        )
    return name


def _drawn(thing: Drawable, method: Method) -> Iterator[str]:
    """All surfaces, and how solids are made of them."""
    if isinstance(thing, Several):
        for each in thing:
            yield from _thing(each)
            yield ""
    else:
        yield from _thing(thing)
    yield f"method      {method.name}, {'certified' if method.certified else 'not certified'}: {method.summary}"
    for surface in thing.surfaces:
        yield f"operations  {surface.field.expr.size} distinct"
        yield from _short(surface.field.expr)
        yield from _beforehand(surface)


def _thing(thing: Surface | Solid) -> Iterator[str]:
    from zeroset.scene.solid_text import solid_text

    if isinstance(thing, Surface):
        yield from _formula(thing)
    else:
        names = {surface: surface.name or f"part{i}" for i, surface in enumerate(thing.surfaces)}
        if thing.name:
            yield f"name        {thing.name}"
        yield f"solid       {solid_text(thing, names)}"
        for surface, name in names.items():
            yield f"{name:<12}" + "; ".join(line[12:] for line in _formula(surface) if line.startswith("formula"))
    yield f"bounds      {thing.fitted}{'' if thing.bounds is not None else ', fitted'}"


def _formula(surface: Surface) -> Iterator[str]:
    from zeroset.expr.text import brief

    expr = surface.field.expr
    if surface.name:
        yield f"name        {surface.name}"
    yield f"formula     {brief(expr, 400)} = 0"
    degree = surface.field.degree
    yield f"kind        {'no polynomial' if degree is None else f'polynomial of degree {degree}'}"
    yield f"variables   {', '.join(sorted(expr.variables))}"
    values = [f"{name} = {value:g}" for name, value in surface.params.items()]
    values += [f"{name} ({len(array)} numbers)" for name, array in surface.arrays.items()]
    yield f"parameters  {', '.join(values) or 'none'}"
    if surface.isovalues:
        yield f"isovalues   {', '.join(f'{value:g}' for value in surface.isovalues)}"


def _beforehand(surface: Surface) -> Iterator[str]:
    """What of f parameters alone decide, and kernels are given."""
    from zeroset.expr.text import brief

    field, numbers = surface.settled
    parts = {name: part for name, part in surface.field.settled.parts.items() if name in field.parameters}
    if parts:
        yield f"in kernels  {brief(field.expr, 400)} = 0"
    for name, part in parts.items():
        yield f"  {name} = {brief(part)} = {numbers[name][0]:.8g}"


def _short(expr: Expr) -> Iterator[str]:
    if expr.size <= SHORT:
        yield from (f"  {line}" for line in operations(expr))


def operations(expr: Expr) -> Iterator[str]:
    """The DAG as numbered lines, each operation after its arguments."""
    from zeroset.expr import postorder

    numbers: dict[Expr, int] = {}
    for part in postorder(expr):
        numbers[part] = len(numbers)
        arguments = [f"%{numbers[arg]}" for arg in part.args]
        data = [str(item) for item in part.data]
        yield f"%{numbers[part]} = {' '.join((part.op, ', '.join(arguments + data)))}"


def _stages_of(kernel: Kernel) -> dict[str, Kernel]:
    """The kernel as traced and after each pass."""
    from zeroset.kernel.passes import optimise

    stages = {TRACED: kernel}
    optimise(kernel, stages.__setitem__)
    return stages


def _counts(made: Mapping[str, Callable[[], Kernel]]) -> Iterator[str]:
    from zeroset.kernel.text import count_instructions

    stages = {name: _stages_of(make()) for name, make in made.items()}
    heads = tuple(next(iter(stages.values())))
    yield "kernels     instructions after each pass"
    yield f"  {'':8}" + "".join(f"{head:>9}" for head in heads)
    for name, kernels_of in stages.items():
        yield f"  {name:8}" + "".join(f"{count_instructions(kernels_of[head].body):9}" for head in heads)


def _more() -> Iterator[str]:
    yield "more: --dag, --kernel NAME, --pass NAME, --passes, --target llvm, --target asm, --target wgsl"


def _stages(kernel: Kernel, pass_name: str | None, passes: bool) -> Iterator[str]:
    from zeroset.kernel.text import count_instructions, to_text

    stages = _stages_of(kernel)
    shown = tuple(stages) if passes else (_one_of(pass_name or tuple(stages)[-1], stages, "pass"),)
    before: Kernel | None = None
    for name in shown:
        stage = stages[name]
        yield f"# {kernel.name}, {name}: {count_instructions(stage.body)} instructions"
        if stage is before:
            yield "# unchanged"
        else:
            yield to_text(stage)
        before = stage


def _target_code(kernel: Kernel, target: str, device: str) -> Iterator[str]:
    if _one_of(target, ("llvm", "asm", "wgsl"), "target code") == "wgsl":
        yield from _shader(kernel, device)
        return
    from zeroset.codegen import llvm
    from zeroset.codegen.assembly import to_assembly
    from zeroset.kernel.passes import optimise
    from zeroset.runtime.cpu import host

    cpu = host()[0]
    code = llvm.to_llvm(optimise(kernel), cpu.suited(kernel))
    yield code if target == "llvm" else to_assembly(code, cpu)


def _shader(kernel: Kernel, device: str) -> Iterator[str]:
    """WGSL as this machine's GPU gets it; as one without any optional feature gets it where there is none."""
    from zeroset.codegen.gpu_target import GpuTarget
    from zeroset.codegen.wgsl import to_wgsl
    from zeroset.kernel.passes import optimise

    gpu = _gpu(device)
    target = GpuTarget() if gpu is None else gpu.target
    flags = ("subgroups", "doubles", "exact_division", "exact_root", "exact_rounding")
    has = [flag.replace("_", " ") for flag in flags if getattr(target, flag)]
    name = "a GPU with the least that zeroset needs" if gpu is None else gpu.found.title
    yield f"// for {name}: {', '.join(has) or 'nothing optional'}"
    yield to_wgsl(optimise(kernel), target)


def _gpu(device: str) -> GpuDevice | None:
    """The GPU, where one was asked for by name or may well be there."""
    from zeroset.runtime import get_device
    from zeroset.runtime.gpu.adapter import likely
    from zeroset.runtime.gpu.device import GpuDevice

    if device != "gpu" and not likely():
        return None
    try:
        found = get_device("gpu")
    except DeviceError:
        if device == "gpu":
            raise
        return None
    return found if isinstance(found, GpuDevice) else None
