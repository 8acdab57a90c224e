"""What is known of jumps, poles and ends of domains."""

from __future__ import annotations

import pytest

from zeroset.expr import continuous, parse


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x^2 + sin(y) - exp(z)", True),
        ("1/(x^2 + y^2 + a)", True),
        ("sum(i, r[i]/((x - r[i])^2 + a))", True),
        ("|x|^a + |y|^a", True),
        ("sqrt(x^2 + y^2) + max(x, |y|)", True),
        ("log(1 + x^2)", True),
        ("1/x", False),
        ("sin(x)/x", False),
        ("x^a", False),
        ("sqrt(1 - x^2)", False),
        ("log(x)", False),
        ("asin(x)", False),
        ("tan(x)", False),
        ("floor(x)", False),
        ("(mod(x, 1) - 1/2)^2", False),
        ("atan2(y, x)", False),
        ("if(x < 1, x, 1)", False),
        ("sign(x)", False),
    ],
)
def test_what_may_jump_or_have_no_value_is_known(text: str, expected: bool) -> None:
    assert continuous(parse(text, params=["a"], arrays=["r"])) is expected
