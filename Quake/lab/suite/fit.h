// How a cost grows: the exponent of a power of what is varied.
#pragma once

#include <optional>
#include <span>

#include "lab/statistics.h"

namespace fb::lab {

// The slope of log y over log x by least squares, with its 95% interval by Student's t. Nothing where a value is not
// above 0, where there are fewer than three points, or where all x are one.
std::optional<Estimate> fit_power(std::span<const double> x, std::span<const double> y);

}  // namespace fb::lab
