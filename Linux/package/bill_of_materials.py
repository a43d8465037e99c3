#!/usr/bin/env python3
"""What the programs are made with: bill_of_materials.py VERSION FILE PROGRAM... writes SPDX 2.3 (JSON) of Fullbright and of every
Debian package whose shared libraries the programs load, with its version. Same inputs, same bytes: the time is SOURCE_DATE_EPOCH's,
else 1970. Libraries that no package owns are named by their file."""

import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys


def libraries(programs: list[str]) -> list[str]:
    paths = set()
    for program in programs:
        said = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
        paths |= {str(pathlib.Path(path).resolve()) for path in re.findall(r"=> (/\S+)", said)}
    return sorted(paths)


def owner(library: str) -> tuple[str, str]:
    """The package's name and version; dpkg may know the file without the /usr of a merged root."""
    for name in (library, library.removeprefix("/usr")):
        found = subprocess.run(["dpkg-query", "--search", name], capture_output=True, text=True, check=False).stdout
        if found:
            package = found.split(": ")[0].split(",")[0]
            version = subprocess.run(["dpkg-query", "--show", "--showformat", "${source:Package} ${Version}", package],
                                     capture_output=True, text=True, check=True).stdout.split()[1]
            return package.split(":")[0], version
    return pathlib.Path(library).name, "NOASSERTION"


def entry(name: str, version: str) -> dict:
    named = re.sub(r"[^A-Za-z0-9.-]", "-", name)
    return {"SPDXID": f"SPDXRef-{named}", "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION", "copyrightText": "NOASSERTION"}


def main() -> int:
    version, out, programs = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
    own = entry("fullbright", version) | {"licenseConcluded": "GPL-2.0-only", "licenseDeclared": "GPL-2.0-only"}
    used = sorted({owner(library) for library in libraries(programs)})
    if not used:
        print("bill_of_materials.py: the programs load no library; are they programs?", file=sys.stderr)
        return 1
    packages = [own, *(entry(name, its) for name, its in used)]
    time = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), datetime.timezone.utc)
    sums = hashlib.sha256(json.dumps(packages, sort_keys=True).encode()).hexdigest()
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"fullbright-{version}",
        "documentNamespace": f"https://fullbright.invalid/spdx/{version}-{sums[:16]}",
        "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: bill_of_materials.py"]},
        "packages": packages,
        "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": own["SPDXID"]},
                          *({"spdxElementId": own["SPDXID"], "relationshipType": "DYNAMIC_LINK", "relatedSpdxElement": p["SPDXID"]}
                            for p in packages[1:])],
    }
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(document, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
