"""A model whose frames are the conventions' sequences: each sequence has a clip, all clips are posed at once."""

from __future__ import annotations

import numpy as np

from models.conventions import SEQUENCES, frame_names
from models.kit import humanoid
from models.kit.figure import Figure, build
from models.kit.motion import Clip, joined
from models.kit.shapes import Patch
from models.kit.skeleton import Skeleton


def sequence_clips(name: str, clips: dict[str, Clip]) -> list[tuple[Clip, int]]:
    """The clips in the conventions' order, each with its length. Raises ValueError where one does not fit."""
    wanted = SEQUENCES[name]
    if set(clips) != {sequence for sequence, _ in wanted}:
        raise ValueError(f"{name}: clips {sorted(clips)} where {sorted(s for s, _ in wanted)} are wanted")
    for sequence, count in wanted:
        for control, values in clips[sequence].items():
            if len(values) != count:
                raise ValueError(f"{name}: {sequence} moves {control} over {len(values)} frames, not {count}")
    return [(clips[sequence], count) for sequence, count in wanted]


def humanoid_model(
    name: str,
    body: humanoid.Build,
    skeleton: Skeleton,
    patches: list[Patch],
    clips: dict[str, Clip],
    rest: dict | None = None,
    left_grip=None,
    posture: dict | None = None,
    shrink: dict[str, str] | None = None,
    floor: float = -23.9,
    **options,
) -> Figure:
    """A humanoid's model. `rest` changes controls' rest values; bones named in `shrink` vanish where the control it
    gives for them is 0. `posture` is added to controls while the body does not lie: how it holds itself."""
    base = {**humanoid.REST, **(rest or {})}
    controls = joined(base, sequence_clips(name, clips))
    for control, offset in (posture or {}).items():
        controls[control] = controls[control] + (1.0 - controls["loose"]) * np.asarray(offset, float)
    posing = humanoid.pose(body, skeleton, controls, left_grip)
    for bone, control in (shrink or {}).items():
        turn, at = posing.of(bone)
        size = np.clip(controls[control][:, :1], 0.02, 4.0)[:, :, None]
        posing.place(bone, turn * size, at)
    return build(patches, posing, frame_names(name), floor=floor, **options)
