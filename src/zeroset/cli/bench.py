"""``zeroset bench``: how fast this machine draws the gallery, what frames do to memory, how long the command takes.

On a GPU frames are timed by the GPU's own clock and by the wall's, pass by pass where that is wished for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from zeroset.cli.bench_paper import command as paper
from zeroset.cli.progress import Progress

if TYPE_CHECKING:
    from zeroset.bench.devices import Devices
    from zeroset.bench.report import Cost

MEMORY_SURFACE = "tangle"
COMMAND_SURFACE = "barth-sextic"
PASSES_SURFACE = "barth-sextic"


SIZES = (512, 1024)
"""Pixels a side where nobody asks for others."""


@dataclass(frozen=True)
class Wish:
    """What the user asked to have measured; the options of the command."""

    names: tuple[str, ...]
    sizes: tuple[int, ...]
    threads: int | None
    method: str
    device: str
    seconds: float
    kind: str | None
    frames: int
    runs: int


class _Bench(click.Command):
    """``zeroset bench paper ...`` is a command of its own, wherever among the options the word stands."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        # Of several such options the last one would count, in silence.
        asked = [name for option in self.params if option.name == "kind" for name in option.opts if name in args]
        if len(asked) > 1:
            raise click.UsageError(f"{' and '.join(asked)} are measured one at a time")
        with super().make_context(info_name, list(args), parent, resilient_parsing=True) as seen:
            names: Sequence[str] = seen.params.get("names") or ()
        if not names or names[0] != paper.name:
            return super().make_context(info_name, args, parent, **extra)
        rest = list(args)
        rest.remove(names[0])
        return paper.make_context(f"{info_name} {paper.name}", rest, parent, **extra)


@click.command("bench", cls=_Bench)
@click.argument("names", nargs=-1)
@click.option("-s", "--size", "sizes", multiple=True, type=click.IntRange(8, 16384), help="Pixels a side; repeatable.")
@click.option("--threads", type=click.IntRange(1, 1024), help="Threads that a frame is spread over.")
@click.option("-m", "--method", default="auto", show_default=True, help="Ray method.")
@click.option("-d", "--device", default="auto", show_default=True, help="Where to run.")
@click.option("--seconds", default=0.5, show_default=True, type=click.FloatRange(0), help="Time for each size.")
@click.option("--memory", "kind", flag_value="memory", help="Instead: growth and compilations over many frames.")
@click.option("--light", "kind", flag_value="light", help="Instead: what shadows, mirrors, layers and edges cost.")
@click.option("--cold", "kind", flag_value="cold", help="Instead: the whole command, from formula to PNG.")
@click.option("--passes", "kind", flag_value="passes", help="Instead: each pass of a frame, by the GPU's own clock.")
@click.option("--papers", "kind", flag_value="papers", help="Instead: frame rates beside those that papers print.")
@click.option("--frames", default=1000, show_default=True, type=click.IntRange(1), help="Frames for --memory.")
@click.option("--runs", default=5, show_default=True, type=click.IntRange(1), help="Processes of each kind for --cold.")
@click.option("--markdown", is_flag=True, help="Print the table in Markdown.")
@click.option("--json", "json_file", metavar="FILE", help="Write all figures to a file too.")
def command(markdown: bool, json_file: str | None, **wish: object) -> None:
    """Time the surfaces NAMES, or all of the gallery: frames in steady state, compiling, and how far the limit is.

    zeroset bench paper [TABLE]... measures the papers' own tables once more; zeroset bench paper lists them.
    """
    from zeroset.atomic import check_writable, replacing
    from zeroset.bench import report
    from zeroset.bench.devices import Devices
    from zeroset.bench.drivers import no_driver_caches
    from zeroset.bench.machine import this_machine
    from zeroset.solve import resolve_method

    wanted = Wish(**wish)  # type: ignore[arg-type]
    path = None if json_file is None else check_writable(json_file)
    resolve_method(wanted.method)
    # The whole command is timed as its user has it, drivers' caches included.
    with nullcontext() if wanted.kind == "cold" else no_driver_caches():
        devices = Devices(wanted.device, wanted.threads)
        costs, interrupted = _collect(wanted, devices)
    machine = this_machine(devices.steady)
    if costs:
        table = report.table(costs, machine)
        click.echo(table.markdown()) if markdown else table.show()
    if interrupted:
        raise click.Abort
    if path is not None:
        with replacing(path) as file:
            file.write(report.to_json(costs, machine).encode())


def _collect(wish: Wish, devices: Devices) -> tuple[list[Cost], bool]:
    """What could be measured before it was all done, or before the user interrupted, and whether he did."""
    kinds = {"memory": _memory, "cold": _cold, "passes": _passes, "papers": _papers, "light": _light}
    measure = kinds.get(wish.kind or "", _frames)
    costs: list[Cost] = []
    with Progress("timing") as progress:
        try:
            costs.extend(measure(wish, devices, progress))
        except KeyboardInterrupt:
            return costs, True
    return costs, False


def _frames(wish: Wish, devices: Devices, progress: Callable[[float], None]) -> Iterator[Cost]:
    from zeroset.bench.frames import measure, warm_up
    from zeroset.bench.gpu import measure_gpu
    from zeroset.shelf import gallery

    names = wish.names or tuple(gallery)
    surfaces = [gallery[name] for name in names]
    warm_up(devices, wish.method)
    for i, surface in enumerate(surfaces):
        progress(i / len(surfaces))
        sizes = wish.sizes or SIZES
        if devices.gpu is not None:
            yield measure_gpu(surface, sizes, wish.method, devices, devices.gpu, wish.seconds)
        else:
            yield measure(surface, sizes, wish.method, devices, wish.seconds)


def _light(wish: Wish, devices: Devices, progress: Callable[[float], None]) -> Iterator[Cost]:
    from zeroset.bench.light import measure_light
    from zeroset.shelf import gallery

    for name, part in _parts(wish.names or (MEMORY_SURFACE,), progress):
        for size in wish.sizes or (1024,):
            part(0.0)
            yield from measure_light(gallery[name], size, wish.method, devices.steady, wish.seconds)


def _passes(wish: Wish, devices: Devices, progress: Callable[[float], None]) -> Iterator[Cost]:
    from zeroset.bench.gpu import measure_passes
    from zeroset.errors import DeviceError
    from zeroset.shelf import gallery

    gpu = devices.gpu
    if gpu is None:
        raise DeviceError("only a GPU tells how long each pass takes", hint='use device="gpu"')
    if gpu.stream.clock is None:
        raise DeviceError(f"{gpu.found.name} has no clock of its own", hint="without --passes, wall times are measured")
    for name, part in _parts(wish.names or (PASSES_SURFACE,), progress):
        for size in wish.sizes or SIZES:
            part(0.0)
            yield measure_passes(gallery[name], size, wish.method, gpu, wish.seconds)


def _papers(wish: Wish, devices: Devices, progress: Callable[[float], None]) -> Iterator[Cost]:
    from zeroset.bench.papers import measure_paper, references
    from zeroset.errors import ZerosetError
    from zeroset.shelf import gallery

    if wish.sizes:
        raise ZerosetError("frames beside a paper's have the paper's size", hint="leave --size out")
    wanted = tuple(references(wish.names))
    for i, reference in enumerate(wanted):
        progress(i / len(wanted))
        yield measure_paper(reference, gallery.find, wish.method, devices, wish.seconds)


def _memory(wish: Wish, devices: Devices, progress: Callable[[float], None]) -> Iterator[Cost]:
    from zeroset.bench.memory import measure_memory
    from zeroset.shelf import gallery

    for name, part in _parts(wish.names or (MEMORY_SURFACE,), progress):
        for size in wish.sizes or (512,):
            yield measure_memory(gallery[name], wish.frames, size, wish.method, devices, part)


def _cold(wish: Wish, devices: Devices, progress: Callable[[float], None]) -> Iterator[Cost]:
    from zeroset.bench.cold import measure_command

    options = ("-m", wish.method, "-d", wish.device)
    for name, part in _parts(wish.names or (COMMAND_SURFACE,), progress):
        for size in wish.sizes or (512,):
            yield measure_command(name, size, wish.runs, options, wish.threads, part)


def _parts(names: Sequence[str], progress: Callable[[float], None]) -> Iterator[tuple[str, Callable[[float], None]]]:
    """Names, each with its share of the progress."""
    for i, name in enumerate(names):
        yield name, lambda share, i=i: progress((i + share) / len(names))  # type: ignore[misc]
