"""The formula boxes: when each text was changed, whether it has been read, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from zeroset.view.formula import Complaint, differ
from zeroset.view.item import Item

DEBOUNCE = 0.15
"""Seconds without a keystroke before a formula is compiled."""


@dataclass
class _Box:
    """One box.

    Attributes:
        text: as it was last looked at.
        edited: when it became that.
        asked: what was read last.
        shown: what is drawn.
        refit: whether the bounds of what is to be read are fitted in any case.
        complaint: what is wrong with the text.
    """

    text: str
    asked: str | None
    shown: str
    edited: float = 0.0
    refit: bool = False
    complaint: Complaint | None = None


class Boxes:
    """The boxes of all surfaces.

    Args:
        items: what is there at first; the texts of all that are new mean what is drawn.

    Example:
        >>> import zeroset as zs
        >>> item = Item(0, "x = y", zs.surface("x = y"))
        >>> boxes = Boxes([item])
        >>> boxes.due([item], 1.0), boxes.due([Item(0, "x = 2y", item.surface)], 2.0)
        ([], [])
        >>> [item.text for item in boxes.due([Item(0, "x = 2y", item.surface)], 3.0)]
        ['x = 2y']
    """

    def __init__(self, items: Iterable[Item]) -> None:
        self._known: dict[int, _Box] = {}
        for item in items:
            self._of(item)

    def due(self, items: Iterable[Item], now: float) -> list[Item]:
        """The surfaces whose text is to be read: those that have been left alone for a moment since it was changed."""
        found = []
        for item in items:
            box = self._of(item)
            if item.text != box.text:
                box.text, box.edited = item.text, now
            if box.text != box.asked and now - box.edited >= DEBOUNCE:
                found.append(item)
        return found

    def waiting(self, items: Iterable[Item]) -> bool:
        """Whether any text is still to be read."""
        return any(item.text != self._of(item).asked for item in items)

    def ask(self, item: Item) -> bool:
        """Note that a text is being read; gives whether its bounds are to be fitted though they are the user's own."""
        box = self._of(item)
        refit = box.refit or differ(box.shown, item.text)
        box.text, box.asked, box.refit = item.text, item.text, False
        return refit

    def again(self, item: Item, refit: bool = False) -> None:
        """A text is to be read at once, though it may be the same."""
        box = self._of(item)
        box.text, box.asked, box.edited, box.refit = item.text, None, 0.0, refit

    def take(self, item: Item) -> None:
        """Note that what a surface's text means is known already."""
        box = self._of(item)
        box.text = box.asked = item.text
        box.complaint = None

    def show(self, item: Item) -> None:
        """Note that what was read is drawn."""
        box = self._of(item)
        box.shown = box.text if box.asked is None else box.asked

    def complaint(self, item: Item) -> Complaint | None:
        """What is wrong with a text."""
        box = self._known.get(item.key)
        return None if box is None else box.complaint

    def complain(self, item: Item, complaint: Complaint | None) -> None:
        """Note what is wrong with a text, or that nothing is."""
        self._of(item).complaint = complaint

    def _of(self, item: Item) -> _Box:
        return self._known.setdefault(item.key, _Box(item.text, item.text, item.text))
