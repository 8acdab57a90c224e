from __future__ import annotations

import pytest

from zeroset.errors import FormulaError
from zeroset.expr.grammar import END, Token, compiled, run, tables
from zeroset.expr.names import Names
from zeroset.expr.parse import _Actions


def test_the_tables_are_those_of_the_grammar():
    assert compiled() == tables()


def test_every_alternative_has_its_action_and_every_action_its_alternative():
    named = {name for _, _, name in tables().rules if name}
    assert named == set(_Actions(Names("", (), (), False)).table())


def test_a_rule_without_an_action_hands_on_its_only_part():
    assert all(length == 1 for _, length, name in tables().rules if not name)


def test_the_machine_reports_the_first_token_that_cannot_stand():
    def unexpected(token):
        return FormulaError(token.kind, position=token.position)

    for kinds in (["RPAR"], ["NUMBER", "NUMBER"], ["NUMBER", "ADD", END], []):
        tokens = [Token(kind, "", place) for place, kind in enumerate(kinds)]
        actions = {name: lambda *parts: parts for _, _, name in tables().rules}
        with pytest.raises(FormulaError):
            run(tables(), tokens, actions, unexpected)
