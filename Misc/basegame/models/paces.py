"""How far the rules move each walking body in each frame of its gaits, units: feet that bear weight keep to it.

`qc/monsters/*.qc` has these numbers; `test_paces.py` holds the two together, and the models' feet to them. Frame n shows a
body that has gone the n-th number since the frame before.
"""

from __future__ import annotations

# Model -> sequence -> units, one a frame.
PACES: dict[str, dict[str, list[float]]] = {
    "soldier": {
        "prowl_": [1, 1, 1, 1, 2, 3, 4, 4, 2, 2, 2, 1, 0, 1, 1, 1, 3, 3, 3, 3, 2, 1, 1, 1],
        "run": [11, 15, 10, 10, 8, 15, 10, 8],
    },
    "dog": {"walk": [8] * 8, "run": [16, 32, 32, 20, 64, 32] * 2},
    "ogre": {
        "walk": [3, 2, 2, 2, 2, 5, 3, 2, 3, 1, 2, 3, 3, 3, 3, 4],
        "run": [9, 12, 8, 22, 16, 4, 13, 24],
    },
    "knight": {"walk": [3, 2, 3, 4, 3, 3, 3, 4, 3, 3, 2, 3, 4, 3], "runb": [16, 20, 13, 7, 16, 20, 14, 6]},
    "hknight": {
        "walk": [2, 5, 5, 4, 4, 2, 2, 3, 3, 4, 3, 4, 6, 2, 2, 4, 3, 3, 3, 2],
        "run": [20, 25, 18, 16, 14, 25, 21, 13],
    },
    "demon": {"walk": [8, 6, 6, 7, 4, 6, 10, 10], "run": [20, 15, 36] * 2},
    "shambler": {"walk": [10, 9, 9, 5, 6, 12, 8, 3, 13, 9, 7, 5], "run": [20, 24, 20] * 2},
    "zombie": {
        "walk": [0, 2, 3, 2, 1, 0, 0, 0, 0, 0, 2, 2, 1, 0, 0, 0, 0, 0, 0],
        "run": [1, 1, 0, 1, 2, 3, 4, 4, 2, 0, 0, 0, 2, 4, 6, 7, 3, 8],
    },
    "shalrath": {"walk": [6, 4, 0, 0, 0, 0, 5, 6, 5, 0, 4, 5]},
    "enforcer": {
        "walk": [2, 4, 4, 3, 1, 2, 2, 1, 2, 4, 4, 1, 2, 3, 4, 2],
        "run": [18, 14, 7, 12, 14, 14, 7, 11],
    },
}
PLAYER = [32.0] * 6  # 320 units a second
