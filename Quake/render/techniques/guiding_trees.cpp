#include "render/techniques/guiding_trees.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/rng.h"
#include "render/techniques/iteration_state.h"

namespace fb::render {
namespace {

constexpr float kLeastWidth = 1.0f / (1u << GuidingTrees::kMostHalvings);  // of a leaf, in the cube
constexpr float kMargin = 1.0f / 1024;                                     // about the first vertices
constexpr float kLargestWeight = 1e30f;

// A square, in units of a node.
struct Square {
  vec2 low, high;
};
void spread(std::vector<DirectionalTree::Node>& nodes, std::uint32_t at, const Square& square, float per_area) {
  for (std::uint32_t q = 0; q < 4; ++q) {
    const vec2 corner(q & 1u ? 0.5f : 0.0f, q & 2u ? 0.5f : 0.0f);
    const Square part{glm::clamp((square.low - corner) * 2.0f, vec2(0.0f), vec2(1.0f)),
                      glm::clamp((square.high - corner) * 2.0f, vec2(0.0f), vec2(1.0f))};
    const float area = (part.high.x - part.low.x) * (part.high.y - part.low.y);
    if (!(area > 0)) continue;
    nodes[at].weight[q] += 0.25f * area * per_area;
    if (nodes[at].child[q] != 0) spread(nodes, nodes[at].child[q], part, 0.25f * per_area);
  }
}

void refine(const std::vector<DirectionalTree::Node>& from, std::uint32_t at, float share, float least,
            std::vector<DirectionalTree::Node>& to, std::uint32_t into, std::uint32_t depth) {
  for (std::uint32_t q = 0; q < 4; ++q) {
    // `at` none: what is here has been halved into quarters.
    const float weight = at == shared::kUntaught ? 0.25f * share : from[at].weight[q];
    if (!(weight > least) || depth + 1 >= GuidingTrees::kMostNodeLevels || to.size() >= shared::kMostGuidingNodes)
      continue;
    const auto child = static_cast<std::uint32_t>(to.size());
    to[into].child[q] = child;
    to.emplace_back();
    const std::uint32_t below =
        at != shared::kUntaught && from[at].child[q] != 0 ? from[at].child[q] : shared::kUntaught;
    refine(from, below, weight, least, to, child, depth + 1);
  }
}

}  // namespace

void DirectionalTree::deposit(vec2 place, float weight, bool filtered) {
  if (!(weight > 0)) return;
  weight = std::min(weight, kLargestWeight);
  vec2 p = place;
  float width = 0.5f;
  std::uint32_t at = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> way;
  while (true) {
    const std::uint32_t x = p.x >= 0.5f ? 1 : 0, y = p.y >= 0.5f ? 1 : 0, q = x + 2 * y;
    way.emplace_back(at, q);
    if (nodes_[at].child[q] == 0) break;
    at = nodes_[at].child[q];
    p = 2.0f * p - vec2(static_cast<float>(x), static_cast<float>(y));
    width *= 0.5f;
  }
  if (!filtered) {
    for (const auto& [node, q] : way) nodes_[node].weight[q] += weight;
    return;
  }
  const vec2 middle = glm::clamp(place, vec2(0.5f * width), vec2(1 - 0.5f * width));
  spread(nodes_, 0, {middle - vec2(0.5f * width), middle + vec2(0.5f * width)}, weight / (width * width));
}

float DirectionalTree::total() const {
  const auto& w = nodes_.front().weight;
  return w[0] + w[1] + w[2] + w[3];
}

DirectionalTree DirectionalTree::refined(float most_share) const {
  DirectionalTree result;
  const float sum = total();
  if (sum > 0) {
    refine(nodes_, 0, sum, most_share * sum, result.nodes_, 0, 0);
  } else {
    result.nodes_ = nodes_;
    for (Node& node : result.nodes_) node.weight = {};
  }
  return result;
}

bool DirectionalTree::set_nodes(std::vector<Node> nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::uint32_t child : nodes[i].child)
      if (child != 0 && (child <= i || child >= nodes.size())) return false;
  if (nodes.empty()) return false;
  nodes_ = std::move(nodes);
  return true;
}

std::uint32_t DirectionalTree::levels() const {
  std::vector<std::uint32_t> level(nodes_.size(), 1);  // children stand behind their node
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (const std::uint32_t child : nodes_[i].child)
      if (child != 0) level[child] = level[i] + 1;
  return *std::ranges::max_element(level);
}

std::vector<shared::uvec4> DirectionalTree::packed() const {
  std::vector<shared::uvec4> result;
  for (const Node& node : nodes_) {
    const double sum = static_cast<double>(node.weight[0]) + node.weight[1] + node.weight[2] + node.weight[3];
    double until = 0;
    std::uint32_t before = 0;
    shared::uvec4 words(0);
    for (int q = 0; q < 4; ++q) {
      until += static_cast<double>(node.weight[static_cast<std::size_t>(q)]);
      // Nothing was found below: even, though nothing is drawn there.
      const double share = sum > 0 ? until / sum : 0.25 * (q + 1);
      const auto parts = static_cast<std::uint32_t>(std::lround(share * 65535.0));
      words[q] = (parts - before) << 16u | node.child[static_cast<std::size_t>(q)];
      before = parts;
    }
    result.push_back(words);
  }
  return result;
}

void GuidingTrees::split(std::span<const GuidingSample> samples, float most) {
  std::vector<std::uint32_t> counts(history_.size()), leaf_of(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) ++counts[leaf_of[i] = leaf(samples[i].position)];
  // A level at a time: leaves with too many vertices, each once.
  bool any = true;
  while (any) {
    any = false;
    const std::size_t nodes = places_.size();
    std::vector<bool> halved(history_.size());
    for (std::size_t at = 0; at < nodes; ++at) {
      if ((places_[at] & shared::kGuidingLeaf) == 0) continue;
      const std::uint32_t one = places_[at] & ~shared::kGuidingLeaf;
      if (!(static_cast<float>(counts[one]) > most)) continue;
      // Levels take x, y and z in turns: it is the first axis of the largest width.
      vec3& width = widths_[one];
      const int axis = width.x >= width.z ? (width.x >= width.y ? 0 : 1) : (width.y >= width.z ? 1 : 2);
      if (width[axis] <= kLeastWidth) continue;
      const auto other = static_cast<std::uint32_t>(history_.size());
      width[axis] *= 0.5f;
      const vec3 new_width = width;
      const float part = new_width.x * new_width.y * new_width.z;  // of the cube, a power of two
      levels_ = std::max(levels_, static_cast<std::uint32_t>(std::lround(-std::log2(part))));
      vec3 low = lows_[one];
      low[axis] += new_width[axis];
      widths_.push_back(new_width);
      lows_.push_back(low);
      recorded_.push_back(DirectionalTree(recorded_[one]));
      history_.push_back(std::vector<std::uint32_t>(history_[one]));
      counts.push_back(0);
      places_[at] = static_cast<std::uint32_t>(places_.size());
      places_.push_back(one | shared::kGuidingLeaf);
      places_.push_back(other | shared::kGuidingLeaf);
      counts[one] = 0;
      halved[one] = any = true;
    }
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (halved[leaf_of[i]]) ++counts[leaf_of[i] = leaf(samples[i].position)];
  }
}

void GuidingTrees::learn(std::span<const GuidingSample> samples, float samples_per_pixel, const GuidingOptions& options,
                         std::uint64_t seed) {
  if (places_.empty()) {
    Bounds bounds;
    for (const GuidingSample& s : samples) bounds.add(s.position);
    if (bounds.empty()) bounds.add(vec3(0.0f));
    const vec3 size = bounds.max - bounds.min;
    const float width = std::max({size.x, size.y, size.z, 1e-3f}) * (1 + 2 * kMargin);
    cube_ = {0.5f * (bounds.min + bounds.max) - vec3(0.5f * width), 1 / width};
    places_ = {shared::kGuidingLeaf};
    lows_ = {vec3(0.0f)};
    widths_ = {vec3(1.0f)};
    recorded_.resize(1);
    history_.resize(1);
  }
  split(samples, options.split * std::sqrt(std::max(samples_per_pixel, 1.0f)));

  // Each leaf's samples in their order, so that sums do not depend on how many threads there are.
  Rng rng(seed);
  std::vector<std::vector<std::pair<vec2, float>>> sorted(history_.size());
  for (const GuidingSample& s : samples) {
    vec3 position = s.position;
    if (options.filtered) {
      const vec3 jitter{rng.uniform(-0.5f, 0.5f), rng.uniform(-0.5f, 0.5f), rng.uniform(-0.5f, 0.5f)};  // in this order
      position += jitter * widths_[leaf(position)] / cube_.inverse_width;
    }
    if (s.weight > 0) sorted[leaf(position)].emplace_back(shared::guiding_place(s.direction), s.weight);
  }
  node_levels_ = 1;
  for (const DirectionalTree& tree : recorded_) node_levels_ = std::max(node_levels_, tree.levels());
  std::vector<std::vector<shared::uvec4>> packed(history_.size());
  parallel_for(history_.size(), 8, [&](std::size_t i) {
    DirectionalTree& tree = recorded_[i];
    for (const auto& [place, weight] : sorted[i]) tree.deposit(place, weight, options.filtered);
    if (tree.total() > 0) packed[i] = tree.packed();
    tree = tree.refined(options.most_share);
  });
  firsts_.clear();
  nodes_.clear();
  for (std::size_t i = 0; i < packed.size(); ++i) {
    firsts_.push_back(packed[i].empty() ? shared::kUntaught : static_cast<std::uint32_t>(nodes_.size()));
    history_[i].push_back(packed[i].empty() ? shared::kUntaught
                                            : static_cast<std::uint32_t>(kept_.size() + nodes_.size()));
    nodes_.insert(nodes_.end(), packed[i].begin(), packed[i].end());
  }
  kept_.insert(kept_.end(), nodes_.begin(), nodes_.end());
  ++iterations_;
}

void GuidingTrees::keep_last() {
  if (iterations_ == 0) return;
  for (std::size_t i = 0; i < history_.size(); ++i) history_[i] = {firsts_[i]};
  kept_ = nodes_;
  iterations_ = kept_count_ = 1;
}

std::uint64_t GuidingTrees::bytes() const {
  std::uint64_t words = places_.size() + 4 * std::uint64_t{kept_.size()};
  for (const auto& leaf : history_) words += leaf.size();
  return 4 * words;
}

void GuidingTrees::save(Bytes& state) const {
  for (const std::uint32_t number : {iterations_, kept_count_, levels_, node_levels_}) put_value(state, number);
  put_value(state, cube_);
  put_array(state, places_);
  put_array(state, lows_);
  put_array(state, widths_);
  for (const DirectionalTree& tree : recorded_) put_array(state, tree.nodes());
  for (const auto& leaf : history_) put_array(state, leaf);
  put_array(state, kept_);
  put_value(state, std::uint64_t{nodes_.size()});
}

bool GuidingTrees::load(ByteReader& state) {
  clear();
  GuidingTrees read;
  std::uint64_t last = 0;
  bool whole = take_value(state, read.iterations_) && take_value(state, read.kept_count_) && read.kept_count_ <= 1 &&
               take_value(state, read.levels_) && take_value(state, read.node_levels_) &&
               take_value(state, read.cube_) && take_array(state, read.places_) && take_array(state, read.lows_) &&
               take_array(state, read.widths_) && read.widths_.size() == read.lows_.size();
  read.recorded_.resize(whole ? read.lows_.size() : 0);
  read.history_.resize(read.recorded_.size());
  for (DirectionalTree& tree : read.recorded_) {
    std::vector<DirectionalTree::Node> nodes;
    whole = whole && take_array(state, nodes) && tree.set_nodes(std::move(nodes));
  }
  for (auto& leaf : read.history_) whole = whole && take_array(state, leaf) && leaf.size() == read.iterations_;
  whole = whole && take_array(state, read.kept_) && take_value(state, last) && last <= read.kept_.size() &&
          read.iterations_ > 0 && read.leads_somewhere();
  if (!whole) return false;
  const auto before = static_cast<std::uint32_t>(read.kept_.size() - last);
  read.nodes_.assign(read.kept_.begin() + before, read.kept_.end());
  for (const auto& leaf : read.history_) {
    if (leaf.back() != shared::kUntaught && leaf.back() < before) return false;
    read.firsts_.push_back(leaf.back() == shared::kUntaught ? leaf.back() : leaf.back() - before);
  }
  *this = std::move(read);
  return true;
}

// Walks end at leaves within their rounds, and at nodes that are there.
bool GuidingTrees::leads_somewhere() const {
  if (places_.empty() || levels_ > 3 * kMostHalvings || node_levels_ > kMostNodeLevels) return false;
  std::vector<std::uint32_t> depth(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (depth[i] > levels_) return false;
    if ((places_[i] & shared::kGuidingLeaf) != 0) {
      if ((places_[i] & ~shared::kGuidingLeaf) >= history_.size()) return false;
      continue;
    }
    if (places_[i] <= i || places_[i] + std::size_t{1} >= places_.size()) return false;
    for (const std::size_t half : {std::size_t{places_[i]}, std::size_t{places_[i]} + 1}) depth[half] = depth[i] + 1;
  }
  for (const auto& leaf : history_) {
    for (const std::uint32_t first : leaf) {
      if (first == shared::kUntaught) continue;
      std::size_t most = 0;  // of the tree's nodes, each behind its parent
      for (std::size_t at = 0; at <= most; ++at) {
        if (first + at >= kept_.size()) return false;
        for (int q = 0; q < 4; ++q) {
          const std::uint32_t child = kept_[first + at][q] & 0xffffu;
          if (child != 0 && child <= at) return false;
          most = std::max<std::size_t>(most, child);
        }
      }
    }
  }
  return true;
}

}  // namespace fb::render
