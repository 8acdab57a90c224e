"""The one DAG that every way of writing a formula ends in: immutable, hash-consed nodes.

`node` hands out the node of an operator, arguments and data; equal nodes are one object, so structural
identity is object identity and common subexpressions are shared without a pass. Rewriting is the business of
`zeroset.expr.build`.

Nothing here recurses: formulas may be a hundred thousand operations deep.
"""

from __future__ import annotations

import threading
import weakref
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from zeroset.errors import FormulaError
from zeroset.expr.facts import CONDITION, NONNEGATIVE, POSITIVE, TOTAL, check_kinds, flags_of
from zeroset.expr.operators import Operators
from zeroset.expr.ops import OPS, Data
from zeroset.hashes import blake2b

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

__all__ = ["PI", "Data", "Expr", "constant", "made_so_far", "node", "postorder", "rational"]

Symbol = tuple[str, str]


class Expr(Operators):
    """One operation of a formula; get nodes from `parse`, `trace`, `from_sympy`, or operators.

    Attributes:
        op: Name of the operator, a row of `zeroset.expr.ops.OPS`.
        args: The nodes it is applied to.
        data: What else the operator needs: a constant's value, a name, an exponent.
        symbols: The names it depends on, as (kind, name): `variable`, `parameter`, `array`, `index`.
        flags: What is known of its domain and sign (see `zeroset.expr.facts`).

    Example:
        >>> from zeroset.expr import parse
        >>> f = parse("x^2 + y^2 - 1")
        >>> f * f is f**2
        True
    """

    __slots__ = ("__weakref__", "_digest", "args", "data", "flags", "op", "symbols")

    op: str
    args: tuple[Expr, ...]
    data: Data
    symbols: frozenset[Symbol]
    flags: int
    _digest: bytes | None

    def _names(self, kind: str) -> frozenset[str]:
        return frozenset(name for of, name in self.symbols if of == kind)

    @property
    def variables(self) -> frozenset[str]:
        """Those of x, y, z, w it depends on."""
        return self._names("variable")

    @property
    def parameters(self) -> frozenset[str]:
        """The scalar parameters it depends on."""
        return self._names("parameter")

    @property
    def arrays(self) -> frozenset[str]:
        """The array parameters it depends on."""
        return self._names("array")

    @property
    def indices(self) -> frozenset[str]:
        """The indices of enclosing sums it depends on; empty for a whole formula."""
        return self._names("index")

    @property
    def is_constant(self) -> bool:
        """Whether it depends on no variable and no parameter."""
        return not self.symbols

    @property
    def is_condition(self) -> bool:
        """Whether its value is a truth rather than a number."""
        return bool(self.flags & CONDITION)

    @property
    def is_total(self) -> bool:
        """Whether it is known to be defined at every real point."""
        return bool(self.flags & TOTAL)

    @property
    def is_nonnegative(self) -> bool:
        """Whether it is known to be >= 0 wherever it is defined."""
        return bool(self.flags & NONNEGATIVE)

    @property
    def is_positive(self) -> bool:
        """Whether it is known to be > 0 wherever it is defined."""
        return bool(self.flags & POSITIVE)

    @property
    def size(self) -> int:
        """Number of distinct operations, leaves included."""
        return sum(1 for _ in postorder(self))

    @property
    def digest(self) -> str:
        """Hexadecimal hash of the content, the same in every process; equal iff the formulas are."""
        for part in postorder(self, lambda item: () if item._digest else item.args):
            if part._digest is None:
                part._digest = _hash(part)
        return (self._digest or b"").hex()

    # Nodes are immutable and shared, so a copy is the node itself.
    def __copy__(self) -> Expr:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Expr:
        return self

    def __reduce__(self) -> tuple[Callable[..., Expr], tuple[object, ...]]:
        numbers: dict[Expr, int] = {}
        rows = []
        for part in postorder(self):
            rows.append((part.op, tuple(numbers[arg] for arg in part.args), part.data))
            numbers[part] = len(numbers)
        return _from_rows, (tuple(rows),)

    def __repr__(self) -> str:
        from zeroset.expr.text import brief

        return f"Expr({brief(self)!r})"

    def __str__(self) -> str:
        from zeroset.expr.text import text

        return text(self)


_Key = tuple[str, tuple[Expr, ...], Data]
_nodes: weakref.WeakValueDictionary[_Key, Expr] = weakref.WeakValueDictionary()
_lock = threading.Lock()


class _Made(threading.local):
    """How many nodes a thread has made."""

    count = 0


_made = _Made()
_NO_SYMBOLS: frozenset[Symbol] = frozenset()


def node(op: str, args: tuple[Expr, ...] = (), data: Data = ()) -> Expr:
    """The node of an operator as it stands, without rewriting (`build` rewrites).

    Raises:
        FormulaError: A truth stands where a number belongs, or the other way round.
    """
    key = (op, args, data)
    found = _nodes.get(key)
    if found is not None:
        return found
    check_kinds(op, args)
    made = object.__new__(Expr)
    made.op = op
    made.args = args
    made.data = data
    made.symbols = _symbols(op, args, data)
    made.flags = flags_of(op, args, data)
    made._digest = None
    _made.count += 1
    with _lock:
        return _nodes.setdefault(key, made)


def made_so_far() -> int:
    """How many nodes this thread has made: the measure of work that limits are put on."""
    return _made.count


def constant(value: int | Fraction) -> Expr:
    """The node of an exact rational number."""
    return node("const", (), (value if isinstance(value, Fraction) else Fraction(value),))


def rational(expr: Expr) -> Fraction | None:
    """The value of a rational constant, None for any other node."""
    if expr.op == "const":
        value = expr.data[0]
        return value if isinstance(value, Fraction) else None
    return None


def postorder(root: Expr, needs: Callable[[Expr], Iterable[Expr]] | None = None) -> Iterator[Expr]:
    """All distinct nodes under `root`, arguments before their users, the root last.

    Args:
        root: Where to start.
        needs: The nodes to visit before a node; its arguments by default.
    """
    done: set[Expr] = set()
    stack = [root]
    while stack:
        top = stack[-1]
        if top in done:
            stack.pop()
            continue
        waiting = [arg for arg in (needs(top) if needs else top.args) if arg not in done]
        if waiting:
            stack.extend(reversed(waiting))
        else:
            stack.pop()
            done.add(top)
            yield top


def _symbols(op: str, args: tuple[Expr, ...], data: Data) -> frozenset[Symbol]:
    """The names a node depends on; sets are shared between nodes where they are equal."""
    if not args:
        return _symbols_of_leaf(op, data)
    symbols = args[0].symbols
    for arg in args[1:]:
        if arg.symbols is not symbols and not arg.symbols <= symbols:
            symbols = arg.symbols if symbols <= arg.symbols else symbols | arg.symbols
    if op == "sum":
        bound = ("index", str(data[0]))
        symbols = (symbols - {bound}) | {("array", str(name)) for name in data[1:]}
    return symbols


def _symbols_of_leaf(op: str, data: Data) -> frozenset[Symbol]:
    if op == "const":
        return _NO_SYMBOLS
    if op == "element":
        return frozenset({("array", str(data[0])), ("index", str(data[1]))})
    return frozenset({(op, str(data[0]))})


def _hash(part: Expr) -> bytes:
    """Hash of a node whose arguments have theirs."""
    content = blake2b(repr((part.op, part.data)).encode(), digest_size=16)
    for arg in part.args:
        content.update(arg._digest or b"")
    return content.digest()


def _from_rows(rows: tuple[tuple[str, tuple[int, ...], Data], ...]) -> Expr:
    """The node that `__reduce__` has taken apart."""
    parts: list[Expr] = []
    for op, args, data in rows:
        if op not in OPS:
            raise FormulaError(f"a stored formula has the unknown operator {op!r}")
        parts.append(node(op, tuple(parts[index] for index in args), data))
    return parts[-1]


PI = node("const", (), ("pi",))
"""The one constant leaf that is no rational."""
