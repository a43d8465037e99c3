#include "scene/authored/light_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fb::scene {
namespace {

constexpr double kDark = 0.004;    // added to both sides: light below is as dark as no light on a display
constexpr double kOutlier = 1.0;   // natural logarithm: equations farther off pull as if they were as far
constexpr double kFirmness = 0.3;  // equations' worth that hold an emitter to its physical value
constexpr double kLoose = 0.02;    // the same of what the map does not ask for
constexpr double kLeastTerm = 1e-6;
constexpr double kWhite = 4.4;  // as light: what luxels of 251 and more hold
constexpr double kMostStep = 1.0;
constexpr double kAbsurd = 1e-3;                           // a factor that says so of an emitter's keys
constexpr double kLeastLog = -12.0;                        // how far a factor goes from where it began
constexpr double kMostOfLamps = 2.5, kMostOfOthers = 7.0;  // textures' and skies' powers are guesses before
constexpr int kIterations = 40;

// In four sums, which a processor adds side by side: the fit's time is this.
double dot(const double* a, const double* b, std::size_t count) {
  std::array<double, 4> sums{};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4)
    for (std::size_t lane = 0; lane < 4; ++lane) sums[lane] += a[k + lane] * b[k + lane];
  for (; k < count; ++k) sums[0] += a[k] * b[k];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// Solves A x = b in place for a symmetric positive definite A (row-major, lower half); b becomes x.
void solve_cholesky(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      const double sum = a[i * n + j] - dot(&a[i * n], &a[j * n], j);
      if (i == j)
        a[j * n + j] = std::sqrt(std::max(sum, 1e-12));
      else
        a[i * n + j] = sum / a[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

double sum_of(const LightEquation& equation, const std::vector<double>& factors) {
  double sum = 0;
  for (const auto& term : equation.terms) sum += static_cast<double>(term.coefficient) * factors[term.unknown];
  return sum;
}

// A luxel holds no more than 255: what is as bright may have been meant brighter.
double off_by(const LightEquation& equation, double sum) {
  if (static_cast<double>(equation.value) > kWhite && sum > kWhite) return 0.0;
  return std::log((static_cast<double>(equation.value) + kDark) / (sum + kDark));
}

std::vector<LightEquation> equations_of(std::size_t channel, const std::vector<Emitter>& emitters,
                                        const std::vector<LuxelPoint>& points, const LightTransport& transport) {
  std::vector<LightEquation> out;
  const auto add = [&](const float* row, int style, float value) {
    LightEquation equation{{}, value};
    for (std::uint32_t e = 0; e < emitters.size(); ++e)
      if (emitters[e].style == style && row[e] > kLeastTerm) equation.terms.push_back({e, row[e]});
    if (!equation.terms.empty()) out.push_back(std::move(equation));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (transport.outside[i] != 0) continue;
    const float* const row = &transport.light[channel][i * transport.emitters];
    for (std::size_t k = 0; k < 4; ++k) {
      if (points[i].styles[k] == Lightmaps::kNoStyle) continue;
      add(row, points[i].styles[k], points[i].baked[k][static_cast<int>(channel)]);
    }
  }
  return out;
}

double rms_stops(const std::vector<LightEquation>& equations, const std::vector<double>& factors) {
  double sum = 0;
  for (const LightEquation& e : equations) {
    const double stops = off_by(e, sum_of(e, factors)) / std::log(2.0);
    sum += stops * stops;
  }
  return equations.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(equations.size()));
}

// The median of what equations of lit points are off by.
double common_log(const std::vector<LightEquation>& equations, const std::vector<double>& ones) {
  std::vector<double> off;
  for (const LightEquation& e : equations)
    if (static_cast<double>(e.value) > kDark) off.push_back(off_by(e, sum_of(e, ones)));
  if (off.empty()) return 0.0;
  const auto middle = off.begin() + std::ssize(off) / 2;
  std::ranges::nth_element(off, middle);
  return *middle;
}

// Where each emitter begins: at 1, but for those whose keys are absurd (a light of 100,000), which begin at what the
// baked light allows, so that others are not thought as weak.
std::vector<double> first_factors(const std::vector<LightEquation>& equations, std::size_t emitters) {
  std::vector<std::vector<double>> allowed(emitters);
  for (const LightEquation& e : equations)
    for (const auto& term : e.terms)
      if (term.coefficient > 0.0f)
        allowed[term.unknown].push_back(std::max(static_cast<double>(e.value), kDark) /
                                        static_cast<double>(term.coefficient));
  std::vector<double> factors(emitters, 1.0);
  for (std::size_t i = 0; i < emitters; ++i) {
    if (allowed[i].empty()) continue;
    const auto high = allowed[i].begin() + std::ssize(allowed[i]) * 19 / 20;
    std::ranges::nth_element(allowed[i], high);
    if (*high < kAbsurd) factors[i] = *high;
  }
  return factors;
}

std::vector<double> exponentials(const std::vector<double>& logs) {
  std::vector<double> out;
  for (const double u : logs) out.push_back(std::exp(u));
  return out;
}

}  // namespace

std::vector<double> solve_logarithms(const std::vector<LightEquation>& equations, const std::vector<double>& begin,
                                     const std::vector<double>& firmness, const std::vector<double>& most) {
  const std::size_t n = begin.size();
  std::vector<double> logs = begin;
  std::vector<std::pair<std::uint32_t, double>> shares;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const std::vector<double> factors = exponentials(logs);
    std::vector<double> matrix(n * n, 0.0), right(n, 0.0);
    for (const LightEquation& e : equations) {
      const double sum = sum_of(e, factors), off = off_by(e, sum);
      const double weight = std::min(1.0, kOutlier / std::max(std::fabs(off), 1e-9));
      shares.clear();
      for (const auto& term : e.terms) {
        const double share = static_cast<double>(term.coefficient) * factors[term.unknown] / (sum + kDark);
        if (share > 1e-3) shares.emplace_back(term.unknown, share);
      }
      for (const auto& [i, share_i] : shares) {
        right[i] += weight * share_i * off;
        for (const auto& [j, share_j] : shares)
          if (j <= i) matrix[i * n + j] += weight * share_i * share_j;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      right[i] += firmness[i] * (begin[i] - logs[i]);
      matrix[i * n + i] = matrix[i * n + i] * 1.02 + firmness[i] + 1e-9;
    }
    solve_cholesky(matrix, right);
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double step = std::clamp(right[i], -kMostStep, kMostStep);
      logs[i] = std::clamp(logs[i] + step, begin[i] + kLeastLog, begin[i] + most[i]);
      largest = std::max(largest, std::fabs(step));
    }
    if (largest < 1e-3) break;
  }
  return logs;
}

LightFit fit_light(const std::vector<Emitter>& emitters, const std::vector<LuxelPoint>& points,
                   const LightTransport& transport) {
  LightFit fit;
  fit.factors.assign(emitters.size(), vec3(1.0f));
  fit.shares.assign(emitters.size(), 0.0f);
  double before = 0, after = 0, all = 0;
  std::vector<double> light(emitters.size(), 0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<LightEquation> equations = equations_of(c, emitters, points, transport);
    const std::vector<double> ones(emitters.size(), 1.0);
    const std::vector<double> first = first_factors(equations, emitters.size());
    const double common = common_log(equations, first);
    fit.common[static_cast<int>(c)] = static_cast<float>(std::exp(common));
    std::vector<double> begin, firmness, most;
    for (std::size_t i = 0; i < emitters.size(); ++i) {
      const Emitter& e = emitters[i];
      const bool added = e.kind == EmitterKind::kAmbient;
      begin.push_back(added ? 0.0 : common + std::log(first[i]));
      firmness.push_back(added ? kLoose : kFirmness);
      most.push_back(e.kind == EmitterKind::kLamp ? kMostOfLamps : kMostOfOthers);
    }
    const std::vector<double> factors = exponentials(solve_logarithms(equations, begin, firmness, most));
    before += std::pow(rms_stops(equations, ones), 2) / 3;
    after += std::pow(rms_stops(equations, factors), 2) / 3;
    for (std::size_t e = 0; e < emitters.size(); ++e)
      fit.factors[e][static_cast<int>(c)] = static_cast<float>(factors[e]);
    for (const LightEquation& e : equations)
      for (const auto& term : e.terms) {
        const double part = static_cast<double>(term.coefficient) * factors[term.unknown];
        light[term.unknown] += part;
        all += part;
      }
  }
  fit.stops_before = std::sqrt(before);
  fit.stops_after = std::sqrt(after);
  for (std::size_t e = 0; e < emitters.size(); ++e) fit.shares[e] = all > 0 ? static_cast<float>(light[e] / all) : 0.0f;
  return fit;
}

}  // namespace fb::scene
