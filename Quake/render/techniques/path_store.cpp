#include "render/techniques/path_store.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/techniques/iteration_state.h"
#include "render/techniques/reweighting.h"
#include "shared/color.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kTile = 16;

}  // namespace

void PathStore::add(std::uint32_t pixel, std::uint32_t iteration, std::span<const PathVertex> vertices) {
  std::uint32_t count = 0;
  float importance = 0;
  for (std::uint32_t k = 0; k < vertices.size(); ++k) {
    const float light = shared::luminance(vertices[k].light);
    if (!(light > 0)) continue;
    importance += light;
    count = k + 1;
  }
  if (count == 0) return;
  paths_.push_back({pixel, iteration, static_cast<std::uint32_t>(vertices_.size()), count, importance});
  vertices_.insert(vertices_.end(), vertices.begin(), vertices.begin() + count);
}

void PathStore::shrink(std::uint64_t bytes, const std::function<void(const Path&)>& gone) {
  if (this->bytes() <= bytes) return;
  std::vector<std::uint32_t> order(paths_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return paths_[a].importance != paths_[b].importance ? paths_[a].importance > paths_[b].importance : a < b;
  });
  std::vector<bool> kept(paths_.size());
  std::uint64_t used = 0;
  for (const std::uint32_t i : order) {
    used += sizeof(Path) + paths_[i].count * sizeof(PathVertex);
    if (used > bytes) break;
    kept[i] = true;
  }
  std::vector<Path> paths;
  std::vector<PathVertex> vertices;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (!kept[i]) {
      gone(paths_[i]);
      continue;
    }
    const auto of = this->vertices(paths_[i]);
    paths.push_back(paths_[i]);
    paths.back().first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), of.begin(), of.end());
  }
  paths_ = std::move(paths);
  vertices_ = std::move(vertices);
}

void PathStore::save(Bytes& state) const {
  put_array(state, paths_);
  put_array(state, vertices_);
}
bool PathStore::load(ByteReader& state, std::size_t pixels, std::size_t iterations) {
  clear();
  PathStore read;
  if (!take_array(state, read.paths_) || !take_array(state, read.vertices_)) return false;
  for (const Path& path : read.paths_)
    if (path.pixel >= pixels || path.iteration >= iterations || path.count > read.vertices_.size() ||
        path.first > read.vertices_.size() - path.count)
      return false;
  *this = std::move(read);
  return true;
}

double vertex_density(const GuidingTrees& trees, std::uint32_t leaf, std::uint32_t k, const PathVertex& vertex,
                      float defence) {
  const double scattered = static_cast<double>(vertex.scatter_pdf);
  if (k == 0) return scattered;
  const float guided = trees.density(leaf, k - 1, vertex.direction);
  if (guided < 0) return scattered;
  const double share = static_cast<double>(defence);
  return share * scattered + (1 - share) * static_cast<double>(guided);
}

std::uint32_t other_densities(const GuidingTrees& trees, std::span<const PathVertex> vertices, std::uint32_t own,
                              float defence) {
  std::uint32_t others = 0;
  for (const PathVertex& v : vertices) {
    if (!(v.guided > 0)) continue;
    const auto drawn = static_cast<double>(v.pdf);
    const double asked = vertex_density(trees, trees.leaf(v.position), own, v, defence);
    if (!(std::abs(asked - drawn) <= kDensityError * drawn)) ++others;
  }
  return others;
}

void for_each_ratio(const GuidingTrees& trees, std::span<const PathVertex> vertices, std::uint32_t own,
                    std::uint32_t iterations, float defence,
                    const std::function<void(const PathVertex&, std::span<const double>)>& each) {
  std::vector<double> ratios(iterations);
  for (const PathVertex& vertex : vertices) {
    if (vertex.guided > 0) {
      const std::uint32_t leaf = trees.leaf(vertex.position);
      const double own_log = std::log(vertex_density(trees, leaf, own, vertex, defence));
      for (std::uint32_t k = 0; k < iterations; ++k)
        if (k != own) ratios[k] += std::log(vertex_density(trees, leaf, k, vertex, defence)) - own_log;
    }
    if (shared::luminance(vertex.light) > 0) each(vertex, ratios);
  }
}

void IterationPictures::begin(uvec2 size) {
  size_ = size;
  counts_.clear();
  sums_.clear();
}
void IterationPictures::begin_iteration() {
  counts_.push_back(0);
  sums_.emplace_back(std::size_t{size_.x} * size_.y, vec4(0.0f));
}
void IterationPictures::add(std::span<const vec4> frame) {
  counts_.back() += 1;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const vec3 color(frame[i].x, frame[i].y, frame[i].z);
    const float y = shared::luminance(color);
    sums_.back()[i] += vec4(color.x, color.y, color.z, y * y);
  }
}
void IterationPictures::save(Bytes& state) const {
  put_value(state, size_);
  put_array(state, counts_);
  for (const auto& sums : sums_) put_array(state, sums);
}
bool IterationPictures::load(ByteReader& state) {
  begin(uvec2(0));
  IterationPictures read;
  if (!take_value(state, read.size_) || !take_array(state, read.counts_)) return false;
  for (std::size_t i = 0; i < read.counts_.size(); ++i) {
    read.sums_.emplace_back();
    if (!take_array(state, read.sums_.back()) || read.sums_.back().size() != std::size_t{read.size_.x} * read.size_.y)
      return false;
  }
  *this = std::move(read);
  return true;
}
double IterationPictures::samples() const { return std::accumulate(counts_.begin(), counts_.end(), 0.0); }

std::vector<vec4> IterationPictures::mean(
    const std::function<double(std::size_t iteration, std::size_t pixel)>& share) const {
  std::vector<vec4> result(std::size_t{size_.x} * size_.y, vec4(0.0f));
  for (std::size_t pixel = 0; pixel < result.size(); ++pixel) {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < counts_.size(); ++k) {
      if (!(counts_[k] > 0)) continue;
      const vec4& s = sums_[k][pixel];
      sum += glm::dvec3(s.x, s.y, s.z) * (share(k, pixel) / counts_[k]);
    }
    result[pixel] = vec4(vec3(sum), 0.0f);
  }
  return result;
}

double IterationPictures::second_moment(std::size_t iteration, std::size_t pixel) const {
  const double n = counts_[iteration];
  return n > 0 ? static_cast<double>(sums_[iteration][pixel].w) / n : 0;
}
double IterationPictures::variance(std::size_t iteration, std::size_t pixel) const {
  const double n = counts_[iteration];
  if (n < 2) return -1;
  const vec4& s = sums_[iteration][pixel];
  const double mean = static_cast<double>(shared::luminance(vec3(s.x, s.y, s.z))) / n;
  return std::max(second_moment(iteration, pixel) - mean * mean, 0.0) * n / (n - 1);
}

std::size_t IterationPictures::tile_of(std::size_t pixel) const {
  const std::size_t across = (size_.x + kTile - 1) / kTile;
  return pixel / size_.x / kTile * across + pixel % size_.x / kTile;
}
std::vector<double> IterationPictures::variance_factors() const {
  const std::size_t pixels = std::size_t{size_.x} * size_.y, iterations = counts_.size();
  const std::size_t tiles = pixels == 0 ? 0 : tile_of(pixels - 1) + 1;
  std::vector<double> second(tiles * iterations), variances(tiles * iterations);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (std::size_t k = 0; k < iterations; ++k) {
      const std::size_t at = tile_of(pixel) * iterations + k;
      second[at] += second_moment(k, pixel);
      variances[at] += variance(k, pixel);
    }
  }
  std::vector<double> factors(second.size());
  for (std::size_t at = 0; at < factors.size(); ++at) factors[at] = variance_factor(second[at], variances[at]);
  return factors;
}

std::vector<vec4> IterationPictures::combined(IterationWeights weights) const {
  const std::size_t iterations = counts_.size(), pixels = std::size_t{size_.x} * size_.y;
  const double all = std::max(samples(), 1.0);
  const auto shares_of = [&](const auto& variance_of) {
    std::vector<double> variances(iterations);
    for (std::size_t k = 0; k < iterations; ++k) variances[k] = counts_[k] > 1 ? variance_of(k) / counts_[k] : -1;
    return inverse_variance_shares(variances, counts_);
  };
  switch (weights) {
    case IterationWeights::kLast: {
      std::size_t last = iterations;
      while (last > 0 && !(counts_[last - 1] > 0)) --last;
      return mean([&](std::size_t k, std::size_t) { return k + 1 == last ? 1.0 : 0.0; });
    }
    case IterationWeights::kInverseVariance: {
      const std::vector<double> shares = shares_of([&](std::size_t k) {
        double sum = 0;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) sum += variance(k, pixel);
        return sum / static_cast<double>(pixels);
      });
      return mean([&](std::size_t k, std::size_t) { return shares[k]; });
    }
    case IterationWeights::kPixelInverseVariance: {
      std::vector<double> shares;
      for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (const double share : shares_of([&](std::size_t k) { return variance(k, pixel); })) shares.push_back(share);
      return mean([&](std::size_t k, std::size_t pixel) { return shares[pixel * iterations + k]; });
    }
    default:
      return mean([&](std::size_t k, std::size_t) { return counts_[k] / all; });
  }
}

}  // namespace fb::render
