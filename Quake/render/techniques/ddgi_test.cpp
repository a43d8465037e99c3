// Probes in the whole renderer: a furnace's closed form, hard cases, the same pictures again, nothing remembered that
// is to be forgotten.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

constexpr float kProbeAlbedo = 0.6f, kProbeEmission = 0.7f;
constexpr double kProbeLight = static_cast<double>(kProbeEmission) / (1 - static_cast<double>(kProbeAlbedo));
constexpr const char* kProbeEstimators[]{"ddgi", "ddgi_plus", "ddgi_restir"};

class DdgiSequences : public DeviceTest {
 protected:
  static RenderSettings probe_settings(const std::string& estimator, int bounces = 3) {
    RenderSettings s;
    s.estimator = estimator;
    s.bounces = bounces;
    s.accumulate = 0;
    s.jitter = 0;
    s.ddgi_spacing = 64;
    s.ddgi_hysteresis = 0.5f;  // else a furnace of albedo a nears its light by a tenth of 1 - a a turn
    return s;
  }
  static double mean_after(Renderer& renderer, const scene::FrameSnapshot& scene, const RenderSettings& s, int frames) {
    render_still(renderer, scene, s, frames);
    EXPECT_EQ(renderer.read().counters().not_finite, 0u);
    return image_estimate(renderer.read().linear()).mean;
  }
  // Share of the picture's pixels of a debug view that are magenta or red, whatever its brightness.
  static double share_of(Renderer& renderer, const scene::FrameSnapshot& scene, RenderSettings s, bool unknown) {
    s.debug_view = static_cast<int>(shared::kViewDdgiLight);
    s.fxaa = 0;
    renderer.render(scene, nullptr, s);
    const auto output = renderer.read().output();
    double count = 0;
    for (const std::uint32_t pixel : output) {
      const bool magenta = ((pixel >> 8u) & 255u) == 0 && (pixel & 255u) > 64 && ((pixel >> 16u) & 255u) > 64;
      count += magenta == unknown ? 1 : 0;
    }
    return count / static_cast<double>(output.size());
  }
};

// Any number of reflections in a closed room of albedo a and emission e: e / (1 - a), from probes that hold as much
// (ddgi_plus), or what of it is reflected (ddgi).
TEST_F(DdgiSequences, AFurnaceHasItsClosedForm) {
  const scene::FrameSnapshot scene = scene::furnace(kProbeAlbedo, kProbeEmission, true);
  for (const char* estimator : kProbeEstimators) {
    for (const int vertex : {2, 1}) {
      if (vertex == 1 && std::string(estimator) != "ddgi_plus") continue;
      RenderSettings s = probe_settings(estimator);
      s.ddgi_vertex = vertex;
      auto renderer = make_renderer(s, 48, 36);
      // Reservoirs that take over samples whose visibility was another lose up to so much (probes.md).
      const double off = std::string(estimator) == "ddgi_restir" ? 0.05 : 0.01;
      EXPECT_NEAR(mean_after(*renderer, scene, s, 28), kProbeLight, off * kProbeLight) << estimator << vertex;
      if (std::string(estimator) == "ddgi_restir") {
        s.restir_history = 0;
        s.restir_neighbors = 0;
        s.spp = 4;
        EXPECT_NEAR(mean_after(*renderer, scene, s, 4), kProbeLight, 0.015 * kProbeLight) << "nothing is reused";
      }
    }
  }
}

// Nor does a control variate change what a furnace is, nor the density by which directions are drawn: what probes know
// to be reflected is most of its light.
TEST_F(DdgiSequences, AFurnaceKeepsItsClosedFormWithAControlVariateAndAGuide) {
  const scene::FrameSnapshot scene = scene::furnace(kProbeAlbedo, kProbeEmission, true);
  for (const auto& [control, guide] : {std::pair(1, 0.0f), std::pair(0, 0.5f), std::pair(1, 0.5f)}) {
    RenderSettings s = probe_settings("ddgi_plus");
    s.ddgi_control = control;
    s.ddgi_guide = guide;
    auto renderer = make_renderer(s, 48, 36);
    EXPECT_NEAR(mean_after(*renderer, scene, s, 28), kProbeLight, 0.01 * kProbeLight) << control << " " << guide;
  }
}

// A coat under even light reflects what a surface of its directional albedo does, so a furnace with one is as bright
// whatever of it probes stand for; divided by 2 pi, as Eq. 6 is printed, gloss is half of what it should be.
TEST_F(DdgiSequences, GlossIsAsBrightAsWhatIsMirrored) {
  scene::FrameSnapshot scene = scene::furnace(1.0f, kProbeEmission, false);
  auto assets = std::make_shared<scene::Assets>(*scene.assets);
  assets->materials[0].base_color = vec3(kProbeAlbedo);
  assets->materials[0].metalness = 1;
  assets->materials[0].roughness = 0.9f;
  assets->generation = scene::next_generation();
  scene.assets = assets;
  double mean[3] = {};
  for (const int form : {0, 1, 2}) {
    RenderSettings s = probe_settings(form == 2 ? "pt" : "ddgi_plus", form == 2 ? 12 : 3);
    s.ddgi_form = form == 1 ? 1 : 0;
    s.spp = 16;
    auto renderer = make_renderer(s, 48, 36);
    mean[form] = mean_after(*renderer, scene, s, form == 2 ? 4 : 40);
  }
  EXPECT_NEAR(mean[0], mean[2], 0.015 * mean[2]);
  EXPECT_LT(mean[1], 0.97 * mean[2]);
}

// Without light, black, and white.
TEST_F(DdgiSequences, AlbedosAtTheirEnds) {
  for (const char* estimator : kProbeEstimators) {
    for (const float emission : {0.0f, 1.0f}) {
      RenderSettings s = probe_settings(estimator);
      s.ddgi_control = 1;
      s.ddgi_guide = 0.5f;
      auto renderer = make_renderer(s, 48, 36);
      EXPECT_NEAR(mean_after(*renderer, scene::furnace(0, emission, true), s, 4), static_cast<double>(emission), 1e-5);
      if (emission == 0) {
        EXPECT_EQ(mean_after(*renderer, scene::furnace(1, 0, true), s, 4), 0);
      }
    }
  }
}

// Before any probe has had a turn, and where all are in walls or asleep: as in nee, nothing is lost.
TEST_F(DdgiSequences, WhereNothingIsKnownPathsGoOn) {
  const scene::FrameSnapshot scene = scene::furnace(kProbeAlbedo, kProbeEmission, false);
  const double all = static_cast<double>(kProbeEmission) * (1 + 0.6 + 0.36 + 0.216);
  for (const char* estimator : {"ddgi", "ddgi_plus"}) {
    // One probe of hundreds has a turn a frame, and the picture's first frame has no other.
    RenderSettings s = probe_settings(estimator);
    s.ddgi_spacing = 32;
    s.ddgi_rays = s.ddgi_probe_rays = 64;
    s.spp = 16;
    auto renderer = make_renderer(s, 32, 24);
    const double found = mean_after(*renderer, scene, s, 1);
    EXPECT_GT(found, 0.98 * all) << estimator;
    EXPECT_LT(found, 1.02 * kProbeLight) << estimator;
    EXPECT_GT(share_of(*renderer, scene, s, true), 0.5) << estimator;
  }
}

// A cube of rock with the only probe in its middle, under an even sky: it sleeps, and the picture is that of nee.
TEST_F(DdgiSequences, AProbeInRockSaysNothing) {
  auto assets = scene::new_code_assets();
  const std::uint32_t grey = scene::add_material(*assets, "rock", vec3(0.5f));
  scene::Mesh rock;
  scene::add_box(rock, vec3(-256), vec3(256), grey, false);
  scene::FrameSnapshot scene = scene::still(assets, scene::camera_at({-500, 0, 0}, {0, 0, 0}, 60));
  scene.instances.push_back(
      scene::make_instance(scene::kIdWorld, scene::add_finished(*assets, std::move(rock), "rock")));
  scene.sky.mode = scene::SkyMode::kConstant;
  scene.sky.color = vec3(1);
  scene.sky.beyond_everything = true;
  double mean[2] = {};
  for (const bool nee : {false, true}) {
    RenderSettings s = probe_settings(nee ? "nee" : "ddgi_plus");
    s.ddgi_spacing = 512;
    s.spp = 16;
    auto renderer = make_renderer(s, 32, 24);
    mean[nee ? 1 : 0] = mean_after(*renderer, scene, s, 12);
    if (!nee) {
      EXPECT_GT(share_of(*renderer, scene, s, true), 0.2) << "the rock, of which nothing is known";
    }
  }
  EXPECT_NEAR(mean[0], mean[1], 0.004 * mean[1]);
}

// A box of 30,000 units: the volume is about the camera, beyond it paths go on; a camera that flies through it takes
// its probes along.
TEST_F(DdgiSequences, AHugeMapLosesNothing) {
  auto assets = scene::new_code_assets();
  const std::uint32_t walls = scene::add_material(*assets, "walls", vec3(kProbeAlbedo), vec3(kProbeEmission));
  scene::Mesh room;
  scene::add_box(room, vec3(-15000), vec3(15000), walls, true);
  const std::uint32_t mesh = scene::add_finished(*assets, std::move(room), "room");
  const double least = static_cast<double>(kProbeEmission) * (1 + 0.6 + 0.36 + 0.216);
  for (const char* estimator : {"ddgi", "ddgi_plus"}) {
    RenderSettings s = probe_settings(estimator);
    s.spp = 8;
    auto renderer = make_renderer(s, 32, 24);
    for (const float x : {14900.0f, 14700.0f, 2000.0f, -14990.0f}) {
      scene::FrameSnapshot scene = scene::still(assets, scene::camera_at({x, 14950, -14950}, {20, 30, 0}, 80));
      scene.instances.push_back(scene::make_instance(scene::kIdWorld, mesh));
      const double found = mean_after(*renderer, scene, s, 3);
      EXPECT_GT(found, 0.96 * least) << estimator << x;
      EXPECT_LT(found, 1.02 * kProbeLight) << estimator << x;
    }
  }
}

// Of light that fog scatters r_fog_bounces 1 has what glows alone, as in nee; 2 also what probes know is reflected.
TEST_F(DdgiSequences, FogHasReflectedLightWhereItIsAskedFor) {
  const auto scattered = [&](const char* estimator, int fog_bounces) {
    double mean[2] = {};
    for (const int white : {0, 1}) {
      scene::FrameSnapshot scene = scene::furnace(kProbeAlbedo, kProbeEmission, false);
      scene.medium.extinction = 0.004f;
      scene.medium.albedo = vec3(static_cast<float>(white));
      RenderSettings s = probe_settings(estimator);
      s.spp = 16;
      s.medium_bounces = fog_bounces;
      auto renderer = make_renderer(s, 32, 24);
      mean[white] = mean_after(*renderer, scene, s, 12);
    }
    return mean[1] - mean[0];
  };
  const double straight = scattered("nee", 1);
  EXPECT_GT(straight, 0.05);
  for (const char* estimator : {"ddgi", "ddgi_plus"}) EXPECT_NEAR(scattered(estimator, 1), straight, 0.04 * straight);
  const double once_reflected = scattered("nee", 2);
  EXPECT_GT(once_reflected, 1.1 * straight);
  EXPECT_GT(scattered("ddgi_plus", 2), once_reflected);
}

TEST_F(DdgiSequences, CutsSizesAndSettingsLeaveAFurnaceAsItIs) {
  const std::pair<const char*, std::function<void(RenderSettings&)>> variants[] = {
      {"few rays", [](RenderSettings& s) { s.ddgi_rays = 64, s.ddgi_probe_rays = 16; }},
      {"all rays", [](RenderSettings& s) { s.ddgi_rays = 131072; }},
      {"one probe", [](RenderSettings& s) { s.ddgi_spacing = 4096; }},
      {"evenly", [](RenderSettings& s) { s.ddgi_spacing = 0, s.ddgi_rays = 65536; }},
      {"no memory", [](RenderSettings& s) { s.ddgi_hysteresis = 0; }},
      {"no visibility", [](RenderSettings& s) { s.ddgi_visibility = 0; }},
      {"none moves or sleeps", [](RenderSettings& s) { s.ddgi_relocate = s.ddgi_sleep = 0; }},
      {"no looking", [](RenderSettings& s) { s.ddgi_looking = 0; }},
      {"a control variate", [](RenderSettings& s) { s.ddgi_control = 1; }},
      {"a guide", [](RenderSettings& s) { s.ddgi_guide = 0.95f; }},
  };
  const scene::FrameSnapshot scene = scene::furnace(kProbeAlbedo, kProbeEmission, true);
  for (const char* estimator : kProbeEstimators) {
    // Where probes know nothing ddgi_restir has one reflection.
    const double least =
        static_cast<double>(kProbeEmission) * (std::string(estimator) == "ddgi_restir" ? 1 + 0.6 : 1 + 0.6 + 0.36);
    auto renderer = make_renderer(probe_settings(estimator), 48, 36);
    const auto expect_light = [&](const scene::FrameSnapshot& snapshot, const RenderSettings& s,
                                  const std::string& what) {
      const double found = mean_after(*renderer, snapshot, s, 4);
      EXPECT_GT(found, 0.95 * least) << estimator << ", " << what;
      EXPECT_LT(found, 1.04 * kProbeLight) << estimator << ", " << what;
    };
    for (const auto& [name, change] : variants) {
      RenderSettings s = probe_settings(estimator);
      change(s);
      expect_light(scene, s, name);
    }
    const RenderSettings s = probe_settings(estimator);
    scene::FrameSnapshot cut = scene;
    cut.cut = true;
    cut.time -= 5;  // a demo that was sought through backwards
    expect_light(cut, s, "a cut");
    for (const uvec2 size : {uvec2(33, 47), uvec2(1, 1), uvec2(65, 35)}) {
      renderer->resize(size.x, size.y);
      if (size.x > 1)
        expect_light(scene, s, "a resize");
      else
        render_still(*renderer, scene, s, 2);
    }
  }
}

// A box that shuts a probe in, as a door does: the probe moves or sleeps, and nothing is dark.
TEST_F(DdgiSequences, ADoorThatClosesOnAProbe) {
  scene::FrameSnapshot scene = scene::furnace(kProbeAlbedo, kProbeEmission, true);
  for (const char* estimator : kProbeEstimators) {
    const RenderSettings s = probe_settings(estimator);
    auto renderer = make_renderer(s, 48, 36);
    mean_after(*renderer, scene, s, 12);
    scene::FrameSnapshot closed = scene;
    closed.instances[1].transform = scene::placed({96, 32, 0}, vec3(50, 50, 110));
    closed.instances[1].prev_transform = closed.instances[1].transform;
    const double off = std::string(estimator) == "ddgi_restir" ? 0.05 : 0.02;
    EXPECT_NEAR(mean_after(*renderer, closed, s, 12), kProbeLight, off * kProbeLight) << estimator;
  }
}

// A lamp that goes out leaves what probes know of its reflections: gone within some turns, later where nothing tells
// them of the change.
TEST_F(DdgiSequences, LightThatGoesIsForgotten) {
  auto assets = scene::new_code_assets();
  const std::uint32_t walls = scene::add_material(*assets, "walls", vec3(0.5f));
  const std::uint32_t light = scene::add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  scene::Mesh room;
  scene::add_box(room, vec3(-128), vec3(128), walls, true);
  const std::uint32_t mesh = scene::add_finished(*assets, std::move(room), "room");
  const std::uint32_t sphere = scene::add_sphere_mesh(*assets);
  const auto with_lamp = [&](bool shines) {
    scene::FrameSnapshot s = scene::still(assets, scene::camera_at({-100, 0, 0}, {0, 0, 0}, 90));
    s.instances.push_back(scene::make_instance(scene::kIdWorld, mesh));
    if (shines)
      s.instances.push_back(scene::glowing(scene::kIdEntityLight, sphere, light, {0, 60, 90}, vec3(12), vec3(100.0f)));
    return s;
  };
  double left[2] = {};
  for (const int tells : {0, 1}) {
    RenderSettings s = probe_settings("ddgi");
    s.ddgi_hysteresis = 0.9f;
    s.ddgi_change = tells == 1 ? 6 : 0;
    auto renderer = make_renderer(s, 32, 24);
    const double before = mean_after(*renderer, with_lamp(true), s, 24);
    EXPECT_GT(before, 0.1);
    left[tells] = mean_after(*renderer, with_lamp(false), s, 6) / before;
  }
  EXPECT_LT(left[1], 0.06);
  EXPECT_GT(left[0], 0.1);
}

TEST_F(DdgiSequences, TheSamePicturesAgain) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  for (const auto& [estimator, control] :
       {std::pair("ddgi", 0), std::pair("ddgi_plus", 0), std::pair("ddgi_plus", 1), std::pair("ddgi_restir", 0)}) {
    RenderSettings s = probe_settings(estimator);
    s.ddgi_control = control;
    s.ddgi_guide = control ? 0.5f : 0.0f;
    s.deterministic = 1;
    s.ddgi_rays = 1024;
    s.ddgi_probe_rays = 64;
    std::vector<std::uint64_t> hashes[2];
    for (std::vector<std::uint64_t>& of_run : hashes) {
      auto renderer = make_renderer(s, 24, 16);
      for (int frame = 0; frame < 60; ++frame) {
        renderer->render(scene, nullptr, s);
        of_run.push_back(image_hash(*renderer));
      }
    }
    EXPECT_EQ(hashes[0], hashes[1]) << estimator;
  }
}

TEST_F(DdgiSequences, ForgettingStartsAnew) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  RenderSettings s = probe_settings("ddgi");
  s.deterministic = 1;
  auto renderer = make_renderer(s, 32, 24);
  renderer->render(scene, nullptr, s);
  const std::uint64_t fresh = image_hash(*renderer);
  render_still(*renderer, scene, s, 3);
  EXPECT_NE(image_hash(*renderer), fresh);
  renderer->reset_learning();
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(image_hash(*renderer), fresh);
}

}  // namespace
}  // namespace fb::render
