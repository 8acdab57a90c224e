"""What a certified answer promises, held to the judge's verdict; and a count of what was found.

- MISS: there is no root, but for one at an edge.
- HIT: f changes sign within four tolerances of t, and nothing that certainly is a root comes before that.
- UNRESOLVED: likewise nothing before; and it stands where f can be excluded only if rounding hid a sign. Such false
  alarms break no promise and are counted.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import zeroset as zs
from zeroset import Surface
from zeroset.methods import METHODS, Affine, Interval, Method

from .judge import EDGE, Judge, Kind, Verdict
from .rays import rays

PROVING = [name for name, method in METHODS.items() if method.certified]
STATUS = {zs.MISS: "miss", zs.HIT: "hit", zs.UNRESOLVED: "unresolved"}


def proving_methods(surface: Surface) -> dict[str, Method]:
    """Every certified method that treats this surface, the ones along the dominant axis included, by a label."""
    degree = surface.field.degree
    made: dict[str, Method] = {name: METHODS[name]() for name in PROVING}
    made |= {"affine-k": Affine(axis="k"), "interval-k": Interval(axis="k")}
    most = {"analytic": 4, "mitchell-exact": 5}
    return {name: m for name, m in made.items() if name not in most or (degree is not None and degree <= most[name])}


@dataclass
class Account:
    """What came of casting rays with one method."""

    statuses: Counter[str] = field(default_factory=Counter)
    false_alarms: int = 0
    open_hits: int = 0
    broken: list[str] = field(default_factory=list)

    def enter(self, verdict: Verdict, status: int, t: float, where: str) -> None:
        """Hold one answer to its verdict."""
        self.statuses[STATUS[status]] += 1
        wrong = broken_promise(verdict, status, t)
        if wrong:
            self.broken.append(f"{where}: {wrong}")
        elif status != zs.MISS:
            near = nearby(verdict, t)
            self.false_alarms += not near
            self.open_hits += status == zs.HIT and near == {Kind.OPEN}


def nearby(verdict: Verdict, t: float) -> set[Kind]:
    """What is within four tolerances of t."""
    reach = EDGE * verdict.tolerance
    return {e.kind for e in verdict.events if e.a - reach <= t <= e.b + reach}


def broken_promise(verdict: Verdict, status: int, t: float) -> str:
    """What is wrong with an answer; empty where nothing is."""
    root, reach = verdict.root, EDGE * verdict.tolerance
    if status == zs.MISS:
        return f"MISS, but {root.kind.value} at {root.a:.9g}" if root else ""
    name = STATUS[status].upper()
    if verdict.stretch is None or not verdict.stretch[0] - reach <= t <= verdict.stretch[1] + reach:
        return f"{name} at {t:.9g}, outside the bounds: {verdict.stretch}"
    if root and root.b < t - reach:
        return f"{name} at {t:.9g}, but {root.kind.value} before it, at {root.a:.9g}"
    if status == zs.HIT:
        near = nearby(verdict, t)
        if not near:
            return f"HIT at {t:.9g}, but f is not 0 within {reach:.3g}; first root: {root.a if root else None}"
        if not near & {Kind.CROSS, Kind.OPEN}:
            return f"HIT at {t:.9g}, but f does not change sign there: {', '.join(kind.value for kind in near)}"
    return ""


class Trial:
    """Rays at one surface with their verdicts, judged once for all methods."""

    def __init__(self, surface: Surface, count: int) -> None:
        self.surface = surface
        judge = Judge(surface)
        self.origins, self.directions = rays(judge, count)
        pairs = zip(self.origins.tolist(), self.directions.tolist(), strict=True)
        self.verdicts = [judge.first_root(o, d) for o, d in pairs]

    @property
    def unsettled(self) -> list[int]:
        """Rays on which Arb left something open."""
        return [i for i, verdict in enumerate(self.verdicts) if not verdict.settled]

    def hold(self, method: str | Method, device: str = "cpu") -> Account:
        """Cast all rays with a method and hold each answer to its verdict."""
        hits = zs.cast(self.surface, self.origins, self.directions, method=method, device=device)
        return held(self.verdicts, hits, self.origins, self.directions)


def held(verdicts: Sequence[Verdict], hits: Any, origins: Iterable[Any], directions: Iterable[Any]) -> Account:
    """Hold all answers to their verdicts."""
    account = Account()
    for verdict, status, t, o, d in zip(verdicts, hits.status, hits.t, origins, directions, strict=True):
        account.enter(verdict, int(status), float(t), f"from {o.tolist()} towards {d.tolist()}")
    return account
