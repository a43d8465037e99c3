// shared/vmf.h on the host (gpu/vmf_device_test.cpp holds the device to the same), and the reference against itself.
#include "shared/vmf.h"

#include "shared/test_vmf_checks.h"

namespace fb::shared {
namespace {

TEST(Vmf, IsWithinItsErrorBounds) { check_vmf_errors(vmf_evaluate_on_host, kVmfHostPrecision); }
TEST(Vmf, KappaAndMeanCosineInvertEachOther) { check_vmf_inversion(vmf_evaluate_on_host, kVmfHostPrecision); }
TEST(Vmf, IsFiniteEverywhere) { check_vmf_is_finite(vmf_evaluate_on_host); }
TEST(Vmf, SamplerFollowsThePdf) { check_vmf_sampler_follows_pdf(vmf_evaluate_on_host); }

TEST(Vmf, ALobeGivesTheSameNumbers) {
  Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    const float kappa = std::exp(rng.uniform(-5, 20));
    const vec3 mu = vmf_sample(vec3(0, 0, 1), 0, {rng.uniform(), rng.uniform()});
    const vec3 w = vmf_sample(mu, kappa, {rng.uniform(), rng.uniform()});
    EXPECT_EQ(vmf_lobe_pdf(vmf_lobe(mu, kappa), w), vmf_pdf(mu, kappa, w));
  }
}

// A sample is the mean of the next, as in a chain of states: lengths do not drift.
TEST(Vmf, AChainOfSamplesStaysOnTheSphere) {
  Rng rng(4);
  vec3 w(0, 0, 1);
  for (int i = 0; i < 100000; ++i) {
    w = vmf_sample(w, 1e6f, {rng.uniform(), rng.uniform()});
    ASSERT_NEAR(static_cast<double>(reference::length(w)), 1, 9 * kRoundoff) << "after " << i;
  }
}

// The reference has no outside witness but mathematics: its pdf integrates to 1, its inverse CDF inverts the pdf's
// integral, its moments are the integrals, and it meets the limits for small and large kappa.
TEST(VmfReference, AgreesWithItself) {
  using reference::Real;
  for (const Real kappa : {1e-9L, 1e-3L, 0.3L, 0.999999L, 1.0L, 5.0L, 30.0L, 1e4L, 1e9L}) {
    constexpr int kSteps = 200000;
    const Real top = std::min(2.0L, 60 / kappa), h = top / kSteps;
    Real mass = 0, mean = 0, second = 0;
    for (int i = 0; i < kSteps; ++i) {
      const Real t = (i + 0.5L) * h, p = 2 * reference::kPi * reference::pdf_of_t(kappa, t) * h;
      if (i == kSteps / 64) {
        EXPECT_NEAR(static_cast<double>(reference::inverse_cdf(kappa, mass) / (i * h)), 1, 2e-8);
      }
      mass += p;
      mean += t * p;
      second += t * (2 - t) * p;
    }
    // The midpoint rule's relative error is (60 / steps)^2 / 24 at most.
    EXPECT_NEAR(static_cast<double>(mass), 1, 1e-8);
    EXPECT_NEAR(static_cast<double>(mean / reference::mean_cosine_complement(kappa)), 1, 1e-8);
    EXPECT_NEAR(static_cast<double>(second / reference::second_moment(kappa)), 1, 1e-8);
    EXPECT_NEAR(static_cast<double>(reference::cdf(kappa, reference::inverse_cdf(kappa, 0.7L))), 0.7, 1e-15);
    EXPECT_NEAR(static_cast<double>(reference::mean_cosine(kappa) + reference::mean_cosine_complement(kappa)), 1,
                1e-15);
    // The derivative, by a central difference.
    const Real d = kappa * 1e-4L;
    const Real slope =
        (reference::mean_cosine_complement(kappa - d) - reference::mean_cosine_complement(kappa + d)) * kappa / (2 * d);
    EXPECT_NEAR(static_cast<double>(reference::mean_cosine_slope(kappa) / slope), 1, 1e-6);
  }
  EXPECT_NEAR(static_cast<double>(reference::mean_cosine(1e-5L) / 1e-5L), 1.0 / 3, 1e-10);
}

}  // namespace
}  // namespace fb::shared
