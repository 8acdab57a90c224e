from __future__ import annotations

import threading
from functools import partial

import pytest

from zeroset.runtime.coming import side_by_side


def test_things_are_begun_in_their_order() -> None:
    begun: list[int] = []

    def make(number: int) -> int:
        begun.append(number)
        return number * number

    coming = side_by_side({number: partial(make, number) for number in range(20)}, 1)
    assert [coming[number].result() for number in range(20)] == [number * number for number in range(20)]
    assert begun == list(range(20))


def test_no_more_are_under_way_than_may_be() -> None:
    under_way = threading.Semaphore(0)
    finish = threading.Event()

    def make() -> None:
        under_way.release()
        finish.wait()

    coming = side_by_side(dict.fromkeys("abc", make), 2)
    assert under_way.acquire(timeout=10)
    assert under_way.acquire(timeout=10)
    assert not under_way.acquire(timeout=0.05)
    assert not any(one.done() for one in coming.values())
    finish.set()
    for one in coming.values():
        one.wait()
        assert one.done()


def test_an_error_is_raised_where_the_thing_is_asked_for() -> None:
    def fail() -> int:
        raise KeyError("no")

    coming = side_by_side({"bad": fail, "good": lambda: 1}, 1)
    for _ in range(2):
        with pytest.raises(KeyError):
            coming["bad"].result()
    assert coming["bad"].done()
    assert coming["good"].result() == 1


def test_nothing_to_do() -> None:
    assert side_by_side({}, 5) == {}
