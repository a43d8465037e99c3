// The list of lights: every kind of light is in it with the power it has, nothing else is, and its intervals are whole.
#include "render/scene/light_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "render/scene/gpu_scene_tables.h"
#include "render/passes/settings.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"
#include "shared/spot.h"

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
  void build(const scene::FrameSnapshot& snapshot, std::uint64_t most = shared::kLightRange) {
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
    list.build(assets, snapshot.sky, sources, table.entries(), most);
  }
  double probability(std::uint32_t light) const {
    return static_cast<double>(list.lights()[light].probability) / shared::kLightRange;
  }
  // Of an instance, by its material.
  std::map<std::string, double> by_material(const scene::FrameSnapshot& snapshot, std::size_t instance) const {
    std::map<std::string, double> sums;
    const std::uint32_t at = list.first_lights()[instance];
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
  const auto& lights = listed.list.lights();
  ASSERT_EQ(listed.list.first_lights().size(), snapshot.instances.size());
  ASSERT_FALSE(lights.empty());
  std::vector<std::uint64_t> chosen(lights.size());  // times kLightRange, times their number
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    ASSERT_LE(lights[i].threshold, shared::kLightRange);
    ASSERT_LT(lights[i].other, lights.size());
    chosen[i] += lights[i].threshold;
    chosen[lights[i].other] += shared::kLightRange - lights[i].threshold;
    sum += lights[i].probability;
  }
  EXPECT_EQ(sum, shared::kLightRange);
  for (std::size_t i = 0; i < lights.size(); ++i)
    EXPECT_EQ(chosen[i], std::uint64_t{lights[i].probability} * lights.size()) << i;
  for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
    const std::uint32_t at = listed.list.first_lights()[i];
    if (at == shared::kNoIndex) continue;
    const auto count = snapshot.assets->meshes[snapshot.instances[i].mesh].triangles.size();
    ASSERT_LE(at + count, lights.size());
    for (std::uint32_t t = 0; t < count; ++t) {
      EXPECT_EQ(lights[at + t].instance, i);
      EXPECT_EQ(lights[at + t].triangle, t);
    }
  }
}

std::uint32_t lamp_name(const shared::GpuLight& light) { return light.lamp & 0xffffu; }

// How often each light is drawn of a lamp, times kLampRange, times the number of its lights.
std::map<std::uint32_t, std::uint64_t> draws_of(const LightList& list, const shared::GpuLamp& lamp) {
  std::map<std::uint32_t, std::uint64_t> chosen;
  for (std::uint32_t i = 0; i < lamp.count; ++i) {
    const shared::GpuLight& place = list.lights()[lamp.first + i];
    chosen[lamp.first + (place.lamp_lights & 0xffffu)] += place.lamp_threshold;
    if (place.lamp_threshold < shared::kLampRange)
      chosen[lamp.first + (place.lamp_lights >> 16)] += shared::kLampRange - place.lamp_threshold;
  }
  return chosen;
}

// Every light is of one lamp, which draws it as often as the light says, nearly in proportion to its power. The room's
// glowing faces lie scattered among dark ones.
TEST(LightList, LampsHaveEachLightOnceAndDrawItExactly) {
  const scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  const Listed listed(snapshot);
  const auto& lights = listed.list.lights();
  std::size_t drawn = 0, scattered = 0;
  for (std::uint32_t n = 0; n < listed.list.lamps().size(); ++n) {
    shared::GpuLamp lamp = listed.list.lamps()[n];
    lamp.first &= ~shared::kLampIsNew;
    ASSERT_LE(lamp.count, shared::kLampLights);
    const auto draws = draws_of(listed.list, lamp);
    ASSERT_EQ(draws.size(), lamp.count);
    double power = 0;
    for (const auto& [i, times] : draws) power += lights.at(i).probability;
    for (const auto& [i, times] : draws) {
      EXPECT_EQ(lamp_name(lights[i]), n + 1);
      EXPECT_EQ(lights[i].instance, lights[lamp.first].instance);
      EXPECT_EQ(times, std::uint64_t{lights[i].lamp >> 16} * lamp.count);
      EXPECT_NEAR((lights[i].lamp >> 16) / double{shared::kLampRange}, lights[i].probability / power, 1e-3);
    }
    drawn += draws.size();
    scattered += !draws.empty() && draws.rbegin()->first - draws.begin()->first >= draws.size();
  }
  const auto glows = [](const shared::GpuLight& light) { return light.probability > 0; };
  EXPECT_EQ(drawn, static_cast<std::size_t>(std::count_if(lights.begin(), lights.end(), glows)));
  EXPECT_GT(scattered, 0u);
  for (const shared::GpuLight& light : lights) EXPECT_EQ(lamp_name(light) != 0, glows(light));
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
  EXPECT_FALSE(Listed(snapshot).list.lights().empty());
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  for (scene::Material& m : assets->materials) m.emission = vec3(0.0f);
  snapshot.assets = assets;
  const Listed dark(snapshot);
  EXPECT_TRUE(dark.list.lights().empty());
  EXPECT_TRUE(dark.list.lamps().empty());
  EXPECT_EQ(dark.list.first_lights().at(0), shared::kNoIndex);
}

// By instance: the names of its lamps.
std::map<std::uint32_t, std::vector<std::uint32_t>> names_by_id(const scene::FrameSnapshot& snapshot,
                                                                const LightList& list) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> names;
  for (const shared::GpuLight& light : list.lights())
    if (light.probability > 0) names[snapshot.instances[light.instance].id].push_back(lamp_name(light));
  return names;
}

TEST(LightList, LampsKeepTheirNamesFromFrameToFrame) {
  scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) snapshot.instances[i].id = 100 + i;
  Listed listed(snapshot);
  auto names = names_by_id(snapshot, listed.list);
  ASSERT_TRUE(names.count(102) == 1 && names.size() > 2);

  snapshot.instances.erase(snapshot.instances.begin() + 2);
  std::swap(snapshot.instances[0], snapshot.instances[1]);
  listed.build(snapshot);
  const std::vector<std::uint32_t> gone = names[102];
  names.erase(102);
  EXPECT_EQ(names_by_id(snapshot, listed.list), names);
  for (const std::uint32_t name : gone) EXPECT_EQ(listed.list.lamps().at(name - 1).count, 0u);
}

TEST(LampNumbers, AreGivenAnewTheLongestUnusedFirst) {
  LampNumbers numbers;
  using Numbers = std::vector<std::uint32_t>;
  EXPECT_EQ(numbers.of(7, 2), (Numbers{0, 1}));
  EXPECT_EQ(numbers.of(8, 1), (Numbers{2}));
  EXPECT_EQ(numbers.of(7, 1), (Numbers{3})) << "another instance of the same id";
  numbers.free_unused();
  EXPECT_EQ(numbers.of(8, 1), (Numbers{2}));
  numbers.free_unused();
  EXPECT_EQ(numbers.of(9, 4), (Numbers{0, 1, 3, 4}));
  EXPECT_EQ(numbers.of(8, 1), (Numbers{2}));
  EXPECT_EQ(numbers.end(), 5u);
  EXPECT_EQ(numbers.of(10, shared::kMostLamps).size(), shared::kMostLamps - 5) << "there are no more";
}

// Frame after frame, with whatever changes: the list that is kept is the one that would be made.
TEST(LightList, IsMadeAnewWhereWhatGlowsHasChangedAndOnlyThere) {
  scene::FrameSnapshot s = scene::many_lights(20);
  Listed kept(s);
  const auto expect_as_new = [&](bool made_anew, const char* what) {
    kept.build(s);
    const LightList &list = kept.list, fresh = Listed(s).list;
    EXPECT_EQ(list.made_anew(), made_anew) << what;
    EXPECT_EQ(list.first_lights(), fresh.first_lights()) << what;
    ASSERT_EQ(list.lights().size(), fresh.lights().size()) << what;
    for (std::size_t i = 0; i < list.lights().size(); ++i) {
      const shared::GpuLight &a = list.lights()[i], &b = fresh.lights()[i];
      EXPECT_EQ(a.threshold, b.threshold) << what;
      EXPECT_EQ(a.other, b.other) << what;
      EXPECT_EQ(a.probability, b.probability) << what;
      EXPECT_EQ(a.instance, b.instance) << what;
      EXPECT_EQ(a.lamp >> 16, b.lamp >> 16) << what;
    }
  };
  expect_as_new(true, "lamps are new no more");
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
  expect_as_new(false, "it stays painted");
  s.instances[glows].emission = vec3(0);
  expect_as_new(true, "it went out");
  s.instances.push_back(s.instances[dark]);
  s.instances.back().id = 9999;
  expect_as_new(true, "something came");
  s.instances.pop_back();
  expect_as_new(true, "it went");
}

// By what it lights 200 units away, or half its range away where that is less: never more than by the square's law.
TEST(LightList, ALampOfAFlatLawIsDrawnByWhatItLights) {
  scene::FrameSnapshot s = scene::light_of_every_kind();
  const std::size_t lamp = 4;  // the flash, painted
  const auto odds = [&] {
    const double p = Listed(s).of_instance(s, lamp);
    return p / (1.0 - p);
  };
  const double plain = odds();
  ASSERT_GT(plain, 0.0);
  s.instances[lamp].flags |= scene::kInstanceSpot | shared::kFallLinear << scene::kInstanceFallShift;
  s.instances[lamp].color = vec3(-2.0f, -2.0f, 1e-3f);
  const double x = 0.2;
  EXPECT_NEAR(odds() / plain, x * x * (2.0 - x), 1e-3);
  s.instances[lamp].color.z = 1.0f;
  EXPECT_NEAR(odds() / plain, 1.0, 1e-3) << "of short range: as by the square";
}

// Which lamps a technique that reuses the former frame's samples may look for there.
TEST(LightList, LampsSayInOneFrameThatTheyAreNew) {
  scene::FrameSnapshot s = scene::light_of_every_kind();
  Listed kept(s);
  const auto news = [&] {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < kept.list.lamps().size(); ++i)
      if ((kept.list.lamps()[i].first & shared::kLampIsNew) != 0) numbers.push_back(i);
    return numbers;
  };
  const std::size_t all = news().size();
  EXPECT_GT(all, 1u) << "in the first frame all are";
  kept.build(s);
  EXPECT_TRUE(news().empty());
  const vec3 emission = s.instances[4].emission;
  s.instances[4].emission = vec3(0);
  kept.build(s);
  EXPECT_TRUE(news().empty()) << "one went out";
  s.instances[4].emission = emission;
  kept.build(s);
  const auto lit = news();
  EXPECT_FALSE(lit.empty()) << "it shines again";
  EXPECT_LT(lit.size(), all);
  for (const std::uint32_t lamp : lit)
    for (const shared::GpuLight& light : kept.list.lights())
      if ((light.lamp & 0xffffu) == lamp + 1) {
        EXPECT_EQ(light.instance, 4u);
      }
  kept.build(s);
  EXPECT_TRUE(news().empty());
  s.instances[4].transform[3].x += 1;
  kept.build(s);
  EXPECT_TRUE(news().empty()) << "what moves is not new";
}

// A lamp's samples say which of its triangles they are on by their order.
TEST(LightList, ALampOfOtherTrianglesIsNew) {
  scene::FrameSnapshot s = scene::light_of_every_kind();
  Listed kept(s);
  kept.build(s);
  const auto some_lamp = [&](bool is_new) {
    return std::ranges::any_of(kept.list.lamps(), [&](const shared::GpuLamp& lamp) {
      return lamp.count > 0 && ((lamp.first & shared::kLampIsNew) != 0) == is_new;
    });
  };
  ASSERT_FALSE(some_lamp(true));
  // One of the world's materials goes out, of others than which lamps are left.
  const scene::Mesh& world = s.assets->meshes[s.instances[0].mesh];
  std::uint32_t dark = shared::kNoIndex;
  for (const auto& t : world.triangles)
    if (s.assets->materials[t.material].emission != vec3(0)) dark = t.material;
  ASSERT_NE(dark, shared::kNoIndex);
  auto changed = std::make_shared<scene::Assets>(*s.assets);
  changed->materials[dark].emission = vec3(0);
  s.assets = changed;
  kept.build(s);
  EXPECT_TRUE(some_lamp(true)) << "the lamps behind those that went out have their numbers";
  EXPECT_TRUE(some_lamp(false)) << "those of other instances are what they were";
  kept.build(s);
  EXPECT_FALSE(some_lamp(true));
}

// What a device's buffer cannot hold: the rest is drawn as ever.
TEST(LightList, ThoseOfTheFirstInstancesAreListedWhereThereIsNoRoomForAll) {
  const scene::FrameSnapshot snapshot = scene::light_of_every_kind();
  Listed listed(snapshot);
  const auto all = listed.list.lights().size();
  const std::vector<std::uint32_t> first = listed.list.first_lights();
  ASSERT_GT(std::count_if(first.begin(), first.end(), [](auto at) { return at != shared::kNoIndex; }), 1);
  listed.build(snapshot, all);
  EXPECT_EQ(listed.list.lights().size(), all);
  listed.build(snapshot, all - 1);
  const auto& lights = listed.list.lights();
  ASSERT_LT(lights.size(), all);
  ASSERT_GT(lights.size(), 0u);
  std::uint64_t sum = 0;
  for (const shared::GpuLight& light : lights) sum += light.probability;
  EXPECT_EQ(sum, shared::kLightRange) << "what is listed is drawn in their place";
  listed.build(snapshot, 0);
  EXPECT_TRUE(listed.list.lights().empty());
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
