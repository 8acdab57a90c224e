"""The certified search: the first interval of t, along one ray, that can hold a root.

One loop serves every enclosing number system and every walk. Each turn evaluates f on one interval [a, b]:

- excluded: f keeps one sign there, which is remembered;
- an affine form cuts it to the part [left, right] that can hold roots, and tells the sign on either side of it;
- as narrow as the tolerance and still not excluded: it joins the *zone*, and the walk goes on behind it. The first
  stretch behind the zone where f has a certain sign decides: the other sign than before the zone proves a root inside
  (HIT); the same sign, or a zone that does not end within three intervals, is UNRESOLVED.

So existence costs no evaluations of its own, and nothing is claimed that an enclosure has not shown.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from zeroset.arith import AffineSystem
from zeroset.kernel import BOOL, F64, U32, Value, constant, while_
from zeroset.solve.compound import Turn, look_at, note_parts
from zeroset.solve.haze import beside_haze, look_around, mixed, sees_signs, through_a_pole
from zeroset.solve.look import Interval, Look, read, stretch
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.status import HIT, MISS, UNRESOLVED
from zeroset.solve.walk import State, Walk

ZONE = 3
"""How many narrowest intervals in a row may join before the search gives up on proving their sign change."""
HAZE = 48
"""The same where f may jump or have no value: beside such a place enclosures are wide over many of them."""
GRAZING = 48
"""Evaluations that getting away from the surface that a ray comes from may take."""
PATIENCE = 1 << 15
"""Evaluations in f64, whose narrowest intervals are 2^-26 of the bounds, after which the rest of a ray is left open."""
BLUNT = 0.25
"""What a cut leaves of an interval around a simple root is less; around a triple one, a third, where bends are kept."""


def look(problem: Problem, system: Any, a: Value, b: Value) -> Look:
    """Evaluate what is searched on [a, b] and read off what it proves."""
    over = Interval.between(a, b)
    t = stretch(system, over.middle, over.half)
    if problem.body is not None:
        return look_at(problem, problem.body, system, t, over)
    f = problem.lowered.along(system, problem.ray, t)
    seen = read(problem, f, over)
    if not problem.lowered.has_poles:
        return seen
    pole = problem.lowered.beside_poles(f, seen.excluded, lambda other: other.along(system, problem.ray, t))
    return seen.without(pole)


def _differ(problem: Problem, a: Value, b: Value) -> Value:
    """Whether two signs, or two labels of isovalues, are both known and not the same."""
    return a.ne(0.0) & b.ne(0.0) & a.ne(b) if problem.levels else a * b < 0.0


def _bends(system: Any) -> bool:
    """Whether forms keep their bend: then a slope proves even a triple root, where the gradient vanishes."""
    return isinstance(system, AffineSystem) and system.curved


class _Zone(NamedTuple):
    """Narrowest intervals in a row that could not be excluded, and the last certain sign before them."""

    sign: Value
    length: Value
    start: Value
    whole: Value
    mark: Value | None = None
    signs: Value | None = None

    def components(self) -> State:
        return self.sign, self.length, self.start, self.whole

    def more(self) -> State:
        """The parts that they can be of, where there is a choice; the signs seen in between, where f has haze."""
        return tuple(v for v in (self.mark, self.signs) if v is not None)

    def having(self, more: State) -> _Zone:
        """The zone with other such values."""
        left = list(more)
        mark = None if self.mark is None else left.pop(0)
        return self._replace(mark=mark, signs=None if self.signs is None else left.pop(0))


def search(
    problem: Problem,
    system: Any,
    walk: Walk,
    wanted: Value | None = None,
    delta: Value | None = None,
    leaving: Value | None = None,
) -> Answer:
    """The first root along the ray, with proof; see the module's text.

    Args:
        problem: the ray.
        system: encloses f.
        walk: which interval is looked at next.
        wanted: lanes that shall search; the others do nothing.
        delta: where above 0, an interval counts as narrowest only once f is enclosed to this width (K09 6.1.2), or
            the walk cannot go deeper.
        leaving: lanes whose ray comes from a surface: what cannot be told from its beginning, for f has had no certain
            sign since then, is that surface and is passed by.
    """
    first = walk.start(problem)
    n = len(first)
    none = constant(0, U32)
    alive = problem.t1 > problem.t0
    if wanted is not None:
        alive = alive & wanted
    zone = _Zone(
        problem.number(0.0),
        none,
        problem.t0,
        constant(True, BOOL),
        None if problem.body is None else none,
        none if sees_signs(problem) else None,
    )

    patient, begun = problem.type == F64, zone

    def running(*state: Value) -> Value:
        return state[n] & (state[n + 7] < PATIENCE) if patient else state[n]

    def turn(*state: Value) -> State:
        sign, length, begins, whole = state[n + 1 : n + 5]
        zone = _Zone(sign, length, begins, whole, begun.mark, begun.signs).having(state[n + 12 :])
        passing = None if leaving is None else leaving & (state[n + 7] < GRAZING)
        found, place, zone = _turn(problem, system, walk, delta, state[:n], zone, passing)
        over = found.status.ne(MISS) | walk.ended(problem, place)
        told = found.status, found.t, state[n + 7] + 1, *found.rest
        return *place, ~over, *zone.components(), *told, *zone.more()

    begin = (constant(MISS, U32), problem.t0, none, problem.t0, problem.number(0.0), problem.t0, constant(False, BOOL))
    state = while_(running, turn, *first, alive, *zone.components(), *begin, *zone.more())
    # Where the slope is known it leaves little of the narrowest intervals that can hold the root.
    status, t, steps, clear, side, end, blunt, *more = state[n + 5 :]
    if patient:
        given_up, (reached, _) = state[n], walk.interval(problem, state[:n])
        status = given_up.select(constant(UNRESOLVED, U32), status)
        t, clear = (given_up.select(reached, place) for place in (t, clear))
        end = given_up.select(problem.t1, end)
    blunt = blunt | ((state[n + 2] > 0) & (end - clear > problem.tolerance * (BLUNT if _bends(system) else 0.5)))
    return Answer(t, status, steps, clear, side, end, zone.having(tuple(more)).mark, blunt)


def _mark_of(mark: Value | None) -> Value:
    """The parts of a look, or of a zone, of a solid."""
    assert mark is not None
    return mark


def _on_a_shared_face(problem: Problem, before: Value, after: Value, mark: Value | None) -> Value:
    """Whether what lies between two certain signs is but a face that parts of a solid share.

    What is taken off along a face takes the face with it; two parts that lie side by side have no wall between them,
    and two that are taken off leave none.
    """
    direct, taken = (constant(bits, U32) for bits in problem.orientations)
    mark = _mark_of(mark)
    off = (mark & taken).ne(0)
    both, several, other = (mark & direct).ne(0) & off, (mark & (mark - 1)).ne(0), (mark & (~taken)).ne(0)
    shared = both | (several & ((before < 0.0) | ~other))
    return shared & before.ne(0.0) & before.eq(after)


def _passed(zone: _Zone, passed: Value) -> _Zone:
    """The zone, or none where it is passed over."""
    return zone._replace(length=passed.select(constant(0, U32), zone.length))


class _Found(NamedTuple):
    """What a turn found; the rest is where it may begin, the sign before that, where it ends, and how bluntly."""

    status: Value
    t: Value
    rest: tuple[Value, Value, Value, Value]


def _turn(
    problem: Problem,
    system: Any,
    walk: Walk,
    delta: Value | None,
    place: State,
    zone: _Zone,
    passing: Value | None,
) -> tuple[_Found, State, _Zone]:
    """One evaluation and what follows from it."""
    a, b = walk.interval(problem, place)
    seen = look(problem, system, a, b)
    skipped = b <= a
    excluded = seen.excluded | skipped
    # The form's error shrinks with the square of the width that is looked at: a cut alone is no reason to give up.
    narrowest = walk.narrowest(problem, place, b - a) & ~excluded
    if delta is not None:
        narrowest = narrowest & ((seen.width <= delta) | (delta <= 0.0) | walk.deepest(place))
    proven = seen.crosses & (seen.right - seen.left <= problem.tolerance)
    in_zone = zone.length > 0
    cut = ~excluded & (seen.left > a)

    # A stretch with a certain sign behind the zone closes it: all of [a, b], or [a, left).
    closes = in_zone & ((excluded & ~skipped) | cut)
    changes = _differ(problem, zone.sign, seen.before)
    shared = problem.shares_faces
    if problem.hazy:
        changes = changes | through_a_pole(problem, zone.start, a, closes & ~zone.whole & ~changes)
    if problem.hazy or shared:
        # f jumps or has no value in the zone, and the same sign on either side: no surface, and no zone any more.
        over = (
            ~zone.whole & ~changes & ~mixed(zone.signs, zone.sign, seen.before)
            if problem.hazy
            else constant(False, BOOL)
        )
        if shared:
            over = over | _on_a_shared_face(problem, zone.sign, seen.before, zone.mark)
        zone, closes = _passed(zone, closes & over), closes & ~over
        in_zone = zone.length > 0
    joins = narrowest & ~closes
    if passing is not None:
        # A sign that is certain for less than the tolerance may be that beside the surface that the ray comes from.
        begins = passing & zone.sign.eq(0.0) & (seen.left - a < problem.tolerance)
        joins = joins & (~begins | proven)
        cut = cut & ~begins
    start = in_zone.select(zone.start, seen.left)
    firm, signs = seen.defined, zone.signs
    if signs is not None:
        haze, inside = look_around(problem, a, seen.right, joins)
        firm, signs = firm & ~haze, in_zone.select(signs, constant(0, U32)) | inside
    elif problem.hazy:
        firm = firm & ~beside_haze(problem, a, b, joins & firm)
    whole = (~in_zone | zone.whole) & firm
    sign = cut.select(seen.before, zone.sign)
    # Right of what joins, up to b, the sign may be known as well: then the zone closes at once.
    ends = joins & (seen.right < b)
    turns = _differ(problem, sign, seen.after)
    passed = constant(False, BOOL)
    if problem.hazy:
        turns = turns | through_a_pole(problem, start, seen.right, ends & ~whole & ~turns)
        passed = ends & ~whole & ~turns & ~mixed(signs, sign, seen.after)
    if shared:
        own = in_zone.select(_mark_of(zone.mark), constant(0, U32)) | _mark_of(seen.mark)
        passed = passed | (ends & _on_a_shared_face(problem, sign, seen.after, own))
    crossed = (closes & changes & zone.whole) | (ends & turns & whole)
    full = joins & (zone.length >= (HAZE if problem.hazy or shared else ZONE) - 1)
    if problem.hazy:
        crossed = crossed & (zone.length < ZONE)
    if problem.hazy or shared:
        ends, full = ends & ~passed, full & ~passed
    hit = crossed | (proven & ~closes)
    unresolved = (closes | ends | full) & ~hit

    done = excluded
    if problem.hazy or shared:
        # What ends where it began would be looked at for ever.
        done = done | passed
    left_place = walk.leave(problem, place, done.select(b, seen.right), narrowest)
    cut_place = walk.narrow(problem, place, seen.left, seen.right)
    moved = tuple((excluded | narrowest).select(x, y) for x, y in zip(left_place, cut_place, strict=True))

    trailing = walk.ended(problem, moved) & (in_zone | joins) & ~hit
    status = hit.select(HIT, (unresolved | trailing).select(constant(UNRESOLVED, U32), MISS))
    end = closes.select(a, seen.right)
    learnt = cut | (seen.excluded & ~skipped)
    after = _Zone(
        learnt.select(seen.before, zone.sign),
        joins.select(zone.length + 1, zone.length),
        joins.select(start, zone.start),
        joins.select(whole, zone.whole),
        signs=signs,
    )
    if problem.hazy or shared:
        after = _passed(after._replace(sign=passed.select(seen.after, after.sign)), passed)
    # What closes a zone lies behind it; the sign before it was learnt earlier.
    side = closes.select(zone.sign, proven.select(seen.before, sign))
    if zone.mark is not None:
        mark, side = note_parts(problem, Turn(seen, zone.mark, in_zone, joins, proven, closes, hit, side))
        after = after._replace(mark=mark)
    blunt = proven & (seen.right - seen.left > (b - a) * BLUNT) if _bends(system) else constant(False, BOOL)
    t = (start + end) * 0.5
    if problem.hazy:
        # Behind a jump f has another gradient: all of a wall shows that of the side which is seen.
        t = (hit | closes.select(zone.whole, whole)).select(t, start)
    return _Found(status, t, (start, side, end, blunt)), moved, after
