"""What of the things that are drawn shapes kernels: bodies, each a tree of fields inside bounds of one kind.

A *leaf* is a field with the names of its numbers; a plain one is met where f = 0, one with levels where f is one of so
many isovalues. A solid is a tree of leaves that stand for f <= 0. A *body* is what is searched at once, and a *shape*
is all bodies of a scene. What can be told apart where a ray meets them are its *parts*, counted over the whole shape: a
plain leaf is one, each isovalue is one. ``Subject`` is a shape inside one kernel.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from zeroset.solve.field import Field

MOST_PARTS = 32
"""Parts of a shape: what a ray may have met is a set of bits."""


class Leaf(NamedTuple):
    """One field.

    Attributes:
        field: f.
        prefix: before the names of its parameters in kernels; empty where it is the only one.
        part: its (first) part.
        levels: how many isovalues there are; 0 for f = 0 alone.
    """

    field: Field
    prefix: str = ""
    part: int = 0
    levels: int = 0

    @property
    def parts(self) -> int:
        """How many parts it has."""
        return max(self.levels, 1)

    @property
    def bits(self) -> int:
        """Its parts as a set of bits."""
        return ((1 << self.parts) - 1) << self.part

    @property
    def digest(self) -> str:
        """Equal for what gives equal kernels."""
        levels = f" levels {self.levels}" if self.levels else ""
        return f"{self.field.digest}{levels}{f' as {self.part}' if self.prefix else ''}"


class Complement(NamedTuple):
    """What is not inside a tree."""

    of: Tree

    @property
    def digest(self) -> str:
        """Equal for what gives equal kernels."""
        return f"~{self.of.digest}"


class Join(NamedTuple):
    """What is inside both of two trees, or (``union``) inside one of them at least."""

    left: Tree
    right: Tree
    union: bool

    @property
    def digest(self) -> str:
        """Equal for what gives equal kernels."""
        return f"({self.left.digest} {'|' if self.union else '&'} {self.right.digest})"


Tree = Leaf | Complement | Join


def leaves_of(tree: Tree, sign: int = 1) -> Iterator[tuple[Leaf, int]]:
    """The leaves from the left, each with -1 where the tree holds its complement."""
    match tree:
        case Leaf():
            yield tree, sign
        case Complement():
            yield from leaves_of(tree.of, -sign)
        case Join():
            yield from leaves_of(tree.left, sign)
            yield from leaves_of(tree.right, sign)


def has_unions(tree: Tree) -> bool:
    """Whether a point may be inside a tree because it is inside one of several parts."""
    match tree:
        case Leaf():
            return False
        case Complement():
            return has_unions(tree.of)
        case Join():
            return tree.union or has_unions(tree.left) or has_unions(tree.right)


class Body(NamedTuple):
    """What is searched at once.

    Attributes:
        tree: a leaf alone, or a solid.
        kind: of its bounds.
        prefix: before the names of the bounds' numbers in kernels; empty where it is the only one.
    """

    tree: Tree
    kind: str
    prefix: str = ""

    @property
    def plain(self) -> bool:
        """Whether it is f = 0 and nothing more."""
        return isinstance(self.tree, Leaf) and not self.tree.levels

    @property
    def levels(self) -> int:
        """How many isovalues it has; 0 for solids and plain surfaces."""
        return self.tree.levels if isinstance(self.tree, Leaf) else 0

    @property
    def leaves(self) -> tuple[tuple[Leaf, int], ...]:
        """Its leaves, each once, with the sign that turns their gradients out of the solid."""
        return tuple({leaf.part: (leaf, sign) for leaf, sign in reversed(tuple(leaves_of(self.tree)))}.values())[::-1]

    @property
    def highest_power(self) -> int:
        """The largest whole exponent in any of its formulas."""
        return max(leaf.field.highest_power for leaf, _ in self.leaves)

    @property
    def continuous(self) -> bool:
        """Whether all of its formulas are likely to be defined and continuous everywhere."""
        return all(leaf.field.continuous for leaf, _ in self.leaves)

    @property
    def degree(self) -> int | None:
        """An upper bound of the degree of its formulas; None where one is no polynomial."""
        return _largest([leaf.field.degree for leaf, _ in self.leaves])

    @property
    def digest(self) -> str:
        """Equal for what gives equal kernels."""
        return f"{self.tree.digest} {self.kind}"


class Shape(NamedTuple):
    """All that a scene shows."""

    bodies: tuple[Body, ...]

    @property
    def parts(self) -> int:
        """How many parts can be told apart."""
        return sum(leaf.parts for body in self.bodies for leaf, _ in body.leaves)

    @property
    def plain(self) -> bool:
        """Whether it is one surface f = 0 and nothing more."""
        return len(self.bodies) == 1 and self.bodies[0].plain

    @property
    def highest_power(self) -> int:
        """The largest whole exponent in any formula."""
        return max(body.highest_power for body in self.bodies)

    @property
    def large(self) -> bool:
        """Whether something on the way to any formula may be larger than f32 knows."""
        return any(leaf.field.large for body in self.bodies for leaf, _ in body.leaves)

    @property
    def continuous(self) -> bool:
        """Whether all formulas are likely to be defined and continuous everywhere."""
        return all(body.continuous for body in self.bodies)

    @property
    def degree(self) -> int | None:
        """An upper bound of the degree of its formulas; None where one is no polynomial."""
        return _largest([body.degree for body in self.bodies])

    @property
    def digest(self) -> str:
        """Equal for shapes with equal kernels."""
        return " + ".join(body.digest for body in self.bodies)


def _largest(degrees: list[int | None]) -> int | None:
    known = [degree for degree in degrees if degree is not None]
    return max(known) if known and None not in degrees else None
