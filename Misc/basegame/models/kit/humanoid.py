"""The body of everything that walks on two legs and has two arms: its bones, and poses from few controls.

Controls are relative to the body's own size, so that one clip serves bodies of every build: `root` and `foot_*` are in
leg lengths, `hand_*` in arm lengths. `root` moves the hips, `foot_*` is an ankle's distance from where it stands at
rest (in the world, or with `loose` 1 in the hips' axes, for bodies that lie), `hand_*` is a hand's place from its
shoulder in the chest's axes. Legs and arms follow by inverse kinematics. The ground is at z = -24, the front +x, the
left +y.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from models.kit.motion import Clip
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import about, apply, blend, euler, limb

GROUND = -24.0
SIDES = (("_l", 1.0), ("_r", -1.0))


@dataclasses.dataclass
class Build:
    """Proportions in units."""

    thigh: float = 10.5
    shin: float = 10.5
    ankle: float = 3.0  # above the ground
    hip_width: float = 3.8  # half the distance between the legs
    crouch: float = 0.97  # hips' height as a share of the legs
    belly: float = 4.0  # above the hips
    chest: float = 9.0
    shoulder: tuple[float, float, float] = (-0.5, 7.2, 7.0)  # from the chest, of the left
    neck: float = 9.0  # above the chest
    neck_forward: float = 0.0
    upper: float = 8.0
    lower: float = 8.0
    feet: float = 0.0  # ankles' distance before the hips
    toe: float = 5.2  # the sole's ends, before and behind the ankle
    heel: float = 2.4
    knees: float = 1.0  # -1: they bend backwards

    @property
    def leg(self) -> float:
        return self.thigh + self.shin

    @property
    def arm(self) -> float:
        return self.upper + self.lower

    @property
    def hip(self) -> float:
        """Height of the hip joints."""
        return GROUND + self.ankle + self.leg * self.crouch


# Every control, at rest: standing, arms hanging.
REST: dict[str, tuple[float, ...]] = {
    "root": (0, 0, 0),
    "hips": (0, 0, 0),
    "belly": (0, 0, 0),
    "chest": (0, 0, 0),
    "head": (0, 0, 0),
    "jaw": (0,),
    "foot_l": (0, 0, 0),
    "foot_r": (0, 0, 0),
    "toe_l": (0, 0),
    "toe_r": (0, 0),
    "loose": (0,),
    "hand_l": (0.1, 0.15, -0.93),
    "hand_r": (0.1, -0.15, -0.93),
    "elbow_l": (0,),
    "elbow_r": (0,),
    "grip": (0, 0, 0),
    "grip_l": (0, 0, 0),
    "hold": (0,),
    "aim": (1,),
    "extra": (0,),
    "fade": (1,),
}


def bones(b: Build) -> Skeleton:
    """The bones at rest: legs straight below the hips, arms straight down. `weapon` is in the right hand."""
    hip = b.hip
    stand = GROUND + b.ankle
    skeleton = Skeleton(
        {
            "root": ("", (0, 0, 0)),
            "hips": ("root", (0, 0, hip)),
            "belly": ("hips", (0, 0, hip + b.belly)),
            "chest": ("belly", (0, 0, hip + b.chest)),
            "head": ("chest", (b.neck_forward, 0, hip + b.chest + b.neck)),
            "jaw": ("head", (b.neck_forward, 0, hip + b.chest + b.neck)),
        }
    )
    chest = skeleton.rest["chest"]
    for side, sign in SIDES:
        thigh = np.array([0.0, sign * b.hip_width, stand + b.leg])
        skeleton.add("thigh" + side, "hips", thigh)
        skeleton.add("shin" + side, "thigh" + side, thigh - [0, 0, b.thigh])
        skeleton.add("foot" + side, "shin" + side, thigh - [0, 0, b.leg])
        arm = chest + np.array(b.shoulder) * [1, sign, 1]
        skeleton.add("upper" + side, "chest", arm)
        skeleton.add("lower" + side, "upper" + side, arm - [0, 0, b.upper])
        skeleton.add("hand" + side, "lower" + side, arm - [0, 0, b.arm])
        skeleton.add("weapon" if sign < 0 else "weapon_l", "hand" + side, arm - [0, 0, b.arm])
    return skeleton


def pose(b: Build, skeleton: Skeleton, c: Clip, left_grip=None) -> Posing:
    """The bones' places for the controls `c` (every control of REST).

    `left_grip` is where the left hand holds the right hand's weapon, in units of the weapon's own axes; the control
    `hold` says how much it does.
    """
    frames = len(c["root"])
    p = Posing(skeleton, frames)
    hips = euler(c["hips"])
    rest = skeleton.rest
    at = rest["hips"] + c["root"] * b.leg
    p.place("hips", hips, at)
    for bone in ("belly", "chest", "head"):
        p.turn(bone, c[bone])
    p.turn("jaw", np.concatenate([c["jaw"], np.zeros((frames, 2))], axis=1))
    for side, sign in SIDES:
        _leg(b, p, c, side, sign)
    hand_r = _arm(b, p, c, "_r", -1.0, None)
    weapon = _grip(p, c["grip"], c["aim"][:, 0], "_r")
    p.place("weapon", weapon, hand_r)
    held = None if left_grip is None else hand_r + apply(weapon, left_grip)
    hand_l = _arm(b, p, c, "_l", 1.0, held)
    p.place("weapon_l", _grip(p, c["grip_l"], c["aim"][:, 0], "_l"), hand_l)
    return p


def _grip(p: Posing, angles: np.ndarray, aim: np.ndarray, side: str) -> np.ndarray:
    """A weapon's rotation: in the chest's axes (`aim` 1) or along the forearm (0)."""
    chest, _ = p.of("chest")
    arm, _ = p.of("lower" + side)
    along = arm @ euler(np.array([[90.0, 0.0, 0.0]]))
    return blend(along @ euler(angles), chest @ euler(angles), aim)


def _leg(b: Build, p: Posing, c: Clip, side: str, sign: float) -> None:
    hips, at = p.of("hips")
    rest = p.skeleton.rest
    start = at + apply(hips, rest["thigh" + side] - rest["hips"])
    stand = rest["foot" + side] + [b.feet, 0, 0]
    loose = c["loose"][:, 0]
    toe = c["toe" + side]
    step = c["foot" + side] * b.leg
    world = stand + step
    own = at + apply(hips, stand - rest["hips"] + step)
    target = world + (own - world) * loose[:, None]
    turned = about("z", np.radians(toe[:, 1])) @ about("y", np.radians(toe[:, 0]))
    foot = blend(turned, hips @ turned, loose)
    yaw = about("z", np.radians(toe[:, 1] + sign * 8.0))
    pole = apply(hips @ yaw, (b.knees, 0.0, 0.0))
    upper, lower, knee, ankle = limb(start, target, pole, b.thigh, b.shin, (1, 0, 0))
    if b.knees < 0:  # the hinge is the other way round, the flesh is not
        turn = about("z", np.full(p.frames, np.pi))
        upper, lower = upper @ turn, lower @ turn
    p.place("thigh" + side, upper, start)
    p.place("shin" + side, lower, knee)
    p.place("foot" + side, foot, ankle)


def _arm(b: Build, p: Posing, c: Clip, side: str, sign: float, held: np.ndarray | None) -> np.ndarray:
    chest, at = p.of("chest")
    rest = p.skeleton.rest
    start = at + apply(chest, rest["upper" + side] - rest["chest"])
    target = start + apply(chest, c["hand" + side] * b.arm)
    if held is not None:
        target = target + (held - target) * c["hold"]
    angle = np.radians(c["elbow" + side][:, 0])
    # At 0 the elbow points back and down, a little outwards; positive angles raise it outwards.
    pole = np.stack(
        [-0.55 * np.ones_like(angle), sign * (0.35 * np.cos(angle) + np.sin(angle)), -0.75 * np.cos(angle)], axis=1
    )
    upper, lower, elbow, hand = limb(start, target, apply(chest, pole), b.upper, b.lower, (-1, 0, 0))
    p.place("upper" + side, upper, start)
    p.place("lower" + side, lower, elbow)
    p.place("hand" + side, lower, hand)
    return hand


def grown(build: Build, size: float, **changes) -> Build:
    """A build `size` times as large, with some of its proportions changed afterwards."""
    keep = ("crouch", "knees")
    values = {f.name: getattr(build, f.name) for f in dataclasses.fields(build)}
    scaled = {
        k: v if k in keep else tuple(x * size for x in v) if isinstance(v, tuple) else v * size
        for k, v in values.items()
    }
    return Build(**{**scaled, **changes})
