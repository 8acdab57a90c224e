"""What the truth suite tells at its end: rays judged, those that Arb left open by surface, answers by method."""

from __future__ import annotations

from collections import Counter
from typing import Any

import pytest

from .held import Account

UNSETTLED: dict[str, int] = {}
ANSWERS: dict[str, Counter[str]] = {}


class Report:
    """What tests add to the summary."""

    def judged(self, name: str, rays: int, unsettled: int) -> None:
        """A surface's rays, and how many of them Arb left open."""
        COUNTED[name] = rays
        if unsettled:
            UNSETTLED[name] = unsettled

    def held(self, method: str, account: Account) -> None:
        """What one method answered."""
        extra = Counter({"false alarm": account.false_alarms, "open hit": account.open_hits})
        ANSWERS.setdefault(method, Counter()).update(account.statuses + extra)


COUNTED: dict[str, int] = {}


@pytest.fixture(scope="session")
def report() -> Report:
    return Report()


def pytest_terminal_summary(terminalreporter: Any) -> None:
    if not ANSWERS:
        return
    terminalreporter.section("truth")
    named = ", ".join(f"{name} {count}" for name, count in UNSETTLED.items()) or "none"
    terminalreporter.line(f"{sum(COUNTED.values())} rays judged at {len(COUNTED)} surfaces; unsettled by Arb: {named}")
    for method, found in ANSWERS.items():
        terminalreporter.line(f"  {method:15} " + ", ".join(f"{what} {n}" for what, n in sorted(found.items())))
