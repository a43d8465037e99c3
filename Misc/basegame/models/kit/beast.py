"""Bodies that are not humanoid: chains of bones that wave, and legs that reach by themselves."""

from __future__ import annotations

import numpy as np

from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import about, apply, limb


def add_chain(skeleton: Skeleton, name: str, parent: str, points) -> list[str]:
    """Bones name0, name1 ... at the points, each hanging on the one before."""
    names = []
    for i, point in enumerate(points):
        skeleton.add(f"{name}{i}", parent if i == 0 else names[-1], point)
        names.append(f"{name}{i}")
    return names


def wave(
    posing: Posing, chain: list[str], axis: str, phase: np.ndarray, amount, lag: float, bias=0.0, growth: float = 0.0
) -> None:
    """Bends a chain about an axis by a running sine.

    `phase` (F) is in turns, `amount` and `bias` are degrees a bone, each bone is `lag` turns later.
    """
    for i, bone in enumerate(chain):
        angle = np.asarray(bias) + np.asarray(amount) * (1.0 + growth * i) * np.sin(2 * np.pi * (phase - lag * i))
        turn_about(posing, bone, axis, np.broadcast_to(angle, (posing.frames,)))


def turn_about(posing: Posing, bone: str, axis: str, degrees: np.ndarray) -> None:
    """Turns a bone about one axis on top of how it is turned already."""
    if bone in posing.turns:
        turn, at = posing.of(bone)
        posing.place(bone, turn @ about(axis, np.radians(degrees)), at)
    else:
        posing.turn(bone, matrix=about(axis, np.radians(degrees)))


def add_leg(skeleton: Skeleton, name: str, parent: str, hip, upper: float, lower: float) -> None:
    """A leg of two bones that hangs straight down at rest, and its foot."""
    hip = np.asarray(hip, float)
    skeleton.add(f"{name}_upper", parent, hip)
    skeleton.add(f"{name}_lower", f"{name}_upper", hip - [0, 0, upper])
    skeleton.add(f"{name}_foot", f"{name}_lower", hip - [0, 0, upper + lower])


def reach(
    posing: Posing,
    name: str,
    parent: str,
    target: np.ndarray,
    pole,
    upper: float,
    lower: float,
    pitch: np.ndarray,
    follow: np.ndarray | float = 0.0,
) -> None:
    """Puts a leg's foot at `target` (F, 3), the knee towards `pole` in the parent's axes. Where `follow` is 1 the foot
    turns with the parent."""
    turn, at = posing.of(parent)
    rest = posing.skeleton.rest
    start = at + apply(turn, rest[f"{name}_upper"] - rest[parent])
    first, second, joint, end = limb(start, target, apply(turn, pole), upper, lower, pole)
    posing.place(f"{name}_upper", first, start)
    posing.place(f"{name}_lower", second, joint)
    foot = about("y", np.radians(np.broadcast_to(pitch, (posing.frames,))))
    share = np.broadcast_to(np.asarray(follow, float), (posing.frames,))[:, None, None]
    posing.place(f"{name}_foot", np.where(share > 0.5, turn @ foot, foot), end)


def chain_rings(chain: list[str], count: int) -> list[dict[str, float]]:
    """Shares for `count` rings spread along a chain, blending from bone to bone."""
    out = []
    for at in np.linspace(0.0, len(chain) - 1.0, count):
        i = min(int(at), len(chain) - 2) if len(chain) > 1 else 0
        f = float(at - i)
        out.append({chain[i]: 1.0 - f, chain[i + 1]: f} if len(chain) > 1 and f > 0 else {chain[i]: 1.0})
    return out
