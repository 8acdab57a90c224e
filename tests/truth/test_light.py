"""Rays beyond the first hit, held to Arb: what is lit, what is mirrored, what lies behind, where bent rays go.

Materials are chosen so that a pixel's brightness says what its rays met: black surfaces that let half of the light
pass, or mirror half of it, before a white background show 1/2 for each surface that was met. Rays are made again in
f64 from the pixel's own hit; where rays a hair beside them meet something else, nothing is asked of the pixel.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs

from .judge import Judge, Kind, Verdict
from .test_frames import SIZE, frame_rays

Array = np.ndarray
SUN = np.array((0.55, -0.35, 0.9)) / np.linalg.norm((0.55, -0.35, 0.9))
BLACK = {"front": (0.0, 0.0, 0.0), "back": (0.0, 0.0, 0.0), "ambient": 0.0, "diffuse": 0.0, "specular": 0.0}
HAIR = 1e-5
"""Relative error of a ray that was made of a hit and a normal in f32, and more."""
NAMES = ("torus", "tangle", "barth-sextic", "blobby")
OFTEN = ("tangle", "barth-sextic")
"""Of these, the ones that throw shadows on themselves and mirror themselves."""


def on_devices(*names: str) -> pytest.MarkDecorator:
    """Each surface on the CPU, and the tangle on a GPU too."""
    gpu = pytest.param("tangle", "gpu", marks=needs_gpu)
    return pytest.mark.parametrize(("name", "where"), [*((name, "cpu") for name in names), gpu])


def linear(image: zs.Image) -> Array:
    """The first channel in linear light, pixel by pixel."""
    s = np.asarray(image)[..., 0].astype(float).ravel() / 255
    return np.where(s <= 0.04045, s / 12.92, ((s + 0.055) / 1.055) ** 2.4)


class Seen:
    """A small picture, and the rays of its pixels."""

    def __init__(self, name: str, **options: object) -> None:
        self.surface = zs.gallery[name]
        camera = self.surface.camera
        assert camera is not None
        self.image = zs.render(self.surface, SIZE, **options)  # type: ignore[arg-type]
        self.light = linear(self.image)
        self.judge = Judge(self.surface)
        self.origins, self.directions = frame_rays(camera)
        self.status, self.t = (self.image.aov(key).ravel() for key in ("status", "t"))
        self.normals = self.image.aov("normal").reshape(-1, 3).astype(float)
        # What a search may leave open where it begins, and the shadows' own tolerance.
        self.fine = self.surface.fitted.extent * 2.0**-14
        self.coarse = self.surface.fitted.extent * 2.0**-11

    def hits(self) -> Iterator[tuple[int, Array, Array, Array]]:
        """Every other pixel that certainly shows the surface, not from the side: number, hit, direction and normal."""
        for i in np.flatnonzero(self.status == zs.HIT)[::2]:
            direction = self.directions[i] / np.linalg.norm(self.directions[i])
            normal = self.normals[i]
            if abs(normal @ direction) > 0.15:
                yield int(i), self.origins[i] + float(self.t[i]) * self.directions[i], direction, normal

    def around(self, origin: Array, direction: Array, t_min: float) -> Iterator[Verdict]:
        """What Arb says of a ray and of those a hair beside it; each is judged when it is asked for."""
        rng = np.random.default_rng(1)
        size = HAIR * max(1.0, float(np.abs(origin).max()))
        shifts = [np.zeros((2, 3)), *(rng.choice([-size, size], (2, 3)) for _ in range(4))]
        for a, b in shifts:
            yield self.judge.first_root((origin + a).tolist(), (direction + b).tolist(), t_min)


def meets(verdict: Verdict) -> bool:
    """Whether there certainly is a crossing."""
    return verdict.root is not None and verdict.root.kind is Kind.CROSS


def free(verdict: Verdict) -> bool:
    """Whether there certainly is nothing at all."""
    return not verdict.events


Asked = Iterator[tuple[int, bool, Iterator[Verdict], Iterator[Verdict]]]


def hold(asked: Asked, least: int) -> None:
    """Each pixel's word, met or not met, against what Arb says of the way beyond its start and from its start on."""
    wrong, said = [], {True: 0, False: 0}
    for i, met, beyond, whole in asked:
        said[met] += 1
        if all(map(free, whole)) if met else all(map(meets, beyond)):
            wrong.append(f"pixel {divmod(i, SIZE)}: {'met' if met else 'not met'}, but Arb says otherwise")
    assert not wrong, "\n".join(wrong)
    assert min(said.values()) >= least, said


@on_devices(*NAMES)
def test_what_is_lit_is_in_the_light(name: str, where: str) -> None:
    white = zs.Material(front=(1, 1, 1), back=(1, 1, 1), ambient=0.0, diffuse=1.0, specular=0.0)
    sun = zs.Light(direction=tuple(SUN), headlight=False)  # type: ignore[arg-type]
    seen = Seen(name, material=white, lights=[sun], shadows=True, device=where)

    def asked() -> Asked:
        for i, point, direction, normal in seen.hits():
            facing = -math.copysign(1.0, normal @ direction) * (normal @ SUN)
            if facing > 0.1:
                beyond, whole = (seen.around(point, SUN, start * seen.coarse) for start in (3.0, 1.0))
                yield i, bool(seen.light[i] < 0.02), beyond, whole

    hold(asked(), 5 if name in OFTEN else 0)


@on_devices(*NAMES)
def test_mirrored_rays_meet_what_is_there(name: str, where: str) -> None:
    mirror = zs.Material(reflectance=0.5, **BLACK)  # type: ignore[arg-type]
    seen = Seen(name, material=mirror, depth=1, background=(1, 1, 1), device=where)

    def asked() -> Asked:
        for i, point, direction, normal in seen.hits():
            mirrored = direction - 2 * (normal @ direction) * normal
            beyond, whole = (seen.around(point, mirrored, start * seen.fine) for start in (16.0, 2.0))
            yield i, bool(seen.light[i] < 0.375), beyond, whole

    hold(asked(), 5 if name in OFTEN else 0)


def walk(
    seen: Seen, origin: Array, direction: Array, most: int, turn: Callable[[Array, Array], Array | None]
) -> int | None:
    """How many surfaces a ray meets; None where that hangs on a hair. ``turn`` gives the direction after a hit."""
    count, start = 0, 0.0
    while count < most:
        verdicts = list(seen.around(origin, direction, start))
        if all(map(free, verdicts)):
            return count
        if not all(map(meets, verdicts)):
            return None
        root = verdicts[0].root
        assert root is not None
        count += 1
        point = origin + (root.a + root.b) / 2 * direction
        gradient = np.array(seen.judge.gradient(point.tolist()))
        onward = turn(direction, gradient / np.linalg.norm(gradient))
        if onward is None:
            return None
        origin, direction, start = point, onward, 16 * seen.fine
    return count


def count_layers(seen: Seen, turn: Callable[[Array, Array], Array | None]) -> tuple[list[str], set[int]]:
    """Pixels whose brightness tells another number of surfaces than Arb, and the numbers that there were."""
    wrong, numbers = [], set()
    for i in np.flatnonzero(seen.status != zs.UNRESOLVED)[::3]:
        told = round(-math.log2(max(seen.light[i], 2.0**-8)))
        direction = seen.directions[i] / np.linalg.norm(seen.directions[i])
        count = walk(seen, seen.origins[i], direction, 4, turn)
        if count is None:
            continue
        numbers.add(count)
        if told != count:
            wrong.append(f"pixel {divmod(int(i), SIZE)}: {told} surfaces, but {count}")
    return wrong, numbers


@on_devices("torus", "tangle", "blobby")
def test_layers_are_as_many_as_there_are(name: str, where: str) -> None:
    half = zs.Material(opacity=0.5, **BLACK)  # type: ignore[arg-type]
    seen = Seen(name, material=half, depth=3, background=(1, 1, 1), device=where)

    def straight(direction: Array, normal: Array) -> Array | None:
        return direction if abs(normal @ direction) > 0.15 else None

    wrong, numbers = count_layers(seen, straight)
    assert not wrong, "\n".join(wrong)
    assert {0, 2} <= numbers


@on_devices("torus", "tangle", "blobby")
def test_bent_rays_meet_what_snell_says(name: str, where: str) -> None:
    glass = zs.Material(opacity=0.5, ior=1.3, **BLACK)  # type: ignore[arg-type]
    seen = Seen(name, material=glass, depth=3, background=(1, 1, 1), device=where)

    def bend(direction: Array, normal: Array) -> Array | None:
        cosine = normal @ direction
        ratio = 1 / 1.3 if cosine < 0 else 1.3
        facing = -normal if cosine > 0 else normal
        within = 1 - ratio**2 * (1 - cosine**2)
        if abs(cosine) < 0.15 or abs(within) < 0.05:
            return None
        if within < 0:
            mirrored: Array = direction - 2 * cosine * normal
            return mirrored
        bent: Array = ratio * direction + (ratio * abs(cosine) - math.sqrt(within)) * facing
        return bent / np.linalg.norm(bent)

    wrong, numbers = count_layers(seen, bend)
    assert not wrong, "\n".join(wrong)
    assert len(numbers) >= 2
