from __future__ import annotations

from itertools import combinations

import pytest

from zeroset.figures import find, names
from zeroset.figures.layout import LINE, NARROWEST, Plan, panel_size, plan, wrapped
from zeroset.figures.page import width_of

Box = tuple[float, float, float, float]
SIZES = (8, 40, 56, 90, 200, 420, 1000)


def page(name: str, side: int, label: str | None = None) -> Plan:
    figure = find(name)
    labels = [panel.label if label is None else label for panel in figure.panels]
    return plan(figure, labels, side, width_of)


def boxes(made: Plan) -> list[Box]:
    """Left, top, right and bottom of everything on a page."""
    wide, high = made.panel
    found: list[Box] = [(x, y, x + wide, y + high) for x, y in made.corners]
    for text in made.texts:
        width = width_of(text.text, text.size)
        left = text.x - width / 2 if text.middle else text.x
        found.append((left, text.y, left + width, text.y + text.size * LINE - 1))
    return found


def apart(a: Box, b: Box) -> bool:
    return a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


@pytest.mark.parametrize("side", SIZES)
@pytest.mark.parametrize("name", names())
def test_nothing_overlaps_and_all_is_on_the_page(name: str, side: int):
    made = page(name, side)
    found = boxes(made)
    assert len(made.corners) == len(find(name).panels)
    assert all(apart(a, b) for a, b in combinations(found, 2))
    for left, top, right, bottom in found:
        assert 0 <= left < right <= made.width
        assert 0 <= top < bottom <= made.height


def test_long_labels_overlap_nothing():
    made = page("sn10-12", 120, "a label of very many words that goes on and on until nobody wants to read it any more")
    assert all(apart(a, b) for a, b in combinations(boxes(made), 2))
    assert any(text.text.endswith("…") for text in made.texts)


def test_labels_stand_under_their_panels():
    made = page("k09-8", 300)
    under = [text for text in made.texts if text.middle]
    assert [text.text for text in under] == ["Barth's sextic", "Barth's decic"]
    for (x, y), text in zip(made.corners, under, strict=True):
        assert text.x == x + 150
        assert y + 300 < text.y < y + 320


def test_small_panels_have_no_labels():
    assert not [text for text in page("k09-8", NARROWEST - 1).texts if text.middle]
    assert [text for text in page("k09-8", NARROWEST).texts if text.middle]


def test_panels_that_do_not_fit_go_on_below():
    made = page("sn10-12", 100)
    assert len({y for _, y in made.corners}) == 4
    assert len({x for x, _ in made.corners}) == 8


def test_panels_can_be_flat():
    assert panel_size(find("k09-11"), 100) == (100, 60)


def test_lines_are_cut_where_there_is_no_room():
    assert wrapped("alpha beta gamma", 10, len, 5) == ["alpha beta", "gamma"]
    assert wrapped("alphabet", 4, len, 5) == ["alp…"]
    assert wrapped("", 4, len, 5) == []
    for line in wrapped("one two three four five", 9, len, 2):
        assert len(line) <= 9
