"""``zeroset bench paper sn10-1``: a paper's table measured once more, its figures beside ours."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import click

from zeroset.cli.progress import Progress

if TYPE_CHECKING:
    from zeroset.bench.devices import Devices
    from zeroset.bench.printed import PrintedTable
    from zeroset.bench.rerun import RowCost


@click.command("paper")
@click.argument("ids", nargs=-1, metavar="[TABLE]...")
@click.option("--threads", type=click.IntRange(1, 1024), help="Threads that a frame is spread over.")
@click.option("-d", "--device", default="auto", show_default=True, help="Where to run.")
@click.option("--seconds", default=0.5, show_default=True, type=click.FloatRange(0), help="Time for each figure.")
@click.option("--markdown", is_flag=True, help="Print the tables in Markdown.")
@click.option("--json", "json_file", metavar="FILE", help="Write all figures to a file too.")
def command(
    ids: tuple[str, ...], threads: int | None, device: str, seconds: float, markdown: bool, json_file: str | None
) -> None:
    """Measure the papers' TABLEs with their sizes, methods and steps, and print their figures beside ours.

    Without a TABLE, list them; all measures all of them.
    """
    from zeroset.atomic import check_writable, replacing
    from zeroset.bench.devices import Devices
    from zeroset.bench.drivers import no_driver_caches
    from zeroset.bench.machine import this_machine
    from zeroset.bench.paper_report import paper_report
    from zeroset.bench.printed import find_tables
    from zeroset.bench.report import to_json

    if not ids:
        _list()
        return
    tables = find_tables(ids)
    path = None if json_file is None else check_writable(json_file)
    costs: list[RowCost] = []
    with no_driver_caches():
        devices = Devices(device, threads)
        machine = this_machine(devices.steady)
        for table in tables:
            found, interrupted = _collect(table, devices, seconds)
            for part in paper_report(found, machine):
                click.echo(part.markdown()) if markdown else part.show()
            if interrupted:
                raise click.Abort
            costs += found
    if path is not None:
        with replacing(path) as file:
            file.write(to_json(costs, machine).encode())


def _share(progress: Callable[[float], None], part: int, parts: int, share: float) -> None:
    """Progress of one part as progress of the whole."""
    progress((part + share) / parts)


def _list() -> None:
    from zeroset.bench.printed import printed_tables

    for table in printed_tables():
        count = len({row.title for row in table.rows})
        click.echo(f"{table.id:8} {table.paper}, {table.table}: {table.about} ({count} surfaces)")


def _collect(table: PrintedTable, devices: Devices, seconds: float) -> tuple[Sequence[RowCost], bool]:
    """What could be measured before it was all done, or before the user interrupted, and whether he did."""
    from zeroset.bench.rerun import measure_row
    from zeroset.shelf import gallery

    costs: list[RowCost] = []
    with Progress(f"timing {table.id}") as progress:
        try:
            for i, row in enumerate(table.rows):
                part = partial(_share, progress, i, len(table.rows))
                costs.extend(measure_row(table, row, gallery.find, devices, seconds, part))
        except KeyboardInterrupt:
            return costs, True
    return costs, False
