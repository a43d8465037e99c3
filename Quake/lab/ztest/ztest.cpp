#include "lab/ztest/ztest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "base/probability.h"

namespace fb::lab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-6;

// A block's values, run by run.
std::vector<double> column(const BlockRuns& runs, std::size_t block) {
  std::vector<double> values;
  for (std::uint32_t run = 0; run < runs.runs(); ++run) values.push_back(runs.value(run, block));
  return values;
}

// Sum over blocks of weight times value, run by run.
std::vector<double> weighted(const BlockRuns& runs, const std::vector<double>& weights) {
  std::vector<double> values(runs.runs(), 0.0);
  for (std::uint32_t run = 0; run < runs.runs(); ++run)
    for (std::size_t block = 0; block < runs.blocks(); ++block) values[run] += weights[block] * runs.value(run, block);
  return values;
}

std::vector<double> block_means(const BlockRuns& a, const BlockRuns& b) {
  std::vector<double> means;
  for (std::size_t block = 0; block < a.blocks(); ++block)
    means.push_back(0.5 * (mean(column(a, block)) + mean(column(b, block))));
  return means;
}

// Calls see(index of the neighbour) for the up to 3 x 3 blocks about a block, itself among them.
template <typename See>
void visit_neighbours(const ZTest& result, std::size_t block, const See& see) {
  const std::size_t nx = result.blocks_x, ny = result.blocks_y, x = block % nx, y = block / nx;
  for (std::size_t j = y > 0 ? y - 1 : 0; j <= std::min(y + 1, ny - 1); ++j)
    for (std::size_t i = x > 0 ? x - 1 : 0; i <= std::min(x + 1, nx - 1); ++i) see(j * nx + i);
}

// Whether a block holds too little light. Its neighbourhood is asked: to choose blocks by their own error would choose
// those in which rare samples happened to miss, and make their z large.
bool too_dim(const ZTest& result, std::size_t block, const std::vector<Welch>& tests, const std::vector<double>& means,
             double enough) {
  std::vector<double> errors;
  visit_neighbours(result, block, [&](std::size_t i) {
    if (means[i] > 0) errors.push_back(tests[i].error / means[i]);
  });
  constexpr double kFarTooMuch = 3;  // a dim block among bright ones
  return median(errors) > enough || tests[block].error > kFarTooMuch * enough * means[block];
}

// A tested block's weight is one over the mean of the 3 x 3 blocks about it.
std::vector<double> relative_weights(const ZTest& result, const std::vector<double>& means) {
  std::vector<double> weights(means.size(), 0.0);
  for (std::size_t block = 0; block < means.size(); ++block) {
    if (std::isnan(result.z[block])) continue;
    double sum = 0, count = 0;
    visit_neighbours(result, block, [&](std::size_t i) {
      sum += means[i];
      count += 1;
    });
    if (sum > 0) weights[block] = count / sum;
  }
  return weights;
}

Welch compare(const BlockRuns& reference, const BlockRuns& test, const std::vector<double>& weights) {
  return welch_test(weighted(reference, weights), weighted(test, weights));
}

Interval relative_interval(const Welch& w, double scale) {
  if (scale <= 0) return {};
  const double half = student_t_quantile(0.95, std::max(1, static_cast<int>(w.degrees))) * w.error;
  return {(w.difference - half) / scale, (w.difference + half) / scale};
}

void finish_blocks(ZTest& result) {
  std::vector<double> tested;
  for (const double z : result.z)
    if (!std::isnan(z)) tested.push_back(z);
  if (!std::isnan(result.pooled_z)) tested.push_back(result.pooled_z);
  if (tested.empty()) return;
  for (const double z : tested) result.chi_squared += z * z;
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  result.max_z = *std::max_element(tested.begin(), tested.end(), larger);
  const auto at = std::find(result.z.begin(), result.z.end(), result.max_z);
  result.worst = static_cast<std::size_t>(at - result.z.begin());
  const auto n = static_cast<double>(tested.size());
  result.p_block = std::min(1.0, n * two_sided_p(result.max_z));
  result.p_spread = chi_squared_p(result.chi_squared, n);
  result.p_kolmogorov = kolmogorov_p(tested);
}

}  // namespace

BlockRuns::BlockRuns(std::uint32_t width, std::uint32_t height, std::uint32_t block)
    : width_(width),
      height_(height),
      block_(block),
      blocks_x_((width + block - 1) / block),
      blocks_y_((height + block - 1) / block),
      pixels_(std::size_t{blocks_x_} * blocks_y_, 0.0) {
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t x = 0; x < width_; ++x) pixels_[std::size_t{y / block_} * blocks_x_ + x / block_] += 1;
}

void BlockRuns::add(const Picture& picture) {
  FB_CHECK(picture.width == width_ && picture.height == height_);
  values_.resize(values_.size() + blocks(), 0.0);
  double* sums = values_.data() + std::size_t{runs_} * blocks();
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t x = 0; x < width_; ++x) {
      const vec3& c = picture.pixels[std::size_t{y} * width_ + x];
      const double luminance = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
      if (!std::isfinite(luminance)) {
        ++not_finite_;
        continue;
      }
      sums[std::size_t{y / block_} * blocks_x_ + x / block_] += luminance;
    }
  for (std::size_t block = 0; block < blocks(); ++block) sums[block] /= pixels_[block];
  ++runs_;
}

Welch welch_test(const std::vector<double>& reference, const std::vector<double>& test) {
  FB_CHECK(reference.size() >= 2 && test.size() >= 2);
  const double error_a = standard_error(reference), error_b = standard_error(test);
  const double mean_a = mean(reference), mean_b = mean(test);
  const double a = error_a * error_a, b = error_b * error_b;
  Welch w;
  w.difference = mean_b - mean_a;
  const double floor = kRounding * 0.5 * (std::abs(mean_a) + std::abs(mean_b));
  w.error = std::max(std::sqrt(a + b), floor);
  const double below = a * a / static_cast<double>(reference.size() - 1) + b * b / static_cast<double>(test.size() - 1);
  w.degrees = below > 0 ? (a + b) * (a + b) / below : static_cast<double>(reference.size() + test.size() - 2);
  if (w.error > 0) {
    const double t = w.difference / w.error, n = w.degrees;
    w.z = std::copysign((8 * n + 1) / (8 * n + 3) * std::sqrt(n * std::log1p(t * t / n)), t);
  }
  return w;
}

double kolmogorov_p(std::vector<double> values) {
  if (values.empty()) return 1;
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double p = normal_probability(values[i]);
    distance = std::max({distance, p - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p});
  }
  const double x = distance * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));
  if (x < 0.3) return 1;
  double sum = 0;
  for (int k = 1; k <= 20; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

double ZTest::detectable(double alpha) const {
  constexpr double kNineInTen = 1.2816;
  return (normal_quantile_two_sided(alpha / 4) + kNineInTen) * energy_error;
}

std::size_t ZTest::holm_rejected(double alpha) const {
  std::vector<double> p;
  for (const double value : z)
    if (!std::isnan(value)) p.push_back(two_sided_p(value));
  std::sort(p.begin(), p.end());
  std::size_t rejected = 0;
  while (rejected < p.size() && p[rejected] <= alpha / static_cast<double>(p.size() - rejected)) ++rejected;
  return rejected;
}

ZTest z_test(const BlockRuns& reference, const BlockRuns& test, const ZTestOptions& options) {
  FB_CHECK(reference.runs() >= 2 && test.runs() >= 2 && reference.blocks_x() == test.blocks_x() &&
           reference.blocks_y() == test.blocks_y());
  ZTest result;
  result.blocks_x = reference.blocks_x();
  result.blocks_y = reference.blocks_y();
  result.z.assign(reference.blocks(), kNone);
  result.pooled_z = kNone;
  result.worst = reference.blocks();
  const std::vector<double> means = block_means(reference, test);

  std::vector<Welch> tests;
  for (std::size_t block = 0; block < reference.blocks(); ++block)
    tests.push_back(welch_test(column(reference, block), column(test, block)));
  std::vector<double> pool(reference.blocks(), 0.0);
  double pool_mean = 0;
  for (std::size_t block = 0; block < reference.blocks(); ++block) {
    const Welch& w = tests[block];
    if (w.difference == 0 && w.error <= kRounding * std::abs(means[block])) continue;  // nothing to test
    if (too_dim(result, block, tests, means, options.enough)) {
      pool[block] = reference.pixels(block);
      pool_mean += pool[block] * means[block];
      ++result.pooled;
      continue;
    }
    result.z[block] = w.z;
    ++result.tested;
  }
  if (result.pooled > 0) {
    const Welch w = compare(reference, test, pool);
    if (w.error <= options.enough * pool_mean) result.pooled_z = w.z;
  }
  finish_blocks(result);

  std::vector<double> all;
  double pixels = 0;
  for (std::size_t block = 0; block < reference.blocks(); ++block) {
    all.push_back(reference.pixels(block));
    pixels += all.back();
  }
  for (double& weight : all) weight /= pixels;
  result.mean_reference = mean(weighted(reference, all));
  const Welch energy = compare(reference, test, all);
  result.p_energy = two_sided_p(energy.z);
  result.energy = relative_interval(energy, result.mean_reference);
  result.energy_error = result.mean_reference > 0 ? energy.error / result.mean_reference : 0;

  const std::vector<double> weights = relative_weights(result, means);
  const Welch relative = compare(reference, test, weights);
  result.p_relative = two_sided_p(relative.z);
  result.relative = relative_interval(relative, mean(weighted(reference, weights)));
  result.p = std::min(1.0, 4 * std::min({result.p_block, result.p_spread, result.p_energy, result.p_relative}));
  return result;
}

std::string ztest_text(const ZTest& r) {
  std::string text =
      fmt::format("p {:.3g} = 4 x the least of: block {:.3g}, spread {:.3g}, energy {:.3g}, relative {:.3g}\n", r.p,
                  r.p_block, r.p_spread, r.p_energy, r.p_relative);
  text += r.worst < r.z.size()
              ? fmt::format("largest |z| {:.2f} at block {},{}", r.max_z, r.worst % r.blocks_x, r.worst / r.blocks_x)
              : fmt::format("largest |z| {:.2f} in the pool", r.max_z);
  text += fmt::format("; {} blocks tested, {} pooled; sum of z^2 {:.1f}; z normal: p {:.2g}\n", r.tested, r.pooled,
                      r.chi_squared, r.p_kolmogorov);
  text += fmt::format("bias of the energy {:+.3f}% to {:+.3f}%, of the mean block {:+.3f}% to {:+.3f}% (95%)\n",
                      100 * r.energy.low, 100 * r.energy.high, 100 * r.relative.low, 100 * r.relative.high);
  return text;
}

std::string ztest_map(const ZTest& r) {
  std::string text;
  for (std::uint32_t y = 0; y < r.blocks_y; ++y) {
    for (std::uint32_t x = 0; x < r.blocks_x; ++x) {
      const double z = r.z[std::size_t{y} * r.blocks_x + x];
      text += std::isnan(z) ? std::string("    . ") : fmt::format("{:5.1f} ", z);
    }
    text += '\n';
  }
  return text;
}

}  // namespace fb::lab
