#!/usr/bin/env python3
"""Manual pages from what the programs say of themselves: man_pages.py FULLBRIGHT FULLBRIGHT_LAB FOLDER writes fullbright.6 and
fullbright-lab.1. Fails where a program does not answer."""

import pathlib
import subprocess
import sys

SEE = "The pages in Misc/docs of the sources: playing.md, running.md, laboratory.md, commands.md, settings.md."


def said(*command: str) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout


def verbatim(text: str) -> str:
    """Lines as they are; no line is taken for a request, no hyphen for a dash."""
    lines = [line.replace("\\", "\\e").replace("-", "\\-") for line in text.strip("\n").splitlines()]
    return ".nf\n" + "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in lines) + "\n.fi\n"


def page(name: str, section: int, version: str, about: str, parts: list[tuple[str, str]]) -> str:
    text = f'.TH {name.upper()} {section} "" "Fullbright {version}"\n.SH NAME\n{name} \\- {about}\n'
    return text + "".join(f".SH {title}\n{body}" for title, body in parts)


def commands_of(help_text: str) -> list[str]:
    """The names of the subcommands, as CLI11 lists them."""
    _, _, listed = help_text.partition("Subcommands:\n")
    return [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and not line.startswith("   ")]


def main() -> int:
    game, lab, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    version = said(game, "-version").split()[1]
    (folder / "fullbright.6").write_text(page("fullbright", 6, version, "Quake, path traced", [
        ("DESCRIPTION", verbatim(said(game, "-help"))), ("SEE ALSO", "fullbright\\-lab(1)\n.PP\n" + SEE + "\n")]))
    overview = said(lab, "--help")
    commands = commands_of(overview)
    if len(commands) < 10:
        print(f"man_pages.py: {lab} --help lists {len(commands)} subcommands", file=sys.stderr)
        return 1
    parts = [("DESCRIPTION", verbatim(overview)), *((name.upper(), verbatim(said(lab, name, "--help"))) for name in commands)]
    (folder / "fullbright-lab.1").write_text(page("fullbright-lab", 1, version, "renders and measures without a window",
                                                  [*parts, ("SEE ALSO", "fullbright(6)\n.PP\n" + SEE + "\n")]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
