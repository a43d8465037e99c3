// Fog over many frames, against numbers that are known without it: single scattering as an integral over a lamp and one
// along the ray; numbers at the ends of their ranges; and no fog at all. A glowing room full of fog:
// fog_furnace_statistics_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/picture/frame_constants.h"
#include "render/test_fog.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_fog.h"

namespace fb::render {
namespace {

using FogStatistics = FogTest;
using glm::dvec3;

// --- single scattering of one lamp ---

struct LampTriangle {
  dvec3 corner, e1, e2, area;  // area: outward, half the cross product
};

std::vector<LampTriangle> lamp_triangles(const scene::FrameSnapshot& snapshot) {
  const scene::Instance& lamp = snapshot.instances.at(0);
  const scene::Mesh& mesh = snapshot.assets->meshes[lamp.mesh];
  std::vector<LampTriangle> list;
  for (const scene::MeshTriangle& t : mesh.triangles) {
    dvec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = dvec3(lamp.transform * vec4(mesh.positions[t.vertices[k]], 1.0f));
    list.push_back({p[0], p[1] - p[0], p[2] - p[0], 0.5 * glm::cross(p[1] - p[0], p[2] - p[0])});
  }
  return list;
}

// Light of radiance 1 that comes from the lamp to a point outside and is scattered along -direction there: the integral
// over the triangles that face the point (the lamp is convex), by Radon's rule of degree 5.
double scattered_once(const std::vector<LampTriangle>& lamp, const dvec3& point, const dvec3& direction, double sigma,
                      const Lobe& lobe) {
  struct Node {
    double u, v, weight;
  };
  static const double a = 0.059715871789770, b = 0.470142064105115, c = 0.797426985353087, d = 0.101286507323456;
  static const Node kNodes[] = {{1.0 / 3, 1.0 / 3, 0.225}, {a, b, 0.132394152788506}, {b, a, 0.132394152788506},
                                {b, b, 0.132394152788506}, {c, d, 0.125939180544827}, {d, c, 0.125939180544827},
                                {d, d, 0.125939180544827}};
  double sum = 0;
  for (const LampTriangle& t : lamp) {
    if (glm::dot(t.area, point - t.corner) <= 0) continue;
    for (const Node& node : kNodes) {
      const dvec3 way = t.corner + node.u * t.e1 + node.v * t.e2 - point;
      const double r2 = glm::dot(way, way), r = std::sqrt(r2);
      sum += node.weight * draine(lobe, glm::dot(direction, way) / r) * left_of_light(sigma, r) *
             -glm::dot(t.area, way) / (r2 * r);
    }
  }
  return sum;
}

// The same from all of a ray that starts at the origin and passes by the lamp: the distance is along + apart tan(u).
double airlight(const std::vector<LampTriangle>& lamp, const dvec3& direction, double sigma, const Lobe& lobe,
                int panels) {
  const dvec3 centre(scene::kSlabLamp);
  const double along = glm::dot(centre, direction), apart = glm::length(centre - direction * along);
  return integral(std::atan2(-along, apart), 0.5 * kHalfTurn, panels, [&](double u) {
    const double t = along + apart * std::tan(u), t_u = apart / (std::cos(u) * std::cos(u));
    return sigma * left_of_light(sigma, t) * scattered_once(lamp, direction * t, direction, sigma, lobe) * t_u;
  });
}

struct SlabView {
  scene::FrameSnapshot snapshot;
  double expected[2];  // red, over the left half of the picture and over the right
};
constexpr std::uint32_t kSlabWidth = 16, kSlabHeight = 8;

// Beside the lamp, whose triangles no ray of the picture comes nearer to than some 25 units.
SlabView slab_view(float extinction, float g, float alpha) {
  SlabView view{scene::slab(extinction, g), {}};
  scene::FrameSnapshot& snapshot = view.snapshot;
  snapshot.medium.alpha = alpha;
  snapshot.camera.angles = {0, -8, 0};
  snapshot.camera.fov_x = 24;
  snapshot.prev_camera = snapshot.camera;
  const std::vector<LampTriangle> lamp = lamp_triangles(snapshot);
  const CameraFrame camera = camera_frame(snapshot.camera, kSlabWidth, kSlabHeight);
  const double light = static_cast<double>(scene::kSlabRadiance.x * snapshot.medium.albedo.x);
  for (std::uint32_t y = 0; y < kSlabHeight; ++y)
    for (std::uint32_t x = 0; x < kSlabWidth; ++x) {
      const double sx = (x + 0.5) / kSlabWidth * 2 - 1, sy = (y + 0.5) / kSlabHeight * 2 - 1;
      const dvec3 ray = glm::normalize(dvec3(camera.forward) + sx * dvec3(camera.right) - sy * dvec3(camera.up));
      const double radiance = light * airlight(lamp, ray, static_cast<double>(extinction), {g, alpha}, 24);
      view.expected[x >= kSlabWidth / 2] += radiance / (kSlabWidth / 2 * kSlabHeight);
    }
  return view;
}

TEST_F(FogStatistics, TheQuadratureOfAirlightHasConverged) {
  const std::vector<LampTriangle> lamp = lamp_triangles(scene::slab(0.01f, 0.7f));
  for (const double degrees : {-20.0, -8.0, 4.0}) {
    const dvec3 ray(std::cos(radians(static_cast<float>(degrees))), std::sin(radians(static_cast<float>(degrees))), 0);
    for (const Lobe& lobe : {Lobe{0.0, 0.0}, Lobe{0.7, 0.0}, Lobe{0.7, 1.0}}) {
      const double coarse = airlight(lamp, ray, 0.01, lobe, 24), fine = airlight(lamp, ray, 0.01, lobe, 96);
      EXPECT_NEAR(coarse, fine, 1e-4 * fine) << degrees << ' ' << lobe.g << ' ' << lobe.alpha;
    }
  }
}

TEST_F(FogStatistics, SlabHasTheAirlightIntegral) {
  struct Effort {
    const char* estimator;
    int spp;
    double enough;  // relative standard error of half the picture
  };
  // One renderer for all: another medium is another picture, but no other shader.
  for (const Effort& effort : {Effort{"nee", 256, 0.006}, Effort{"mcpg_nee", 256, 0.006}, Effort{"mcpg", 256, 0.03},
                               Effort{"pt", 1024, 0.03}}) {
    const RenderSettings s = settings(effort.estimator, effort.spp);
    auto renderer = make_renderer(s, kSlabWidth, kSlabHeight);
    for (const float extinction : {0.002f, 0.01f})
      for (const auto& [g, alpha] : {std::pair(0.0f, 0.0f), std::pair(0.7f, 0.0f), std::pair(0.7f, 1.0f)}) {
        const SlabView view = slab_view(extinction, g, alpha);
        const std::string what =
            fmt::format("{}, extinction {}, g {}, alpha {}", effort.estimator, extinction, g, alpha);
        draw(*renderer, view.snapshot, s, 16);
        for (const std::uint32_t half : {0u, 1u}) {
          const ImageEstimate e =
              columns_estimate(*renderer, kSlabWidth, half * kSlabWidth / 2, (half + 1) * kSlabWidth / 2);
          // The quadrature's own error is below 1e-4.
          EXPECT_NEAR(e.mean, view.expected[half], 4.5 * e.error + 1e-4 * view.expected[half]) << what << ", " << half;
          EXPECT_LT(e.error, effort.enough * view.expected[half]) << what << ": the test can see little";
          fmt::print("{}, half {}: {:.5f}, quadrature {:.5f}: {:+.2f}% +- {:.2f}%\n", what, half, e.mean,
                     view.expected[half], 100 * (e.mean / view.expected[half] - 1),
                     100 * e.error / view.expected[half]);
        }
        for (const vec4& p : renderer->read().linear()) {
          const vec3 light = scene::kSlabRadiance * view.snapshot.medium.albedo;
          ASSERT_NEAR(p.y * light.x, p.x * light.y, 1e-4f * p.x * light.y) << what;
          ASSERT_NEAR(p.z * light.x, p.x * light.z, 1e-4f * p.x * light.z) << what;
        }
        expect_finite(*renderer, what);
      }
  }
}

// --- hard numbers ---

TEST_F(FogStatistics, NothingIsNotFiniteAtTheEndsOfItsNumbers) {
  scene::FrameSnapshot in_lamp = scene::slab(0.0f, 0.0f);
  in_lamp.camera.position = in_lamp.prev_camera.position = scene::kSlabLamp;
  scene::FrameSnapshot far_off = scene::window();
  for (scene::Instance& instance : far_off.instances) {
    instance.transform[3] += vec3(30000, -30000, 29000);
    instance.prev_transform = instance.transform;
  }
  far_off.camera.position += vec3(30000, -30000, 29000);
  far_off.prev_camera = far_off.camera;
  const std::pair<const char*, scene::FrameSnapshot> scenes[] = {
      {"slab", scene::slab(0.0f, 0.0f)}, {"in the lamp", in_lamp}, {"wide", wide_furnace()}, {"far off", far_off}};
  // What they do holds for the other techniques, whose steps are among theirs.
  for (const char* estimator : {"nee", "mcpg", "mcpg_nee"}) {
    RenderSettings s = settings(estimator, 2, 2, 2);
    s.force_features = 1;  // one shader for all scenes
    auto renderer = make_renderer(s, 8, 8);
    for (const auto& [name, original] : scenes) {
      scene::FrameSnapshot snapshot = original;
      snapshot.medium.albedo = vec3(1.0f);
      for (const auto& [extinction, g] :
           {std::pair(0.0f, 0.0f), std::pair(1e-30f, 0.999f), std::pair(1e-9f, -0.999f), std::pair(0.01f, 0.999f),
            std::pair(0.01f, -0.999f), std::pair(10.0f, 0.999f), std::pair(10.0f, -0.999f), std::pair(10.0f, 0.0f)}) {
        snapshot.medium.extinction = extinction;
        snapshot.medium.g = g;
        draw(*renderer, snapshot, s, 2);
        expect_finite(*renderer, fmt::format("{}, {}, extinction {}, g {}", estimator, name, extinction, g));
      }
    }
  }
}

// --- no medium ---

// The same bits as without it, in a renderer that never saw one and in one whose shaders know of it.
TEST_F(FogStatistics, OfNoExtinctionIsNone) {
  for (const char* estimator : {"nee", "mcpg"}) {
    RenderSettings s = settings(estimator, 2, 2, 2);
    s.deterministic = 1;
    const scene::FrameSnapshot clear = scene::light_of_every_kind();
    scene::FrameSnapshot fog = clear;
    fog.medium.albedo = vec3(1.0f);
    fog.medium.g = 0.5f;
    fog.medium.sky = 0.3f;
    auto renderer = make_renderer(s, 48, 36);
    const auto hash_of = [&](const scene::FrameSnapshot& snapshot) {
      renderer->restart_accumulation();
      renderer->reset_learning();
      draw(*renderer, snapshot, s, 3);
      return image_hash(*renderer);
    };
    const std::uint64_t expected = hash_of(clear);
    EXPECT_EQ(hash_of(fog), expected) << estimator;
    fog.medium.extinction = 0.01f;
    EXPECT_NE(hash_of(fog), expected) << estimator;
    EXPECT_EQ(hash_of(clear), expected) << estimator << ": after fog";
  }
}

// r_bounces 0: nothing is scattered, and nothing of former frames is shown.
TEST_F(FogStatistics, EmissionAloneIsTransmitted) {
  scene::FrameSnapshot snapshot = scene::furnace(0.5f, 0.7f);
  snapshot.medium.extinction = 0.01f;
  snapshot.medium.albedo = vec3(1.0f);
  for (const char* estimator : {"nee", "mcpg"}) {
    auto renderer = make_renderer(settings(estimator, 1), 16, 12);
    draw(*renderer, snapshot, settings(estimator, 1), 1);
    draw(*renderer, snapshot, settings(estimator, 1, 0), 1);
    const auto image = renderer->read().linear();
    const auto gbuffer = renderer->read().gbuffer();
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double expected = 0.7 * left_of_light(0.01, static_cast<double>(gbuffer[i].position_t.w));
      ASSERT_NEAR(image[i].x, expected, 3e-6 * expected) << estimator;
    }
  }
}

}  // namespace
}  // namespace fb::render
