"""What every test shares: a cache folder of its own, so that no test reads or writes the user's.

And what the truth suite tells at the end of a run, here because several processes may have run its tests.
"""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from collections import Counter
from typing import Any

if "ZEROSET_CACHE_DIR" not in os.environ:
    os.environ["ZEROSET_CACHE_DIR"] = tempfile.mkdtemp(prefix="zeroset-tests-")
    atexit.register(shutil.rmtree, os.environ["ZEROSET_CACHE_DIR"], ignore_errors=True)


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Rays judged, those that Arb left open by surface, answers by method."""
    judged: dict[str, tuple[int, int]] = {}
    answers: dict[str, Counter[str]] = {}
    for kind in ("passed", "failed"):
        for report in terminalreporter.getreports(kind):
            for what, note in report.user_properties if report.when == "call" else ():
                if what == "truth judged":
                    judged[note[0]] = (note[1], note[2])
                elif what == "truth held":
                    answers.setdefault(note[0], Counter()).update(note[1])
    if not answers:
        return
    terminalreporter.section("truth")
    unsettled = ", ".join(f"{name} {count}" for name, (_, count) in sorted(judged.items()) if count) or "none"
    rays = sum(count for count, _ in judged.values())
    terminalreporter.line(f"{rays} rays judged at {len(judged)} surfaces; unsettled by Arb: {unsettled}")
    for method, found in sorted(answers.items()):
        terminalreporter.line(f"  {method:15} " + ", ".join(f"{what} {n}" for what, n in sorted(found.items())))
