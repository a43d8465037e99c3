#!/usr/bin/env python3
"""Begins a new estimator: writes its folder, Shaders/estimators/NAME (shader, steps, page, and what is asked for beside them),
its file in Quake/render/techniques, and its rows in the lists of techniques. What it writes builds, draws and is unbiased:
change it from there.

    Misc/new_estimator.py NAME [PART ...]     PART: lights control record memory table probes reuse pass final setting view, or all

A part is what the loop of paths (Shaders/lib/path.glsl) or the renderer offers a technique:
    lights   looks for lights by the renderer's list at every vertex, and remembers what shadow rays reach
    control  subtracts a control variate
    record   is told what each path met (with memory: keeps it)
    memory   an array of the pixels, whose former frame's half is kept
    table    cells of the world in a hash grid, which learn the light that is reflected there (for the control variate)
    probes   points in a grid about the scene, with a pass that traces their rays (for the control variate)
    reuse    a reservoir over time at every pixel: frames hang on each other
    pass     a pass of its own after the paths (works on the memory)
    final    offline, the pass that makes the picture of all iterations (from the memory)
    setting  a cvar r_NAME_... and its field in the uniform block
    view     a debug view

Frames are independent, or learning where there is lights, table or probes, or correlated where there is reuse: the row says
so, and tests and references go by it. Every estimator that its row calls unbiased is held to pt's mean by lab_test (UnbiasedStatistics, suite Every).
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

import new_estimator_texts as texts

PARTS = ["lights", "control", "record", "memory", "table", "probes", "reuse", "pass", "final", "setting", "view"]
NEEDS = {"pass": ["memory"], "final": ["pass", "record"], "view": ["memory"], "setting": ["pass"],  # what a part's example works on
         "table": ["control", "record"], "probes": ["control"], "reuse": ["record"]}

SOURCES = (".cpp", ".h", ".glsl", ".comp")  # what Misc/check_format.sh looks at


def names_of(name: str) -> dict[str, str]:
    return {"name": name, "NAME": name.upper(), "Name": "".join(word.capitalize() for word in name.split("_"))}


def steps_of(name: str, parts: set[str]) -> dict[str, str]:
    """The texts of its steps and passes, by their paths in its folder."""
    names, own = names_of(name), f'#include "estimators/{name}/'
    files = {}

    def write(path: str, text: str, **more: str) -> None:
        files[path] = text.format(**names, **more)

    carries = bool(parts & {"table", "reuse"})
    if carries:
        write("begin.glsl", texts.BEGIN)
    learnt = parts & {"table", "probes"}
    headers, fields, prepare = [], [], []
    if carries:
        headers.append(own + 'begin.glsl"')
    for part, header in (("table", "cells"), ("probes", "probes"), ("reuse", "reuse")):
        if part in parts:
            headers.append(own + header + '.glsl"')
    headers.append('#include "lib/path_state.glsl"')
    if learnt:
        fields.append("  float light;  // that is known about it\n")
        prepare.append("  g.light = 0.0;\n")
    if "table" in parts:
        prepare.append("  uint cell = cell_about(v, rng);\n  if (!IN_MEDIUM && path.depth == 0u) path.own.cell = cell;\n"
                       "  g.light += light_of_cell(cell);\n")
    if "probes" in parts:
        prepare.append("  g.light += light_of_probe(probe_about(v.position));\n")
    if "reuse" in parts:
        fields.append("  vec3 kept;    // a direction\n" if learnt else "  vec3 kept;  // a direction\n")
        prepare.append("  g.kept = kept_direction(path, rng);\n")
    even, density, draw = texts.EVEN["reuse" in parts]
    write("propose.glsl", texts.PROPOSE, even=even, density=density, draw=draw, headers="\n".join(headers) + "\n",
          fields="".join(fields) or "  uint none;\n", prepare="".join(prepare) or "  g.none = 0u;\n")
    if "control" in parts:
        write("control.glsl", texts.CONTROL, what="what is known of it" if learnt else "kLight",
              constant="" if learnt else "const float kLight = 0.05;\n", light="g.light" if learnt else "kLight")
    if "record" in parts:
        stores = [text for part, text in (("memory", texts.STORE_PIXEL), ("table", texts.STORE_CELL)) if part in parts]
        clears = [text for part, text in (("memory", texts.NONE_PIXEL), ("reuse", texts.NONE_KEPT)) if part in parts]
        write("record.glsl", texts.RECORD, what="the light of paths is kept" if stores else "nothing is kept of what paths bring",
              store=(texts.STORE + "".join(stores)).format(**names) if stores else "",
              none="\n".join(text.format(**names).rstrip("\n") for text in clears).replace("\n\n", "\n") + "\n" if clears else "")
    if "table" in parts:
        write("cells.glsl", texts.CELLS)
        write("passes/cells.comp", texts.FOLD)
    if "probes" in parts:
        write("probes.glsl", texts.PROBES)
        write("passes/probes.comp", texts.ASK)
    if "reuse" in parts:
        write("reuse.glsl", texts.REUSE)
    if "pass" in parts:
        write("passes/mean.comp", texts.PASS, alpha=f"own.{name}_alpha" if "setting" in parts else "0.0")
    if "final" in parts:
        write("passes/final.comp", texts.FINAL)
    if "view" in parts:
        write("views.glsl", texts.VIEWS)
    return files


def header_of(name: str, parts: set[str], view_number: int, view_owner: int) -> str:
    """Its header for C++ and GLSL: arrays, settings, views, the uniform block."""
    names = names_of(name)
    arrays, fields = "", ""
    for list_name, which, of in (("ARRAYS_OF", "", ("memory", "reuse")), ("WORLD_OF", " that outlast a cut", ("table", "probes"))):
        rows = [texts.ROWS[part].format(**names) for part in of if part in parts]
        if rows:
            arrays += texts.HEADER_ARRAYS.format(**names, list=list_name, which=which, rows=" ".join(rows))
    if "probes" in parts:
        fields += "  vec4 origin, spacing;  // of probes: the corner of the first one's cell, the size of cells; units\n"
    if "setting" in parts:
        fields += f"  FB_{names['NAME']}_SETTINGS(FB_UNIFORM_FIELD)\n"
    if "lights" in parts:
        fields += ("  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)\n  uint seen_stride;  // of this many shadow rays one is remembered; a power of two\n"
                   "  uint seen_ways;    // the table of ways that is read, 0 or 1\n")
    if "memory" in parts:
        fields += "  uint now, former;  // where the halves of the pixels' array begin, elements\n"
    if "reuse" in parts:
        fields += "  uint now_kept, former_kept;  // and those of the reservoirs'\n"
    if "table" in parts:
        fields += "  uint cells;  // a power of two\n"
    if "probes" in parts:
        fields += "  int count_x, count_y, count_z;  // probes along each axis\n"
    return texts.HEADER.format(
        **names, arrays=arrays, fields=fields,
        settings=texts.HEADER_SETTINGS.format(**names) if "setting" in parts else "",
        views=texts.HEADER_VIEWS.format(**names, number=view_number, owner=view_owner) if "view" in parts else "")


def host_of(name: str, description: str, parts: set[str]) -> str:
    """Its file in Quake/render/techniques."""
    names = names_of(name)
    lights, pixels, world = "lights" in parts, bool(parts & {"memory", "reuse"}), bool(parts & {"table", "probes"})
    learns = lights or world or "reuse" in parts
    rows, members, prepare, before, after, forget, fields, counted, info, includes = ([] for _ in range(10))
    kept = []  # memories: list of rows, member, what its reset is called
    if pixels:
        kept.append(("ARRAYS_OF", "Rows", "memory_", f"{name} reset"))
    if world:
        kept.append(("WORLD_OF", "WorldRows", "world_", f"{name} world reset"))
    if lights:
        members.append("seen_(tools)")
        fields.append("  SeenGrid seen_;\n")
        includes.append("seen_grid.h")
        before.append("    seen_.add_reset(passes.list);\n")
        forget.append("    seen_.forget();\n")
        counted.append("seen_.bytes()")
        after.append("    seen_.add_fold(passes.list, passes.shaders);\n")
    for macro, row, member, reset in kept:
        rows.append(f"constexpr ArrayRow k{names['Name']}{row}[]{{FB_{names['NAME']}_{macro}(FB_ARRAY_ROW)}};\n")
        members.append(f'{member}(tools.device, tools.table, k{names["Name"]}{row}, "{reset}")')
        fields.append(f"  TechniqueMemory {member};{'  // outlasts a cut' if member == 'world_' else ''}\n")
        before.append(f"    {member}.add_reset(passes.list);\n")
        forget.append(f"    {member}.forget();\n")
        counted.append(f"{member}.bytes()")
    if kept:
        includes.append("technique_memory.h")
    if "probes" in parts:
        includes.append("probe_grid.h")
        prepare.append(texts.PREPARE_PROBES)
        fields.append("  ProbeGrid grid_;\n")
        before.append(texts.DISPATCH_PROBES)
    if "table" in parts:
        prepare.append(texts.PREPARE_CELLS)
        after.append(texts.DISPATCH_CELLS)
    if world:
        prepare.append("    const bool fresh = world_.begin_frame();\n")
    if pixels:
        prepare.append("    if (frame.cut) memory_.forget();\n    memory_.begin_frame(frame.lit);\n")
    for part, array, field in (("memory", "Pixels", ""), ("reuse", "Kept", "_kept")):
        if part in parts:
            prepare.append("".join(f"    constants.{half}{field} = memory_.{half}(shared::k{names['Name']}{array});\n" for half in ("now", "former")))
    if lights:
        prepare.append(("    if (fresh) seen_.forget();\n" if world else "")
                       + "    constants.seen_stride = seen_stride(frame.lit, frame.settings, frame.medium());\n"
                       "    constants.seen_ways = seen_.begin_frame();\n")
    if learns:
        since = "seen_.fresh() ? 1 : " if lights else "fresh ? 1 : " if world else ""
        prepare.append(f"    frame_ = {since}frame_ + 1;\n")
        fields.append(f"  std::uint32_t frame_ = 0;  // {'since it forgot' if since else 'never again the same'}\n")
        info.append(f",\n    .frames = Frames::{'kCorrelated' if 'reuse' in parts else 'kLearning'}")
    if "pass" in parts:
        after.append(texts.DISPATCH_MEAN)
    if lights:
        info.append(",\n    .wants_lights = true")
    if "view" in parts:
        info.append(f",\n    .views = shared::kViewOf{names['Name']}")
    if "final" in parts:
        info.append(",\n    .ends_iterations = true")
    return texts.HOST.format(
        **names, description=description,
        includes="".join(f'#include "render/techniques/{include}"\n' for include in sorted(includes)),
        rows="\n" + "".join(rows) if rows else "", members="".join(f",\n        {member}" for member in members),
        prepare="".join(prepare).replace("{name}", name).replace("{Name}", names["Name"]),
        before="".join(before).replace("{name}", name), after="".join(after).replace("{name}", name),
        final=texts.FINAL_PASSES.replace("{name}", name) if "final" in parts else "",
        forget="\n" + "".join(forget) + "  ",
        salt="  std::uint32_t salt() const override { return frame_; }\n" if learns else "",
        bytes=" + ".join(counted) or "0", fields="".join(fields), info="".join(info))


def files_of(name: str, description: str, parts: set[str], view_number: int, view_owner: int) -> dict[str, str]:
    """The new files' texts, by their paths."""
    names, folder, host = names_of(name), f"Shaders/estimators/{name}", f"Quake/render/techniques/{name}.cpp"
    keeps = bool(parts & (set(texts.ARRAY) | {"lights", "setting"}))

    def step(part: str, file: str) -> str:
        return f'#include "{f"estimators/{name}/{file}" if part in parts else f"lib/steps/no_{file}"}.glsl"\n'

    files = {f"{folder}/{path}": text for path, text in steps_of(name, parts).items()}
    files[f"{folder}/{name}.comp"] = texts.SHADER.format(
        **names, description=description, headers=f'#include "estimators/{name}/arrays.glsl"\n' if keeps else "",
        begin=f"estimators/{name}/begin.glsl" if parts & {"table", "reuse"} else "lib/steps/one_path.glsl",
        direct=texts.LIGHTS if "lights" in parts else '#include "lib/steps/no_direct.glsl"\n',
        control=step("control", "control"), record=step("record", "record"), views=step("view", "views"))
    files[f"{folder}/README.md"] = texts.PAGE.format(**names, description=description)
    if not keeps:
        files[host] = texts.PLAIN_HOST.format(**names, description=description)
        return files
    arrays = "".join(text.format(**names) for part, text in texts.ARRAY.items() if part in parts)
    files[f"{folder}/arrays.glsl"] = texts.ARRAYS.format(**names, arrays=arrays)
    files[f"{folder}/{name}.h"] = header_of(name, parts, view_number, view_owner)
    files[host] = host_of(name, description, parts)
    return files


def with_rows(name: str, parts: set[str], techniques: str, headers: str) -> tuple[str, str]:
    """The list of techniques and that of their headers, each with the new rows."""
    upper, camel = name.upper(), "".join(word.capitalize() for word in name.split("_"))
    rows = re.search(r"#define FB_TECHNIQUES\(X\).*?\n\n", techniques, re.S)
    assert rows, "techniques.cpp has no FB_TECHNIQUES(X)"
    techniques = techniques.replace(rows[0], rows[0].rstrip("\n") + f" \\\n  X(k{camel})\n\n")
    wanted = [macro for part, macro in (("setting", "SETTINGS"), ("view", "VIEWS")) if part in parts]
    if wanted:
        headers = headers.replace("#include", f'#include "estimators/{name}/{name}.h"\n#include', 1)
    for macro in wanted:
        found = re.search(rf"#define FB_TECHNIQUE_{macro}\(.*?\n\n", headers, re.S)
        assert found, f"techniques.h has no FB_TECHNIQUE_{macro}"
        row = f'G("{name}", FB_{upper}_SETTINGS, X)' if macro == "SETTINGS" else f"FB_{upper}_VIEWS(X)"
        headers = headers.replace(found[0], found[0].rstrip("\n") + f" \\\n  {row}\n\n")
    return techniques, headers


def shaders_of(root: pathlib.Path) -> set[str]:
    """The shaders that there are, with what CMake calls their variants."""
    names = set()
    for path in (root / "Shaders/estimators").glob("*/*.comp"):
        names |= {path.stem, f"{path.stem}_medium"}
    for path in (root / "Shaders/estimators").glob("*/passes/*.comp"):
        names.add(f"{path.parent.parent.name}_{path.stem}")
    lists = root / "Shaders/CMakeLists.txt"
    if lists.exists():
        names |= set(re.findall(r"^fb_shader\((\w+)", lists.read_text(), re.M))
        names |= {word for words in re.findall(r"^foreach\(pass ([\w ]+)\)", lists.read_text(), re.M) for word in words.split()}
    return names


def identifiers_of(name: str, parts: set[str]) -> tuple[set[str], set[str]]:
    """The words of the new files that are made of its name, and all others. A name like no other stands in for it, so that
    what the files only use of other sources is not taken for theirs."""
    words = set(re.findall(r"\w+", "\n".join(files_of("zqx", "", parts, 0, 0).values())))
    made = {word for word in words if "zqx" in word.lower()}
    names = names_of(name)
    own = {word.replace("zqx", name).replace("ZQX", names["NAME"]).replace("Zqx", names["Name"]) for word in made - {"zqx"}}
    return own, words - made


def taken(root: pathlib.Path, name: str, parts: set[str], written: dict[str, str]) -> str | None:
    """What of a new technique is there already, as a sentence: a file, a shader, a debug view, an identifier."""
    host = root / "Quake/render/techniques"
    beside = [f"{name}.h", f"{name}_test.cpp", f"{name}_statistics_test.cpp"]  # what is not written, but is this file's
    paths = [root / "Shaders/estimators" / name, *(root / path for path in written), *(host / path for path in beside)]
    for path in paths:
        if path.exists():
            return f"{path.relative_to(root)} is there already"
    for shader in sorted(shaders_of(root)):
        if shader == name or shader.startswith(f"{name}_"):  # as its passes' are called, and its paths' in a medium
            return f"there is a shader {shader} already: an estimator's or a pass's"
    own, others = identifiers_of(name, parts)
    for word in sorted(own & others):
        return f"what is written has {word} already"
    cvars = {word for word in own if word.startswith("r_")}
    for top in ("Shaders", "Quake"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in SOURCES or not path.is_file():
                continue
            text = path.read_text(encoding="utf-8", errors="replace")
            # What a test or a source of another module has for itself alone is in nobody's way, but for its cvars.
            apart = path.suffix == ".cpp" and (path.stem.endswith("_test") or "render" not in path.relative_to(root).parts)
            seen = cvars if apart else own
            for word in sorted(word for word in seen if word in text):
                if re.search(rf"\b{word}\b", text):
                    return f"{path.relative_to(root)} has {word} already"
            if "view" in parts and re.search(rf'\bX\(kView\w+, [^"\n]*"{name}"', text):
                return f"{path.relative_to(root)} has a debug view {name} already"
    return None


def formatted(root: pathlib.Path, paths: list[pathlib.Path]) -> None:
    """In the shape that Misc/check_format.sh wants, where there is clang-format and the checkout says which shape."""
    tool, style = shutil.which("clang-format"), root / ".clang-format"
    sources = [str(path) for path in paths if path.suffix in SOURCES]
    if tool and style.exists() and sources:
        subprocess.run([tool, "-i", f"--style=file:{style}", *sources], check=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", help="lower case letters, digits and _: the folder, the shader and r_estimator's value")
    parser.add_argument("parts", nargs="*", metavar="PART", help=" ".join(PARTS) + " all")
    parser.add_argument("--description", default="the BSDF's directions and uniform ones, mixed",
                        help="one phrase, without a full stop")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent,
                        help="the checkout (default: this one)")
    options = parser.parse_args()
    word = re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", options.name)
    if not word or len(options.name) > 31 or options.name.split("_")[0] == "gl":  # GLSL keeps gl_ and two _ for itself
        print(f"new_estimator: '{options.name}' is no name: up to 31 lower case letters and digits after a letter, with single _ "
              "between them, and no gl at its begin",
              file=sys.stderr)
        return 2
    unknown = [part for part in options.parts if part not in [*PARTS, "all"]]
    if unknown:
        print(f"new_estimator: '{unknown[0]}' is no part: {' '.join(PARTS)} all", file=sys.stderr)
        return 2
    parts = set(PARTS if "all" in options.parts else options.parts)
    for _ in PARTS:
        parts |= {need for part in parts for need in NEEDS.get(part, [])}
    root = options.root
    table = root / "Quake/render/techniques/techniques.cpp"
    headers = root / "Shaders/estimators/techniques.h"
    headers_text = "".join(path.read_text() for path in [root / "Shaders/shared/debug_views.h", *(root / "Shaders/estimators").glob("*/*.h")]
                    if path.exists())
    number = max([int(n) for n in re.findall(r"X\(kView\w+, (\d+)u", headers_text)], default=0) + 1
    owner = len(re.findall(r"FB_CONST uint kViewOf\w+ = kViewOfTechniques", headers_text))
    written = files_of(options.name, options.description, parts, number, owner)
    found = taken(root, options.name, parts, written)
    if found:
        print(f"new_estimator: {found}; choose another name", file=sys.stderr)
        return 2
    try:
        rows = with_rows(options.name, parts, table.read_text(), headers.read_text())
    except (OSError, AssertionError) as wrong:
        print(f"new_estimator: {wrong}", file=sys.stderr)
        return 1
    for path, text in written.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
        print(f"wrote {root / path}")
    for path, text in zip((table, headers), rows):
        if text != path.read_text():
            path.write_text(text)
            print(f"its rows in {path}")
    formatted(root, [*(root / path for path in written), table, headers])
    print("next: build, then look at  build/fullbright-lab render --scene kinds --estimator " + options.name)
    if "setting" in parts:
        print("and write the manual's page of settings anew:  make settings-page")
    print(f"tests of its own: Shaders/estimators/{options.name}/*_test.cpp of its headers (found by their names), and\n"
          f"Quake/render/techniques/{options.name}_test.cpp of its host, which TESTS in Quake/render/CMakeLists.txt lists")
    return 0


if __name__ == "__main__":
    sys.exit(main())
