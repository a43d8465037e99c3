"""What new_estimator.py writes, as texts in which names are replaced: steps, arrays, passes, the host's file."""

SHADER = """// Technique `{name}`: {description}. Unbiased for paths of at most frame.bounces
// reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
{headers}#include "{begin}"
#include "lib/steps/no_field.glsl"
#include "estimators/{name}/propose.glsl"
{direct}{control}#include "lib/steps/no_learning.glsl"
{record}{views}
#include "lib/paths_main.glsl"
"""

PROPOSE = """// Step `proposal` of `{name}`: half of the directions are of the vertex's own scattering, half are {even};
// each is weighted by the density of both together.
{headers}
struct Guidance {{
{fields}}};
void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {{
{prepare}}}

float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {{
{density}}}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {{
  vec3 w = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  vec3 direction = scatter_sample(v.scatter, v.view, w).direction;
{draw}  float scatter_pdf;
  vec3 f = scatter_eval(v.scatter, v.view, direction, scatter_pdf);
  return proposed(direction, f, proposal_pdf(v, g, direction, scatter_pdf), 0u);
}}
"""
EVEN = {  # of the half that is no scattering: what it is, its density, how it is drawn
    False: ("uniform",
            """  float uniform_pdf = dot(direction, scatter_axis(v.scatter)) > 0.0 ? 1.0 / (2.0 * kPiShared) : 0.0;
  return 0.5 * (scatter_pdf + uniform_pdf);
""",
            """  vec2 u = vec2(rng_uniform(rng), rng_uniform(rng));
  if (rng_uniform(rng) < 0.5) {
    float r = sqrt(max(1.0 - u.x * u.x, 0.0)), phi = 2.0 * kPiShared * u.y;
    direction = frame_about(scatter_axis(v.scatter)) * vec3(r * cos(phi), r * sin(phi), u.x);
  }
"""),
    True: ("kept",
           """  return 0.5 * (scatter_pdf + 1.0 / kSphere);
""",
           """  if (rng_uniform(rng) < 0.5) direction = g.kept;
"""),
}

BEGIN = """// Step `begin` of `{name}`: what its paths carry.
#ifndef FB_{NAME}_BEGIN
#define FB_{NAME}_BEGIN
struct PathOwn {{
  bool first;  // of its pixel's
  uint cell;   // about its first vertex
}};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {{
  path.own.first = i == 0u;
  path.own.cell = kNoIndex;
}}
#endif
"""

LIGHTS = """#include "lib/steps/direct_list.glsl"
uint light_candidates() { return uint(own.nee_candidates); }
uint remembered_candidates() { return uint(own.nee_remembered); }
uint light_seen_stride() { return own.seen_stride; }
bool knows_ways() { return own.nee_visibility != 0; }
uint known_ways() { return own.seen_ways; }
"""

CONTROL = """// Step `control` of `{name}`: light that is the same from everywhere. A white surface reflects {what}.
#include "lib/path_state.glsl"

const bool kHasControl = true;
{constant}
// The integral of control_at over the hemisphere, over which proposals are spread.
vec3 control_mean(Vertex v, Guidance g, Field here) {{ return vec3({light}); }}
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {{
  return vec3({light} * max(dot(direction, scatter_axis(v.scatter)), 0.0) / kPiShared);
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
"""
STORE_PIXEL = """  {name}_pixels.at[own.now + lit_index(path.pixel)] = vec4(sum, 1.0);
"""
STORE_CELL = """  if (path.own.cell != kNoIndex) add_to_cell(path.own.cell, sum);
"""
NONE_PIXEL = """
  {name}_pixels.at[own.now + lit_index(pixel)] = vec4(0.0);
"""
NONE_KEPT = """
  {name}_kept.at[own.now_kept + lit_index(pixel)] = vec4(0.0);
"""

ARRAYS = """// Array and constants of `{name}`.
#ifndef FB_{NAME}_ARRAYS
#define FB_{NAME}_ARRAYS
#include "estimators/{name}/{name}.h"
#include "lib/pixel.glsl"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform OwnBlock {{ {Name}Constants own; }};
{arrays}#endif
"""
ARRAY = {"memory": """FB_TECHNIQUE_ARRAY(k{Name}Pixels, 16, , PixelArray, vec4, {name}_pixels)
""", "reuse": """FB_TECHNIQUE_ARRAY(k{Name}Kept, 16, , KeptArray, vec4, {name}_kept)
""", "table": """FB_TECHNIQUE_ARRAY(k{Name}Cells, 4, , CellWordArray, uint, {name}_cells)
""", "probes": """FB_TECHNIQUE_ARRAY(k{Name}Probes, 16, , ProbeArray, vec4, {name}_probes)
"""}

CELLS = """// What `{name}` knows of cells of the world: the mean light that first vertices in each reflect. Cells that share an
// element share a mean; lib/cells.glsl tells them apart, and finds coarser ones far from the camera.
#ifndef FB_{NAME}_CELLS
#define FB_{NAME}_CELLS
#include "estimators/{name}/arrays.glsl"
#include "lib/interaction.glsl"
#include "shared/hash_grid.h"

const float kCellWidth = 64.0;
// Light is added up in whole steps, so that sums do not depend on the order of threads; the largest sum of so many
// samples fits.
const float kCellSteps = 1024.0, kMostCellLight = 256.0;
const uint kMostInCell = 4096u;

uint cell_about(Vertex v, inout uint rng) {{
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  return grid_vertex(v.position, kCellWidth, cube_face(scatter_axis(v.scatter)), u).hash & (own.cells - 1u);
}}
float light_of_cell(uint cell) {{ return uintBitsToFloat({name}_cells.at[4u * cell + 2u]); }}
void add_to_cell(uint cell, vec3 light) {{
  float x = clamp(dot(light, vec3(1.0 / 3.0)), -kMostCellLight, kMostCellLight);
  if (atomicAdd({name}_cells.at[4u * cell + 1u], 1u) < kMostInCell)
    atomicAdd({name}_cells.at[4u * cell], uint(int(x * kCellSteps)));
}}
#endif
"""
FOLD = """// Takes this frame's samples of each cell into what is known of it, for the next frame: a mean that changes while paths
// read it would be a bias.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/{name}/cells.glsl"

const float kMostKnown = 65536.0;  // samples: older ones fade

void main() {{
  uint cell = gl_GlobalInvocationID.x;
  if (cell >= own.cells) return;
  uint count = min({name}_cells.at[4u * cell + 1u], kMostInCell);
  if (count == 0u) return;
  float now = float(int({name}_cells.at[4u * cell])) / (kCellSteps * float(count)), before = light_of_cell(cell);
  float known = min(uintBitsToFloat({name}_cells.at[4u * cell + 3u]) + float(count), kMostKnown);
  {name}_cells.at[4u * cell] = {name}_cells.at[4u * cell + 1u] = 0u;
  {name}_cells.at[4u * cell + 2u] = floatBitsToUint(mix(before, now, min(float(count) / known, 1.0)));
  {name}_cells.at[4u * cell + 3u] = floatBitsToUint(known);
}}
"""
PROBES = """// Probes of `{name}`: points in a grid about the scene that know the mean light which is emitted towards them.
#ifndef FB_{NAME}_PROBES
#define FB_{NAME}_PROBES
#include "estimators/{name}/arrays.glsl"

ivec3 probes_along() {{ return ivec3(own.count_x, own.count_y, own.count_z); }}
vec3 place_of_probe(uint probe) {{
  uvec3 n = uvec3(probes_along()), at = uvec3(probe % n.x, probe / n.x % n.y, probe / (n.x * n.y));
  return own.origin.xyz + (vec3(at) + 0.5) * own.spacing.xyz;
}}
uint probe_about(vec3 p) {{
  ivec3 n = probes_along(), at = clamp(ivec3(floor((p - own.origin.xyz) / own.spacing.xyz)), ivec3(0), n - 1);
  return uint((at.z * n.y + at.y) * n.x + at.x);
}}
float light_of_probe(uint probe) {{ return dot({name}_probes.at[probe].rgb, vec3(1.0 / 3.0)); }}
#endif
"""
ASK = """// A ray from each probe; w: rays so far, as which an old probe's count less.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/steps/none.glsl"
#include "estimators/{name}/probes.glsl"

void main() {{
  uint probe = gl_GlobalInvocationID.x;
  if (probe >= uint(own.count_x * own.count_y * own.count_z)) return;
  uint rng = rng_seed(probe, frame.frame, 0u, frame.seed ^ 0x2545f491u);
  float z = 1.0 - 2.0 * rng_uniform(rng), r = sqrt(max(1.0 - z * z, 0.0)), phi = 2.0 * kPiShared * rng_uniform(rng);
  vec3 direction = vec3(r * cos(phi), r * sin(phi), z);
  Segment way = segment_of(place_of_probe(probe), kNoIndex, direction, kRayEnd, kTurnByChance, rng);
  vec3 light = vec3(0.0);
  if (!ends_in_darkness(way))
    light = load_surface(way.hit, way.direction, kFilterNearest, true, false).emission * way.left;
  vec4 known = {name}_probes.at[probe];
  float rays = min(known.w + 1.0, 1024.0);
  if (!any(isnan(light)) && !any(isinf(light))) {name}_probes.at[probe] = vec4(mix(known.rgb, light, 1.0 / rays), rays);
}}
"""
REUSE = """// A reservoir over time at every pixel (shared/reservoir.h) of a direction for its first path: a place on the sphere, W and
// confidence. Its target is one everywhere, so that whatever is kept stays uniform over the sphere, at any surface and
// in any motion. With a target of its own each pixel weighs a sample by W, for which there is no density then, and
// former frames' targets are asked by the former G-buffer (estimators/restir).
#ifndef FB_{NAME}_REUSE
#define FB_{NAME}_REUSE
#include "estimators/{name}/arrays.glsl"
#include "estimators/{name}/begin.glsl"
#include "shared/reservoir.h"

const float kSphere = 4.0 * kPiShared;  // one over the density of a new direction
const float kHistory = 8.0;             // frames that a kept sample counts for, at most

vec3 on_sphere(vec2 u) {{
  float z = 1.0 - 2.0 * u.x, r = sqrt(max(1.0 - z * z, 0.0)), phi = 2.0 * kPiShared * u.y;
  return vec3(r * cos(phi), r * sin(phi), z);
}}

vec3 kept_direction(Path path, inout uint rng) {{
  vec2 place = vec2(rng_uniform(rng), rng_uniform(rng));
  if (IN_MEDIUM || path.depth != 0u || !path.own.first) return on_sphere(place);
  uint at = lit_index(path.pixel);
  vec4 old = {name}_kept.at[own.former_kept + at];
  Reservoir former = empty_reservoir(), r = empty_reservoir();
  former.contribution_weight = old.z;
  former.confidence = min(old.w, kHistory);
  float all = 1.0 + former.confidence;
  update_reservoir(r, mis_by_confidence(1.0, all) * kSphere, 1.0, 1.0, rng_uniform(rng));
  float share = mis_by_confidence(former.confidence, all);
  if (merge_reservoir(r, former, share, 1.0, 1.0, rng_uniform(rng))) place = old.xy;
  finish_reservoir(r, 1.0);
  {name}_kept.at[own.now_kept + at] = vec4(place, r.contribution_weight, r.confidence);
  return on_sphere(place);
}}
#endif
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
HEADER_ARRAYS = """// Arrays{which}: X(constant, binding, what there is one element of, bytes of one, two halves, name).
#define FB_{NAME}_{list}(X) {rows}
FB_{NAME}_{list}(FB_ARRAY_CONSTANT)

"""
ROWS = {"memory": 'X(k{Name}Pixels, 0u, kPixel, 16u, true, "{name} pixels")',
        "reuse": 'X(k{Name}Kept, 1u, kPixel, 16u, true, "{name} reservoirs")',
        "table": 'X(k{Name}Cells, 2u, kTable, 16u, false, "{name} cells")',
        "probes": 'X(k{Name}Probes, 3u, kProbe, 16u, false, "{name} probes")'}
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

# Statements of the host's file. {name} and {Name} are replaced; braces stand as they are.
PREPARE_PROBES = """    const ProbeGrid grid = probe_grid(lit_bounds(frame.snapshot), frame.snapshot.camera.position, 128.0f);
    if (!grid_.goes_on_as(grid)) world_.forget();
    grid_ = grid;
    world_.set_count(shared::k{Name}Probes, grid.probes());
    const vec3 first(static_cast<float>(grid.first[0]), static_cast<float>(grid.first[1]), static_cast<float>(grid.first[2]));
    constants.origin = vec4(grid.origin + first * grid.spacing, 0.0f);
    constants.spacing = vec4(grid.spacing, 0.0f);
    constants.count_x = grid.count[0], constants.count_y = grid.count[1], constants.count_z = grid.count[2];
"""
PREPARE_CELLS = """    constants.cells = 1u << 14u;
    world_.set_count(shared::k{Name}Cells, constants.cells);
"""
DISPATCH_PROBES = """    passes.list.dispatch("{name} probes", PassKind::kEstimator, passes.shaders.get("{name}_probes", passes.variant),
                         {(grid_.probes() + 63) / 64, 1});
"""
DISPATCH_CELLS = """    passes.list.dispatch("{name} cells", PassKind::kEstimator, passes.shaders.get("{name}_cells"), {(1u << 14u) / 64, 1});
"""
DISPATCH_MEAN = """    passes.list.dispatch("{name} mean", PassKind::kEstimator, passes.shaders.get("{name}_mean"), groups_over(passes.size, 8));
"""
FINAL_PASSES = """  void add_final_passes(const TechniquePasses& passes) override {
    memory_.add_reset(passes.list);
    passes.list.dispatch("{name} final", PassKind::kEstimator, passes.shaders.get("{name}_final", passes.variant),
                         groups_over(passes.size, 8));
  }
"""

PAGE = """# `{name}`

{description}.

- **Bias:** none, for paths of at most `r_bounces` reflections: each direction's weight is `f cos / pdf` of the density that
  both ways of sampling have together.
- **Choose it:** `r_estimator {name}`; in the laboratory `--estimator {name}`.
- **Hold it to `pt`:** `build/fullbright-lab ztest --scene kinds --estimator {name}`.
- **Measure it:** `build/fullbright-lab bench --scene kinds --config pt:r_estimator=pt --config {name}:r_estimator={name}`.
"""
