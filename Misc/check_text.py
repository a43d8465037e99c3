#!/usr/bin/env python3
"""Checks the repository's text for faults that reviews would otherwise have to point out.

Errors: trailing blanks, tabs and carriage returns in sources, a file that does not end with one newline, marks of
unfinished work, absolute paths of somebody's machine, network addresses of private hosts, disabled code, a suite of tests
whose name disagrees with its file's about whether it is statistical (Misc/cmake/module.cmake goes by both), and a link of a page
(.md) to a file or a heading that is not there. A source of more than 500 lines gets a warning: it may hold a second idea.

    Misc/check_text.py [--root DIR]    checks the files that git would track
    Misc/check_text.py --self-test     tests the checks themselves on texts that break every rule
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

CODE = {".cpp", ".h", ".glsl", ".comp", ".py", ".sh", ".cmake"}
TEXT = CODE | {".md", ".txt", ".bib", ".json", ".supp", ".qc", ".ent", ".cfg"}
LINES_WORTH_A_WARNING = 500

# The words are split here so that this file does not break its own rules.
UNFINISHED = re.compile(r"\b(" + "|".join(["TO" + "DO", "FIX" + "ME", "XX" + "X", "HA" + "CK"]) + r")\b")
# Folders that only one machine has: home folders, mounts, unpacked archives. Tests may invent home
# folders and addresses.
ABSOLUTE = re.compile(
    r"""(?:^|[\s"'(=:`])(/(?:home|root|Users|mnt|media|srv|opt|workspace)/[\w.-]+|[A-Z]:\\Users\\\w+)"""
)
PRIVATE_HOST = re.compile(
    r"\b(?:10\.\d{1,3}\.\d{1,3}\.\d{1,3}|192\.168\.\d{1,3}\.\d{1,3}|172\.(?:1[6-9]|2\d|3[01])\.\d{1,3}\.\d{1,3})\b"
    r"|\b[\w-]+\.(?:internal|corp|lan)\b(?!\()"
)
DISABLED = re.compile(r"^\s*#\s*if\s+0\b")
SUITE = re.compile(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)")
LINK = re.compile(r"\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#+ +(.*?) *$")


def errors_of(name, text, checkout="/nowhere/" + "else/"):
    """Yields (line, sentence) for one file's text; `name` decides which rules apply, `checkout` is a path that no text may contain."""
    suffix = pathlib.PurePath(name).suffix
    is_code = suffix in CODE
    if text and not text.endswith("\n"):
        yield text.count("\n") + 1, "the file does not end with a newline"
    if text.endswith("\n\n"):
        yield text.count("\n"), "the file ends with an empty line"
    for number, line in enumerate(text.split("\n"), 1):
        if line.endswith("\r"):
            yield number, "carriage return"
        elif line != line.rstrip():
            yield number, "trailing blanks"
        if is_code and "\t" in line:
            yield number, "a tab; indent with spaces"
        if UNFINISHED.search(line):
            yield number, "a mark of unfinished work; finish it, or open an issue"
        match = ABSOLUTE.search(line)
        if match and not ("_test." in name and match.group(1).startswith("/home/")):
            yield number, f"{match.group(1)} is a path of one machine"
        if checkout in line:
            yield number, f"{checkout} is where this checkout happens to be"
        if PRIVATE_HOST.search(line) and "_test." not in name:
            yield number, f"{PRIVATE_HOST.search(line).group(0)} is a host that only some can reach"
        if is_code and DISABLED.search(line):
            yield number, "disabled code; delete it"
        suite = SUITE.match(line) if name.endswith("_test.cpp") else None
        if suite and suite[1].endswith("Statistics") != name.endswith("_statistics_test.cpp"):
            yield number, f"{suite[1]}: suites that end in Statistics are those of the files x_statistics_test.cpp, and no others"


def lines_of_page(text):
    """Yields (line, text) of a page of Markdown, but for what stands in blocks of code."""
    in_code = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            in_code = not in_code
        elif not in_code:
            yield number, line


def headings_of(text):
    """The names by which links find a page's headings, as GitHub makes them."""
    found = {}
    for _, line in lines_of_page(text):
        heading = HEADING.match(line)
        if heading:
            name = re.sub(r"[^\w\- ]", "", heading[1].lower()).replace(" ", "-")
            found[name] = found.get(name, -1) + 1
    return {name if again == 0 else f"{name}-{again}" for name, count in found.items() for again in range(count + 1)}


def broken_links(page, text, read):
    """Yields (line, sentence) for links that lead nowhere. `read` gives the text of a path, or None where there is nothing."""
    for number, line in lines_of_page(text):
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, heading = target.partition("#")
            other = text if not name else read(page.parent / name)
            if other is None:
                yield number, f"{name}, to which this links, is not there"
            elif heading and heading not in headings_of(other):
                yield number, f"{name or 'the page'} has no heading #{heading}"


def read_page(path):
    if not path.exists():
        return None
    return path.read_text() if path.suffix == ".md" else ""


def files_of(root):
    listing = subprocess.run(
        ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        check=True,
        capture_output=True,
    ).stdout
    for name in sorted(set(listing.decode().split("\0"))):
        path = root / name
        if not name or not path.is_file():
            continue
        is_text = path.suffix in TEXT or path.name in ("Makefile", "CMakeLists.txt", "run", ".clang-format", ".clang-tidy")
        if is_text and path.name != "LICENSE":
            yield name, path


def check(root):
    failed = False
    root = root.resolve()
    # The folder that contains the checkout, unless every machine has a folder of that name.
    home = root.parent if str(root.parent) not in ("/", "/tmp", "/usr/src") else root
    for name, path in files_of(root):
        data = path.read_bytes()
        try:
            text = data.decode("utf-8")
        except UnicodeDecodeError as error:
            print(f"{name}: byte {error.start} is not UTF-8")
            failed = True
            continue
        if path.name == "Makefile":
            text = text.replace("\t", " ")
        for line, sentence in errors_of(name, text, f"{home}/"):
            print(f"{name}:{line}: {sentence}")
            failed = True
        for line, sentence in broken_links(path, text, read_page) if path.suffix == ".md" else ():
            print(f"{name}:{line}: {sentence}")
            failed = True
        lines = text.count("\n")
        if path.suffix in CODE and lines > LINES_WORTH_A_WARNING:
            print(f"{name}: warning: {lines} lines; is there a second idea in it?")
    if not failed:
        print("check_text: the text is in order")
    return 1 if failed else 0


def self_test():
    cases = [  # name, text, lines with an error
        ("a.cpp", "int a;\n", []),
        ("a.cpp", "int a; \n\tint b;\r\n", [1, 2, 2]),
        ("a.cpp", "int a;", [1]),
        ("a.cpp", "int a;\n\n", [2]),
        ("a.h", "// " + "TO" + "DO: later\n", [1]),
        ("a.md", "in `/ho" + "me/anyone/quake` or /usr/games and ~/quake\n", [1]),
        ("a.sh", "ls /o" + "pt/thing\n", [1]),
        ("a.md", "from 192." + "168.0.7 or files.in" + "ternal, not 127.0.0.1 or version 10.2\n", [1]),
        ("a.md", "C:\\Us" + "ers\\anyone\n", [1]),
        ("a.cpp", "#if" + " 0\nint a;\n#endif\n", [1]),
        ("a.cpp", "#if 0x10 == 16\n", []),
        ("a.txt", "a\tb\n", []),
        ("a_test.cpp", 'open("/ho' + 'me/ranger/quake");\n', []),
        ("a.txt", "see /nowhere/" + "else/quake\n", [1]),
        ("a/b_statistics_test.cpp", "TEST_F(BStatistics, C) {}\nTEST(B, C) {}\n", [2]),
        ("a/b_test.cpp", "TEST_P(B, C) {}\n  TYPED_TEST(BStatistics, C) {}\n", [2]),
        ("a/statistics_test.cpp", "TEST(Sums, C) {}\nTEST(Statistics, C) {}\n", [2]),
    ]
    passed = True
    for name, text, lines in cases:
        found = sorted(line for line, _ in errors_of(name, text))
        if found != lines:
            print(f"check_text: self-test: {name} {text!r}: expected errors in lines {lines}, found {found}")
            passed = False
    page = pathlib.PurePath("docs/a.md")
    pages = {"docs/b.md": "# One `two`: three\n## One\n## One\n", "picture.jpg": ""}
    links = [  # text, lines with a link that leads nowhere
        ("[x](b.md#one-two-three) [y](b.md#one-1) [z](https://a.b/c.md) [p](../picture.jpg)\n", []),
        ("[x](b.md#two)\n[y](c.md)\n[z](#here)\n", [1, 2, 3]),
        ("# Here\n[z](#here)\n```\n[y](c.md)\n```\n`[y](c.md)`\n", []),
    ]
    for text, lines in links:
        found = [line for line, _ in broken_links(page, text, lambda path: pages.get(os.path.normpath(path)))]
        if found != lines:
            print(f"check_text: self-test: {text!r}: expected broken links in lines {lines}, found {found}")
            passed = False
    return passed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return 0 if self_test() else 1
    return check(arguments.root)


if __name__ == "__main__":
    sys.exit(main())
