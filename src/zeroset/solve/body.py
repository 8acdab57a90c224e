"""A body inside one kernel: all its leaves lowered, and what enclosures of them prove over any set of points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zeroset.kernel import BOOL, F32, KernelBuilder, Type, Value, constant, lift
from zeroset.solve.field import Lowered
from zeroset.solve.names import isovalue_name, parameter_names
from zeroset.solve.shape import Body, Complement, Join, Leaf, Tree

Point = Sequence[Any]


class LoweredBody:
    """One body inside one kernel.

    Attributes:
        body: what it is.
        builder: the kernel being traced.
        type: scalar type of the evaluation, f32 or f64.
    """

    def __init__(self, body: Body, builder: KernelBuilder, type_: Type = F32, offset: bool = False) -> None:
        self.body = body
        self.builder = builder
        self.type = type_
        self._leaves = {leaf.part: Lowered(leaf.field, builder, type_, offset, leaf.prefix) for leaf, _ in body.leaves}
        self._values = {leaf.part: [self._value(leaf, i) for i in range(leaf.levels)] for leaf, _ in body.leaves}

    def _value(self, leaf: Leaf, i: int) -> tuple[Value, Value]:
        value, error = parameter_names(leaf.prefix + isovalue_name(i), self.type)
        return self.builder.uniform(value, self.type), self.builder.uniform(error, self.type)

    @property
    def first(self) -> Lowered:
        """Its first leaf, which is all of a plain body."""
        return self._leaves[self.body.leaves[0][0].part]

    def leaf(self, leaf: Leaf) -> Lowered:
        """One of its leaves."""
        return self._leaves[leaf.part]

    def isovalues(self, leaf: Leaf, system: Any) -> list[Any]:
        """A leaf's isovalues, rising, as numbers of a system."""
        return [system.enclose(*pair) for pair in self._values[leaf.part]]

    def values(self, leaf: Leaf) -> list[Value]:
        """A leaf's isovalues, rising."""
        return [value for value, _ in self._values[leaf.part]]

    def excludes(self, system: Any, point: Point) -> Value:
        """Whether nothing of it is certainly at these points, given as numbers of an enclosing system."""
        tree = self.body.tree
        if isinstance(tree, Leaf):
            return self.free(tree, system, point)
        return self._sign(tree, system, point).ne(0.0)

    def free(self, leaf: Leaf, system: Any, point: Point) -> Value:
        """Whether a leaf has certainly no zero, or none of its isovalues, at these points."""
        lowered = self.leaf(leaf)
        f = lowered.evaluate(system, *point)
        result = constant(True, BOOL)
        for value in self.isovalues(leaf, system) if leaf.levels else [None]:
            above = f if value is None else f - value
            excluded = ~lift(above.contains_zero(), BOOL)
            pole = lowered.beside_poles(above, excluded, lambda other: other.evaluate(system, *point), value)
            result = result & (excluded | pole)
        return result

    def jumps(self, system: Any, point: Point) -> Value:
        """Whether a formula of it may jump, or have no value, at any of these points, where that matters to a solid."""
        if isinstance(self.body.tree, Leaf):
            return self._undefined(self.body.tree, system, point)
        return self._jumps(self.body.tree, system, point)

    def _undefined(self, leaf: Leaf, system: Any, point: Point) -> Value:
        if leaf.field.continuous:
            return constant(False, BOOL)
        return ~lift(self.leaf(leaf).evaluate(system, *point).defined, BOOL)

    def _jumps(self, tree: Tree, system: Any, point: Point) -> Value:
        match tree:
            case Leaf():
                # What is on one side of 0 altogether is inside or outside, jump as it may.
                return self._undefined(tree, system, point) & self._sign(tree, system, point).eq(0.0)
            case Complement():
                return self._jumps(tree.of, system, point)
            case Join():
                u, v = (self._jumps(each, system, point) for each in (tree.left, tree.right))
                return (u | v) & self._sign(tree, system, point).eq(0.0)

    def _sign(self, tree: Tree, system: Any, point: Point) -> Value:
        """+1 outside, -1 inside, 0 where that is not certain."""
        match tree:
            case Leaf():
                f = self.leaf(tree).evaluate(system, *point)
                # What has no value is not <= 0: outside where f is above 0 or nothing, inside only where it is defined.
                outside = lift(f.signs()[0], BOOL) | lift(f.empty, BOOL)
                inside = ~lift(f.contains_zero(), BOOL) & ~outside
                if not tree.field.total:
                    inside = inside & lift(f.defined, BOOL)
                one = constant(1.0, self.type)
                return outside.select(one, inside.select(-one, 0.0))
            case Complement():
                return -self._sign(tree.of, system, point)
            case Join():
                u, v = (self._sign(each, system, point) for each in (tree.left, tree.right))
                return u.minimum(v) if tree.union else u.maximum(v)
