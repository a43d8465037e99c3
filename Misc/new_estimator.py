#!/usr/bin/env python3
"""Begins a new estimator: writes its folder, Shaders/estimators/NAME (shader, steps, page, and what is asked for beside them),
its file in Quake/render/techniques, and its rows in the lists of techniques. What it writes builds, draws and is unbiased:
change it from there.

    Misc/new_estimator.py NAME [PART ...]     PART: lights control record memory pass final setting view, or all

A part is what the loop of paths (Shaders/lib/path.glsl) or the renderer offers a technique:
    lights   looks for lights by the renderer's list at every vertex, and remembers what shadow rays reach
    control  subtracts a control variate
    record   is told what each path met (with memory: keeps it)
    memory   an array of the pixels, whose former frame's half is kept
    pass     a pass of its own after the paths (works on the memory)
    final    offline, the pass that makes the picture of all iterations (from the memory)
    setting  a cvar r_NAME_... and its field in the uniform block
    view     a debug view

Every estimator that its row calls unbiased is held to pt's mean by lab_test (UnbiasedStatistics, suite Every).
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

PARTS = ["lights", "control", "record", "memory", "pass", "final", "setting", "view"]
NEEDS = {"pass": ["memory"], "final": ["pass", "record"], "view": ["memory"], "setting": ["pass"]}  # what a part's example works on

SHADER = """// Technique `{name}`: {description}. Unbiased for paths of at most frame.bounces
// reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
{headers}#include "lib/steps/one_path.glsl"
#include "lib/steps/no_field.glsl"
#include "estimators/{name}/propose.glsl"
{direct}{control}#include "lib/steps/no_learning.glsl"
{record}{views}
#include "lib/paths_main.glsl"
"""

PROPOSE = """// Step `proposal` of `{name}`: half of the directions from the vertex's own scattering, half uniform over the hemisphere;
// each is weighted by the density of both together.
#include "lib/path_state.glsl"

struct Guidance {{
  uint none;
}};
void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {{ g.none = 0u; }}

float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {{
  float uniform_pdf = dot(direction, scatter_axis(v.scatter)) > 0.0 ? 1.0 / (2.0 * kPiShared) : 0.0;
  return 0.5 * (scatter_pdf + uniform_pdf);
}}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {{
  vec3 w = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  vec3 direction = scatter_sample(v.scatter, v.view, w).direction;
  vec2 u = vec2(rng_uniform(rng), rng_uniform(rng));
  if (rng_uniform(rng) < 0.5) {{
    float r = sqrt(max(1.0 - u.x * u.x, 0.0)), phi = 2.0 * kPiShared * u.y;
    direction = frame_about(scatter_axis(v.scatter)) * vec3(r * cos(phi), r * sin(phi), u.x);
  }}
  float scatter_pdf;
  vec3 f = scatter_eval(v.scatter, v.view, direction, scatter_pdf);
  return proposed(direction, f, proposal_pdf(v, g, direction, scatter_pdf), 0u);
}}
"""

LIGHTS = """#include "lib/steps/direct_list.glsl"
uint light_candidates() { return uint(own.nee_candidates); }
uint remembered_candidates() { return uint(own.nee_remembered); }
uint light_seen_stride() { return own.seen_stride; }
bool knows_ways() { return own.nee_visibility != 0; }
uint known_ways() { return own.seen_ways; }
"""

CONTROL = """// Step `control` of `{name}`: light that is the same from everywhere, of which a white surface reflects kLight.
#include "lib/path_state.glsl"

const bool kHasControl = true;
const float kLight = 0.05;

// The integral of control_at over the hemisphere, over which half of the proposals are spread.
vec3 control_mean(Vertex v, Guidance g, Field here) {{ return vec3(kLight); }}
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {{
  return vec3(kLight * max(dot(direction, scatter_axis(v.scatter)), 0.0) / kPiShared);
}}
"""

RECORD = """// Step `record` of `{name}`: {what}.
#include "lib/incident.glsl"

const bool kRecords = true;

void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput) {{}}
void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput) {{}}
void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput) {{}}
void record_path(Path path, vec3 sum, inout uint rng) {{{store}}}
void record_none(uvec2 block, uvec2 pixel) {{{none}}}
"""
STORE = """
  if (IN_MEDIUM || any(isnan(sum)) || any(isinf(sum))) return;
  {name}_pixels.at[own.now + lit_index(path.pixel)] = vec4(sum, 1.0);
"""
NONE = """
  {name}_pixels.at[own.now + lit_index(pixel)] = vec4(0.0);
"""

ARRAYS = """// Array and constants of `{name}`.
#ifndef FB_{NAME}_ARRAYS
#define FB_{NAME}_ARRAYS
#include "estimators/{name}/{name}.h"
#include "lib/pixel.glsl"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform OwnBlock {{ {Name}Constants own; }};
{array}#endif
"""
ARRAY = """FB_TECHNIQUE_ARRAY(k{Name}Pixels, 16, , PixelArray, vec4, {name}_pixels)
"""

PASS = """// Takes this frame's light of each pixel into the mean of those before; w: how many these are.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/{name}/arrays.glsl"
#include "lib/pixel.glsl"

void main() {{
  uvec2 pixel = light_pixel(invocation_pixel());
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = lit_index(pixel);
  vec4 now = {name}_pixels.at[own.now + at], former = {name}_pixels.at[own.former + at];
  float frames = now.w > 0.0 ? former.w + now.w : 0.0;
  vec3 mean = frames > 0.0 ? mix(former.rgb, now.rgb, max({alpha}, 1.0 / frames)) : vec3(0.0);
  {name}_pixels.at[own.now + at] = vec4(mean, frames);
}}
"""

FINAL = """// The picture of all iterations: what the last frame knew of each pixel's light.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/{name}/arrays.glsl"
#include "lib/steps/none.glsl"
#include "lib/store_light.glsl"

void main() {{
  PathPixel p = path_pixel(invocation_pixel());
  if (!within_picture(p)) return;
  GBufferTexel g = gbuffer_at(p.at);
  vec4 known = {name}_pixels.at[own.former + lit_index(p.pixel)];
  if (reflects_light(g) && known.w > 0.0) store_light(p, g, PixelLight(known.rgb, vec4(0.0), 0.0), 1.0);
  else store_emission(p, g);
}}
"""

VIEWS = """// Step `views` of `{name}`: what is known of each pixel.
#include "lib/store_light.glsl"

const bool kHasViews = true;

void draw_view(PathPixel p, bool lit, Vertex v) {{
  vec3 x = lit ? {name}_pixels.at[own.former + lit_index(p.pixel)].rgb * exposure_now() : vec3(0.0);
  ldr.at[p.at] = packUnorm4x8(vec4(sqrt(x / (1.0 + x)), 1.0));
}}
"""

HEADER = """// `{name}`: what it keeps, what can be set, what it shows.
#ifndef FB_{NAME}_H
#define FB_{NAME}_H
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

{arrays}{settings}{views}struct {Name}Constants {{
{fields}}};

FB_NAMESPACE_END
#endif
"""
HEADER_ARRAYS = """// Arrays: X(constant, binding, what there is one element of, bytes of one, two halves, name).
#define FB_{NAME}_ARRAYS_OF(X) X(k{Name}Pixels, 0u, kPixel, 16u, true, "{name} pixels")
FB_{NAME}_ARRAYS_OF(FB_ARRAY_CONSTANT)

"""
HEADER_SETTINGS = """// clang-format off
#define FB_{NAME}_SETTINGS(X) \\
  X(float, {name}_alpha, "r_{name}_alpha", 0.1f, 0.001f, 1, "{name}: weight of a new frame in what is remembered of a pixel")
// clang-format on

"""
HEADER_VIEWS = """FB_CONST uint kViewOf{Name} = kViewOfTechniques + {owner}u;
#define FB_{NAME}_VIEWS(X) X(kView{Name}, {number}u, kViewOf{Name}, "{name}", "{name}: what is remembered of a pixel")
FB_{NAME}_VIEWS(FB_VIEW_CONSTANT)

"""

PLAIN_HOST = """// Technique `{name}`: its shader alone.
#include "render/techniques/technique.h"

namespace fb::render {{

extern constinit const TechniqueInfo k{Name}{{
    .name = "{name}",
    .description = "{description}; unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_path_technique}};

}}  // namespace fb::render
"""

HOST = """// Technique `{name}`: what it keeps, and its passes.
#include <cstring>
#include <memory>

#include "estimators/{name}/{name}.h"
#include "render/techniques/path_technique.h"
{includes}
namespace fb::render {{
namespace {{
{rows}
class {Name}Technique : public PathTechnique {{
 public:
  {Name}Technique(const TechniqueTools& tools, std::string_view name)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::{Name}Constants), "constants of {name}"){members} {{
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }}
  void prepare(const TechniqueFrame& frame) override {{
    shared::{Name}Constants constants{{}};
    copy_settings(frame.settings, constants);
{prepare}    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
  }}
  void add_passes(const TechniquePasses& passes) override {{
{before}    PathTechnique::add_passes(passes);
{after}  }}
{final}  void forget() override {{{forget}}}
{salt}  std::uint64_t bytes() const override {{ return {bytes}; }}

 private:
  gpu::Buffer uniform_;
{fields}}};

std::unique_ptr<Technique> make_{name}(const TechniqueTools& tools, std::string_view name) {{
  return std::make_unique<{Name}Technique>(tools, name);
}}

}}  // namespace

extern constinit const TechniqueInfo k{Name}{{
    .name = "{name}",
    .description = "{description}; unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_{name}{info}}};

}}  // namespace fb::render
"""

PAGE = """# `{name}`

{description}.

- **Bias:** none, for paths of at most `r_bounces` reflections: each direction's weight is `f cos / pdf` of the density that
  both ways of sampling have together.
- **Choose it:** `r_estimator {name}`; in the laboratory `--estimator {name}`.
- **Hold it to `pt`:** `build/fullbright-lab ztest --scene kinds --estimator {name}`.
- **Measure it:** `build/fullbright-lab bench --scene kinds --config pt:r_estimator=pt --config {name}:r_estimator={name}`.
"""


def files_of(name: str, description: str, parts: set[str], view_number: int, view_owner: int) -> dict[str, str]:
    """The new files' texts, by their paths."""
    values = {"name": name, "NAME": name.upper(), "Name": "".join(word.capitalize() for word in name.split("_")),
              "description": description}
    keeps = bool(parts & {"lights", "memory", "setting"})
    files = {}

    def shader(path: str, text: str, **more: str) -> None:
        files[f"Shaders/estimators/{name}/{path}"] = text.format(**values, **more)

    own = f'#include "estimators/{name}/'
    shader(f"{name}.comp", SHADER,
           headers=own + 'arrays.glsl"\n' if keeps else "",
           direct=LIGHTS if "lights" in parts else '#include "lib/steps/no_direct.glsl"\n',
           control=own + 'control.glsl"\n' if "control" in parts else '#include "lib/steps/no_control.glsl"\n',
           record=own + 'record.glsl"\n' if "record" in parts else '#include "lib/steps/no_record.glsl"\n',
           views=own + 'views.glsl"\n' if "view" in parts else '#include "lib/steps/no_views.glsl"\n')
    shader("propose.glsl", PROPOSE)
    shader("README.md", PAGE)
    if "control" in parts:
        shader("control.glsl", CONTROL)
    if "record" in parts:
        stores = "memory" in parts
        shader("record.glsl", RECORD, what="the light of a pixel's last path is kept" if stores else "nothing is kept yet",
               store=STORE.format(**values) if stores else "",
               none=NONE.format(**values) if stores else "")
    if "pass" in parts:
        shader("passes/mean.comp", PASS, alpha=f"own.{name}_alpha" if "setting" in parts else "0.0")
    if "final" in parts:
        shader("passes/final.comp", FINAL)
    if "view" in parts:
        shader("views.glsl", VIEWS)
    host = f"Quake/render/techniques/{name}.cpp"
    if not keeps:
        files[host] = PLAIN_HOST.format(**values)
        return files

    shader("arrays.glsl", ARRAYS, array=ARRAY.format(**values) if "memory" in parts else "")
    fields = ""
    if "setting" in parts:
        fields += f"  FB_{values['NAME']}_SETTINGS(FB_UNIFORM_FIELD)\n"
    if "lights" in parts:
        fields += ("  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)\n  uint seen_stride;  // of this many shadow rays one is remembered; a power of two\n"
                   "  uint seen_ways;    // the table of ways that is read, 0 or 1\n")
    if "memory" in parts:
        fields += "  uint now, former;  // where the halves of the array begin, elements\n"
    shader(f"{name}.h", HEADER,
           arrays=HEADER_ARRAYS.format(**values) if "memory" in parts else "",
           settings=HEADER_SETTINGS.format(**values) if "setting" in parts else "",
           views=HEADER_VIEWS.format(**values, number=view_number, owner=view_owner) if "view" in parts else "",
           fields=fields)
    lights, memory = "lights" in parts, "memory" in parts
    pixels = f"shared::k{values['Name']}Pixels"
    files[host] = HOST.format(
        **values,
        includes=('#include "render/techniques/seen_grid.h"\n' if lights else "")
        + ('#include "render/techniques/technique_memory.h"\n' if memory else ""),
        rows=f"\nconstexpr ArrayRow k{values['Name']}Rows[]{{FB_{values['NAME']}_ARRAYS_OF(FB_ARRAY_ROW)}};\n" if memory else "",
        members=(",\n        seen_(tools)" if lights else "")
        + (f',\n        memory_(tools.device, tools.table, k{values["Name"]}Rows, "{name} reset")' if memory else ""),
        prepare=("    constants.seen_stride = seen_stride(frame.lit, frame.settings, frame.medium());\n"
                 "    constants.seen_ways = seen_.begin_frame();\n    frame_ = seen_.fresh() ? 1 : frame_ + 1;\n" if lights else "")
        + (f"    if (frame.cut) memory_.forget();\n    memory_.begin_frame(frame.lit);\n    constants.now = memory_.now({pixels});\n"
           f"    constants.former = memory_.former({pixels});\n" if memory else ""),
        before=("    seen_.add_reset(passes.list);\n" if lights else "") + ("    memory_.add_reset(passes.list);\n" if memory else ""),
        after=("    seen_.add_fold(passes.list, passes.shaders);\n" if lights else "")
        + (f'    passes.list.dispatch("{name} mean", PassKind::kEstimator, passes.shaders.get("{name}_mean"),\n'
           "                         groups_over(passes.size, 8));\n" if "pass" in parts else ""),
        final=("  void add_final_passes(const TechniquePasses& passes) override {\n    memory_.add_reset(passes.list);\n"
               f'    passes.list.dispatch("{name} final", PassKind::kEstimator, passes.shaders.get("{name}_final", passes.variant),\n'
               "                         groups_over(passes.size, 8));\n  }\n" if "final" in parts else ""),
        forget="\n" + ("    seen_.forget();\n" if lights else "") + ("    memory_.forget();\n" if memory else "") + "  ",
        salt="  std::uint32_t salt() const override { return frame_; }\n" if lights else "",
        bytes=" + ".join(["seen_.bytes()"] * lights + ["memory_.bytes()"] * memory) or "0",
        fields=("  SeenGrid seen_;\n  std::uint32_t frame_ = 0;  // since it forgot\n" if lights else "")
        + ("  TechniqueMemory memory_;\n" if memory else ""),
        info=(",\n    .frames = Frames::kLearning,\n    .wants_lights = true" if lights else "")
        + (f",\n    .views = shared::kViewOf{values['Name']}" if "view" in parts else "")
        + (",\n    .ends_iterations = true" if "final" in parts else ""))
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
    """Names that are taken: shaders', with what CMake calls their variants, and words that would name a struct twice."""
    names = {"frame", "guide"}  # FrameConstants, GuideConstants
    for path in (root / "Shaders/estimators").glob("*/*.comp"):
        names |= {path.stem, f"{path.stem}_medium"}
    for path in (root / "Shaders/estimators").glob("*/passes/*.comp"):
        names.add(f"{path.parent.parent.name}_{path.stem}")
    lists = root / "Shaders/CMakeLists.txt"
    if lists.exists():
        names |= set(re.findall(r"^fb_shader\((\w+)", lists.read_text(), re.M))
        names |= {word for words in re.findall(r"^foreach\(pass ([\w ]+)\)", lists.read_text(), re.M) for word in words.split()}
    return names


def formatted(root: pathlib.Path, paths: list[pathlib.Path]) -> None:
    """In the shape that Misc/check_format.sh wants, where there is clang-format and the checkout says which shape."""
    tool, style = shutil.which("clang-format"), root / ".clang-format"
    sources = [str(path) for path in paths if path.suffix in (".cpp", ".h")]
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
    if not re.fullmatch(r"[a-z][a-z0-9_]{0,30}", options.name):
        print(f"new_estimator: '{options.name}' is no name: lower case letters, digits and _ after a letter, up to 31",
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
    folder = root / "Shaders/estimators" / options.name
    if folder.exists() or options.name in shaders_of(root):
        print(f"new_estimator: there is a shader {options.name} already: an estimator's or a pass's", file=sys.stderr)
        return 2
    texts = "".join(path.read_text() for path in [root / "Shaders/shared/debug_views.h", *(root / "Shaders/estimators").glob("*/*.h")]
                    if path.exists())
    number = max([int(n) for n in re.findall(r"X\(kView\w+, (\d+)u", texts)], default=0) + 1
    owner = len(re.findall(r"FB_CONST uint kViewOf\w+ = kViewOfTechniques", texts))
    try:
        rows = with_rows(options.name, parts, table.read_text(), headers.read_text())
    except (OSError, AssertionError) as wrong:
        print(f"new_estimator: {wrong}", file=sys.stderr)
        return 1
    written = files_of(options.name, options.description, parts, number, owner)
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
    return 0


if __name__ == "__main__":
    sys.exit(main())
