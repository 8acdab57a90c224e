"""The gallery held to Arb at length: ``python -m tests.truth [-n RAYS] [-d DEVICE] [NAME ...]`` from the root."""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter

import zeroset as zs

from .held import Trial, proving_methods


def main() -> int:
    """Print a row for each surface and every broken promise; 1 where there is one."""
    options = argparse.ArgumentParser(prog="python -m tests.truth", description=__doc__)
    options.add_argument("-n", type=int, default=512, help="rays a surface")
    options.add_argument("-d", default="cpu", help="device")
    options.add_argument("names", nargs="*", help="surfaces; all by default")
    chosen = options.parse_args()
    broken = rays = unsettled = 0
    totals: dict[str, Counter[str]] = {}
    for name in chosen.names or zs.gallery:
        began = time.perf_counter()
        trial = Trial(zs.gallery[name], chosen.n)
        judged = time.perf_counter()
        rays += len(trial.verdicts)
        unsettled += len(trial.unsettled)
        kinds = Counter(v.root.kind.name.lower() if v.root else "none" for v in trial.verdicts)
        print(f"{name}: {dict(kinds)}, unsettled {len(trial.unsettled)}, judged in {judged - began:.1f} s")
        for label, method in proving_methods(trial.surface).items():
            account = trial.hold(method, chosen.d)
            broken += len(account.broken)
            found = account.statuses + Counter({"false alarm": account.false_alarms, "open hit": account.open_hits})
            totals.setdefault(label, Counter()).update(found + Counter({"broken": len(account.broken)}))
            print(f"  {label:15}" + "".join(f" {what} {number}" for what, number in sorted(found.items())), flush=True)
            for line in account.broken[:5]:
                print(f"    BROKEN {line}")
        print(f"  cast in {time.perf_counter() - judged:.1f} s")
    print(f"{rays} rays, {unsettled} unsettled, {broken} broken promises")
    for label, total in totals.items():
        print(f"  {label:15} {dict(sorted(total.items()))}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
