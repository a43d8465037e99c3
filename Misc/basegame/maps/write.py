#!/usr/bin/env python3
"""Writes the .map files of the maps' scripts, after their checks.

    write.py [NAME ...]     the scripts of these names; all without one. Prints the paths of the .map files
"""

import sys

from sources import maps_of, scripts


def main() -> int:
    wanted = sys.argv[1:]
    if any(name.startswith("-") for name in wanted):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    known = {path.stem: path for path in scripts()}
    unknown = [name for name in wanted if name not in known]
    if unknown:
        print(f"write.py: no script builds {', '.join(unknown)}; there are: {', '.join(known)}", file=sys.stderr)
        return 2
    for name in wanted or known:
        try:
            texts = maps_of(known[name])
        except ValueError as error:
            print(f"write.py: {error}", file=sys.stderr)
            return 1
        for path, text in texts.items():
            path.write_text(text, encoding="ascii")
            print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
