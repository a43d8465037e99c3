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

float PathStore::add(std::uint32_t pixel, std::uint32_t iteration, std::uint32_t frame, const StoredPath& path) {
  std::uint32_t count = 0;
  float importance = 0;
  const auto brings = [&](const vec3& radiance, std::uint32_t vertex) {
    const float light = shared::luminance(radiance);
    if (!(light > 0)) return false;
    importance += light;
    count = std::max(count, vertex + 1);
    return true;
  };
  for (std::uint32_t k = 0; k < path.vertices.size(); ++k) brings(path.vertices[k].light, k);
  const auto first_looked = static_cast<std::uint32_t>(looked_.size());
  for (const LookedFor& found : path.looked)
    if (brings(found.light, found.vertex)) looked_.push_back(found);
  if (count == 0) return 0;
  paths_.push_back({pixel, iteration, frame, static_cast<std::uint32_t>(vertices_.size()), count, first_looked,
                    static_cast<std::uint32_t>(looked_.size()) - first_looked, importance});
  vertices_.insert(vertices_.end(), path.vertices.begin(), path.vertices.begin() + count);
  return importance;
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
    used += sizeof(Path) + paths_[i].count * sizeof(PathVertex) + paths_[i].looked * sizeof(LookedFor);
    if (used > bytes) break;
    kept[i] = true;
  }
  PathStore rest;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (!kept[i]) {
      gone(paths_[i]);
      continue;
    }
    const StoredPath of = stored(paths_[i]);
    rest.paths_.push_back(paths_[i]);
    rest.paths_.back().first = static_cast<std::uint32_t>(rest.vertices_.size());
    rest.paths_.back().first_looked = static_cast<std::uint32_t>(rest.looked_.size());
    rest.vertices_.insert(rest.vertices_.end(), of.vertices.begin(), of.vertices.end());
    rest.looked_.insert(rest.looked_.end(), of.looked.begin(), of.looked.end());
  }
  *this = std::move(rest);
}

void PathStore::save(Bytes& state) const {
  put_array(state, paths_);
  put_array(state, vertices_);
  put_array(state, looked_);
}
bool PathStore::load(ByteReader& state, std::size_t pixels, std::size_t iterations, std::size_t frames) {
  clear();
  PathStore read;
  if (!take_array(state, read.paths_) || !take_array(state, read.vertices_) || !take_array(state, read.looked_))
    return false;
  const auto lies_in = [](std::uint32_t first, std::uint32_t count, std::size_t all) {
    return count <= all && first <= all - count;
  };
  for (const Path& path : read.paths_) {
    if (path.pixel >= pixels || path.iteration >= iterations || path.frame >= frames ||
        !lies_in(path.first, path.count, read.vertices_.size()) ||
        !lies_in(path.first_looked, path.looked, read.looked_.size()))
      return false;
    for (const LookedFor& found : read.stored(path).looked)
      if (found.vertex >= path.count) return false;
  }
  *this = std::move(read);
  return true;
}

double direction_density(const GuidingTrees& trees, std::uint32_t leaf, std::uint32_t k, const vec3& direction,
                         float scatter_pdf, float defence) {
  const double scattered = static_cast<double>(scatter_pdf);
  const float guided = trees.density_in(leaf, k, direction);
  if (guided < 0) return scattered;
  const double share = static_cast<double>(defence);
  return share * scattered + (1 - share) * static_cast<double>(guided);
}

std::uint32_t other_densities(const GuidingTrees& trees, std::span<const PathVertex> vertices, std::uint32_t own,
                              float defence) {
  std::uint32_t others = 0;
  for (const PathVertex& v : vertices) {
    if (!(v.guided > 0) || !(v.pdf > 0)) continue;  // no direction was of use
    const auto drawn = static_cast<double>(v.pdf);
    const double asked = direction_density(trees, trees.leaf(v.position), own, v.direction, v.scatter_pdf, defence);
    if (!(std::abs(asked - drawn) <= kDensityError * drawn)) ++others;
  }
  return others;
}

namespace {

// Along a path: `end` with all light that it met or found, and `on` with each direction that it went on in, with the
// ratios of the densities of that vertex's direction alone: of one that light was looked for in, that of both ends.
template <typename End, typename On>
void walk_path(const GuidingTrees& trees, const StoredPath& path, std::uint32_t own, std::uint32_t iterations,
               float defence, const End& end, const On& on) {
  std::vector<double> densities(iterations), ratios(iterations);
  auto looked = path.looked.begin();
  for (std::uint32_t i = 0; i < path.vertices.size(); ++i) {
    const PathVertex& vertex = path.vertices[i];
    const bool guided = vertex.guided > 0;
    const std::uint32_t leaf = guided ? trees.leaf(vertex.position) : 0;
    const auto ask = [&](const vec3& direction, float scatter_pdf) {
      for (std::uint32_t k = 0; guided && k < iterations; ++k)
        densities[k] = direction_density(trees, leaf, k, direction, scatter_pdf, defence);
    };
    // Where no distribution has a share, all iterations go on alike.
    const auto ratios_with = [&](float looked_for) -> const std::vector<double>& {
      for (std::uint32_t k = 0; guided && k < iterations; ++k)
        ratios[k] = k == own ? 0 : end_log_ratio(densities[k], densities[own], static_cast<double>(looked_for));
      return ratios;
    };
    std::ranges::fill(ratios, 0.0);
    for (; looked != path.looked.end() && looked->vertex == i; ++looked) {
      ask(looked->direction, looked->scatter_pdf);
      end(looked->light, ratios_with(looked->density));
    }
    if (!(vertex.pdf > 0)) return;  // no direction was of use
    ask(vertex.direction, vertex.scatter_pdf);
    if (shared::luminance(vertex.light) > 0) end(vertex.light, ratios_with(vertex.met_density));
    on(ratios_with(0));
  }
}

}  // namespace

void for_each_ratio(const GuidingTrees& trees, const StoredPath& path, std::uint32_t own, std::uint32_t iterations,
                    float defence, const std::function<void(const vec3& light, std::span<const double>)>& each) {
  std::vector<double> to_vertex(iterations), to_light(iterations);
  walk_path(
      trees, path, own, iterations, defence,
      [&](const vec3& light, const std::vector<double>& ratios) {
        for (std::uint32_t k = 0; k < iterations; ++k) to_light[k] = to_vertex[k] + ratios[k];
        each(light, to_light);
      },
      [&](const std::vector<double>& ratios) {
        for (std::uint32_t k = 0; k < iterations; ++k) to_vertex[k] += ratios[k];
      });
}

void for_each_vertex_factor(const GuidingTrees& trees, const StoredPath& path, std::uint32_t own,
                            std::span<const double> counts, float defence,
                            const std::function<void(const vec3& light, double factor)>& each) {
  const double samples = std::accumulate(counts.begin(), counts.end(), 0.0);
  double to_vertex = 1 / samples;
  walk_path(
      trees, path, own, static_cast<std::uint32_t>(counts.size()), defence,
      [&](const vec3& light, const std::vector<double>& ratios) {
        each(light, to_vertex * samples * balance_factor(ratios, counts));
      },
      [&](const std::vector<double>& ratios) { to_vertex *= samples * balance_factor(ratios, counts); });
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
double IterationPictures::light() const {
  double sum = 0;
  for (const auto& sums : sums_)
    for (const vec4& s : sums) sum += static_cast<double>(shared::luminance(vec3(s.x, s.y, s.z)));
  return sum;
}

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
