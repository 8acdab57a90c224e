"""What the truth suite notes for the summary: rays judged, those that Arb left open by surface, answers by method.

Notes travel with a test's report, so it does not matter which process ran the test.
"""

from __future__ import annotations

from collections import Counter

import pytest

from .held import Account


class Report:
    """What a test adds to the summary."""

    def __init__(self, notes: list[tuple[str, object]]) -> None:
        self._notes = notes

    def judged(self, name: str, rays: int, unsettled: int) -> None:
        """A surface's rays, and how many of them Arb left open."""
        self._notes.append(("truth judged", [name, rays, unsettled]))

    def held(self, method: str, account: Account) -> None:
        """What one method answered."""
        extra = Counter({"false alarm": account.false_alarms, "open hit": account.open_hits})
        self._notes.append(("truth held", [method, dict(account.statuses + extra)]))


@pytest.fixture
def report(request: pytest.FixtureRequest) -> Report:
    return Report(request.node.user_properties)
