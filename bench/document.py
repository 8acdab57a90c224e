"""Measures everything anew and puts the tables into docs/benchmarks.md: python bench/document.py FOLDER [PART...]

Each table stands between two comments that name its part. FOLDER takes the peers' pictures; PARTs, where given, are the
only ones that are measured. A quiet machine is half of the work: nothing else should run meanwhile. The parts of a GPU
are measured only when they are named.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "benchmarks.md"
sys.path.insert(0, str(ROOT / "src"))

from zeroset.bench.cold import START, environment  # noqa: E402
from zeroset.bench.printed import printed_tables  # noqa: E402

ZEROSET = (sys.executable, "-c", START, "bench", "--markdown")
GPU = (*ZEROSET, "--device", "gpu")
SOFTWARE = ("sphere", "tangle", "barth-sextic", "barth-decic", "chmutov-14", "blobby")
GPU_PARTS = {
    "gpu": (*GPU,),
    "papers": (*GPU, "--papers"),
    "passes": (*GPU, "--passes", "sphere", "barth-sextic", "barth-decic", "blobby"),
    "gpu-memory": (*GPU, "--memory", "--frames", "10000", "--size", "64"),
    "software-vulkan": (*GPU, "--size", "512", *SOFTWARE),
}
"""For the machine with the GPU; the last one for one without, whose ``gpu`` is Mesa's driver in software."""
TABLES = {table.id: (*ZEROSET, "paper", table.id, "--device", "cpu") for table in printed_tables()}
"""The papers' tables, a part each; all of them by the name ``tables``."""
COMMANDS = (
    "barth-sextic",
    "barth-decic",
    "tangle",
    "blobby",
    "blinn-blobby-30",
    "labs",
    "water",
    "sin-blob",
    "sarti-dodecic",
)
"""Formulas of every kind, with the ones that take longest."""
PARTS = {
    "gallery": (*ZEROSET,),
    "one-thread": (*ZEROSET, "--threads", "1", "--size", "1024", "barth-sextic", "barth-decic", "chmutov-14"),
    "memory": (*ZEROSET, "--memory"),
    "light": (*ZEROSET, "--light", "--seconds", "2", "tangle", "barth-sextic"),
    "cold": (*ZEROSET, "--cold", *COMMANDS),
    **TABLES,
    "peers": (sys.executable, str(ROOT / "bench" / "peers.py"), "--markdown"),
}


def main() -> int:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the peers' scenes and pictures are left")
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)} (the default), tables, {', '.join(GPU_PARTS)}"
    )
    parser.add_argument("--seconds", help="time for each figure, instead of the commands' own")
    options = parser.parse_args()
    known = PARTS | GPU_PARTS
    asked = [name for part in options.parts for name in (TABLES if part == "tables" else (part,))]
    if unknown := set(asked) - set(known):
        parser.error(f"there is no part {', '.join(sorted(unknown))}")
    for part in asked or PARTS:
        print(f"measuring: {part}", file=sys.stderr)
        line = [*known[part], *([str(options.folder.resolve())] if part == "peers" else [])]
        if options.seconds is not None and part != "peers":
            line += ["--seconds", options.seconds]
        done = subprocess.run(line, env=environment(), stdout=subprocess.PIPE, text=True, check=True)
        _replace(part, done.stdout)
    return 0


def _replace(part: str, table: str) -> None:
    """Put a table between its part's comments; read anew each time, for the page may have been edited meanwhile."""
    page = PAGE.read_text()
    marks = re.compile(f"(<!-- {part} -->\n).*?(<!-- end of {part} -->)", re.DOTALL)
    page, count = marks.subn(lambda found: f"{found[1]}{table.strip()}\n{found[2]}", page)
    if count != 1:
        raise SystemExit(f"{PAGE.name} has no place for the part {part}")
    PAGE.write_text(page)


if __name__ == "__main__":
    sys.exit(main())
