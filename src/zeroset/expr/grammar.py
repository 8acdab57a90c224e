"""From `grammar.lark` to LALR(1) tables, and the small machine that runs them.

Lark checks the grammar and computes the tables when the grammar changes (`write()` brings
`tables.json` up to date, and a test holds the two together). At run time only the tables are read: importing Lark and
analysing
the grammar would cost every start of the program some 60 ms, a tenth of its budget, and the machine that runs the
tables is thirty lines. It keeps its own stack, so depth costs no recursion.
"""

from __future__ import annotations

import json
import os
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from zeroset.errors import FormulaError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

__all__ = ["END", "Tables", "Token", "compiled", "run", "tables", "write"]

END = "$END"
_HERE = os.path.dirname(__file__)
_GRAMMAR = os.path.join(_HERE, "grammar.lark")
_TABLES = os.path.join(_HERE, "tables.json")


class Token(NamedTuple):
    """A terminal of the grammar."""

    kind: str
    text: str
    position: int


class Tables(NamedTuple):
    """The LALR(1) automaton.

    Attributes:
        start: The first state.
        accept: The state whose arrival at the end of the text means success.
        states: For each state, by symbol: the next state, or -1 - r to reduce by rule r.
        rules: For each rule: the symbol it makes, how many it takes, and its action's name ("" for a
            rule that hands on its only part).
    """

    start: int
    accept: int
    states: list[dict[str, int]]
    rules: list[tuple[str, int, str]]


@cache
def tables() -> Tables:
    """The tables that come with the package."""
    with open(_TABLES, encoding="utf-8") as file:
        raw = json.load(file)
    return Tables(raw["start"], raw["accept"], raw["states"], [tuple(rule) for rule in raw["rules"]])


def compiled() -> Tables:
    """The tables of `grammar.lark` as Lark computes them now."""
    import lark

    with open(_GRAMMAR, encoding="utf-8") as file:
        parser: Any = lark.Lark(file.read(), parser="lalr")
    table = parser.parser.parser._parse_table
    start = table.start_states["start"]
    # Lark's numbers change from run to run; here states count in the order in which they are reached.
    numbers = {start: 0}
    reached = [start]
    rules: list[tuple[str, int, str]] = []
    known: dict[Any, int] = {}
    states: list[dict[str, int]] = []
    for state in reached:
        row: dict[str, int] = {}
        for symbol, (action, target) in sorted(table.states[state].items(), key=lambda item: str(item[0])):
            if str(action) == "Shift":
                if target not in numbers:
                    numbers[target] = len(reached)
                    reached.append(target)
                row[str(symbol)] = numbers[target]
                continue
            if target not in known:
                known[target] = len(rules)
                rules.append((str(target.origin.name), len(target.expansion), str(target.alias or "")))
            row[str(symbol)] = -1 - known[target]
        states.append(row)
    return Tables(0, numbers[table.end_states["start"]], states, rules)


def run(
    automaton: Tables,
    tokens: Iterable[Token],
    actions: Mapping[str, Callable[..., Any]],
    unexpected: Callable[[Token], FormulaError],
) -> Any:
    """What the actions make of the tokens, whose last must be of kind `END`.

    Args:
        automaton: The tables.
        tokens: The text.
        actions: By name of the rule: takes the values of the rule's parts, tokens as they are.
        unexpected: Makes the error for a token that cannot stand where it does.
    """
    states, rules = automaton.states, automaton.rules
    stack = [automaton.start]
    values: list[Any] = []
    for token in tokens:
        while True:
            step = states[stack[-1]].get(token.kind)
            if step is None:
                raise unexpected(token)
            if step >= 0:
                break
            symbol, length, name = rules[-1 - step]
            if name:
                values[-length:] = [_acted(actions[name], values[-length:], token)]
            del stack[-length:]
            stack.append(states[stack[-1]][symbol])
            if token.kind == END and stack[-1] == automaton.accept:
                return values[0]
        stack.append(step)
        values.append(token)
    raise unexpected(Token(END, "", 0))


def _acted(action: Callable[..., Any], parts: list[Any], ahead: Token) -> Any:
    """The action's value; an error without a place gets that of the rule's first token."""
    try:
        return action(*parts)
    except FormulaError as error:
        if error.position is None:
            place = next((part for part in parts if isinstance(part, Token)), ahead)
            error.position, error.length = place.position, max(1, len(place.text))
        raise


def write() -> None:
    """Bring `tables.json` up to date with `grammar.lark`."""
    with open(_TABLES, "w", encoding="utf-8") as file:
        file.write(json.dumps(compiled()._asdict(), separators=(",", ":")) + "\n")
