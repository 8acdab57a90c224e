"""A ray and all that comes of it, followed in one loop: what its pixel sees.

Each turn of the loop searches along a ray, adds the colour of what it meets, and goes on with the ray that comes of it
(K09 section 6.2 does so for reflections). Where two rays come of a hit, one waits on a stack, which is memory of the
lane's own; rays that count for next to nothing are not followed, and see what is all around.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from zeroset.kernel import BOOL, F32, U32, Value, constant, if_, load, store, while_
from zeroset.rendering.buffers import STACK, STACK_WORDS
from zeroset.rendering.gbuffer import behind, meet
from zeroset.rendering.measure import Measure
from zeroset.rendering.primary import in_doubles, problem_on, stride
from zeroset.rendering.quantity import Met
from zeroset.rendering.response import BRIGHTEST, Found, Onward, Response
from zeroset.solve.clipping import LOW, can_clip, clipped
from zeroset.solve.field import Ray
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.status import MISS, UNRESOLVED
from zeroset.solve.subject import Subject

FAINTEST = 1.0 / 512
"""Weight under which a ray is not followed."""
Values = tuple[Value, ...]


class Traveller(NamedTuple):
    """A ray under way.

    Attributes:
        ray: the ray.
        start: where the search along it begins.
        weight: what its colour counts for, red, green and blue being treated alike.
        left: how many surfaces it may still meet after the next one, u32.
    """

    ray: Ray
    start: Value
    weight: Value
    left: Value

    def flat(self) -> Values:
        """Its values."""
        return *self.ray.origin, *self.ray.direction, self.start, self.weight, self.left

    @classmethod
    def of(cls, values: Sequence[Value]) -> Traveller:
        """The traveller of such values."""
        return cls(Ray(tuple(values[:3]), tuple(values[3:6])), *values[6:9])


SIZE = STACK_WORDS
"""Values of a traveller."""


class Chain:
    """Follows the rays of one kernel.

    Args:
        response: what comes of a hit.
        measure: what surfaces are coloured by, or None.
        place: the lane's place on the stack.
        step: a first step along camera's rays, from their tile's beam.
        exact: what rays meet, in f64, for those that f32 leaves unresolved; None where they stay so.
    """

    def __init__(
        self,
        response: Response,
        measure: Measure | None,
        place: Value,
        step: Value | None = None,
        exact: Subject | None = None,
    ) -> None:
        self._exact = exact
        # Where no ray goes on, all are a camera's.
        self._step = step if response.optics.plain else None
        self._response = response
        self._measure = measure
        self.measures = measure is not None
        self.ends = response.optics.ends
        self._place = place
        self._builder = response.builder
        self._branches = response.optics.branches
        self.parts = response.subject.shape.parts > 1

    def color(self, first: Traveller, found: Found | None, wanted: Value) -> tuple[Value, ...]:
        """What a ray sees.

        Args:
            first: the ray.
            found: what it has met, where that is known already.
            wanted: lanes that ask.
        """
        zero, none = constant(0.0, F32), constant(0, U32)
        known = () if found is None else self._flat(found)

        def running(going: Value, *state: Value) -> Value:
            return going

        def turn(going: Value, *state: Value) -> Values:
            return self._turn(state, len(known))

        # Whether the ray must still be searched for; colours; how many rays wait; the ray; what is seen where it meets
        # nothing, if not the surroundings; what it has met.
        start = (constant(found is None, BOOL), zero, zero, zero, none, *first.flat(), *self._no_backing(), *known)
        state = while_(running, turn, wanted, *start)
        return tuple(state[2:5])

    def _turn(self, state: Values, known: int) -> Values:
        fresh, r, g, b, waiting = state[:5]
        now = Traveller.of(state[5 : 5 + SIZE])
        backing, given = state[5 + SIZE : len(state) - known], state[len(state) - known :]
        if known:
            found = self._found(if_(fresh, lambda: self._flat(self._search(now)), lambda: given))
        else:
            found = self._search(now)
        answer = if_(found.hit, lambda: self._meet(now, found, waiting), lambda: self._miss(now, waiting, backing))
        going, added, waiting, onward = answer[0], answer[1:4], answer[4], answer[5:]
        going, waiting, onward = self._next(going, waiting, onward)
        color = (r + added[0], g + added[1], b + added[2])
        return going, constant(True, BOOL), *color, waiting, *onward, *given

    # ------------------------------------------------------------ searching

    def _search(self, now: Traveller) -> Found:
        """The next thing along a ray."""
        subject = self._response.subject
        farthest = self._builder.uniform("farthest", F32)
        leaving = now.left.ne(self._builder.uniform("depth", U32))

        def ahead(problem: Problem) -> Answer:
            # A beam has brought its rays close to what they meet; others have to get away from where they begin.
            near = self._step is not None and not can_clip(problem, LOW)
            return stride(problem if near else clipped(problem), leaving)

        answer = subject.nearest(lambda body: problem_on(body, now.ray, now.start, farthest, self._step), ahead)
        end = behind(answer)
        if self._exact is not None:
            answer, end = self._resolved(self._exact, now, answer, end, leaving)
        hit = answer.status.ne(MISS)
        zero = constant(0.0, F32)
        nothing = (zero, zero, zero, *([constant(0, U32)] if self.parts else []))
        met = if_(hit, lambda: meet(subject, now.ray, answer), lambda: nothing)
        value = None
        if self._measure is not None:
            measure, place = self._measure, Met(now.ray, answer.t, answer.steps, met[3] if self.parts else None)
            (value,) = if_(hit, lambda: (measure.at(place),), lambda: (zero,))
        return Found(hit, answer.t, met[:3], answer.clear, end, met[3] if self.parts else None, value)

    def _resolved(
        self, exact: Subject, now: Traveller, answer: Answer, end: Value, leaving: Value
    ) -> tuple[Answer, Value]:
        """What f64 makes of a ray that f32 left unresolved; of layers that it is told to count, rounding is none."""
        farthest = self._builder.uniform("farthest", F32)
        clear = answer.clear

        def flat(found: Answer, end: Value) -> Values:
            mark = () if found.mark is None else (found.mark,)
            numbers = (v.convert(F32) for v in (found.t, found.clear, found.side))
            return found.status, found.steps, end, *numbers, *mark

        def again() -> Values:
            better = exact.nearest(
                lambda body: in_doubles(body, problem_on(body, now.ray, now.start, farthest, None), clear),
                lambda problem: stride(problem, leaving),
            )
            return flat(better, behind(better))

        status, steps, end, t, free, side, *mark = if_(answer.status.eq(UNRESOLVED), again, lambda: flat(answer, end))
        return Answer(t, status, steps, free, side, end, mark[0] if mark else None), end

    def _flat(self, found: Found) -> Values:
        more = [v for v in (found.part, found.value) if v is not None]
        return found.hit, found.t, *found.normal, found.clear, found.end, *more

    def _found(self, values: Sequence[Value]) -> Found:
        hit, t, x, y, z, clear, end, *rest = values
        part = rest.pop(0) if self.parts else None
        return Found(hit, t, (x, y, z), clear, end, part, rest.pop(0) if rest else None)

    # ------------------------------------------------------------ answering

    def _no_backing(self) -> Values:
        zero = constant(0.0, F32)
        return (constant(False, BOOL), zero, zero, zero) if self._response.optics.backed else ()

    def _unmet(self, direction: Sequence[Value], weight: Value, backing: Sequence[Value]) -> Values:
        """What counts where a ray meets nothing more: the surface that it comes from, where that is solid then."""
        seen = self._response.sky(direction)
        if backing:
            known, *own = backing
            seen = [known.select(c, s) for c, s in zip(own, seen, strict=True)]
        return _counted(seen, weight)

    def _miss(self, now: Traveller, waiting: Value, backing: Values) -> Values:
        seen = self._unmet(now.ray.direction, now.weight, backing)
        return constant(False, BOOL), *seen, waiting, *now.flat(), *self._no_backing()

    def _meet(self, now: Traveller, found: Found, waiting: Value) -> Values:
        color, children = self._response.of(now.ray, now.start, found)
        added = _counted(color, now.weight)
        if not children:
            return constant(False, BOOL), *added, waiting, *now.flat(), *self._no_backing()
        going, added, onward = self._send(now, children[0], added)
        if len(children) > 1:
            other, added, waits = self._send(now, children[1], added)
            # Where only one of them goes on, nothing has to wait.
            both = going & other
            if_(both, lambda: self._push(waiting, waits[:SIZE]))
            waiting = both.select(waiting + 1, waiting)
            onward = tuple((other & ~going).select(b, a) for a, b in zip(onward, waits, strict=True))
            going = going | other
        return going, *added, waiting, *onward

    def _send(self, now: Traveller, onward: Onward, added: Sequence[Value]) -> tuple[Value, Values, Values]:
        """Whether a ray is followed, the colour if it is not, and the ray."""
        weight = now.weight * onward.share
        backing = self._no_backing()
        if onward.backing is not None:
            backing = (onward.backing.known, *onward.backing.color)
        going = (weight >= FAINTEST) & (now.left > 0)
        lost = (~going & (weight > 0.0)).select(weight, 0.0)
        sky = if_(
            lost > 0.0,
            lambda: self._unmet(onward.ray.direction, lost, backing),
            lambda: (constant(0.0, F32),) * 3,
        )
        sent = Traveller(onward.ray, onward.start, weight, now.left - 1)
        return going, tuple(a + s for a, s in zip(added, sky, strict=True)), (*sent.flat(), *backing)

    # ------------------------------------------------------------ the stack

    def _next(self, going: Value, waiting: Value, onward: Values) -> tuple[Value, Value, Values]:
        """The ray of the next turn: the one that goes on, else the last that waits."""
        if not self._branches:
            return going, waiting, onward
        popped = ~going & (waiting > 0)
        top = popped.select(waiting - 1, waiting)
        taken = if_(popped, lambda: self._peek(top), lambda: onward)
        return going | popped, top, tuple(taken)

    def _at(self, slot: Value, word: int) -> Value:
        plane = self._builder.uniform("plane", U32)
        return (slot * STACK_WORDS + word) * plane + self._place

    def _push(self, slot: Value, values: Sequence[Value]) -> None:
        stack = self._builder.buffer(STACK, U32, writable=True)
        for i, value in enumerate(values):
            store(stack, self._at(slot, i), value if value.type == U32 else value.bitcast(U32))

    def _peek(self, slot: Value) -> Values:
        stack = self._builder.buffer(STACK, U32, writable=True)
        words = [load(stack, self._at(slot, i)) for i in range(STACK_WORDS)]
        # What waits is mirrored, and has nothing behind it but the surroundings.
        return *(word.bitcast(F32) for word in words[:-1]), words[-1], *self._no_backing()


def _counted(color: Sequence[Value], weight: Value) -> Values:
    """A colour as it counts."""
    return tuple((c * weight).maximum(0.0).minimum(BRIGHTEST) for c in color)
