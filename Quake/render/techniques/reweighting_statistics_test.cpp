// Figure 7 of Fan 2025 in kind: an integral in one dimension whose proposals are histograms that few samples teach,
// over many runs with the weights of render/techniques/reweighting.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/rng.h"
#include "render/techniques/reweighting.h"

namespace fb::render {
namespace {

constexpr std::size_t kBins = 24;
constexpr std::array<std::size_t, 4> kExampleSchedule{4, 8, 16, 32};
using Histogram = std::array<double, kBins>;  // densities

double two_peaks(double x) {
  const auto peak = [&](double at, double width) { return std::exp(-0.5 * (x - at) * (x - at) / (width * width)); };
  return 0.1 + 3 * peak(0.3, 0.02) + peak(0.7, 0.08);
}
std::size_t bin_of(double x) { return static_cast<std::size_t>(x * kBins); }

double draw_from(const Histogram& p, Rng& rng) {
  double u = static_cast<double>(rng.uniform()) * kBins;
  std::size_t bin = 0;
  for (; bin + 1 < kBins && u >= p[bin]; ++bin) u -= p[bin];
  return (static_cast<double>(bin) + std::min(u / p[bin], 0.9999999)) / kBins;
}

// A quarter even, and the rest what the samples found.
Histogram learnt_from(const std::vector<double>& xs, const Histogram& p) {
  Histogram next;
  next.fill(0.25);
  double sum = 0;
  for (const double x : xs) sum += two_peaks(x) / p[bin_of(x)];
  for (const double x : xs) next[bin_of(x)] += 0.75 * kBins * two_peaks(x) / p[bin_of(x)] / sum;
  return next;
}

struct Estimates {
  double balance = 0, aware = 0, accumulated = 0, inverse_variance = 0, last = 0;
};
// Of pixels that all show the same and share what all of them learn.
std::vector<Estimates> one_run(Rng& rng, std::size_t pixels) {
  constexpr std::size_t kIterations = kExampleSchedule.size();
  struct Pixel {
    std::array<std::vector<double>, kIterations> xs;
    std::array<double, kIterations> means{}, of_mean{}, v{};
  };
  std::vector<Pixel> all(pixels);
  std::array<Histogram, kIterations> p;
  std::array<double, kIterations> counts{};
  p[0].fill(1);
  double samples = 0;
  for (std::size_t i = 0; i < kIterations; ++i) {
    counts[i] = static_cast<double>(kExampleSchedule[i]);
    samples += counts[i];
    std::vector<double> taught;
    for (Pixel& pixel : all) {
      double second = 0;
      for (std::size_t j = 0; j < kExampleSchedule[i]; ++j) {
        const double x = draw_from(p[i], rng), value = two_peaks(x) / p[i][bin_of(x)];
        pixel.xs[i].push_back(x);
        taught.push_back(x);
        pixel.means[i] += value / counts[i];
        second += value * value / counts[i];
      }
      const double variance = (second - pixel.means[i] * pixel.means[i]) * counts[i] / (counts[i] - 1);
      pixel.of_mean[i] = variance / counts[i];
      pixel.v[i] = variance_factor(second, variance);
    }
    if (i + 1 < kIterations) p[i + 1] = learnt_from(taught, p[i]);
  }
  std::vector<Estimates> estimates;
  for (const Pixel& pixel : all) {
    Estimates e;
    const std::vector<double> shares = inverse_variance_shares(pixel.of_mean, counts);
    for (std::size_t i = 0; i < kIterations; ++i) {
      e.accumulated += pixel.means[i] * counts[i] / samples;
      e.inverse_variance += pixel.means[i] * shares[i];
      for (const double x : pixel.xs[i]) {
        std::array<double, kIterations> ratios{};
        for (std::size_t k = 0; k < kIterations; ++k) ratios[k] = std::log(p[k][bin_of(x)] / p[i][bin_of(x)]);
        const double value = two_peaks(x) / p[i][bin_of(x)];
        e.balance += value * balance_factor(ratios, counts);
        e.aware += value * variance_aware_factor(ratios, counts, pixel.v, i);
      }
    }
    e.last = pixel.means[kIterations - 1];
    estimates.push_back(e);
  }
  return estimates;
}

struct Errors {
  double sum = 0, squares = 0, count = 0;
  void add(double error) { sum += error, squares += error * error, count += 1; }
  double bias() const { return sum / count; }
  double bias_error() const { return std::sqrt((squares / count - bias() * bias()) / count); }
  double root() const { return std::sqrt(squares / count); }
};
struct Example {
  Errors balance, aware, accumulated, inverse, last;
};
// Pixels of one run are correlated: their error is that of runs, of which each counts with one pixel.
Example example_of(std::size_t pixels) {
  constexpr int kRuns = 2000, kSteps = 100000;
  double integral = 0;
  for (int i = 0; i < kSteps; ++i) integral += two_peaks((i + 0.5) / kSteps) / kSteps;
  Rng rng(7);
  Example result;
  for (int run = 0; run < kRuns; ++run) {
    const Estimates e = one_run(rng, pixels).front();
    result.balance.add(e.balance / integral - 1);
    result.aware.add(e.aware / integral - 1);
    result.accumulated.add(e.accumulated / integral - 1);
    result.inverse.add(e.inverse_variance / integral - 1);
    result.last.add(e.last / integral - 1);
  }
  return result;
}

// The samples of one integral alone: what they lose outweighs the variance that weights take away.
TEST(ReweightingExampleStatistics, OneIntegralThatTeachesItselfLosesMoreThanItGains) {
  const Example e = example_of(1);
  EXPECT_LT(std::abs(e.accumulated.bias()), 4.5 * e.accumulated.bias_error());
  EXPECT_LT(std::abs(e.last.bias()), 4.5 * e.last.bias_error());
  EXPECT_LT(e.balance.bias(), -4.5 * e.balance.bias_error());
  EXPECT_GT(e.balance.root(), e.accumulated.root());
}

// As in a picture, where many pixels teach one distribution: the mixture has the least error.
TEST(ReweightingExampleStatistics, ManyPixelsThatShareADistributionGain) {
  const Example e = example_of(64);
  EXPECT_LT(std::abs(e.accumulated.bias()), 4.5 * e.accumulated.bias_error());
  EXPECT_LT(e.balance.bias(), 4.5 * e.balance.bias_error());
  EXPECT_GT(e.balance.bias(), -0.05);
  EXPECT_LT(e.balance.root(), 0.95 * e.accumulated.root());
  EXPECT_LT(e.balance.root(), 0.95 * e.last.root());
  EXPECT_LT(e.balance.root(), 0.95 * e.inverse.root());
}

}  // namespace
}  // namespace fb::render
