#include "render/scene/light_list.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "render/scene/alias_table.h"
#include "render/scene/gpu_scene_copies.h"
#include "scene/library/asset_builder.h"
#include "scene/shapes.h"
#include "shared/spot.h"

namespace fb::render {
namespace {

constexpr float kUsualDistance = 200.0f;  // units, of what a lamp lights

// Of what a lamp would light by the square's law of distance, what it lights by its own: a strong one of a flat law
// would be drawn in the place of all others.
float share_by_law(const shared::GpuInstance& lamp) {
  const std::uint32_t law = (lamp.flags >> shared::kInstanceFallShift) & 7u;
  if ((lamp.flags & shared::kInstanceIsSpot) == 0 || law == shared::kFallSquare) return 1.0f;
  return shared::fall_share(law, std::clamp(kUsualDistance * lamp.pose_scale.x, 1e-6f, 1.0f));
}

float sum(const vec3& v) { return v.x + v.y + v.z; }

// A mesh's vertices in the world, as the instance poses it.
std::vector<vec3> world_vertices(const scene::Mesh& mesh, const MeshRecord& record, const scene::Instance& instance) {
  std::vector<vec3> out(mesh.vertex_count);
  const scene::PoseBlend pose = InstanceCopies::canonical(record, instance.pose);
  for (std::uint32_t v = 0; v < out.size(); ++v) {
    const vec3 local =
        glm::mix(scene::vertex_position(mesh, v, pose.a), scene::vertex_position(mesh, v, pose.b), pose.t);
    out[v] = transform_point(instance.transform, local);
  }
  return out;
}

}  // namespace

const LightList::Means& LightList::means(const scene::Assets& assets, std::uint32_t image) {
  means_.resize(assets.images.size());
  std::optional<Means>& known = means_[image];
  if (known) return *known;
  return known.emplace(Means{scene::mean_color(assets.palette, assets.images[image]),
                             scene::mean_glow(assets.palette, assets.images[image])});
}

float LightList::sky_radiance(const scene::Assets& assets, const scene::Sky& sky) {
  const float even = sum(sky.even);
  const auto mean = [&](std::uint32_t image) {
    return image < assets.images.size() ? sum(means(assets, image).all * sky.color) : 0.0f;
  };
  switch (sky.mode) {
    case scene::SkyMode::kBlack:
      return even;
    case scene::SkyMode::kConstant:
      return even + sum(sky.color);
    case scene::SkyMode::kLayers:
      return even + mean(sky.solid);
    case scene::SkyMode::kBox: {
      float all = 0.0f;
      for (std::uint32_t image : sky.box) all += mean(image);
      return even + all / static_cast<float>(sky.box.size());
    }
  }
  return 0.0f;
}

// The cases are shade_point's (Shaders/lib/material.glsl).
float LightList::radiance(const scene::Assets& assets, const shared::GpuMaterial& m, float sky) {
  using Kind = scene::EmissionKind;
  const vec3 factor = vec3(m.emission) * ((m.flags & scene::kMaterialDielectric) != 0 ? m.opaque_share : 1.0f);
  const auto kind = static_cast<Kind>(m.emission_kind);
  if (kind == Kind::kSky) return sky * sum(factor) / 3.0f;
  if (kind == Kind::kConstant) return sum(factor);
  if (m.base >= assets.images.size()) return 0.0f;
  if (kind == Kind::kFullbright) {
    if (m.luma < assets.images.size()) return sum(means(assets, m.luma).all * factor);
    return (m.flags & scene::kMaterialNoFullbright) != 0 ? 0.0f : sum(means(assets, m.base).glowing * factor);
  }
  return shared::all_texels_glow(m.emission_kind) ? sum(means(assets, m.base).all * factor) : 0.0f;
}

std::vector<LightList::Glowing> LightList::find_glowing(std::span<const Source> sources, std::span<const float> glow,
                                                        std::uint64_t most) {
  std::vector<Glowing> found;
  for (std::uint32_t i = 0; i < sources.size(); ++i) {
    const Source& s = sources[i];
    if ((s.instance->visibility & scene::kSeenByIndirect) == 0) continue;
    Glowing g;
    g.instance = i;
    g.id = s.instance->id;
    g.mesh = s.instance->mesh;
    g.material_base = s.gpu->material_base;
    g.colored = (s.gpu->flags & shared::kInstanceHasColor) != 0;
    g.color = g.colored ? sum(vec3(s.gpu->emission)) * share_by_law(*s.gpu) : 0.0f;
    const auto& materials = s.mesh->materials;
    if (g.colored ? !(g.color > 0.0f) : std::none_of(materials.begin(), materials.end(), [&](std::uint32_t material) {
          return glow[material + g.material_base] > 0.0f;
        }))
      continue;
    if (s.mesh->triangle_count > most) continue;
    most -= s.mesh->triangle_count;
    g.transform = s.instance->transform;
    g.pose = s.instance->pose;
    found.push_back(g);
  }
  return found;
}

void LightList::list_triangles(const scene::Assets& assets, std::span<const Source> sources) {
  first_lights_.assign(sources.size(), shared::kNoIndex);
  lights_.clear();
  std::vector<double> powers;
  double total = 0;
  for (const Glowing& g : glowing_) {
    const Source& s = sources[g.instance];
    const scene::Mesh& mesh = assets.meshes[g.mesh];
    first_lights_[g.instance] = static_cast<std::uint32_t>(lights_.size());
    const std::vector<float>& area = areas(assets, s);
    for (std::uint32_t t = 0; t < s.mesh->triangle_count; ++t) {
      const float radiance = g.colored ? g.color : glow_[mesh.triangles[s.mesh->order[t]].material + g.material_base];
      const float power = radiance * area[t];
      powers.push_back(power > 0.0f && std::isfinite(power) ? static_cast<double>(power) : 0.0);
      total += powers.back();
      shared::GpuLight light{};
      light.instance = g.instance;
      light.triangle = t;
      lights_.push_back(light);
    }
  }
  power_ = static_cast<float>(0.5 * total);  // areas are doubled
  if (total <= 0) {
    first_lights_.assign(sources.size(), shared::kNoIndex);
    lights_.clear();
  }
  // Integers that add up: differences of the rounded sums.
  double sum_of_powers = 0;
  std::uint32_t begin = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    sum_of_powers += powers[i];
    const auto end = static_cast<std::uint32_t>(sum_of_powers / total * shared::kLightRange);
    lights_[i].probability = end - begin;
    begin = end;
  }
  std::vector<std::uint32_t> probabilities;
  for (const shared::GpuLight& light : lights_) probabilities.push_back(light.probability);
  const std::vector<AliasPlace> table = make_alias_table(probabilities, shared::kLightRange);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    lights_[i].threshold = table[i].threshold;
    lights_[i].other = table[i].other;
  }
  list_lamps();
}

// Of a lamp's lights within it, in proportion to their probabilities, none zero; they add up to kLampRange.
std::vector<std::uint32_t> LightList::lamp_shares(std::span<const std::uint32_t> members) const {
  double all = 0;
  for (const std::uint32_t i : members) all += lights_[i].probability;
  std::vector<std::uint32_t> shares;
  std::uint32_t sum = 0;
  for (const std::uint32_t i : members) {
    shares.push_back(1 +
                     static_cast<std::uint32_t>(lights_[i].probability / all * (shared::kLampRange - members.size())));
    sum += shares.back();
  }
  *std::max_element(shares.begin(), shares.end()) += shared::kLampRange - sum;  // what rounding left
  return shares;
}

// An instance's triangles come in the order of its tree's leaves: neighbours in the list are so in space.
std::vector<std::vector<std::uint32_t>> LightList::find_lamps(std::uint32_t instance) const {
  std::vector<std::vector<std::uint32_t>> lamps;
  if (lights_.empty()) return lamps;
  for (std::uint32_t i = first_lights_[instance]; i < lights_.size() && lights_[i].instance == instance; ++i) {
    if (lights_[i].probability == 0) continue;
    const bool joins =
        !lamps.empty() && lamps.back().size() < shared::kLampLights && i - lamps.back().back() <= shared::kLampGap;
    if (!joins) lamps.emplace_back();
    lamps.back().push_back(i);
  }
  return lamps;
}

void LightList::list_lamps() {
  lamps_.clear();
  members_.clear();
  for (const Glowing& g : glowing_) {
    const std::vector<std::vector<std::uint32_t>> lamps = find_lamps(g.instance);
    const std::vector<std::uint32_t>& numbers = numbers_.of(g.id, static_cast<std::uint32_t>(lamps.size()));
    lamps_.resize(numbers_.end());
    members_.resize(numbers_.end());
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::vector<std::uint32_t>& own = lamps[k];
      const std::vector<std::uint32_t> shares = lamp_shares(own);
      const std::vector<AliasPlace> table = make_alias_table(shares, shared::kLampRange);
      for (std::size_t i = 0; i < own.size(); ++i) {
        shared::GpuLight& place = lights_[own[0] + i];
        place.lamp_threshold = table[i].threshold;
        place.lamp_lights = (own[table[i].other] - own[0]) << 16 | (own[i] - own[0]);
        lights_[own[i]].lamp = shares[i] << 16 | (numbers[k] + 1);
      }
      lamps_[numbers[k]] = {own[0], static_cast<std::uint32_t>(own.size())};
      std::vector<std::uint32_t> of{g.id, g.mesh};
      for (const std::uint32_t i : own) of.push_back(lights_[i].triangle);
      members_[numbers[k]] = std::max<std::uint64_t>(hash_span(std::span<const std::uint32_t>(of)), 1);
    }
  }
  numbers_.free_unused();
}

const std::vector<float>& LightList::areas(const scene::Assets& assets, const Source& s) {
  Areas& known = areas_[s.instance->id];
  const scene::PoseBlend& pose = s.instance->pose;
  const bool same = known.mesh == s.instance->mesh && known.transform == s.instance->transform &&
                    known.pose.a == pose.a && known.pose.b == pose.b && known.pose.t == pose.t;
  if (same && known.of.size() == s.mesh->triangle_count) return known.of;
  const scene::Mesh& mesh = assets.meshes[s.instance->mesh];
  const std::vector<vec3> at = world_vertices(mesh, *s.mesh, *s.instance);
  known = {s.instance->mesh, s.instance->transform, pose, {}};
  for (std::uint32_t t = 0; t < s.mesh->triangle_count; ++t) {
    const auto& v = mesh.triangles[s.mesh->order[t]].vertices;
    known.of.push_back(glm::length(glm::cross(at[v[1]] - at[v[0]], at[v[2]] - at[v[0]])));
  }
  return known.of;
}

void LightList::build(const scene::Assets& assets, const scene::Sky& sky, std::span<const Source> sources,
                      std::span<const shared::GpuMaterial> materials, std::uint64_t most) {
  // Other meshes: a triangle's index means another.
  const bool others = assets.generation != generation_ || sources.empty();
  if (others) {
    means_.clear();
    areas_.clear();
  }
  generation_ = assets.generation;
  if (sources.empty()) {
    made_anew_ = !first_lights_.empty();
    first_lights_.clear();
    lights_.clear();
    lamps_.clear();
    members_.clear();
    power_ = 0;
    return;
  }
  if (areas_.size() > 2 * sources.size() + 64) areas_.clear();  // of what is gone
  const float sky_mean = sky_radiance(assets, sky);
  std::vector<float> glow(materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) glow[i] = radiance(assets, materials[i], sky_mean);
  std::vector<Glowing> glowing = find_glowing(sources, glow, most);
  made_anew_ = others || first_lights_.size() != sources.size() || glow != glow_ || glowing != glowing_;
  glow_ = std::move(glow);
  glowing_ = std::move(glowing);
  if (made_anew_) {
    const std::vector<std::uint64_t> former = others ? std::vector<std::uint64_t>() : members_;
    list_triangles(assets, sources);
    mark_new_lamps(former);
  } else if (std::exchange(any_new_, false)) {
    for (shared::GpuLamp& lamp : lamps_) lamp.first &= ~shared::kLampIsNew;
    made_anew_ = true;
  }
}

// A lamp of other triangles is another, though its number is the same.
void LightList::mark_new_lamps(std::span<const std::uint64_t> former) {
  any_new_ = false;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    if (lamps_[i].count == 0 || (i < former.size() && former[i] == members_[i])) continue;
    lamps_[i].first |= shared::kLampIsNew;
    any_new_ = true;
  }
}

}  // namespace fb::render
