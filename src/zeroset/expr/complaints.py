"""The errors of the tokens: what is wrong, where, and the likely cures, most likely first."""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.errors import FormulaError

if TYPE_CHECKING:
    from zeroset.expr.grammar import Token

__all__ = ["foreign", "function_alone", "missing_value", "two_values", "unclosed", "unexpected", "unopened"]

_FOREIGN = {
    "%": "the remainder is mod(x, y)",
    "!": "there is no factorial; `not` is spelled out",
    "&": "spell it out: and",
    "{": "use round parentheses: ( )",
    "}": "use round parentheses: ( )",
    "[": "brackets index an array parameter: r[i]; for grouping use round parentheses",
    ";": "write one formula at a time",
    ":": "write one formula at a time; = sets both sides equal",
    "'": "for a derivative write it out",
    '"': "leave out the quotes",
    "\\": "write plain text, not LaTeX: sqrt(x), x^2",
    "$": "write plain text, not LaTeX: sqrt(x), x^2",
    "≠": "where two things differ is no surface; compare with < or <=",
    "∞": "write a large number, such as 1e30",
    "½": "write 1/2",
    "∛": "write cbrt(x)",
    "#": "leave out the comment",
    "?": "a choice is if(c, a, b)",
}


def foreign(text: str, position: int) -> FormulaError:
    """A character that no formula has, or a bracket where none can stand."""
    character = text[position]
    hint = _FOREIGN.get(character)
    name = character if character.isprintable() else f"U+{ord(character):04X}"
    return FormulaError(
        f"the character {name} cannot stand here",
        text=text,
        position=position,
        hints=(hint,) if hint else ("formulas are made of numbers, names, + - * / ^ ( ) | |, and comparisons",),
    )


def missing_value(text: str, before: Token, token: Token) -> FormulaError:
    """An operator, bracket, or the end where a value is expected."""
    position = token.position
    if not before.kind and not text.strip():
        return FormulaError("the formula is empty", text=text, position=0, hints=("try x^2 + y^2 + z^2 = 1",))
    if before.kind == "LPAR" and token.kind == "RPAR":
        return FormulaError(
            "there is nothing between these parentheses", text=text, position=position, hints=("put a value there",)
        )
    here = f"before {token.text}" if token.text else "at the end"
    after = f" after {before.text}" if before.text and before.kind != "LPAR" else ""
    hints = ["put a value there: a number, a variable, a function"]
    if before.kind == token.kind == "EQUALS":
        hints.insert(0, "write a single =")
    elif before.kind == "COMPARE" and token.kind == "EQUALS":
        hints.insert(0, "at most is <=, at least is >=")
    elif before.kind == "POW" and token.kind == "POW":
        hints.insert(0, "for a power write ^ or **")
    elif before.text:
        hints.append(f"or take out the {before.text}")
    return FormulaError(f"a value is missing {here}{after}", text=text, position=position, hints=hints)


def two_values(text: str, before: Token, token: Token) -> FormulaError:
    """A number right after a value."""
    left = before.text if before.kind in {"NAME", "NUMBER"} else "..."
    hints = (f"for a product write {left}*{token.text}", f"for a power write {left}^{token.text}")
    if before.kind == "NUMBER":
        hints = (f"for a product write {left}*{token.text}", "a number has no spaces and one decimal point")
    return FormulaError(
        f"the number {token.text} follows a value without an operator between them",
        text=text,
        position=token.position,
        length=len(token.text),
        hints=hints,
    )


def function_alone(text: str, name: str, position: int) -> FormulaError:
    """A function's name without its parentheses."""
    end = position + len(name)
    hints = [f"write {name}(x), with the argument in parentheses"]
    if text[end : end + 1] in {"^", "²", "³"}:
        hints.insert(0, f"write the power after the argument: {name}(x)^2")
    return FormulaError(
        f"the function {name} has no argument",
        text=text,
        position=position,
        length=len(name),
        hints=hints,
    )


def unclosed(text: str, bracket: Token) -> FormulaError:
    """A bracket that is still open at the end."""
    sign = text[bracket.position]
    closing = {"(": ")", "[": "]"}.get(sign, sign)
    hints = [f"add the missing {closing}"]
    if sign == "|":
        hints.append("where nested bars are unclear write abs(...)")
    return FormulaError(f"this {sign} is never closed", text=text, position=bracket.position, hints=hints)


def unopened(text: str, token: Token, inside: Token | None) -> FormulaError:
    """A closing bracket without its opening one."""
    if inside is None:
        opening = "[" if token.text == "]" else "("
        message, hints = f"this {token.text} closes nothing", [f"take it out, or add the missing {opening}"]
    else:
        sign = text[inside.position]
        message = f"this {token.text} comes before the {sign} opened earlier is closed"
        hints = [f"close the {sign} first"]
        if sign == "|":
            hints.append("where nested bars are unclear write abs(...)")
    return FormulaError(message, text=text, position=token.position, hints=hints)


def unexpected(text: str, token: Token) -> FormulaError:
    """Anything else that the grammar has no place for."""
    if token.kind in {"AND", "OR", "NOT", "COMPARE", "COMMA"}:
        hints = ("a condition stands in parentheses or in if(c, a, b)",)
    else:
        hints = ("put an operator between, or parentheses around a part",)
    return FormulaError(
        f"{token.text or 'the end'} cannot stand here",
        text=text,
        position=token.position,
        length=max(1, len(token.text)),
        hints=hints,
    )
