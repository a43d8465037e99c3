#!/usr/bin/env python3
"""Compiles a shader as glslang would, or takes what it wrote before for the same text.

usage: compile_shader.py GLSLANG OPTION ... [--vn NAME] --depfile FILE -o FILE SOURCE

What is kept is found by a hash of the source and of all files that it may include, without their comments, of the options and
of the compiler. glslang's own preprocessor would tell more texts to be equal, but takes a quarter of a second each, a fifth of
a build without anything kept. Files are kept in FULLBRIGHT_SHADER_CACHE (~/.cache/fullbright/shaders; empty: nothing is kept),
256 MB at most, of which those go first that were not used for longest. Each holds a hash of itself, so that a damaged one
is no one's shader. A folder that cannot be read or written is the same as none. It runs a hundred times in a build: what few runs
need is imported there.
"""
import hashlib
import os
import re
import sys
import zlib

LIMIT = 256 << 20
FORMAT = b"2"  # of the key and of the files
WITH_VALUE = ("--vn", "--depfile", "-o", "--target-env")
COMMENT = re.compile(r'("(?:\\.|[^"\\\n])*")|//(?:\\\n|[^\n])*|/\*.*?\*/', re.DOTALL)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include\b[ \t]*(?:["<]([^">\n]+)[">])?', re.MULTILINE)
NAME = b"@NAME@"


class Unknown(Exception):
    """What a shader includes cannot be told from its text."""


class Arguments:
    def __init__(self, words: list[str]):
        self.compiler, self.value, self.folders, self.options, sources = words[0], {}, [], [], []
        words = iter(words[1:])
        for word in words:
            if word in WITH_VALUE:
                self.value[word] = next(words)
            elif word.startswith("-I"):
                self.folders.append(word[2:])
            elif word.startswith("-"):
                self.options.append(word)
            else:
                sources.append(word)
        (self.source,) = sources


def without_comments(text: str) -> str:
    if "__LINE__" in text:
        return text
    text = COMMENT.sub(lambda match: match[1] or " ", text)
    lines = [line.rstrip() for line in text.split("\n")]
    return "\n".join(line for line, before in zip(lines, ["", *lines]) if line or before.endswith("\\"))


def texts_of(source: str, folders: list[str]) -> dict[str, str]:
    """The source and all that it may include, whatever its conditions say, by path. glslang looks beside each file that includes
    the one with the directive: here, beside all of them."""
    texts: dict[str, str] = {}
    names: set[str] = set()
    places = list(folders)
    found = [source]
    while found:
        for path in found:
            with open(path, encoding="utf-8") as file:
                text = texts[path] = without_comments(file.read())
            for match in INCLUDE.finditer(text):
                if match[1] is None:
                    raise Unknown(path)
                names.add(match[1])
            if os.path.dirname(path) not in places:
                places.append(os.path.dirname(path))
        found = sorted({path for place in places for name in names if (path := os.path.normpath(os.path.join(place, name))) not in texts
                        and os.path.isfile(path)})
    return texts


def key_of(arguments: Arguments, texts: dict[str, str]) -> str:
    compiler = os.stat(arguments.compiler)
    told = [FORMAT, b"text" if "--vn" in arguments.value else b"words", f"{compiler.st_size} {compiler.st_mtime_ns}".encode(), arguments.value.get("--target-env", "").encode(),
            *(option.encode() for option in arguments.options), os.path.splitext(arguments.source)[1].encode()]

    def place(path: str) -> str:  # the same in every checkout
        inside = [os.path.relpath(path, folder) for folder in arguments.folders]
        return next((name for name in inside if not name.startswith("..")), os.path.relpath(path, os.path.dirname(arguments.source)))

    for path, text in sorted((place(path), text) for path, text in texts.items()):
        told += [path.encode(), text.encode()]
    told.append(place(arguments.source).encode())
    digest = hashlib.sha256()
    for part in told:
        digest.update(str(len(part)).encode() + b":" + part)
    return digest.hexdigest()


def folder_of_cache() -> str:
    folder = os.environ.get("FULLBRIGHT_SHADER_CACHE")
    if folder is None:
        folder = os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "fullbright", "shaders")
    return folder


def read_kept(path: str) -> bytes | None:
    try:
        with open(path, "rb") as file:
            data = file.read()
        digest, packed = data[:32], data[32:]
        if hashlib.sha256(packed).digest() != digest:
            os.unlink(path)
            return None
        os.utime(path)
        return zlib.decompress(packed)
    except (OSError, zlib.error):
        return None


def keep(path: str, text: bytes) -> None:
    import contextlib

    packed = zlib.compress(text, 1)
    folder = os.path.dirname(path)
    new = os.path.join(folder, f"new-{os.getpid()}")
    with contextlib.suppress(OSError):
        os.makedirs(folder, exist_ok=True)
        try:
            with open(new, "wb") as file:
                file.write(hashlib.sha256(packed).digest() + packed)
            os.replace(new, path)
        except OSError:
            os.unlink(new)
            raise
        trim(folder, LIMIT)


def trim(folder: str, limit: int) -> None:
    """Removes what was not used for longest until a tenth of the limit is free, if there is more than the limit."""
    with os.scandir(folder) as entries:
        files = sorted((entry.stat().st_mtime_ns, entry.stat().st_size, entry.path) for entry in entries)
    size = sum(file[1] for file in files)
    if size <= limit:
        return
    for _, bytes_of_file, path in files:
        if size <= limit * 9 // 10:
            return
        os.unlink(path)
        size -= bytes_of_file


def escaped(path: str) -> str:
    return path.replace(" ", "\\ ")


def main(words: list[str]) -> int:
    arguments = Arguments(words)
    out, name = arguments.value["-o"], arguments.value.get("--vn", "").encode()
    folder = folder_of_cache()
    try:
        texts = texts_of(arguments.source, arguments.folders) if folder else {}
        kept = os.path.join(folder, key_of(arguments, texts)) if folder else None
    except (OSError, UnicodeDecodeError, Unknown):
        kept = None
    text = read_kept(kept) if kept else None
    if text is not None:
        with open(out, "wb") as file:
            file.write(text.replace(NAME, name) if name else text)
        with open(arguments.value["--depfile"], "w", encoding="utf-8") as file:
            file.write(f"{escaped(out)}: " + " ".join(map(escaped, sorted(texts))) + "\n")
        return 0
    import subprocess

    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    sys.stdout.buffer.write(done.stdout)
    if kept and done.returncode == 0 and not done.stdout:  # a warning is to be seen each time
        with open(out, "rb") as file:
            text = file.read()
        keep(kept, text.replace(name, NAME) if name else text)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
