#include "render/scene/gpu_scene_assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <queue>
#include <string>
#include <utility>

#include "base/check.h"
#include "base/log.h"
#include "base/out_of_memory.h"
#include "gpu/bvh.h"
#include "scene/snapshot.h"
#include "shared/packing.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr float kTriangleCost = 1.0f;
constexpr std::size_t kTexelChunk = 2u << 20;  // words that are uploaded at a time
constexpr std::uint32_t kLargeMesh = 1000;     // triangles
constexpr std::uint32_t kPosesForShape = 16;   // poses that a posed mesh's tree is built for
constexpr double kFlatTriangle = 1e-6;         // area over squared longest edge below which nothing is hit

float linear_from_srgb(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

std::uint32_t words_of(const scene::Image& image) {
  std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return static_cast<std::uint32_t>((texels * texel_bytes(image.encoding) + 3) / 4);
}

// Whether the image holds as many texels as it says, and more than none.
bool is_whole(const scene::Image& image) {
  if (image.width <= 0 || image.height <= 0 || image.width > 0xffff || image.height > 0xffff) return false;
  const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return image.texels.size() >= texel_bytes(image.encoding) * texels;
}

bool is_flat(const vec3& e1, const vec3& e2) {
  vec3 e3 = e2 - e1;
  double longest = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3)});
  return !(glm::length(glm::cross(e1, e2)) > kFlatTriangle * longest);
}

vec3 pose_position(const scene::Mesh& mesh, std::uint32_t pose, std::uint32_t vertex) {
  return scene::pose_numbers(mesh.poses[std::size_t{pose} * mesh.vertex_count + vertex]) * mesh.pose_scale +
         mesh.pose_origin;
}

// Positions that a mesh's tree is built over: its own, or the mean over poses, whose neighbourhoods are all poses'.
std::vector<vec3> shape_of(const scene::Mesh& mesh) {
  if (!mesh.posed()) return mesh.positions;
  std::uint32_t step = (mesh.pose_count + kPosesForShape - 1) / kPosesForShape, count = 0;
  std::vector<vec3> mean(mesh.vertex_count, vec3(0.0f));
  for (std::uint32_t pose = 0; pose < mesh.pose_count; pose += step, ++count) {
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) mean[v] += pose_position(mesh, pose, v);
  }
  for (vec3& v : mean) v /= static_cast<float>(count);
  return mean;
}

std::uint32_t rebased(std::uint32_t ref, std::uint32_t first_node, std::uint32_t first_triangle) {
  return ref < shared::kRefLeaf ? ref + first_node : ref + first_triangle;
}

// Takes a tree apart, the largest box first, into at most kSubtrees parts that together are the tree.
std::vector<SubtreeRef> take_apart(const gpu::Bvh& bvh) {
  auto area = [](const SubtreeRef& s) {
    vec3 d = s.bounds.max - s.bounds.min;
    return d.x * d.y + d.y * d.z + d.z * d.x;
  };
  auto smaller = [&](const SubtreeRef& a, const SubtreeRef& b) {
    float x = a.ref < shared::kRefLeaf ? area(a) : -1.0f, y = b.ref < shared::kRefLeaf ? area(b) : -1.0f;
    return x != y ? x < y : a.ref < b.ref;
  };
  std::vector<SubtreeRef> heap{{bvh.root, bvh.bounds}};
  while (heap.size() < kSubtrees && heap.front().ref < shared::kRefLeaf) {
    std::pop_heap(heap.begin(), heap.end(), smaller);
    const shared::BvhNode& node = bvh.nodes[heap.back().ref];
    heap.pop_back();
    heap.push_back({node.child0, {node.min0, node.max0}});
    std::push_heap(heap.begin(), heap.end(), smaller);
    heap.push_back({node.child1, {node.min1, node.max1}});
    std::push_heap(heap.begin(), heap.end(), smaller);
  }
  return heap;
}

// What meshes may take of an array in which a frame's copies stand, too.
template <typename T>
std::uint64_t most_kept(const DeviceArray<T>& array) {
  return array.most() - array.most() / kCopiesPart;
}

template <typename T>
void append_to(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

struct SceneAssets::Batch {
  // Where the batch will stand in the device's arrays.
  std::uint32_t first_node, first_triangle, first_attribute, first_pose, first_normal, first_level, first_vertex;
  std::vector<shared::BvhNode> nodes;
  std::vector<shared::GpuTriangle> triangles;
  std::vector<shared::GpuAttribute> attributes;
  std::vector<scene::PoseVertex> poses;
  std::vector<std::uint32_t> normals, levels;
  std::vector<vec3> vertices;
  std::vector<std::string> cut;  // names of meshes for which there was not enough room
};

SceneAssets::SceneAssets(gpu::Device& device, bool ray_query)
    : device_(device),
      ray_query_(ray_query),
      nodes_(device, gpu::BufferUse::kStorage, "nodes"),
      triangles_(device, gpu::BufferUse::kStorage, "triangles"),
      vertices_(device, ray_query ? gpu::BufferUse::kGeometry : gpu::BufferUse::kStorage, "vertices"),
      attributes_(device, gpu::BufferUse::kStorage, "attributes"),
      poses_(device, gpu::BufferUse::kStorage, "poses"),
      normals_(device, gpu::BufferUse::kStorage, "normals"),
      levels_(device, gpu::BufferUse::kStorage, "levels"),
      images_(device, gpu::BufferUse::kStorage, "images"),
      texels_(device, gpu::BufferUse::kStorage, "texels"),
      palette_(device, gpu::BufferUse::kStorage, "palette") {
  clear();
}

void SceneAssets::clear() {
  meshes_.clear();
  images_added_ = 0;
  largest_mesh_ = 0;
  nodes_.clear();
  triangles_.clear();
  vertices_.clear();
  attributes_.clear();
  poses_.clear();
  normals_.clear();
  levels_.clear();
  images_.clear();
  texels_.clear();
  palette_.clear();
  // Node 0 is the root of the tree over instances, written each frame.
  shared::BvhNode root{};
  gpu::set_empty_child(root, 0);
  gpu::set_empty_child(root, 1);
  nodes_.append(std::span<const shared::BvhNode>(&root, 1));
}

void SceneAssets::update(const scene::Assets& assets) {
  // None until all is there: what ends this early is done anew.
  if (assets.generation != std::exchange(generation_, 0)) clear();
  if (palette_.kept() == 0) {
    std::array<vec4, shared::kPaletteSrgb + 256> colors;
    const auto linear = [&](std::size_t byte) -> vec4& { return colors[shared::kPaletteSrgb + byte]; };
    for (std::size_t i = 0; i < 256; ++i) linear(i) = vec4(vec3(linear_from_srgb(static_cast<float>(i) / 255.0f)), 1);
    for (std::size_t i = 0; i < 256; ++i) {
      const auto& c = assets.palette.rgb[i];
      colors[i] = vec4(linear(c[0]).x, linear(c[1]).x, linear(c[2]).x, 1);
    }
    palette_.append(std::span<const vec4>(colors));
  }
  if (images_added_ < assets.images.size()) add_images(assets);
  if (meshes_.size() < assets.meshes.size()) add_meshes(assets);
  generation_ = assets.generation;
}

void SceneAssets::add_images(const scene::Assets& assets) {
  const std::uint64_t limit = texels_.most();
  std::uint64_t total = texels_.kept();
  for (std::size_t i = images_added_; i < assets.images.size(); ++i) total += words_of(assets.images[i]);
  texels_.reserve(std::min(total, limit));

  std::vector<shared::GpuImage> headers;
  std::vector<std::uint32_t> words;
  std::size_t refused = 0;
  for (; images_added_ < assets.images.size(); ++images_added_) {
    const scene::Image& image = assets.images[images_added_];
    std::uint64_t first = texels_.kept() + words.size();
    const std::size_t texel = texel_bytes(image.encoding);
    shared::GpuImage header{};
    header.encoding = static_cast<std::uint32_t>(image.encoding);
    header.first = static_cast<std::uint32_t>(first * 4 / texel);
    if (is_whole(image) && first + words_of(image) <= limit) {
      header.size = static_cast<std::uint32_t>(image.width) | static_cast<std::uint32_t>(image.height) << 16u;
      words.resize(words.size() + words_of(image));
      std::size_t bytes = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * texel;
      std::memcpy(words.data() + (first - texels_.kept()), image.texels.data(), bytes);
    } else {
      // One texel in its place, its first, or where there is no room for that either, the first of all.
      header.size = 1u | 1u << 16u;
      if (first < limit) {
        std::uint32_t word = 0;
        std::memcpy(&word, image.texels.data(), std::min<std::size_t>(image.texels.size(), 4));
        words.push_back(word);
      } else {
        header.first = 0;
      }
      ++refused;
    }
    headers.push_back(header);
    if (words.size() >= kTexelChunk) {
      texels_.append(std::span<const std::uint32_t>(words));
      words.clear();
    }
  }
  texels_.append(std::span<const std::uint32_t>(words));
  images_.append(std::span<const shared::GpuImage>(headers));
  if (refused > 0) {
    log_warning(
        "{} images are shown as one texel: they are incomplete, or more than the device's largest buffer of {} MiB "
        "holds",
        refused, limit >> 18u);
  }
}

void SceneAssets::add_meshes(const scene::Assets& assets) {
  Batch batch;
  batch.first_node = nodes_.kept();
  batch.first_triangle = triangles_.kept();
  batch.first_attribute = attributes_.kept();
  batch.first_pose = poses_.kept();
  batch.first_normal = normals_.kept();
  batch.first_level = levels_.kept();
  batch.first_vertex = vertices_.kept();
  while (meshes_.size() < assets.meshes.size()) {
    meshes_.push_back(add_mesh(assets, assets.meshes[meshes_.size()], batch));
    largest_mesh_ = std::max(largest_mesh_, meshes_.back().triangle_count);
  }
  nodes_.append(std::span<const shared::BvhNode>(batch.nodes));
  triangles_.append(std::span<const shared::GpuTriangle>(batch.triangles));
  attributes_.append(std::span<const shared::GpuAttribute>(batch.attributes));
  poses_.append(std::span<const scene::PoseVertex>(batch.poses));
  normals_.append(std::span<const std::uint32_t>(batch.normals));
  levels_.append(std::span<const std::uint32_t>(batch.levels));
  if (ray_query_) vertices_.append(std::span<const vec3>(batch.vertices));
  tell_of_cut(batch);
}

void SceneAssets::tell_of_cut(const Batch& batch) const {
  if (batch.cut.empty()) return;
  const std::string others = batch.cut.size() == 1 ? "" : fmt::format(" and {} more", batch.cut.size() - 1);
  log_warning("{}{}: not drawn whole; the level has more than {} allows, buffers of {}", batch.cut.front(), others,
              device_.report().name, memory_text(gpu::largest_buffer(device_, gpu::BufferUse::kStorage)));
}

// By the arrays that hold an item a triangle.
std::size_t SceneAssets::triangles_that_fit(const Batch& batch, bool posed) const {
  const auto left = [](std::uint64_t most, std::uint64_t taken) { return most - std::min(most, taken); };
  std::uint64_t count = left(attributes_.most(), batch.first_attribute + batch.attributes.size());
  if (posed) return count;
  count = std::min(count, left(most_kept(triangles_), batch.first_triangle + batch.triangles.size()));
  if (ray_query_) count = std::min(count, left(most_kept(vertices_), batch.first_vertex + batch.vertices.size()) / 3);
  return count;
}

MeshRecord SceneAssets::add_mesh(const scene::Assets& assets, const scene::Mesh& mesh, Batch& batch) const {
  MeshRecord record;
  record.posed = mesh.posed();
  const std::vector<vec3> shape = shape_of(mesh);
  std::vector<Bounds> boxes;
  std::vector<std::uint32_t> used;  // triangles whose vertices exist
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& v = mesh.triangles[i].vertices;
    if (std::max({v[0], v[1], v[2]}) >= shape.size()) continue;
    Bounds box;
    for (std::uint32_t vertex : v) box.add(shape[vertex]);
    boxes.push_back(box);
    used.push_back(i);
  }
  FB_CHECK(!mesh.posed() || mesh.poses.size() >= std::size_t{mesh.pose_count} * mesh.vertex_count);
  // Where there is no room a rigid mesh loses its last triangles, a posed one its last poses.
  bool cut = false;
  const auto keep = [&](std::size_t triangles) {
    if (used.size() <= triangles) return;
    cut = true;
    used.resize(mesh.posed() ? 0 : triangles);
    boxes.resize(used.size());
  };
  keep(triangles_that_fit(batch, mesh.posed()));
  std::uint32_t poses = mesh.pose_count;
  if (mesh.posed()) {
    const std::uint64_t most = poses_.most(), taken = batch.first_pose + batch.poses.size();
    const std::uint64_t fitting = (most - std::min(most, taken)) / std::max(mesh.vertex_count, 1u);
    if (fitting < poses) {
      cut = true;
      poses = static_cast<std::uint32_t>(fitting);
      if (poses == 0) keep(0);
    }
  }
  constexpr gpu::BvhOptions kTree{.max_leaf = kLeafTriangles, .primitive_cost = kTriangleCost};
  gpu::Bvh bvh = used.empty() ? gpu::Bvh{} : gpu::build_bvh(boxes, kTree);
  if (!ray_query_) {
    const std::uint64_t most = most_kept(nodes_), taken = batch.first_node + batch.nodes.size();
    const std::uint64_t nodes = most - std::min(most, taken);
    if (bvh.nodes.size() > nodes) {
      keep(nodes + 1);  // a binary tree has fewer nodes than leaves
      if (!used.empty()) bvh = gpu::build_bvh(boxes, kTree);
    }
  }
  if (cut) batch.cut.push_back(mesh.name);
  if (used.empty()) return record;
  record.triangle_count = static_cast<std::uint32_t>(used.size());
  record.first_attribute = batch.first_attribute + static_cast<std::uint32_t>(batch.attributes.size());
  const bool smooth = mesh.posed() || mesh.normals.size() >= shape.size();

  for (std::uint32_t at : bvh.order) {
    const scene::MeshTriangle& t = mesh.triangles[used[at]];
    std::uint32_t flags = smooth ? shared::kTriangleSmooth : 0u;
    // Right if the instance's material base is 0; other instances say for themselves that they must be asked.
    if (t.material < assets.materials.size()) {
      const scene::Material& m = assets.materials[t.material];
      if ((m.flags & scene::kMaterialAlphaTest) != 0 || m.alpha < 1.0f) flags |= shared::kTriangleAlphaTest;
      constexpr scene::LiquidOpacity kClearest{0.0f, 0.0f, 0.0f, 0.0f};
      if (scene::lets_light_in(m, kClearest)) flags |= shared::kTriangleDielectric;
    }
    if (t.liquid_in_front != 0) flags |= shared::kTriangleLiquidInFront;
    record.asks |= (flags & shared::kTriangleAlphaTest) != 0;
    batch.attributes.push_back(
        {t.vertices[0], t.vertices[1], t.vertices[2], t.material, t.uv[0], t.uv[1], t.uv[2], flags, t.face});
    record.materials.push_back(t.material);
    record.order.push_back(used[at]);
  }
  std::sort(record.materials.begin(), record.materials.end());
  record.materials.erase(std::unique(record.materials.begin(), record.materials.end()), record.materials.end());

  record.first_node = batch.first_node + static_cast<std::uint32_t>(batch.nodes.size());
  record.node_count = static_cast<std::uint32_t>(bvh.nodes.size());
  record.first_triangle = mesh.posed() ? 0 : batch.first_triangle + static_cast<std::uint32_t>(batch.triangles.size());
  record.root = rebased(bvh.root, record.first_node, record.first_triangle);
  record.first_level_entry = batch.first_level + static_cast<std::uint32_t>(batch.levels.size());
  if (mesh.posed()) {
    record.first_pose_vertex = batch.first_pose + static_cast<std::uint32_t>(batch.poses.size());
    record.vertex_count = mesh.vertex_count;
    record.pose_count = poses;
    record.pose_scale = mesh.pose_scale;
    record.pose_origin = mesh.pose_origin;
    record.pose_bounds.resize(poses);
    for (std::uint32_t pose = 0; pose < poses; ++pose) {
      for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) record.pose_bounds[pose].add(pose_position(mesh, pose, v));
      record.bounds.add(record.pose_bounds[pose]);
    }
    const auto end = mesh.poses.begin() + static_cast<std::ptrdiff_t>(std::size_t{poses} * mesh.vertex_count);
    batch.poses.insert(batch.poses.end(), mesh.poses.begin(), end);
  } else {
    record.first_vertex = batch.first_vertex + static_cast<std::uint32_t>(batch.vertices.size());
    record.bounds = bvh.bounds;
    if (record.triangle_count >= kLargeMesh) {
      record.subtrees = take_apart(bvh);
      for (SubtreeRef& part : record.subtrees) part.ref = rebased(part.ref, record.first_node, record.first_triangle);
    }
    for (std::uint32_t i = 0; i < record.triangle_count; ++i) {
      const auto& v = mesh.triangles[used[bvh.order[i]]].vertices;
      vec3 v0 = shape[v[0]], e1 = shape[v[1]] - v0, e2 = shape[v[2]] - v0;
      bool flat = is_flat(e1, e2);
      if (flat) e1 = e2 = vec3(0.0f);
      // Should this be the world: it is instance 0, and all see it.
      const bool asks = (batch.attributes[batch.attributes.size() - record.triangle_count + i].flags &
                         shared::kTriangleAlphaTest) != 0;
      const std::uint32_t owner = (asks ? shared::kTriangleAsks : 0u) | scene::kSeenByAll
                                                                            << shared::kTriangleVisibilityShift;
      batch.triangles.push_back({vec4(v0, shared::uintBitsToFloat(owner)), vec4(e1, 0), vec4(e2, 0)});
      if (ray_query_) {
        for (std::uint32_t corner : v) batch.vertices.push_back(flat ? v0 : shape[corner]);
      }
    }
    if (smooth) {
      record.first_normal = batch.first_normal + static_cast<std::uint32_t>(batch.normals.size());
      for (const vec3& n : mesh.normals) batch.normals.push_back(shared::pack_direction(n));
    }
  }
  if (ray_query_) return record;
  if (!mesh.posed() && bvh.root >= shared::kRefLeaf) {
    record.small.assign(batch.triangles.end() - record.triangle_count, batch.triangles.end());
  }
  for (shared::BvhNode& node : bvh.nodes) {
    node.child0 = rebased(node.child0, record.first_node, record.first_triangle);
    node.child1 = rebased(node.child1, record.first_node, record.first_triangle);
  }
  append_to(batch.nodes, bvh.nodes);
  append_to(batch.levels, bvh.level_order);
  record.level_first = std::move(bvh.level_first);
  return record;
}

std::uint64_t SceneAssets::device_bytes() const {
  return nodes_.bytes() + triangles_.bytes() + vertices_.bytes() + attributes_.bytes() + poses_.bytes() +
         normals_.bytes() + levels_.bytes() + images_.bytes() + texels_.bytes() + palette_.bytes();
}

}  // namespace fb::render
