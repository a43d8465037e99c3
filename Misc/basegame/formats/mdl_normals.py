"""The 162 directions that MDL files name by number: an icosahedron's corners after its faces' edges were halved twice, in id's order.

The directions follow from the construction; only their order is the format's own. Each is written as three letters,
`a` for 0 up to `u` for 1 in the list of the coordinates that occur, capitals for negative ones.
"""

from __future__ import annotations

import functools

import numpy as np

_ORDER = """
Kaq Idr Fat Gjp Ces aau aqk Bom bom akq gjp kaq fat idr ces Mbo Pgj Lhn Qka Rid Omb Nlh Jpg Dri Hnl OmB JpG Kqa aqK DrI
atF EsC aua atf Esc dri esc jpg drI esC jpG qka omb omB kqa hnl rid nlh pgj mbo lhn tfa uaa sce qKa tFa rId sCe pGj mBo
qak riD pgJ scE kaQ mbO mBO qaK pGJ rID sCE boM gjP hnL idR lhN nlH BoM GjP akQ KaQ IdR FaT CeS aaU faT ceS IDR GJP CES
aQK BOM bOM aKQ gJP iDR cES dRI jPG hNL oMB nLH lHN aTF aUa eSC aQk aTf dRi eSc jPg oMb kQa DRI JPG ESC QKa OMB OMb KQa
JPg DRi ESc RId PGj NLh MBo IDr LHn GJp BOm HNl CEs iDr cEs gJp bOm aKq hNl lHn nLh Tfa Sce Uaa Qak TFa SCe RiD ScE PgJ
RID SCE PGJ MbO MBO QaK NlH LhN HnL HNL LHN NLH
"""


def icosphere(levels: int) -> np.ndarray:
    """Directions (n, 3) of an icosahedron's corners after its flat faces' edges are halved `levels` times."""
    phi = (1.0 + 5.0**0.5) / 2.0
    points = [np.roll([0.0, a, b], k) for k in range(3) for a in (-phi, phi) for b in (-1.0, 1.0)]
    near = lambda a, b, edge: np.linalg.norm(a - b) < edge * 1.25
    edge = min(np.linalg.norm(points[0] - p) for p in points[1:])
    for _ in range(levels):
        points += [(a + b) / 2.0 for i, a in enumerate(points) for b in points[:i] if near(a, b, edge)]
        edge /= 2.0
    return np.array([p / np.linalg.norm(p) for p in points])


def _directions() -> np.ndarray:
    sphere = icosphere(2)
    levels = np.unique(np.round(np.abs(sphere), 9))
    letters = {chr(ord("a") + i): value for i, value in enumerate(levels)}
    value = lambda c: letters[c.lower()] * (-1.0 if c.isupper() else 1.0)
    return np.array([[value(c) for c in code] for code in _ORDER.split()])


DIRECTIONS = _directions()  # (162, 3), unit length


_STEPS = 24  # cells of a table from -1 to 1 along each axis: finer than the directions lie apart


@functools.cache
def _table() -> np.ndarray:
    """The nearest direction's number for each cell of the cube around the sphere."""
    at = np.arange(-_STEPS, _STEPS + 1) / _STEPS
    cells = np.stack(np.meshgrid(at, at, at, indexing="ij"), axis=-1)
    return (cells @ DIRECTIONS.T).argmax(axis=-1).astype(np.uint8)


def nearest_direction(normals: np.ndarray) -> np.ndarray:
    """Numbers (...) uint8 of the directions nearest to unit vectors (..., 3), to within a cell of the table."""
    cell = np.round(np.clip(normals, -1.0, 1.0) * _STEPS).astype(int) + _STEPS
    return _table()[cell[..., 0], cell[..., 1], cell[..., 2]]
