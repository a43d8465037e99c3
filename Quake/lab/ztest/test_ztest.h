// Pictures of light that is made up, with tails as heavy as path tracing's.
#pragma once

#include "lab/ztest/ztest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/rng.h"

namespace fb::lab::made_up {

inline constexpr std::uint32_t kWidth = 48, kHeight = 36, kBlock = 8, kRuns = 16;

// A pixel that is lit now and then, as by path tracing: how often a run (so rare samples make heavy tails), and by how
// much in all.
struct Light {
  double hits = 0.5;  // a pixel and run, on average
  double mean = 1.0;
};
using Scene = std::function<Light(std::uint32_t x, std::uint32_t y)>;

inline double exponential(Rng& rng) { return -std::log(1.0 - static_cast<double>(rng.uniform())); }

inline double pixel(const Light& light, Rng& rng) {
  double sum = 0;  // of as many exponential values as a Poisson process has events in a time of `hits`
  for (double t = exponential(rng); t < light.hits; t += exponential(rng)) sum += exponential(rng);
  return sum * light.mean / light.hits;
}

inline BlockRuns make_runs(const Scene& scene, Rng& rng, std::uint32_t runs = kRuns) {
  BlockRuns result(kWidth, kHeight, kBlock);
  for (std::uint32_t run = 0; run < runs; ++run) {
    Picture picture{kWidth, kHeight, {}};
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        picture.pixels.emplace_back(vec3(static_cast<float>(pixel(scene(x, y), rng))));
    result.add(picture);
  }
  return result;
}

// Drawn one after the other: the order of a call's arguments is the compiler's.
inline ZTest compare(const Scene& reference, const Scene& test, Rng& rng, std::uint32_t runs = kRuns) {
  const BlockRuns tested = make_runs(test, rng, runs);
  return z_test(make_runs(reference, rng, runs), tested);
}

// A picture with a bright and a dim half, as rooms have.
inline Light room(std::uint32_t x, std::uint32_t) { return {x < kWidth / 2 ? 2.0 : 0.6, x < kWidth / 2 ? 3.0 : 0.2}; }

}  // namespace fb::lab::made_up
