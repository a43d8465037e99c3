// Weights of paths whose densities were learnt in iterations (Fan 2025, multiple importance reweighting).
//
// Iteration k draws n_k paths a pixel of density p_k. A path x of iteration i brought c = f(x) / p_i(x); what it counts
// with in the picture of all iterations is c times a factor that depends on the densities of x in all of them. The
// factors here are w_i(x) / n_i of Eq. 3. Densities come as logarithms of their ratio to the path's own, ln(p_k / p_i):
// products of a dozen of them leave the range of numbers, and whatever does not depend on the iteration cancels.
//
// Where light is looked for, too, each length of path has two ends: its last direction was drawn as all others are,
// with density q_k, or looked for, with a density d that is the same in all iterations. A path of either kind of
// iteration i brings, with the balance heuristic within its frame, c = f / (P_i (q_i + d)), where P is the density of
// the directions before the last. The balance heuristic over both ends of all iterations gives it
// f / sum_k n_k P_k (q_k + d): what counts in the place of p_k is P_k (q_k + d) (Section 5 of the paper).
//
// Where the same samples have taught the distributions, none of these is unbiased: a bright path makes later densities
// large where it is, and so its own weight small. Energy is lost, less with more samples. If other samples taught
// (the decorrelated form), all but Eq. 7 are unbiased whatever the distributions are, Eq. 8 as long as whether a path
// was kept does not depend on other paths.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace fb::render {

// The balance heuristic at the level of paths, Eq. 6: 1 / sum_k n_k p_k / p_i. `log_ratios` and `counts` have one
// element an iteration, of which the path's own has ratio 0 and a count above 0. -infinity, or no number: the iteration
// never makes the path. Finite and not negative, whatever the ratios are.
double balance_factor(std::span<const double> log_ratios, std::span<const double> counts);

// ln((q_k + d) / (q_i + d)) of a path's last direction; ln(q_k / q_i) where light is not looked for in it.
double end_log_ratio(double proposed, double own_proposed, double looked_for);

// With Eq. 7: v_i / sum_k n_k v_k p_k / p_i. `variances`: v_k, above 0 and finite (variance_factor).
double variance_aware_factor(std::span<const double> log_ratios, std::span<const double> counts,
                             std::span<const double> variances, std::size_t own);
// v of an iteration: second moment over variance of a sample, 1 to kMostVarianceFactor; 1 where there is no light.
double variance_factor(double second_moment, double variance);
constexpr double kMostVarianceFactor = 1000;

// Eq. 8, times the samples of all iterations, which are not known yet when a path is let go of: the mixture of the
// iterations so far, for which the spans are.
double partial_factor(std::span<const double> log_ratios, std::span<const double> counts);

// Shares of whole iterations in a picture, which add up to one: in inverse proportion to the variance of each
// iteration's mean (Müller 2019). Negative or no number: it is unknown, and the iteration is left out. If all are
// unknown, by their samples. Iterations without variance share the picture among them.
std::vector<double> inverse_variance_shares(std::span<const double> variances, std::span<const double> counts);

}  // namespace fb::render
