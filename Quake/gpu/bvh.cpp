// The builder: primitives are partitioned in place, sixteen bins on each axis; a split by the middle of the list takes
// over where bins cannot tell primitives apart or the depth that is left would not do.
#include "gpu/bvh.h"

#include <algorithm>
#include <array>

#include "base/check.h"

namespace fb::gpu {
namespace {

using shared::BvhNode;
constexpr int kBins = 16;

struct Item {
  vec3 min;
  std::uint32_t index;
  vec3 max;
  std::uint32_t pad;
  vec3 center2() const { return min + max; }  // twice the centre
};

float half_area(const Bounds& b) {
  vec3 d = b.max - b.min;
  return b.empty() ? 0.0f : d.x * d.y + d.y * d.z + d.z * d.x;
}

struct Bin {
  Bounds bounds;
  std::uint32_t count = 0;
};

struct Split {
  int axis = -1;
  int bin = 0;  // bins below go left
  float cost = 0;
  std::uint32_t left_count = 0;
};

// Which bin a centre falls into. One function for filling bins and for partitioning: they must agree.
struct Binning {
  vec3 origin, scale;
  explicit Binning(const Bounds& centers) : origin(centers.min) {
    for (int a = 0; a < 3; ++a) {
      float extent = centers.max[a] - centers.min[a];
      scale[a] = extent > 0.0f ? static_cast<float>(kBins) * 0.9999f / extent : 0.0f;
    }
  }
  int bin(const vec3& center2, int axis) const {
    float at = (center2[axis] - origin[axis]) * scale[axis];
    return at > 0.0f ? std::min(static_cast<int>(std::min(at, 1e6f)), kBins - 1) : 0;
  }
};

class Builder {
 public:
  Builder(std::span<const Bounds> primitives, const BvhOptions& options) : options_(options) {
    items_.reserve(primitives.size());
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
      items_.push_back({primitives[i].min, i, primitives[i].max, 0});
      bvh_.bounds.add(primitives[i]);
    }
  }

  Bvh build() {
    auto count = static_cast<std::uint32_t>(items_.size());
    if (count == 0) {
      bvh_.nodes.resize(1);
      set_empty_child(bvh_.nodes[0], 0);
      set_empty_child(bvh_.nodes[0], 1);
      bvh_.depth = 1;
    } else {
      bvh_.nodes.reserve(count);
      bvh_.root = build_range(0, count, bvh_.bounds, 0);
      bvh_.order.resize(count);
      for (std::uint32_t i = 0; i < count; ++i) bvh_.order[i] = items_[i].index;
    }
    list_levels();
    return std::move(bvh_);
  }

 private:
  static std::uint32_t leaf(std::uint32_t first, std::uint32_t count) {
    return shared::kRefLeaf | (count - 1) << shared::kRefCountShift | first;
  }

  // Whether `count` primitives fit below a node with `levels` inner levels left.
  bool fits(std::uint64_t count, std::uint32_t levels) const {
    return levels >= 32 || count <= static_cast<std::uint64_t>(options_.max_leaf) << levels;
  }

  Split best_split(std::uint32_t first, std::uint32_t count, const Binning& binning) const {
    std::array<std::array<Bin, kBins>, 3> bins;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Item& item = items_[i];
      vec3 center = item.center2();
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][static_cast<std::size_t>(binning.bin(center, axis))];
        bin.bounds.min = glm::min(bin.bounds.min, item.min);
        bin.bounds.max = glm::max(bin.bounds.max, item.max);
        ++bin.count;
      }
    }
    Split best;
    best.cost = 1e37f;
    for (int axis = 0; axis < 3; ++axis) {
      if (binning.scale[axis] == 0.0f) continue;
      const auto& row = bins[static_cast<std::size_t>(axis)];
      std::array<float, kBins> right_cost{};
      Bounds box;
      std::uint32_t right = 0;
      for (int i = kBins - 1; i > 0; --i) {
        const Bin& bin = row[static_cast<std::size_t>(i)];
        box.add(bin.bounds);
        right += bin.count;
        right_cost[static_cast<std::size_t>(i)] = half_area(box) * static_cast<float>(right);
      }
      box = Bounds{};
      std::uint32_t left = 0;
      for (int i = 1; i < kBins; ++i) {
        const Bin& bin = row[static_cast<std::size_t>(i - 1)];
        box.add(bin.bounds);
        left += bin.count;
        if (left == 0 || left == count) continue;
        float cost = half_area(box) * static_cast<float>(left) + right_cost[static_cast<std::size_t>(i)];
        if (cost < best.cost) best = {axis, i, cost, left};
      }
    }
    return best;
  }

  // Halves the list at its middle along the widest axis of the centres.
  std::uint32_t split_middle(std::uint32_t first, std::uint32_t count, const Bounds& centers) {
    vec3 extent = centers.max - centers.min;
    int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::uint32_t left = count / 2;
    std::nth_element(items_.begin() + first, items_.begin() + first + left, items_.begin() + first + count,
                     [axis](const Item& a, const Item& b) {
                       float x = a.center2()[axis], y = b.center2()[axis];
                       return x != y ? x < y : a.index < b.index;
                     });
    return left;
  }

  // Builds a subtree over a range of items, which is put into the leaves' order; returns a reference to it.
  std::uint32_t build_range(std::uint32_t first, std::uint32_t count, const Bounds& bounds, std::uint32_t depth) {
    if (count == 1) return leaf(first, 1);
    Bounds centers;
    for (std::uint32_t i = first; i < first + count; ++i) centers.add(items_[i].center2());
    Binning binning(centers);
    Split split = best_split(first, count, binning);
    if (count <= options_.max_leaf) {
      float area = half_area(bounds);
      float leaf_cost = options_.primitive_cost * static_cast<float>(count) * area;
      if (split.axis < 0 || leaf_cost <= area + options_.primitive_cost * split.cost) return leaf(first, count);
    }
    FB_CHECK_LT(depth, options_.max_depth);
    std::uint32_t levels = options_.max_depth - depth - 1;
    std::uint32_t left = 0;
    if (split.axis >= 0 && fits(split.left_count, levels) && fits(count - split.left_count, levels)) {
      auto middle = std::partition(items_.begin() + first, items_.begin() + first + count, [&](const Item& item) {
        return binning.bin(item.center2(), split.axis) < split.bin;
      });
      left = static_cast<std::uint32_t>(middle - items_.begin()) - first;
    } else {
      left = split_middle(first, count, centers);
    }
    Bounds box0, box1;
    for (std::uint32_t i = first; i < first + left; ++i) box0.add(Bounds{items_[i].min, items_[i].max});
    for (std::uint32_t i = first + left; i < first + count; ++i) box1.add(Bounds{items_[i].min, items_[i].max});
    auto at = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes.emplace_back();
    bvh_.depth = std::max(bvh_.depth, depth + 1);
    std::uint32_t child0 = build_range(first, left, box0, depth + 1);
    std::uint32_t child1 = build_range(first + left, count - left, box1, depth + 1);
    bvh_.nodes[at] = {box0.min, child0, box0.max, child1, box1.min, 0, box1.max, 0};
    return at;
  }

  // Breadth first from the root.
  void list_levels() {
    if (bvh_.root < shared::kRefLeaf) bvh_.level_order.push_back(bvh_.root);
    std::size_t first = 0;
    while (first < bvh_.level_order.size()) {
      bvh_.level_first.push_back(static_cast<std::uint32_t>(first));
      const std::size_t end = bvh_.level_order.size();
      for (; first < end; ++first) {
        const BvhNode node = bvh_.nodes[bvh_.level_order[first]];
        if (node.child0 < shared::kRefLeaf) bvh_.level_order.push_back(node.child0);
        if (node.child1 < shared::kRefLeaf) bvh_.level_order.push_back(node.child1);
      }
    }
    bvh_.level_first.push_back(static_cast<std::uint32_t>(first));
  }

  BvhOptions options_;
  std::vector<Item> items_;
  Bvh bvh_;
};

}  // namespace

Bvh build_bvh(std::span<const Bounds> primitives, const BvhOptions& options) {
  FB_CHECK(options.max_leaf >= 1 && options.max_leaf <= shared::kMaxLeafTriangles);
  FB_CHECK_LT(primitives.size(), std::size_t{shared::kRefFirstMask});
  return Builder(primitives, options).build();
}

double bvh_cost(const Bvh& bvh, float primitive_cost) {
  double area = half_area(bvh.bounds);
  if (bvh.root >= shared::kRefLeaf || !(area > 0)) return primitive_cost * static_cast<double>(bvh.order.size());
  auto child_cost = [&](std::uint32_t ref, const Bounds& box) {
    double visits = half_area(box) / area;
    if (ref < shared::kRefLeaf) return visits;
    return visits * primitive_cost * ((ref >> shared::kRefCountShift & shared::kRefCountMask) + 1);
  };
  double cost = 1;
  for (const BvhNode& node : bvh.nodes) {
    cost += child_cost(node.child0, {node.min0, node.max0}) + child_cost(node.child1, {node.min1, node.max1});
  }
  return cost;
}

void set_empty_child(BvhNode& node, int child) {
  // A point beyond every ray's end. (Inverted boxes would not do: slab tests sort the planes.)
  (child == 0 ? node.min0 : node.min1) = vec3(1e30f);
  (child == 0 ? node.max0 : node.max1) = vec3(1e30f);
  (child == 0 ? node.child0 : node.child1) = shared::kRefLeaf;
}

}  // namespace fb::gpu
