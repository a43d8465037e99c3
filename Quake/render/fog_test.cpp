// Fog in the whole renderer, against numbers that are known without it: transmittance and the sky's share. What takes
// many frames: fog_statistics_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "render/test_fog.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

// --- transmittance ---

TEST_F(FogTest, AGlowingWallIsSeenThroughItByTheExponentialLaw) {
  const float emission = 0.7f;
  for (const std::string estimator : {"pt", "nee"}) {
    auto renderer = make_renderer(settings(estimator, 1), 24, 16);
    for (const float extinction : {1e-9f, 0.001f, 0.02f, 10.0f}) {
      scene::FrameSnapshot snapshot = scene::furnace(0.0f, emission);
      snapshot.medium.extinction = extinction;
      draw(*renderer, snapshot, settings(estimator, 1), 2);
      const auto image = renderer->read().linear();
      const auto gbuffer = renderer->read().gbuffer();
      for (std::size_t i = 0; i < image.size(); ++i) {
        const auto sigma = static_cast<double>(extinction), t = static_cast<double>(gbuffer[i].position_t.w);
        ASSERT_GE(t, 128.0);
        const double expected = static_cast<double>(emission) * left_of_light(sigma, t);
        // exp is off by roundings of its argument, which are as many of its value as the argument is large.
        ASSERT_NEAR(image[i].x, expected, (4e-7 + 2e-7 * sigma * t) * expected + 1e-37)
            << estimator << ' ' << extinction;
      }
    }
  }
}

// --- the sky ---

// A face of sky across the view, at this distance from the camera.
scene::FrameSnapshot face_of_sky(float distance, const vec3& color) {
  auto assets = scene::new_code_assets();
  const std::uint32_t sky = scene::add_material(*assets, "sky", vec3(0.0f), vec3(1.0f));
  assets->materials[sky].emission_kind = scene::EmissionKind::kSky;
  scene::Mesh face;
  const float side = 4.0f * distance;
  scene::add_quad(face, {distance, -side, side}, {0, 2 * side, 0}, {0, 0, -2 * side}, sky);
  scene::FrameSnapshot snapshot = scene::still(assets, scene::camera_at(vec3(0.0f), vec3(0.0f), 60.0f));
  snapshot.instances.push_back(
      scene::make_instance(scene::kIdWorld, scene::add_finished(*assets, std::move(face), "face")));
  snapshot.sky.mode = scene::SkyMode::kConstant;
  snapshot.sky.color = color;
  return snapshot;
}

// The camera sees a share of the sky's own colour, however near the face is that shows it, or without a face. Black fog
// scatters nothing, so that this is all; paths are traced all the same.
TEST_F(FogTest, TheSkyKeepsItsShareHoweverFarItsFaceIs) {
  const vec3 color(0.3f, 0.5f, 0.9f);
  for (const char* estimator : {"pt", "nee"}) {
    const RenderSettings s = settings(estimator, 1);
    auto renderer = make_renderer(s, 24, 16);
    for (const float distance : {1.0f, 20000.0f, 0.0f})
      for (const float extinction : {1e-5f, 0.01f, 10.0f})
        for (const float share : {1.0f, 0.5f, 0.3f, 0.0f}) {
          scene::FrameSnapshot snapshot = face_of_sky(std::max(distance, 1.0f), color);
          if (distance == 0.0f) {
            snapshot.instances.clear();
            snapshot.sky.beyond_everything = true;
          }
          snapshot.medium.extinction = extinction;
          snapshot.medium.sky = share;
          draw(*renderer, snapshot, s, 2);
          const auto gbuffer = renderer->read().gbuffer();
          const auto image = renderer->read().linear();
          for (std::size_t i = 0; i < image.size(); ++i) {
            ASSERT_GE(gbuffer[i].position_t.w, distance);
            for (int channel = 0; channel < 3; ++channel)
              ASSERT_NEAR(image[i][channel], share * color[channel], 1e-6f)
                  << estimator << ", distance " << distance << ", extinction " << extinction << ", share " << share;
          }
        }
  }
}

// With a factor of 0 nothing of what bright fog scatters lies before the sky: neither of the sky's light nor of even
// light. A wall beside it keeps all.
TEST_F(FogTest, WhatIsScatteredBeforeTheSkyHasAFactor) {
  const vec3 color(0.3f, 0.5f, 0.9f);
  for (const char* estimator : {"pt", "nee"}) {
    const RenderSettings s = settings(estimator, 1);
    auto renderer = make_renderer(s, 24, 16);
    for (const bool face : {true, false}) {
      const auto mean_of = [&](float factor, const vec3& ambient) {
        scene::FrameSnapshot snapshot = face_of_sky(100.0f, color);
        if (!face) {
          snapshot.instances.clear();
          snapshot.sky.beyond_everything = true;
        }
        snapshot.ambient = ambient;
        snapshot.medium = {0.01f, vec3(1.0f)};
        snapshot.medium.before_sky = factor;
        draw(*renderer, snapshot, s, 2);
        vec3 sum(0.0f);
        const auto image = renderer->read().linear();
        for (const auto& pixel : image) sum += vec3(pixel.x, pixel.y, pixel.z) / static_cast<float>(image.size());
        return sum;
      };
      for (const vec3& ambient : {vec3(0.0f), vec3(2.0f)}) {
        const vec3 none = mean_of(0.0f, ambient);
        for (int channel = 0; channel < 3; ++channel)
          ASSERT_NEAR(none[channel], color[channel], 1e-5f) << estimator << face;
        // Of a sky beyond everything no light comes through endless fog to be scattered.
        if (face || ambient.x > 0.0f) {
          EXPECT_GT(mean_of(1.0f, ambient).x, 1.02f * color.x) << estimator << face;
        }
      }
      // Of even light exactly its part.
      const double whole = 2.0 * (1.0 - left_of_light(0.01, face ? 100.0 : 1e9));
      EXPECT_GT(mean_of(0.5f, vec3(2.0f)).x, color.x + 0.5 * 0.9 * whole) << estimator << face;
    }
  }
}

// --- Quake's law ---

// A black room that glows all around: what fog of albedo 1 takes on the camera's way it gives, and on other ways it
// takes nothing, so that the room's light is whole; and the fog's own light is before it.
TEST_F(FogTest, QuakesLawScattersWhatItTakesAndHasLightOfItsOwn) {
  const float emission = 0.7f;
  const vec3 glow(0.1f, 0.2f, 0.4f);
  const RenderSettings s = settings("pt", 2);
  auto renderer = make_renderer(s, 24, 16);
  for (const float square : {1e-12f, 1e-6f, 3e-5f, 1e-2f, 100.0f}) {
    scene::FrameSnapshot snapshot = scene::furnace(0.0f, emission);
    snapshot.medium.extinction = 0.01f;  // counts for nothing
    snapshot.medium.albedo = vec3(1.0f, 0.5f, 0.0f);
    snapshot.medium.square = square;
    snapshot.medium.glow = glow;
    draw(*renderer, snapshot, s, 2);
    const auto image = renderer->read().linear();
    const auto gbuffer = renderer->read().gbuffer();
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double t = static_cast<double>(gbuffer[i].position_t.w), depth = static_cast<double>(square) * t * t;
      const double left = std::exp(-depth), covers = std::pow(-std::expm1(-depth / 1.4), 1.4);
      for (int c = 0; c < 3; ++c) {
        const double albedo = static_cast<double>(snapshot.medium.albedo[c]);
        const double expected = static_cast<double>(emission) * (left + albedo * -std::expm1(-depth)) +
                                static_cast<double>(glow[c]) * covers;
        ASSERT_NEAR(image[i][c], expected, 2e-5) << square << " channel " << c;
      }
    }
  }
}

// It covers the sky by its share alone, however near the face is that shows it.
TEST_F(FogTest, QuakesLawCoversTheSkyEvenly) {
  const vec3 color(0.3f, 0.5f, 0.9f), glow(0.5f, 0.1f, 0.2f);
  const RenderSettings s = settings("pt", 1);
  auto renderer = make_renderer(s, 24, 16);
  for (const float distance : {1.0f, 20000.0f})
    for (const float square : {1e-9f, 1.0f}) {
      scene::FrameSnapshot snapshot = face_of_sky(distance, color);
      snapshot.medium.extinction = 0.01f;
      snapshot.medium.square = square;
      snapshot.medium.glow = glow;
      snapshot.medium.sky = 0.25f;
      snapshot.medium.glow_before_sky = 0.5f;
      draw(*renderer, snapshot, s, 1);
      for (const vec4& pixel : renderer->read().linear())
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], 0.25f * color[c] + 0.5f * glow[c], 1e-6f) << distance;
    }
}

// --- hard numbers ---

// Optically thin or thick, 29,440 units away.
TEST_F(FogTest, FarWallsHaveTheExponentialLaw) {
  const double emission = static_cast<double>(0.7f);
  for (const float extinction : {1e-9f, 1e-5f, 1e-3f}) {
    scene::FrameSnapshot snapshot = wide_furnace();
    snapshot.medium.extinction = extinction;
    const RenderSettings s = settings("pt", 1, 0);
    auto renderer = make_renderer(s, 16, 12);
    draw(*renderer, snapshot, s, 1);
    const auto image = renderer->read().linear();
    const auto gbuffer = renderer->read().gbuffer();
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double depth = static_cast<double>(extinction) * static_cast<double>(gbuffer[i].position_t.w);
      ASSERT_GT(gbuffer[i].position_t.w, 29000.0f);
      ASSERT_NEAR(image[i].x, emission * std::exp(-depth), (4e-7 + 2e-7 * depth) * emission * std::exp(-depth));
    }
  }
}

}  // namespace
}  // namespace fb::render
