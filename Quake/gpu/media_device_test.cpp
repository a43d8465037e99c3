// shared/phase.h, medium.h, dielectric.h and waves.h through the shader, against what the host computes of the same
// queries: each figure within what Vulkan promises of its operations, at the scale of what it is.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/rng.h"
#include "gpu/test_device.h"
#include "gpu/test_probe_device.h"
#include "shared/test_media_probe.h"
#include "shared/test_vmf_errors.h"
#include "test_media.spv.h"

namespace fb::gpu {
namespace {

using shared::kRoundoff;
using shared::MediaAnswer;
using shared::MediaQuery;
using shared::vec3;
using shared::vec4;

class MediaDeviceTest : public DeviceTest {
 protected:
  std::vector<MediaAnswer> on_device(const std::vector<MediaQuery>& queries) {
    return ProbeDevice<MediaQuery, MediaAnswer>(*device_, test_media_spv, "media")(queries);
  }
};

template <std::size_t N>
float pick(Rng& rng, const float (&values)[N]) {
  return values[rng.below(N)];
}

// The hard numbers of each header in all combinations that chance makes.
std::vector<MediaQuery> media_queries(int count) {
  Rng rng(61);
  std::vector<MediaQuery> queries;
  const auto direction = [&] { return shared::vmf_sample(vec3(0, 0, 1), 0, {rng.uniform(), rng.uniform()}); };
  for (int i = 0; i < count; ++i) {
    MediaQuery q{};
    const vec3 axis = direction(), w = direction();
    const float reach = pick(rng, {1e-6f, 1.0f, 100.0f, 30000.0f, 1e6f});
    const vec3 light = direction() * (reach * rng.uniform(0, 2)) + direction();
    q.axis_g = vec4(axis, pick(rng, {-0.999f, -0.9f, -0.3f, 0.0f, 1e-6f, 0.3f, 0.9f, 0.999f}));
    q.w_alpha = vec4(w, pick(rng, {0.0f, 0.5f, 1.0f, 30.0f}));
    q.light_sigma =
        vec4(rng.below(8) == 0 ? axis * (0.5f * reach) : light, pick(rng, {0.0f, 1e-9f, 1e-4f, 0.01f, 1.0f, 10.0f}));
    q.reach_share_u =
        vec4(reach, pick(rng, {0.0f, 0.5f, 1.0f}), pick(rng, {0.0f, 0x1p-24f, 0x1.fffffep-1f}), rng.uniform());
    if (rng.below(8) != 0) q.reach_share_u.z = rng.uniform();
    q.cosine_eta_x =
        vec4(rng.below(8) == 0 ? std::exp(-rng.uniform(0, 30)) : rng.uniform(),
             pick(rng, {1.333f, 1 / 1.333f, 1.5f, 1.0f, 1.001f}), std::exp(rng.uniform(-60, 4)), reach * rng.uniform());
    q.point_height = vec4(rng.uniform(-3e4f, 3e4f), rng.uniform(-3e4f, 3e4f), 2, pick(rng, {16.0f, 64.0f, 100.3f}));
    q.clock.x = rng.next();
    queries.push_back(q);
  }
  return queries;
}

class Comparison {
 public:
  explicit Comparison(std::size_t index) : index_(index) {}
  void near(const char* what, double device, double host, double tolerance) const {
    EXPECT_TRUE(std::isfinite(device)) << what << " of query " << index_;
    EXPECT_NEAR(device, host, tolerance) << what << " of query " << index_;
  }
  void relative(const char* what, double device, double host, double roundings) const {
    near(what, device, host, std::abs(host) * roundings * kRoundoff + 1e-36);
  }

 private:
  std::size_t index_;
};

TEST_F(MediaDeviceTest, GivesWhatTheHostGives) {
  const auto queries = media_queries(50000);
  const auto device = on_device(queries);
  for (std::size_t i = 0; i < queries.size() && !HasFailure(); ++i) {
    const MediaQuery& q = queries[i];
    const MediaAnswer host = shared::media_probe(q), &d = device[i];
    const Comparison compare(i);
    // From a cosine: its rounding over the least of 1 - side * cosine, which the lobe's width limits.
    const double g = std::abs(q.axis_g.w), width = (1 - g) * (1 - g);
    compare.relative("phase_eval", d.phase.x, host.phase.x, 50 + 6 / std::max(width, 0.01 * (1 - g)));
    compare.relative("phase_eval_about", d.phase.y, host.phase.y, 50);
    compare.relative("phase_mean_cosine", d.phase.z, host.phase.z, 20);
    // Samples: as if u was off by 64 roundings.
    const shared::PhaseFunction p = shared::phase_function(q.axis_g.w, q.w_alpha.w);
    const auto density = 6.2832 * shared::phase_eval(p, host.phase.w);
    compare.near("phase_sample_cosine", d.phase.w, host.phase.w, 64 * kRoundoff / std::min(density, 1.0) + 1e-6);
    // Directions: sin and cos of the azimuth are within 2^-11 by Vulkan.
    const vec3 scattered(d.scattered), forward(q.axis_g), host_scattered(host.scattered);
    compare.near("cosine of phase_sample", dot(scattered, forward), host.phase.w,
                 64 * kRoundoff / std::min(density, 1.0) + 2e-3 * (1 - std::abs(host.phase.w)));
    compare.near("length of phase_sample", length(scattered), 1, 1e-6);
    const double sine = std::sqrt(1 - std::min(1.0f, host.phase.w * host.phase.w)) + 1e-6;
    compare.near("phase_sample", length(scattered - host_scattered), 0,
                 1e-3 * sine + 64 * kRoundoff / (sine * std::min(density, 1.0)) + 1e-6);
    compare.relative("transmittance_integral", d.medium.z, host.medium.z, 40);
    compare.relative("one_minus_exp", d.medium.x, host.medium.x, 20);
    const double depth = static_cast<double>(q.light_sigma.w) * q.cosine_eta_x.w;
    if (depth < 80) {
      compare.relative("transmittance", d.medium.y, host.medium.y, 10 + 6 * depth);
      compare.relative("pdf_transmittance", d.surface.z, host.surface.z, 50 + 6 * depth);
      compare.relative("pdf_distance", d.medium.w, host.medium.w, 60 + 6 * depth);
    }
    compare.relative("pdf_equi_angular", d.surface.w, host.surface.w, 60);
    compare.relative("angle", d.colours.w, host.colours.w, 40);
    compare.near("transmittance of colours", d.colours.y, host.colours.y, 1e-6);
    compare.relative("sample_transmittance", d.drawn.x, host.drawn.x, 50);
    // As if u was off, and the distance rounded.
    const auto at_light = shared::equi_angular(vec3(q.light_sigma), forward, q.reach_share_u.x);
    compare.near("sample_equi_angular", d.drawn.y, host.drawn.y,
                 32 * kRoundoff / shared::pdf_equi_angular(at_light, host.drawn.y) + 32 * kRoundoff * host.drawn.y);
    compare.near("sample_distance", d.drawn.z, host.drawn.z,
                 64 * kRoundoff / host.drawn.w + 50 * kRoundoff * host.drawn.z);
    EXPECT_TRUE(d.drawn.z >= 0 && d.drawn.z <= q.reach_share_u.x && d.drawn.w > 0) << i;
    compare.near("reflectance", d.surface.x, host.surface.x, 1e-6 + 60 * kRoundoff * host.surface.x);
    compare.near("cosine beyond", d.surface.y, host.surface.y, 1e-6 / std::max(host.surface.y, 1e-3f));
    const vec3 w(q.w_alpha), beyond(d.refracted);
    const float cosine = std::abs(dot(forward, w));
    const float excess = shared::dielectric_excess(cosine, q.cosine_eta_x.y);
    compare.near("dielectric_refract", length(beyond - vec3(host.refracted)), 0,
                 4e-6 / std::sqrt(std::max(std::abs(excess), 1e-6f)));
    compare.near("dielectric_reflect", d.refracted.w, host.refracted.w, 1e-6);
    // Of sin and cos Vulkan promises 2^-11.
    const double height = q.point_height.z, slope = height * shared::kWaveMaxSlope / q.point_height.w;
    compare.near("height", d.wave.x, host.wave.x, height * 0x1p-10);
    compare.near("slope", d.wave.y, host.wave.y, slope * 0x1p-10);
    compare.near("slope", d.wave.z, host.wave.z, slope * 0x1p-10);
    compare.near("rate", d.wave.w, host.wave.w, height * 8.8 * shared::wave_frequency(q.point_height.w) * 0x1p-10);
  }
}

}  // namespace
}  // namespace fb::gpu
