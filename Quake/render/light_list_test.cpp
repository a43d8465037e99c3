// The list of lights: every kind of light is in it with the power it has, nothing else is, and its intervals are whole.
#include "render/light_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "render/gpu_scene_tables.h"
#include "render/settings.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

// A snapshot's tables without a device: leaves hold each mesh's triangles backwards.
struct Listed {
  explicit Listed(const scene::FrameSnapshot& snapshot) {
    const scene::Assets& assets = *snapshot.assets;
    for (const scene::Mesh& mesh : assets.meshes) {
      MeshRecord record;
      record.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
      record.posed = mesh.posed();
      record.vertex_count = mesh.vertex_count;
      record.pose_count = mesh.pose_count;
      record.order.resize(mesh.triangles.size());
      std::iota(record.order.rbegin(), record.order.rend(), 0u);
      for (const auto& t : mesh.triangles) record.materials.push_back(t.material);
      records.push_back(std::move(record));
    }
    build(snapshot);
  }
  // Another frame of the same assets.
  void build(const scene::FrameSnapshot& snapshot) {
    const scene::Assets& assets = *snapshot.assets;
    instances.clear();
    const EmissionScales scales = emission_scales(RenderSettings{});
    table.begin(assets, snapshot.time, scales);
    for (const scene::Instance& i : snapshot.instances) {
      const scene::Material& m = assets.materials[records[i.mesh].materials[0] + i.material_base];
      instances.push_back(make_gpu_instance(records[i.mesh], i, mat4x3(1.0f),
                                            table.base_for(assets, records[i.mesh], i),
                                            emission_scale(scales, m.emission_kind)));
    }
    std::vector<LightList::Source> sources;
    for (std::size_t i = 0; i < instances.size(); ++i)
      sources.push_back({&snapshot.instances[i], &records[snapshot.instances[i].mesh], &instances[i]});
    list.build(assets, snapshot.sky, sources, table.entries());
  }
  double probability(std::uint32_t element) const {
    return static_cast<double>(list.elements()[element].x) / shared::kLightRange;
  }
  // Of an instance, by its material.
  std::map<std::string, double> by_material(const scene::FrameSnapshot& snapshot, std::size_t instance) const {
    std::map<std::string, double> sums;
    const std::uint32_t at = list.elements()[instance].x;
    if (at == shared::kNoIndex) return sums;
    const scene::Mesh& mesh = snapshot.assets->meshes[snapshot.instances[instance].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t material = mesh.triangles[mesh.triangles.size() - 1 - t].material;
      const double p = probability(at + t);
      if (p > 0) sums[snapshot.assets->materials[material].name] += p;
    }
    return sums;
  }
  double of_instance(const scene::FrameSnapshot& snapshot, std::size_t instance) const {
    double sum = 0;
    for (const auto& [name, p] : by_material(snapshot, instance)) sum += p;
    return sum;
  }
  std::vector<MeshRecord> records;
  MaterialTable table;
  std::vector<shared::GpuInstance> instances;
  LightList list;
};

TEST(LightList, ProbabilitiesAreWholeAndTheAliasTableHasThemExactly) {
  const scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  const Listed listed(snapshot);
  const auto& elements = listed.list.elements();
  ASSERT_EQ(listed.list.first(), snapshot.instances.size());
  ASSERT_GT(elements.size(), listed.list.first());
  const std::uint32_t first = listed.list.first(), n = listed.list.end() - first;
  ASSERT_GE(elements.size(), listed.list.end() + n);
  std::vector<std::uint64_t> chosen(n);  // times kLightRange, times n
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const uvec2 alias = elements[listed.list.end() + i];
    ASSERT_LE(alias.x, shared::kLightRange);
    ASSERT_LT(alias.y, n);
    chosen[i] += alias.x;
    chosen[alias.y] += shared::kLightRange - alias.x;
    sum += elements[first + i].x;
  }
  EXPECT_EQ(sum, shared::kLightRange);
  for (std::uint32_t i = 0; i < n; ++i) EXPECT_EQ(chosen[i], std::uint64_t{elements[first + i].x} * n) << i;
  for (std::uint32_t i = 0; i < listed.list.first(); ++i) {
    const std::uint32_t at = elements[i].x;
    if (at == shared::kNoIndex) continue;
    const auto count = snapshot.assets->meshes[snapshot.instances[i].mesh].triangles.size();
    ASSERT_LE(at + count, listed.list.end());
    for (std::size_t t = 0; t < count; ++t) EXPECT_EQ(elements[at + t].y, i);
  }
}

TEST(LightList, EveryKindHasItsPowerAndNothingElseAny) {
  const scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  const Listed listed(snapshot);
  const auto room = listed.by_material(snapshot, 0), pictures = listed.by_material(snapshot, 6);
  std::vector<std::string> names;
  for (const auto* part : {&room, &pictures})
    for (const auto& [name, p] : *part) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"*lava", "sky", "luma", "texels"}));
  // The panel of 96 x 64 units glows in 9 of 64 texels of index 0xf8: 17 * 8, 17 * 15, 7.
  const auto linear = [](double c) { return std::pow((c / 255 + 0.055) / 1.055, 2.4); };
  const double texel = linear(136) + linear(255) + 7.0 / 255 / 12.92;
  const double panel = 96 * 64 * 9.0 / 64 * texel * 6;  // r_emit_fullbright 6
  // A sphere's mesh has its area; radiance 95 in all channels, that nobody but paths sees.
  const double flash = 4 * 3.14159265 * 25 * 95;
  const std::size_t flash_at = 4;
  ASSERT_EQ(snapshot.instances[flash_at].visibility, scene::kSeenByIndirect);
  EXPECT_NEAR(pictures.at("texels") / listed.of_instance(snapshot, flash_at), panel / flash, 1e-3 * panel / flash);
  for (std::size_t i = 1; i <= 3; ++i) EXPECT_GT(listed.of_instance(snapshot, i), 0.0) << i;
  EXPECT_EQ(listed.of_instance(snapshot, 5), 0.0) << "paths do not see it";
}

// Between the first two poses.
double area_between(const scene::Mesh& mesh, float t) {
  const auto at = [&](std::uint32_t v) {
    return glm::mix(scene::vertex_position(mesh, v, 0), scene::vertex_position(mesh, v, 1), t);
  };
  double area = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto& v = triangle.vertices;
    area += 0.5 * glm::length(glm::cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0])));
  }
  return area;
}

TEST(LightList, APosedBodyHasThePosesArea) {
  scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  const auto ratio = [&] {
    const Listed listed(snapshot);
    return listed.of_instance(snapshot, 3) / listed.of_instance(snapshot, 4);
  };
  snapshot.instances[3].transform = mat4x3(1.0f);
  const scene::Mesh& body = snapshot.assets->meshes[snapshot.instances[3].mesh];
  const auto posed = [&](float t) {
    snapshot.instances[3].pose = {0, 1, t};
    return ratio();
  };
  const double closed = posed(0), half = posed(0.5f), open = posed(1);
  EXPECT_NEAR(open / closed, scene::mesh_area(body, 1) / scene::mesh_area(body, 0), 1e-3 * open / closed);
  EXPECT_NEAR(half / closed, area_between(body, 0.5f) / area_between(body, 0), 1e-3 * half / closed);
  EXPECT_GT(half / closed, 1.2);
  EXPECT_GT(open / half, 1.2);
}

TEST(LightList, WhatIsDarkHasNone) {
  scene::FrameSnapshot snapshot = scene::alpha_panel();
  EXPECT_GT(Listed(snapshot).list.elements().size(), 1u);
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  for (scene::Material& m : assets->materials) m.emission = vec3(0.0f);
  snapshot.assets = assets;
  const Listed dark(snapshot);
  EXPECT_EQ(dark.list.elements().size(), dark.list.first());
  EXPECT_EQ(dark.list.elements().at(0).x, shared::kNoIndex);
}

// Instances are numbered anew each frame: from the former frame's number one comes to this frame's, by the ids that
// stay.
TEST(LightList, LightsAreFollowedFromFrameToFrame) {
  scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) snapshot.instances[i].id = 100 + i;
  Listed listed(snapshot);
  EXPECT_EQ(listed.list.former(), listed.list.elements().size()) << "there was no frame before";

  const std::size_t before = snapshot.instances.size();
  snapshot.instances.erase(snapshot.instances.begin() + 2);
  std::swap(snapshot.instances[0], snapshot.instances[1]);
  listed.build(snapshot);
  const auto& elements = listed.list.elements();
  ASSERT_EQ(elements.size() - listed.list.former(), before);
  for (std::uint32_t i = 0; i < before; ++i) {
    const uvec2 former = elements[listed.list.former() + i];
    EXPECT_EQ(former.y, 100 + i);
    if (i == 2) {
      EXPECT_EQ(former.x, shared::kNoIndex) << "it is gone";
      continue;
    }
    ASSERT_LT(former.x, snapshot.instances.size());
    EXPECT_EQ(snapshot.instances[former.x].id, 100 + i);
  }

  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  snapshot.assets = assets;
  listed.build(snapshot);
  EXPECT_EQ(listed.list.former(), listed.list.elements().size()) << "other meshes have other triangles";
}

// Frame after frame, with whatever changes: the list that is kept is the one that would be made.
TEST(LightList, IsMadeAnewWhereWhatGlowsHasChangedAndOnlyThere) {
  scene::FrameSnapshot s = scene::many_lights(20);
  Listed kept(s);
  const auto expect_as_new = [&](bool made_anew, const char* what) {
    const std::size_t former = kept.instances.size();
    kept.build(s);
    const LightList &list = kept.list, fresh = Listed(s).list;
    EXPECT_EQ(list.made_anew(), made_anew) << what;
    ASSERT_EQ(list.former(), fresh.former()) << what;
    for (std::uint32_t i = 0; i < list.former(); ++i) ASSERT_EQ(list.elements()[i], fresh.elements()[i]) << what;
    EXPECT_EQ(list.elements().size(), list.former() + former) << what;
  };
  expect_as_new(false, "nothing");
  std::size_t dark = 0, glows = 0;
  for (std::size_t i = 0; i < s.instances.size(); ++i) (kept.of_instance(s, i) > 0 ? glows : dark) = i;
  ASSERT_NE(dark, glows);
  ASSERT_EQ(kept.of_instance(s, dark), 0.0);
  s.instances[dark].transform[3].x += 5;
  expect_as_new(false, "what is dark moved");
  s.instances[glows].transform[0] *= 2.0f;
  expect_as_new(true, "what glows grew");
  expect_as_new(false, "nothing again");
  s.instances[glows].flags |= scene::kInstanceColor;
  s.instances[glows].emission = vec3(3, 1, 1);
  expect_as_new(true, "it was painted");
  s.instances[glows].emission = vec3(0);
  expect_as_new(true, "it went out");
  s.instances.push_back(s.instances[dark]);
  s.instances.back().id = 9999;
  expect_as_new(true, "something came");
  s.instances.pop_back();
  expect_as_new(true, "it went");
}

TEST(LightList, AnInstancesColourReplacesItsMaterials) {
  scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  const double before = Listed(snapshot).of_instance(snapshot, 4);
  snapshot.instances[4].emission *= 3.0f;
  const double after = Listed(snapshot).of_instance(snapshot, 4);
  EXPECT_NEAR(after / (1 - after), 3 * before / (1 - before), 1e-3 * after / (1 - after));
}

}  // namespace
}  // namespace fb::render
