"""Bones in a tree, and their places in every frame."""

from __future__ import annotations

import numpy as np

from models.kit.turn import apply, euler


class Skeleton:
    """Bones by name: parent and where the bone turns, at rest (units)."""

    def __init__(self, bones: dict[str, tuple[str, tuple[float, float, float]]]):
        self.parents = {name: parent for name, (parent, _) in bones.items()}
        self.rest = {name: np.asarray(at, float) for name, (_, at) in bones.items()}

    def add(self, name: str, parent: str, at) -> None:
        self.parents[name] = parent
        self.rest[name] = np.asarray(at, float)


class Posing:
    """Where the bones are in each of F frames; a bone that nobody places keeps its place on its parent."""

    def __init__(self, skeleton: Skeleton, frames: int):
        self.skeleton, self.frames = skeleton, frames
        self.turns: dict[str, np.ndarray] = {}  # (F, 3, 3), may scale
        self.places: dict[str, np.ndarray] = {}  # (F, 3)

    def place(self, bone: str, turn: np.ndarray | None, at: np.ndarray) -> None:
        self.turns[bone] = np.broadcast_to(np.eye(3), (self.frames, 3, 3)) if turn is None else turn
        self.places[bone] = at

    def turn(self, bone: str, angles=None, matrix: np.ndarray | None = None, shift=None) -> None:
        """Turns a bone by degrees (F, 3) or by (F, 3, 3), after moving it by `shift`, both in its parent's axes."""
        turn, at = self.of(bone)
        parent_turn, _ = self.of(self.skeleton.parents[bone])
        if shift is not None:
            at = at + apply(parent_turn, shift)
        local = matrix if matrix is not None else euler(np.broadcast_to(np.asarray(angles, float), (self.frames, 3)))
        self.place(bone, parent_turn @ local, at)

    def of(self, bone: str) -> tuple[np.ndarray, np.ndarray]:
        """A bone's rotation and place."""
        if bone not in self.turns:
            parent = self.skeleton.parents[bone]
            if not parent:
                self.place(bone, None, np.broadcast_to(self.skeleton.rest[bone], (self.frames, 3)))
            else:
                turn, at = self.of(parent)
                self.place(bone, turn, at + apply(turn, self.skeleton.rest[bone] - self.skeleton.rest[parent]))
        return self.turns[bone], self.places[bone]

    def skin(self, points: np.ndarray, shares: list[dict[str, float]]) -> np.ndarray:
        """Points (V, 3) at rest, each with its bones' shares, in every frame (F, V, 3)."""
        names = list(dict.fromkeys(name for share in shares for name in share))
        out = np.zeros((self.frames, len(points), 3))
        for name in names:
            share = np.array([s.get(name, 0.0) for s in shares])
            used = share > 0
            turn, at = self.of(name)
            local = points[used] - self.skeleton.rest[name]
            out[:, used] += (np.einsum("fij,vj->fvi", turn, local) + at[:, None]) * share[used][:, None]
        return out
