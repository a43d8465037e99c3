#include "lab/compare/metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "base/check.h"
#include "lab/compare/spectrum.h"
#include "lab/compare/structure.h"

namespace fb::lab {
namespace {

double top_share(std::vector<double>& pixel_errors) {
  const double total = std::accumulate(pixel_errors.begin(), pixel_errors.end(), 0.0);
  if (total <= 0) return 0;
  const auto top = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(kTopPixels * static_cast<double>(pixel_errors.size()))));
  const auto cut = pixel_errors.begin() + static_cast<std::ptrdiff_t>(top);
  if (cut != pixel_errors.end()) std::nth_element(pixel_errors.begin(), cut, pixel_errors.end(), std::greater<>());
  return std::accumulate(pixel_errors.begin(), cut, 0.0) / total;
}

double middle(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

}  // namespace

double Errors::rmse() const { return std::sqrt(mse); }
double Errors::psnr() const { return 10 * std::log10(peak * peak / mse); }

Errors measure(const Reference& reference, const Picture& test, const MetricOptions& options) {
  FB_CHECK(reference.mean.same_size(test));
  Errors e;
  const std::size_t pixels = test.pixels.size();
  if (pixels == 0) return e;
  std::vector<double> pixel_errors(pixels);
  double variance_of_bias = 0;
  e.peak = options.peak;
  if (!(e.peak > 0))
    for (const vec3& p : reference.mean.pixels) e.peak = std::max(e.peak, double{std::max({p.x, p.y, p.z})});
  for (std::size_t i = 0; i < pixels; ++i) {
    const bool usable = finite(test.pixels[i]);
    e.not_finite += usable ? 0 : 1;
    double deviation = 0;  // of a pixel's sum: its channels err together
    for (int c = 0; c < 3; ++c) {
      const double x = usable ? test.pixels[i][c] : 0.0, r = reference.mean.pixels[i][c];
      const double squared = (x - r) * (x - r), scale = r * r + options.epsilon;
      e.bias += x - r;
      e.rel_mse += squared / scale;
      e.mape += std::abs(x - r) / (std::abs(r) + options.epsilon);
      e.smape += std::abs(x - r) / (std::abs(x) + std::abs(r) + options.epsilon);
      pixel_errors[i] += squared / 3;
      if (reference.variance.empty()) continue;
      const double v = reference.variance[i][c];
      e.reference_variance += v;
      e.reference_rel_variance += v / scale;
      deviation += std::sqrt(std::max(v, 0.0));
    }
    variance_of_bias += deviation * deviation;
  }
  const double n = 3.0 * static_cast<double>(pixels);
  e.mse = std::accumulate(pixel_errors.begin(), pixel_errors.end(), 0.0) / static_cast<double>(pixels);
  e.bias /= n;
  e.rel_mse /= n;
  e.mape /= n;
  e.smape /= n;
  e.reference_rel_variance /= n;
  e.reference_variance /= n;
  e.reference_bias_error = std::sqrt(variance_of_bias) / n;  // pixels as if independent
  e.top_share = top_share(pixel_errors);
  e.median_mse = middle(pixel_errors);
  return e;
}

bool Metric::holds(bool linear, bool variance_known) const {
  switch (when) {
    case When::kLinear:
      return linear;
    case When::kStored:
      return !linear;
    case When::kKnownVariance:
      return variance_known;
    case When::kLinearVariance:
      return linear && variance_known;
    default:
      return true;
  }
}

const std::vector<Metric>& metrics() {
  using When = Metric::When;
  const auto of_pictures = [](const char* name, double (*value)(const PicturePair&)) {
    return Metric{name, nullptr, When::kAlways, false, value};
  };
  const auto error = [](Metric metric) {
    metric.multiplies = true;
    return metric;
  };
  static const std::vector<Metric> rows{
      error({"mse", [](const Errors& e) { return e.mse; }}),
      error({"mse_corrected", [](const Errors& e) { return e.mse_corrected(); }, When::kKnownVariance}),
      error({"rmse", [](const Errors& e) { return e.rmse(); }, When::kAlways, false}),
      error({"relmse", [](const Errors& e) { return e.rel_mse; }, When::kLinear}),
      error({"relmse_corrected", [](const Errors& e) { return e.rel_mse_corrected(); }, When::kLinearVariance}),
      error({"mape", [](const Errors& e) { return e.mape; }, When::kLinear}),
      {"smape", [](const Errors& e) { return e.smape; }, When::kLinear, false},
      {"psnr", [](const Errors& e) { return e.psnr(); }, When::kAlways, false},
      {"bias", [](const Errors& e) { return e.bias; }},
      error({"mse_median_pixel", [](const Errors& e) { return e.median_mse; }}),
      {"top_share", [](const Errors& e) { return e.top_share; }},
      of_pictures("ssim", [](const PicturePair& p) { return ssim(p.shown_reference, p.shown_test); }),
      of_pictures("ms_ssim", [](const PicturePair& p) { return ms_ssim(p.shown_reference, p.shown_test); }),
      of_pictures("low_frequencies",
                  [](const PicturePair& p) { return error_spectrum(p.reference, p.test).low_share; }),
  };
  return rows;
}

void Runs::add(const Picture& picture) {
  if (count_ == 0) {
    mean_ = Picture{picture.width, picture.height, std::vector<vec3>(picture.pixels.size(), vec3(0.0f))};
    m2_.assign(picture.pixels.size(), vec3(0.0f));
  }
  FB_CHECK(mean_.same_size(picture));
  ++count_;
  for (std::size_t i = 0; i < m2_.size(); ++i) {
    const vec3 x = finite(picture.pixels[i]) ? picture.pixels[i] : vec3(0.0f);
    const vec3 delta = x - mean_.pixels[i];
    mean_.pixels[i] += delta / static_cast<float>(count_);
    m2_[i] += delta * (x - mean_.pixels[i]);
  }
}

double Runs::variance() const {
  if (count_ < 2) return 0;
  double sum = 0;
  for (const vec3& v : m2_) sum += double{v.x} + v.y + v.z;
  return sum / (3.0 * static_cast<double>(m2_.size()) * (count_ - 1));
}

double Runs::bias_squared(const Reference& reference) const {
  if (count_ < 2) return 0;
  return measure(reference, mean_).mse_corrected() - variance() / count_;
}

}  // namespace fb::lab
