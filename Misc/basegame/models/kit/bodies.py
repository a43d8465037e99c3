"""Limbs and trunks for humanoid bones: lofts whose rings share bones at the joints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from models.kit.paint import Painter
from models.kit.shapes import Patch, Vec, tube
from models.kit.skeleton import Skeleton

# Places along a limb (0..2: upper bone, lower bone) and how the joints share them.
_RINGS = [(-0.08, 0.0), (0.35, 0.0), (0.84, 0.15), (1.0, 0.5), (1.18, 0.85), (1.55, 1.0), (1.96, 1.0)]


def limb(
    skeleton: Skeleton,
    chain: tuple[str, str, str],
    root: str,
    radii: Sequence,
    paint: Painter,
    sides: int = 7,
    shift: Vec = (0, 0, 0),
    detail: float = 1.0,
) -> Patch:
    """An arm or a leg through the three bones of `chain`; `radii` are seven, from the body to the end.

    `root` is what the first ring hangs on for the most part.
    """
    a, b, c = (skeleton.rest[name] for name in chain)
    path, bones = [], []
    for place, lower in _RINGS:
        point = a + (b - a) * place if place <= 1.0 else b + (c - b) * (place - 1.0)
        path.append(point + np.asarray(shift, float))
        bones.append({chain[0]: 1.0 - lower, chain[1]: lower})
    bones[0] = {root: 0.6, chain[0]: 0.4}
    first = radii[0] if np.isscalar(radii[0]) else min(radii[0])
    return tube(path, radii, paint, bones, sides, caps=(0.5 * first, None), detail=detail)


def leg(
    skeleton: Skeleton, radii: Sequence, paint: Painter, sides: int = 6, shift: Vec = (0, 0, 0), detail: float = 1.0
) -> Patch:
    return limb(skeleton, ("thigh_l", "shin_l", "foot_l"), "hips", radii, paint, sides, shift, detail)


def arm(
    skeleton: Skeleton, radii: Sequence, paint: Painter, sides: int = 6, shift: Vec = (0, 0, 0), detail: float = 1.0
) -> Patch:
    return limb(skeleton, ("upper_l", "lower_l", "hand_l"), "chest", radii, paint, sides, shift, detail)


def trunk(
    skeleton: Skeleton,
    rings: Sequence[tuple[float, float, float, float]],
    paint: Painter,
    sides: int = 10,
    detail: float = 1.0,
    caps=(0.5, 0.5),
) -> Patch:
    """A body from rings of (height above the hips, forward shift, half depth, half width)."""
    hips, belly, chest = (skeleton.rest[name][2] for name in ("hips", "belly", "chest"))
    path, bones = [], []
    for height, forward, _, _ in rings:
        z = hips + height
        path.append((forward, 0.0, z))
        upper = float(np.clip((z - belly) / max(chest - belly, 1e-3), 0.0, 1.0))
        lower = float(np.clip((belly - z) / max(belly - hips, 1e-3), 0.0, 1.0))
        bones.append({"chest": upper, "belly": 1.0 - upper} if z > belly else {"hips": lower, "belly": 1.0 - lower})
    return tube(path, [(depth, width) for _, _, depth, width in rings], paint, bones, sides, caps=caps, detail=detail)


def boot(
    skeleton: Skeleton,
    paint: Painter,
    length: float = 8.0,
    width: float = 2.2,
    height: float = 3.0,
    heel: float = 2.6,
    sides: int = 8,
    ground: float = -24.0,
    detail: float = 1.0,
) -> Patch:
    """A shoe from heel to toe on the ground, around the left ankle."""
    ankle = skeleton.rest["foot_l"]
    x0 = ankle[0] - heel
    path, radii = [], []
    for share, tall, wide in (
        (0.0, 0.75, 0.72),
        (0.22, 1.0, 0.92),
        (0.5, 0.86, 0.9),
        (0.78, 0.62, 1.0),
        (0.95, 0.45, 0.8),
    ):
        half = height * tall / 2.0
        path.append((x0 + length * share, ankle[1] + 0.25 * share, ground + half))
        radii.append((half, width * wide))
    return tube(path, radii, paint, "foot_l", sides, up=(0, 0, 1), caps=(0.3, 0.6), detail=detail)


def mitt(skeleton: Skeleton, paint: Painter, size: float = 1.0, sides: int = 6, detail: float = 1.0) -> list[Patch]:
    """A closed glove at the left wrist with its thumb."""
    wrist = skeleton.rest["hand_l"]
    path = [
        wrist + np.array([0.0, 0.0, 0.9]) * size,
        wrist - [0.1, 0, 0.5 * size],
        wrist - [-0.3, 0, 2.2 * size],
        wrist - [-0.5, 0, 3.4 * size],
    ]
    palm = tube(
        path,
        [(1.2 * size, 1.2 * size), (1.7 * size, 1.45 * size), (1.9 * size, 1.4 * size), (1.1 * size, 0.9 * size)],
        paint,
        "hand_l",
        sides,
        caps=(0.1, 0.4),
        detail=detail,
    )
    thumb = tube(
        [wrist + np.array([0.6, -1.0, -0.3]) * size, wrist + np.array([1.9, -1.3, -1.6]) * size],
        [0.7 * size, 0.55 * size],
        paint,
        "hand_l",
        5,
        caps=(0.1, 0.35),
        detail=detail,
    )
    return [palm, thumb]


def skirt(
    skeleton: Skeleton,
    rings: Sequence[tuple[float, float, float, float]],
    paint: Painter,
    sides: int = 10,
    detail: float = 1.0,
) -> Patch:
    """Cloth from the waist down that follows both legs: rings as in `trunk`, from the top down."""
    hips = skeleton.rest["hips"][2]
    path = [(forward, 0.0, hips + height) for height, forward, _, _ in rings]
    low = min(height for height, _, _, _ in rings)
    patch = tube(
        path, [(depth, width) for _, _, depth, width in rings], paint, "hips", sides, caps=(None, None), detail=detail
    )
    patch.bones = [
        {"hips": 1.0 - 0.7 * s, "thigh_l": 0.35 * s, "thigh_r": 0.35 * s}
        for s in (np.clip(h / min(low, -1e-3), 0, 1) for h, _, _, _ in rings)
    ]
    return patch


def spike(
    at: Vec, tip: Vec, radius: float, paint: Painter, bones, sides: int = 5, bend: Vec = (0, 0, 0), detail: float = 0.6
) -> Patch:
    """A horn, a claw, a tooth: from `at` to `tip`, its middle pushed by `bend`."""
    at, tip = np.asarray(at, float), np.asarray(tip, float)
    middle = (at + tip) / 2 + np.asarray(bend, float)
    return tube(
        [at, middle, at * 0.12 + tip * 0.88 + np.asarray(bend) * 0.25],
        [radius, radius * 0.72, radius * 0.3],
        paint,
        bones,
        sides,
        up=(0.3, 0.2, 1.0),
        caps=(None, float(np.linalg.norm(tip - at)) * 0.12),
        detail=detail,
    )
