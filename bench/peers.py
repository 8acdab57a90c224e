"""Times zeroset beside surf and POV-Ray, one thread each, in one run: python bench/peers.py FOLDER

Everybody draws the same surfaces in the same view; the pictures are left in FOLDER, to be looked at. Programs take
turns, round by round, so that what else the machine does disturbs all of them alike. The share of pixels where a
program's silhouette is not zeroset's is in the table: a fast wrong picture is no peer. What is not installed is named.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

# Before zeroset is imported: the number of threads is read when its device is made.
os.environ["ZEROSET_THREADS"] = "1"
sys.path.insert(0, str(Path(__file__).parent.parent / "src"))

import numpy as np
import programs
from scenes import CASES, Case

import zeroset as zs
from zeroset.bench.machine import this_machine
from zeroset.bench.report import Table
from zeroset.runtime import get_device

COLUMNS = (
    "surface",
    "program",
    "seconds",
    "best",
    "rendering alone",
    "× frame",
    "× warm process",
    "other pixels",
    "note",
)


def main() -> int:
    """Run the comparison."""
    options = _options()
    _one_core()
    options.folder.mkdir(parents=True, exist_ok=True)
    rows: list[tuple[str, ...]] = []
    cases = [case for case in CASES if not options.cases or case.name in options.cases]
    try:
        for case in cases:
            rows += _compare(case, options)
    except KeyboardInterrupt:
        print("interrupted: this is what is done", file=sys.stderr)
    notes = [
        f"Square pictures of {options.size} pixels a side, {options.rounds} rounds, medians, one core for everybody."
    ]
    notes += [f"Not installed and so not compared: {name}." for name in programs.missing()]
    table = Table("bench/peers.py", COLUMNS, tuple(rows), (*notes, str(this_machine(get_device("cpu")))))
    print(table.markdown()) if options.markdown else table.show()
    return 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path, help="where scenes and pictures are left")
    parser.add_argument(
        "cases", nargs="*", metavar="SURFACE", help=f"of {', '.join(case.name for case in CASES)}; default all"
    )
    parser.add_argument("--size", type=int, default=1024, help="pixels a side")
    parser.add_argument("--rounds", type=int, default=3, help="turns of each program")
    parser.add_argument("--longest", type=float, default=120.0, help="seconds after which a peer is stopped")
    parser.add_argument("--markdown", action="store_true", help="print the table in Markdown")
    parser.add_argument("--trial", type=Path, help="script of an early trial of the design, to time in the same run")
    options = parser.parse_args()
    options.folder = options.folder.resolve()
    unknown = set(options.cases) - {case.name for case in CASES}
    if unknown:
        parser.error(f"there is no {', '.join(sorted(unknown))}")
    return options


def _one_core() -> None:
    """Keep this process and all that it starts on one core: surf and the trial have no option for one thread."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def _compare(case: Case, options: argparse.Namespace) -> list[tuple[str, ...]]:
    competitors = programs.programs(case, options.size, options.folder, options.longest)
    if case.name == "barth-sextic" and options.trial is not None:
        competitors.append(programs.trial(options.trial))
    for i in range(options.rounds):
        for program in competitors:
            print(f"{case.name}, round {i + 1}: {program.name}", end="", flush=True, file=sys.stderr)
            program.take_turn()
            print(f" {program.failure or f'{program.seconds[-1]:.3f} s'}", file=sys.stderr)
    truth = zs.render(case.scene, options.size).aov("status") != zs.MISS
    frame, warm = competitors[0].median, competitors[1].median
    return [_row(case, program, frame, warm, truth) for program in competitors]


def _row(case: Case, program: programs.Program, frame: float, warm: float, truth: np.ndarray) -> tuple[str, ...]:
    note = "; ".join(filter(None, (program.note, program.failure)))
    if not program.seconds:
        return (case.name, program.name, "-", "-", "-", "-", "-", "-", note)
    other = "-"
    if program.picture is not None and not program.failure:
        other = f"{np.mean(programs.silhouette(program.picture) != truth):.3%}"
    more = "> " if program.endless else ""
    times = (f"{more}{value:.4f}" for value in (program.median, min(program.seconds)))
    inner = f"{np.median(program.inner):.3f}" if program.inner else "-"
    ratios = (f"{more}{program.median / value:.2f}" for value in (frame, warm))
    return (case.name, program.name, *times, inner, *ratios, other, note)


if __name__ == "__main__":
    sys.exit(main())
