#!/usr/bin/env python3
"""Says where a map leaks: the way from an entity to the outside that qbsp wrote as a .pts file.

    leak.py FILE.pts
"""

import sys
from pathlib import Path


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    points = [tuple(float(n) for n in line.split()) for line in Path(sys.argv[1]).read_text().splitlines() if line]
    corners = points[:1]
    for before, here, after in zip(points, points[1:], points[2:]):
        turn = sum(((here[k] - before[k]) - (after[k] - here[k])) ** 2 for k in range(3))
        if turn > 1.0:
            corners.append(here)
    corners += points[-1:]
    print("leak.py: from one end of the leak to the other:")
    for point in corners[:40]:
        print("  " + " ".join(f"{c:.0f}" for c in point))
    return 0


if __name__ == "__main__":
    sys.exit(main())
