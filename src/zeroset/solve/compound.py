"""Looks at more than one f = 0: several isovalues of one f, and solids made of several.

A solid is searched as a surface is: what counts is the sign of being outside (+1) or inside (-1), and a hit is a proven
change of it. Each leaf is looked at, and the looks are combined as the booleans are (K09 6.3, "conditions over an
implicit"): where one side decides alone, the other one's roots are none of the solid's. Nothing becomes min or max, so
that the cuts of each affine form survive, and a leaf keeps its own gradient and material.

Isovalues need one evaluation of f. What stands in a sign's place is a label: one more than how many isovalues are
certainly below f, 0 where that is not certain.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from zeroset.kernel import BOOL, U32, Value, constant, lift
from zeroset.solve.body import LoweredBody
from zeroset.solve.look import Interval, Look, read
from zeroset.solve.problem import Problem
from zeroset.solve.shape import Complement, Join, Leaf, Tree


class _Span(NamedTuple):
    """A look of which only what is certain is left.

    Attributes:
        left: every root is at or after it; b where there is none.
        right: every root is at or before it; a where there is none.
        before: the sign from a up to ``left``, 0 where it is not certain.
        after: the sign from ``right`` up to b, 0 where it is not certain.
        defined: whether what can have a root is defined and continuous there.
        width: of the widest enclosure of what can have a root.
        mark: the parts that can have one.
    """

    left: Value
    right: Value
    before: Value
    after: Value
    defined: Value
    width: Value
    mark: Value


def look_at(problem: Problem, body: LoweredBody, system: Any, t: Any, over: Interval) -> Look:
    """Evaluate all of a body over an interval and read off what it proves."""
    if isinstance(body.body.tree, Leaf):
        return _levels(problem, body, body.body.tree, system, t, over)
    span = _solid(problem, body, body.body.tree, system, t, over)
    crosses = (span.before * span.after < 0.0) & span.defined
    excluded = span.left > span.right
    return Look(excluded, crosses, span.defined, span.left, span.right, span.before, span.after, span.width, span.mark)


# ---------------------------------------------------------- isovalues


def _levels(problem: Problem, body: LoweredBody, leaf: Leaf, system: Any, t: Any, over: Interval) -> Look:
    lowered = body.leaf(leaf)
    f = lowered.along(system, problem.ray, t)
    spans = []
    for value in body.isovalues(leaf, system):
        above = f - value
        seen = read(problem, above, over)
        pole = lowered.beside_poles(above, seen.excluded, lambda other: other.along(system, problem.ray, t), value)
        spans.append(_certain(seen.without(pole) if lowered.has_poles else seen, leaf, over))
    left, right = spans[0].left, spans[0].right
    for span in spans[1:]:
        left, right = left.minimum(span.left), right.maximum(span.right)
    before, after = (_label(problem, [getattr(span, side) for span in spans]) for side in ("before", "after"))
    defined = lift(f.defined, BOOL)
    crosses = before.ne(0.0) & after.ne(0.0) & before.ne(after) & defined
    # Which level it is, is known once it is known between which labels.
    return Look(left > right, crosses, defined, left, right, before, after, spans[0].width, constant(leaf.bits, U32))


def _label(problem: Problem, signs: Sequence[Value]) -> Value:
    """One more than how many isovalues are below f, 0 where one of the signs is not certain."""
    count, known = problem.number(1.0), constant(True, BOOL)
    for sign in signs:
        count = count + (sign > 0.0).select(problem.number(1.0), 0.0)
        known = known & sign.ne(0.0)
    return known.select(count, 0.0)


# ---------------------------------------------------------- solids


def _solid(problem: Problem, body: LoweredBody, tree: Tree, system: Any, t: Any, over: Interval) -> _Span:
    match tree:
        case Leaf():
            f = body.leaf(tree).along(system, problem.ray, t)
            seen = read(problem, f, over)
            return _certain(seen if tree.field.total else _inside_where_defined(seen, over), tree, over)
        case Complement():
            span = _solid(problem, body, tree.of, system, t, over)
            return span._replace(before=-span.before, after=-span.after)
        case Join():
            left, right = (_solid(problem, body, each, system, t, over) for each in (tree.left, tree.right))
            return _join(left, right, tree.union)


def _inside_where_defined(seen: Look, over: Interval) -> Look:
    """A look at a solid's leaf, which is inside only where f is known to be defined: where it has no value is outside.

    An enclosure is that of the values that f has, and excludes 0 also where f has none in places.
    """
    defined = lift(seen.defined, BOOL)
    known, later = (defined | (sign > 0.0) for sign in (seen.before, seen.after))
    return seen._replace(
        excluded=seen.excluded & known,
        left=known.select(seen.left, over.a),
        right=later.select(seen.right, over.b),
    )


def _certain(seen: Look, leaf: Leaf, over: Interval) -> _Span:
    """What is certain of one leaf."""
    crosses, excluded = lift(seen.crosses, BOOL), seen.excluded
    before = (excluded | crosses | (seen.left > over.a)).select(seen.before, 0.0)
    after = excluded.select(seen.before, (crosses | (seen.right < over.b)).select(seen.after, 0.0))
    return _Span(
        excluded.select(over.b, seen.left),
        excluded.select(over.a, seen.right),
        before,
        after,
        lift(seen.defined, BOOL) | excluded,
        excluded.select(0.0, seen.width),
        excluded.select(constant(0, U32), leaf.bits),
    )


def _join(u: _Span, v: _Span, union: bool) -> _Span:
    """Both, or one at least: what decides alone is being inside for a union, being outside for an intersection.

    Where a side decides before its first root, nothing of the other counts up to there; likewise after its last one.
    Where the two stretches that are decided meet, nothing at all is left.
    """
    alone = -1.0 if union else 1.0
    left, right = u.left.minimum(v.left), u.right.maximum(v.right)
    for side in (u, v):
        left = side.before.eq(alone).select(left.maximum(side.left), left)
        right = side.after.eq(alone).select(right.minimum(side.right), right)
    # A side with all its roots outside of what is left has none that counts, and one sign there, jump as it may.
    counts = [(s.left <= right) & (s.right >= left) for s in (u, v)]
    marks = [count.select(s.mark, constant(0, U32)) for s, count in zip((u, v), counts, strict=True)]
    pick = Value.minimum if union else Value.maximum
    before, after = pick(u.before, v.before), pick(u.after, v.after)
    # Where there is no root the sign is one and the same, though it may be certain but from one end.
    free = left > right
    return _Span(
        left,
        right,
        (free & before.eq(0.0)).select(after, before),
        (free & after.eq(0.0)).select(before, after),
        (u.defined | ~counts[0]) & (v.defined | ~counts[1]),
        u.width.maximum(v.width),
        marks[0] | marks[1],
    )


# ---------------------------------------------------------- what was met


class Turn(NamedTuple):
    """What a turn of the search came to, for a body of several parts.

    Attributes:
        seen: the look.
        old: the parts that the zone can be of.
        in_zone, joins, proven, closes, hit: masks, as in the search.
        side: the sign or label before what was found.
    """

    seen: Look
    old: Value
    in_zone: Value
    joins: Value
    proven: Value
    closes: Value
    hit: Value
    side: Value


def note_parts(problem: Problem, turn: Turn) -> tuple[Value, Value]:
    """The parts that a turn's find, or the zone so far, can be of; and the sign before it, of what was found."""
    seen = turn.seen
    assert seen.mark is not None
    if problem.levels:
        beyond = turn.closes.select(seen.before, seen.after)
        up = beyond > turn.side
        # With k isovalues below, f is about to reach number k from below, or number k - 1 from above.
        level = (turn.side - up.select(problem.number(1.0), 2.0)).convert(U32)
        met = constant(problem.first_part_bit, U32) << level
        one = problem.number(1.0)
        return turn.hit.select(met, seen.mark), turn.hit.select(up.select(-one, one), 0.0)
    own = seen.mark | turn.in_zone.select(turn.old, constant(0, U32))
    mark = (turn.joins | turn.proven).select(own, turn.old)
    return turn.closes.select(turn.old, mark), turn.side
