"""From text to the tokens of the grammar.

What a sign means depends on whether an operand has just ended: there `-` subtracts, elsewhere it negates; there a
name or a parenthesis starts an implied product (JUX), elsewhere an operand; and `|` closes an absolute value if one
is open and opens one otherwise. So that is settled here, in one pass that also keeps the stack of open brackets and the
limits, and most mistakes are found here, where their place and cure are known.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from zeroset.errors import FormulaError, FormulaLimitError
from zeroset.expr import limits
from zeroset.expr.complaints import foreign, function_alone, missing_value, two_values, unclosed, unopened
from zeroset.expr.grammar import END, Token

if TYPE_CHECKING:
    from collections.abc import Iterator

    from zeroset.expr.names import Names

__all__ = ["tokens"]

_SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_LETTER_CONSTANTS = {"π": "pi", "φ": "phi", "ϕ": "phi"}
_FRACTIONS = "¼½¾⅐⅑⅒⅓⅔⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"
_SPECIAL = _SUPERSCRIPTS + _FRACTIONS + "".join(_LETTER_CONSTANTS)
_PATTERN = re.compile(
    rf"(?P<NUMBER>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[{_FRACTIONS}])"
    rf"|(?P<LETTER>[{''.join(_LETTER_CONSTANTS)}])"
    rf"|(?P<NAME>[^\W\d{_SPECIAL}][^\W{_SPECIAL}]*)"
    rf"|(?P<SUPERSCRIPT>⁻?[{_SUPERSCRIPTS}]+)"
    r"|(?P<SIGN>\*\*|<=|>=|[-−–+*·×⋅∗/÷^(),\[\]|=<>≤≥√])"
    r"|(?P<SPACE>\s+)"
)
_SIGNS = {
    "+": "ADD", "-": "SUB", "−": "SUB", "–": "SUB", "*": "MUL", "·": "MUL", "×": "MUL", "⋅": "MUL", "∗": "MUL",
    "/": "DIV", "÷": "DIV", "^": "POW", "**": "POW", "(": "LPAR", ")": "RPAR", "[": "LSQB", "]": "RSQB",
    ",": "COMMA", "=": "EQUALS", "√": "ROOT", "|": "BAR",
    "<": "COMPARE", "<=": "COMPARE", "≤": "COMPARE", ">": "COMPARE", ">=": "COMPARE", "≥": "COMPARE",
}  # fmt: skip
_STARTS = frozenset({"NUMBER", "NAME", "FUNCTION", "ARRAY", "SUM", "ROOT", "LPAR", "BAR", "NOT"})
_ENDS = frozenset({"NUMBER", "NAME", "INDEX", "RPAR", "RSQB", "ENDBAR", "SUPERSCRIPT"})
_CLOSERS = {"RPAR": "LPAR", "RSQB": "LSQB"}


def tokens(text: str, names: Names) -> Iterator[Token]:
    """The tokens of a formula, `END` last.

    Raises:
        FormulaError: A character, bracket, or value stands where it cannot.
        FormulaLimitError: The text is too long or too deeply nested.
    """
    if len(text) > limits.TEXT:
        raise FormulaLimitError(
            f"the formula has {len(text):,} characters; at most {limits.TEXT:,} are read",
            hints=("put repeated data into an array parameter: sum(i, ... c[i] ...)",),
        )
    yield from _Reader(text, names).read()


class _Reader:
    """The state of the pass: the token before, and the brackets that are open."""

    def __init__(self, text: str, names: Names) -> None:
        self.text = text
        self.names = names
        self.before = Token("", "", 0)
        self.open: list[Token] = []
        self.equals = 0

    def read(self) -> Iterator[Token]:
        position, length = 0, len(self.text)
        while position < length:
            match = _PATTERN.match(self.text, position)
            if match is None:
                raise foreign(self.text, position)
            position = match.end()
            if match.lastgroup == "SPACE":
                continue
            token = self._classified(match)
            if self.open and self.open[-1].position == self.before.position and token.kind != "INDEX":
                self._check_index(token)
            if token.kind in _STARTS and self.before.kind in _ENDS:
                if token.kind == "NUMBER":
                    raise two_values(self.text, self.before, token)
                yield Token("JUX", "", token.position)
            elif token.kind not in _STARTS and token.kind != "INDEX":
                self._check_operand(token)
            self._bracket(token)
            self.before = token
            yield from self._letters(token)
        if self.before.kind not in _ENDS:
            raise missing_value(self.text, self.before, Token(END, "", len(self.text.rstrip())))
        if self.open:
            raise unclosed(self.text, self.open[-1])
        yield Token(END, "", length)

    def _letters(self, token: Token) -> Iterator[Token]:
        """A name of variables' letters is their product, letter by letter: xy^2 is x*y^2."""
        name = token.text
        if token.kind != "NAME" or len(name) == 1 or not self.names.is_letters(name):
            yield token
            return
        for offset, letter in enumerate(name):
            if offset:
                yield Token("JUX", "", token.position + offset)
            yield Token("NAME", letter, token.position + offset)

    def _classified(self, match: re.Match[str]) -> Token:
        """The token with its kind as it depends on the left neighbour."""
        kind, text, position = match.lastgroup or "", match.group(), match.start()
        if kind == "LETTER":
            return Token("NAME", _LETTER_CONSTANTS[text], position)
        if kind == "NAME":
            return self._name(text, position, match.end())
        if kind != "SIGN":
            return Token(kind, text, position)
        kind = _SIGNS[text]
        after_operand = self.before.kind in _ENDS
        if kind in {"ADD", "SUB"} and not after_operand:
            kind = "POS" if kind == "ADD" else "NEG"
        elif kind == "BAR" and after_operand and self.open and self.open[-1].kind == "BAR":
            kind = "ENDBAR"
        elif kind == "LSQB" and self.before.kind != "ARRAY":
            raise foreign(self.text, position)
        return Token(kind, text, position)

    def _name(self, name: str, position: int, end: int) -> Token:
        """A name as operand, function, array, index, or word."""
        if self.names.is_word(name):
            return Token(name.upper(), name, position)
        inside = self.open[-1] if self.open else None
        if inside and self.before.kind in {"LPAR", "LSQB"} and inside.text in {"[", "sum("}:
            self.names.indices.add(name)
            return Token("INDEX", name, position)
        follower = self.text[end : end + 200].lstrip()[:1]
        if follower == "[":
            return Token("ARRAY", name, position)
        if follower == "(":
            if name == "sum":
                self._check_sums(position)
                return Token("SUM", name, position)
            if self.names.is_function(name):
                return Token("FUNCTION", name, position)
            if not self.names.is_value(name) and not (self.names.open and len(name) == 1):
                raise self.names.unknown_function(name, position)
        elif self.names.is_function(name) and name not in self.names.params:
            raise function_alone(self.text, name, position)
        return Token("NAME", name, position)

    def _check_index(self, token: Token) -> None:
        """Right after `r[` or `sum(` stands an index."""
        if self.open[-1].text in {"[", "sum("}:
            raise FormulaError(
                "the index of a sum is expected here",
                text=self.text,
                position=token.position,
                hints=("sums over an array parameter r are written sum(i, ... r[i] ...)",),
            )

    def _check_sums(self, position: int) -> None:
        if sum(bracket.text == "sum(" for bracket in self.open) >= limits.SUMS:
            raise FormulaLimitError(
                f"sums go at most {limits.SUMS} deep",
                text=self.text,
                position=position,
                hints=("put the inner sum into an array parameter",),
            )

    def _check_operand(self, token: Token) -> None:
        """Signs that need an operand before them have one; a sign before an operand needs none."""
        prefix = token.kind in {"NEG", "POS", "LSQB"}
        if not prefix and self.before.kind not in _ENDS:
            raise missing_value(self.text, self.before, token)

    def _bracket(self, token: Token) -> None:
        """Keep the stack of open brackets, and refuse what does not belong in the innermost."""
        kind = token.kind
        inside = self.open[-1] if self.open else None
        if kind in {"LPAR", "LSQB", "BAR"}:
            if len(self.open) >= limits.NESTING:
                raise FormulaLimitError(
                    f"the formula is nested too deeply: at most {limits.NESTING:,} levels",
                    text=self.text,
                    position=token.position,
                    hints=("leave out parentheses that are not needed",),
                )
            called = kind == "LPAR" and self.before.kind in {"FUNCTION", "SUM"}
            self.open.append(token._replace(text="sum(" if self.before.kind == "SUM" else "f(") if called else token)
        elif kind == "ENDBAR":
            self.open.pop()
        elif kind in _CLOSERS:
            if inside is None or inside.kind != _CLOSERS[kind]:
                raise unopened(self.text, token, inside)
            self.open.pop()
        elif kind == "COMMA" and (inside is None or inside.text not in {"f(", "sum("}):
            raise FormulaError(
                "this comma is not between the arguments of a function",
                text=self.text,
                position=token.position,
                hints=("write decimals with a point: 0.5", "functions with several arguments: min(x, y)"),
            )
        elif kind == "EQUALS":
            self._check_equals(token)

    def _check_equals(self, token: Token) -> None:
        self.equals += 1
        if self.open:
            message = "this = stands inside brackets: a formula has one = at most, outside all brackets"
            hints = ("compare with < or <= inside if(...)",)
        elif self.equals > 1:
            message = "this is the second =: a formula has one = at most"
            hints = ("draw each equation as a surface of its own",)
        else:
            return
        raise FormulaError(message, text=self.text, position=token.position, hints=hints)
