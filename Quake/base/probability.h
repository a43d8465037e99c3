// Tail probabilities of the normal and chi-squared distributions, for the tests and the laboratory.
#pragma once

namespace fb {

double normal_probability(double z);  // P(Z <= z), standard normal
double two_sided_p(double z);         // P(|Z| > |z|)
// The z whose P(|Z| > z) is p.
double normal_quantile_two_sided(double p);
double chi_squared_p(double chi_squared, double degrees);  // P(X > x) (Wilson and Hilferty 1931)

}  // namespace fb
