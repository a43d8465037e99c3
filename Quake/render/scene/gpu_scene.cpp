#include "render/scene/gpu_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <ratio>

#include "base/check.h"
#include "base/log.h"
#include "base/out_of_memory.h"
#include "base/system.h"
#include "render/scene/former_instances.h"
#include "render/scene/gpu_scene_assets.h"
#include "render/scene/gpu_scene_copies.h"
#include "render/scene/gpu_scene_rays.h"
#include "render/scene/gpu_scene_room.h"
#include "render/scene/gpu_scene_tables.h"
#include "render/scene/gpu_scene_tree.h"
#include "render/scene/light_list.h"
#include "render/passes/shader_code.h"

namespace fb::render {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool is_finite(const mat4x3& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

// An instance that is drawn, before its place in the tables is known.
struct Drawn {
  const scene::Instance* instance = nullptr;
  mat4x3 inverse;
  Bounds bounds;  // in the world
  MaterialNeeds needs;
  float alpha = 1.0f;  // the instance's, but for glass, which lets light through in its own way
  std::uint32_t copy = shared::kNoIndex;
  std::uint32_t order = 0;  // along the curve
  bool asks() const {
    return alpha < 1.0f || (instance->material_base != 0 && (needs.alpha_test || needs.translucent));
  }
};

// The part of an upload buffer that one of the device's buffers gets.
struct Transfer {
  const gpu::Buffer* target = nullptr;
  VkDeviceSize from = 0, to = 0, bytes = 0;
};

}  // namespace

struct GpuScene::Impl {
  Impl(gpu::Device& d, gpu::BindingTable& t, const GpuSceneOptions& o)
      : device(d),
        table(t),
        options(o),
        assets(d, o.ray_query),
        copies(o.ray_query),
        rays(d, o.build),
        instances(d, gpu::BufferUse::kStorage, "instances"),
        materials(d, gpu::BufferUse::kStorage, "materials"),
        jobs(d, gpu::BufferUse::kStorage, "copy jobs"),
        lights(d, gpu::BufferUse::kStorage, "lights"),
        staging(d, gpu::BufferUse::kUpload, 1 << 16, "scene staging") {
    const gpu::SpecializationConstant constants[]{{shared::kSpecForQuery, o.ray_query ? 1u : 0u}};
    pose = make_pipeline(d, t, "pose", false, arrays_by_address(d, o.by_address), constants);
  }

  void collect(const scene::FrameSnapshot& snapshot);
  void choose_world();
  bool is_copy(std::size_t drawn_index) const;
  void leave_out_farthest(const scene::FrameSnapshot& snapshot);
  void make_room();
  void fill(const scene::FrameSnapshot& snapshot, const EmissionScales& emission);
  void list_lights(const scene::FrameSnapshot& snapshot, bool wanted);
  void stage();
  void bind();
  void record_tables(gpu::Commands& commands);
  void record_rays(gpu::Commands& commands);
  // Where the tables of lights, of lamps and of the former frame's instances begin in their buffer.
  std::uint32_t light_texel() const { return static_cast<std::uint32_t>((light_list.first_lights().size() + 3) / 4); }
  std::uint32_t lamp_texel() const {
    return light_texel() + 2 * static_cast<std::uint32_t>(light_list.lights().size());
  }
  std::uint32_t former_texel() const {
    return lamp_texel() + static_cast<std::uint32_t>((light_list.lamps().size() + 1) / 2);
  }

  gpu::Device& device;
  gpu::BindingTable& table;
  GpuSceneOptions options;
  SceneAssets assets;
  InstanceCopies copies;
  RayStructures rays;
  MaterialTable material_table;
  LightList light_list;
  FormerInstances former;
  gpu::ComputePipeline pose;

  DeviceArray<shared::GpuInstance> instances;
  DeviceArray<shared::GpuMaterial> materials;
  DeviceArray<shared::GpuCopyJob> jobs;
  DeviceArray<glm::uvec4> lights;
  gpu::Buffer staging;

  // This frame.
  std::vector<Drawn> drawn;
  bool has_world = false;  // drawn[0] stands in the world's own space
  std::vector<shared::GpuInstance> instance_table;
  std::vector<shared::GpuCopyJob> job_table;
  std::vector<shared::BvhNode> tree;
  std::vector<Transfer> transfers;
  VkDeviceSize staged = 0;
  bool recorded = true;     // the last prepared frame was recorded
  bool has_lights = false;  // the device has the list of lights as it is
  bool said_unknown_material = false;
  std::uint64_t said_too_many = 0;   // of the assets of this generation
  std::uint32_t asset_features = 0;  // features_of(assets), when these were known
  std::size_t known_meshes = 0, known_materials = 0;
  SceneFeatures features;
  Interfaces interfaces;
  SceneStatistics statistics;
};

// Which instances are drawn, in the snapshot's order, which changes little from frame to frame, and what they need.
void GpuScene::Impl::collect(const scene::FrameSnapshot& snapshot) {
  features = SceneFeatures{};
  features.surfaces = asset_features | features_of(snapshot.sky);
  drawn.clear();
  Bounds space;
  for (const scene::Instance& instance : snapshot.instances) {
    if (instance.mesh >= assets.meshes().size() || !is_finite(instance.transform)) continue;
    const MeshRecord& mesh = assets.meshes()[instance.mesh];
    if (mesh.triangle_count == 0 || (instance.visibility & scene::kSeenByAll) == 0 || !(instance.alpha > 0.0f))
      continue;
    Drawn d;
    d.instance = &instance;
    d.inverse = inverse_affine(instance.transform);
    if (d.inverse == mat4x3(0.0f) || !is_finite(d.inverse)) continue;
    d.needs = needs_of(*snapshot.assets, mesh, instance.material_base, interfaces, snapshot.liquid_opacity);
    if (!d.needs.known) {
      if (!said_unknown_material)
        log_warning("instance {} names a material that does not exist; it is not drawn", instance.id);
      said_unknown_material = true;
      continue;
    }
    features.alpha_test |= d.needs.alpha_test;
    d.alpha = interfaces.glass && d.needs.glass_alone ? 1.0f : instance.alpha;
    features.translucent |= d.needs.translucent || d.alpha < 1.0f;
    features.specular |= d.needs.specular;
    features.water |= d.needs.water;
    features.glass |= d.needs.glass;
    features.veils |= d.needs.veils;
    features.surfaces |= d.needs.skins ? shared::kFeatureSkins : 0u;
    features.turbid |= d.needs.turbid && interfaces.scattering > 0.0f;
    const Bounds local = InstanceCopies::bounds(mesh, InstanceCopies::canonical(mesh, instance.pose));
    d.bounds = transform_bounds(instance.transform, local);
    // Corners are rounded when they are taken into the world.
    vec3 pad = glm::max(glm::abs(d.bounds.min), glm::abs(d.bounds.max)) * 1e-6f;
    d.bounds.min -= pad;
    d.bounds.max += pad;
    space.add((d.bounds.min + d.bounds.max) * 0.5f);
    drawn.push_back(d);
  }
  for (Drawn& d : drawn) d.order = morton_code((d.bounds.min + d.bounds.max) * 0.5f, space);
  choose_world();
  leave_out_farthest(snapshot);

  copies.begin(assets);
  for (std::uint32_t i = 0; i < drawn.size(); ++i) {
    Drawn& d = drawn[i];
    if (is_copy(i)) d.copy = copies.add(assets, *d.instance, i, d.asks());
  }
}

bool GpuScene::Impl::is_copy(std::size_t i) const {
  return options.ray_query ? assets.meshes()[drawn[i].instance->mesh].posed : i > 0 || !has_world;
}

// Where the device's arrays cannot hold all that is in sight.
void GpuScene::Impl::leave_out_farthest(const scene::FrameSnapshot& snapshot) {
  SceneRoom room = copies.room(assets);
  constexpr std::uint64_t kMostInTopLevel = 1u << 23;  // Vulkan promises 2^24 - 1, and RayStructures adds some to spare
  room.instances = std::min(room.instances, instances.most());
  if (options.ray_query) room.instances = std::min(room.instances, kMostInTopLevel);
  room.copies = std::min<std::uint64_t>(jobs.most(), device.limits().max_workgroups[0]);
  std::vector<SceneDemand> demands;
  demands.reserve(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Bounds& box = drawn[i].bounds;
    const vec3 eye = snapshot.camera.position;
    const float distance = glm::distance(glm::clamp(eye, box.min, box.max), eye);
    SceneDemand demand{{}, std::isfinite(distance) ? distance : 0.0f};
    if (is_copy(i)) demand.room = copies.needs(assets.meshes()[drawn[i].instance->mesh]);
    if (i == 0 && has_world) demand.distance = -1.0f;
    demands.push_back(demand);
  }
  const std::vector<bool> fits = nearest_that_fit(demands, room);
  std::size_t i = 0;
  const std::size_t left_out = std::erase_if(drawn, [&](const Drawn&) { return !fits[i++]; });
  if (left_out == 0 || said_too_many == assets.generation()) return;
  said_too_many = assets.generation();
  log_warning(
      "{} of {} models and particles are not drawn, the farthest: they are more than {} allows, buffers of {} and {} "
      "models",
      left_out, fits.size(), device.report().name, memory_text(gpu::largest_buffer(device, gpu::BufferUse::kStorage)),
      room.copies);
}

// The largest rigid instance that all rays see and that stands where its mesh does becomes instance 0: its own
// tree and triangles are traced as they are.
void GpuScene::Impl::choose_world() {
  has_world = false;
  std::size_t best = 0;
  std::uint32_t best_count = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const scene::Instance& instance = *drawn[i].instance;
    const MeshRecord& mesh = assets.meshes()[instance.mesh];
    bool fits = !mesh.posed && !drawn[i].asks() && instance.transform == mat4x3(1.0f) &&
                (instance.visibility & scene::kSeenByAll) == scene::kSeenByAll;
    if (fits && mesh.triangle_count > best_count) {
      has_world = true;
      best = i;
      best_count = mesh.triangle_count;
    }
  }
  if (has_world)
    std::rotate(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(best),
                drawn.begin() + static_cast<std::ptrdiff_t>(best) + 1);
}

// Places the copies, and makes room for them and for the nodes above them.
void GpuScene::Impl::make_room() {
  const VkBuffer old[]{assets.nodes().buffer().handle(), assets.triangles().buffer().handle(),
                       assets.vertices().buffer().handle()};
  const std::uint64_t small_triangles = drawn.size() * shared::kMaxLeafTriangles;
  assets.nodes().reserve(std::uint64_t{copies.end_node()} + (options.ray_query ? 0 : drawn.size() + kSubtrees));
  assets.triangles().reserve(copies.host_triangle() + (options.ray_query ? 0 : small_triangles));
  assets.vertices().reserve(options.ray_query ? copies.end_vertex() : 1);
  const bool moved = old[0] != assets.nodes().buffer().handle() || old[1] != assets.triangles().buffer().handle() ||
                     old[2] != assets.vertices().buffer().handle();
  copies.finish(assets, moved || !recorded);
  job_table = copies.jobs(assets);
}

// The tables' contents.
void GpuScene::Impl::fill(const scene::FrameSnapshot& snapshot, const EmissionScales& emission) {
  const scene::Assets& source = *snapshot.assets;
  make_room();
  instance_table.clear();
  std::vector<TreeLeaf> leaves;
  std::vector<RayInstance> ray_instances;
  for (std::uint32_t i = 0; i < drawn.size(); ++i) {
    const Drawn& d = drawn[i];
    const scene::Instance& instance = *d.instance;
    const MeshRecord& mesh = assets.meshes()[instance.mesh];
    const scene::Material& material = source.materials[mesh.materials[0] + instance.material_base];
    shared::GpuInstance out =
        make_gpu_instance(mesh, instance, d.inverse, material_table.base_for(source, mesh, instance),
                          emission_scale(emission, material.emission_kind));
    out.alpha = d.alpha;
    if (d.asks()) out.flags |= shared::kInstanceTranslucent;
    out.first_triangle = out.world_triangle = mesh.first_triangle;
    if (d.copy != shared::kNoIndex) {
      out.first_triangle = copies.copies()[d.copy].object_triangle;
      out.world_triangle = copies.copies()[d.copy].world_triangle;
    }
    instance_table.push_back(out);
    if (options.ray_query) {
      ray_instances.push_back(
          {instance.transform, i, instance.visibility & scene::kSeenByAll, instance.mesh, d.copy, d.asks()});
    } else if (i == 0 && has_world) {
      if (mesh.subtrees.empty()) leaves.push_back({mesh.root, mesh.bounds});
      for (const SubtreeRef& part : mesh.subtrees) leaves.push_back({part.ref, part.bounds});
    } else {
      leaves.push_back({copies.copies()[d.copy].root, d.bounds});
    }
  }
  if (options.ray_query) {
    std::stable_sort(ray_instances.begin(), ray_instances.end(), [&](const RayInstance& a, const RayInstance& b) {
      return drawn[a.index].order < drawn[b.index].order;
    });
    rays.prepare(assets, std::move(ray_instances));
  } else {
    tree = build_instance_tree(leaves, copies.end_node());
  }
}

void GpuScene::Impl::list_lights(const scene::FrameSnapshot& snapshot, bool wanted) {
  std::vector<LightList::Source> sources;
  if (wanted) {
    for (std::size_t i = 0; i < drawn.size(); ++i)
      sources.push_back({drawn[i].instance, &assets.meshes()[drawn[i].instance->mesh], &instance_table[i]});
  }
  std::vector<FormerInstances::Row> rows;
  for (const Drawn& d : drawn)
    rows.push_back({d.instance->id, d.instance->mesh, (d.instance->flags & scene::kInstanceNew) != 0});
  former.begin_frame(std::move(rows));
  // Beside the tables of instances, of lamps and of the former frame's instances.
  const std::uint64_t bytes = lights.most() * sizeof(glm::uvec4),
                      others = (sources.size() + former.places().size()) * sizeof(std::uint32_t) +
                               shared::kMostLamps * sizeof(shared::GpuLamp) + 4 * sizeof(glm::uvec4);
  light_list.build(*snapshot.assets, snapshot.sky, sources, material_table.entries(),
                   (bytes - std::min(bytes, others)) / sizeof(shared::GpuLight));
  if (light_list.made_anew()) has_lights = false;
}

// Lays this frame's tables into the staging buffer.
void GpuScene::Impl::stage() {
  instances.reserve(instance_table.size());
  materials.reserve(material_table.entries().size());
  jobs.reserve(job_table.size());
  const std::uint64_t had_room = lights.bytes();
  if (!light_list.first_lights().empty()) lights.reserve(former_texel() + former.places().size() / 4 + 1);
  if (lights.bytes() != had_room) has_lights = false;

  staged = 0;
  transfers.clear();
  const auto bytes_of = [](const auto& items) { return items.size() * sizeof(items[0]); };
  staging.reserve(bytes_of(instance_table) + bytes_of(material_table.entries()) + bytes_of(job_table) + bytes_of(tree) +
                  former_texel() * sizeof(glm::uvec4) + bytes_of(former.places()) + bytes_of(copies.host_triangles()));
  const auto put = [&](const void* data, VkDeviceSize bytes, const gpu::Buffer& target, VkDeviceSize to) {
    if (bytes == 0) return;
    std::memcpy(static_cast<std::byte*>(staging.mapped()) + staged, data, bytes);
    transfers.push_back({&target, staged, to, bytes});
    staged += bytes;
  };
  put(instance_table.data(), bytes_of(instance_table), instances.buffer(), 0);
  put(material_table.entries().data(), bytes_of(material_table.entries()), materials.buffer(), 0);
  put(job_table.data(), bytes_of(job_table), jobs.buffer(), 0);
  const auto put_lights = [&](const auto& items, std::uint32_t texel) {
    if (!has_lights) put(items.data(), bytes_of(items), lights.buffer(), texel * sizeof(glm::uvec4));
  };
  put_lights(light_list.first_lights(), 0);
  put_lights(light_list.lights(), light_texel());
  put_lights(light_list.lamps(), lamp_texel());
  if (!light_list.first_lights().empty())
    put(former.places().data(), bytes_of(former.places()), lights.buffer(), former_texel() * sizeof(glm::uvec4));
  put(copies.host_triangles().data(), bytes_of(copies.host_triangles()), assets.triangles().buffer(),
      std::uint64_t{copies.host_triangle()} * sizeof(shared::GpuTriangle));
  if (!options.ray_query) {
    constexpr VkDeviceSize kNode = sizeof(shared::BvhNode);
    put(tree.data(), kNode, assets.nodes().buffer(), 0);
    put(tree.data() + 1, bytes_of(tree) - kNode, assets.nodes().buffer(), copies.end_node() * kNode);
  }
}

void GpuScene::Impl::bind() {
  table.set_array(shared::kSetScene, shared::kBindNodes, assets.nodes().buffer());
  table.set_array(shared::kSetScene, shared::kBindTriangles, assets.triangles().buffer());
  table.set_texels(shared::kTexelsNodes, assets.nodes().buffer());
  table.set_texels(shared::kTexelsTriangles, assets.triangles().buffer());
  table.set_texels(shared::kTexelsInstances, instances.buffer());
  table.set_texels(shared::kTexelsAttributes, assets.attributes());
  table.set_texels(shared::kTexelsMaterials, materials.buffer());
  table.set_texels(shared::kTexelsImages, assets.images());
  table.set_texels(shared::kTexelsPalette, assets.palette());
  table.set_texels(shared::kTexelsLights, lights.buffer());
  table.set_array(shared::kSetScene, shared::kBindAttributes, assets.attributes());
  table.set_array(shared::kSetScene, shared::kBindPoses, assets.poses());
  table.set_array(shared::kSetScene, shared::kBindNormals, assets.normals());
  table.set_array(shared::kSetScene, shared::kBindInstances, instances.buffer());
  table.set_array(shared::kSetPose, shared::kBindLevels, assets.levels());
  table.set_array(shared::kSetScene, shared::kBindMaterials, materials.buffer());
  table.set_array(shared::kSetScene, shared::kBindImages, assets.images());
  table.set_array(shared::kSetScene, shared::kBindTexels, assets.texels());
  table.set_array(shared::kSetScene, shared::kBindPalette, assets.palette());
  table.set_array(shared::kSetPose, shared::kBindCopyJobs, jobs.buffer());
  table.set_array(shared::kSetPose, shared::kBindVertices, assets.vertices().buffer());
  table.set_array(shared::kSetScene, shared::kBindLights, lights.buffer());
}

void GpuScene::Impl::record_tables(gpu::Commands& commands) {
  for (const Transfer& t : transfers) commands.copy(staging, *t.target, t.bytes, t.from, t.to);
  commands.barrier();
  // Where there is nothing to do, too: drivers may compile code of its own for the first dispatch of a frame, and it is
  // to be this one's always (gpu/precompiler.h).
  commands.bind_third(table, shared::kSetPose);
  commands.dispatch(pose, static_cast<std::uint32_t>(job_table.size()));
  commands.barrier();
  commands.bind_third(table, shared::kSetTechnique);
}

void GpuScene::Impl::record_rays(gpu::Commands& commands) {
  if (!options.ray_query) return;
  rays.record(commands, assets, copies);
  commands.barrier();
}

std::uint64_t most_texel_bytes(const gpu::Device& device) {
  return std::min({gpu::largest_buffer(device, gpu::BufferUse::kStorage), device.limits().local_memory_bytes / 4,
                   physical_memory() / 8});
}

GpuScene::GpuScene(gpu::Device& device, gpu::BindingTable& table, const GpuSceneOptions& options)
    : impl_(std::make_unique<Impl>(device, table, options)) {}
GpuScene::~GpuScene() = default;

void GpuScene::prepare(const scene::FrameSnapshot& snapshot, const EmissionScales& emission, bool wants_lights,
                       Interfaces interfaces) {
  Impl& s = *impl_;
  const auto start = std::chrono::steady_clock::now();
  FB_CHECK(snapshot.assets != nullptr);
  const std::uint64_t generation = s.assets.generation();
  s.assets.update(*snapshot.assets);
  const bool renumbered = s.assets.generation() != generation;
  if (renumbered) {
    s.copies.forget();
    s.former.forget();
  }
  const std::size_t meshes = snapshot.assets->meshes.size(), materials = snapshot.assets->materials.size();
  // A model may come in the middle of a level.
  if (renumbered || meshes != s.known_meshes || materials != s.known_materials) {
    s.asset_features = features_of(*snapshot.assets);
    s.known_meshes = meshes;
    s.known_materials = materials;
  }
  s.material_table.begin(*snapshot.assets, snapshot.time, emission, interfaces, snapshot.liquid_opacity,
                         snapshot.authored, snapshot.light_styles);
  s.interfaces = interfaces;
  s.collect(snapshot);
  s.fill(snapshot, emission);
  s.list_lights(snapshot, wants_lights);
  s.statistics.host_milliseconds = milliseconds_since(start);
}

void GpuScene::stage() {
  Impl& s = *impl_;
  const auto start = std::chrono::steady_clock::now();
  s.stage();
  s.bind();
  s.recorded = false;
  if (s.options.ray_query && s.rays.must_grow()) {
    s.device.run([&](gpu::Commands& commands) {
      commands.bind(s.table);
      s.record_tables(commands);
    });
    // The old top level goes here: nothing that is recorded may have it bound.
    s.device.run([&](gpu::Commands& commands) { s.record_rays(commands); });
    s.table.set_tlas(s.rays.top_level());
  }

  s.statistics.meshes = static_cast<std::uint32_t>(s.assets.meshes().size());
  s.statistics.triangles = s.assets.triangle_count();
  s.statistics.instances = static_cast<std::uint32_t>(s.drawn.size());
  s.statistics.posed_instances = static_cast<std::uint32_t>(std::count_if(
      s.drawn.begin(), s.drawn.end(), [&](const Drawn& d) { return s.assets.meshes()[d.instance->mesh].posed; }));
  s.statistics.lights = s.light_list.lights().size();
  s.statistics.light_power = s.light_list.power();
  s.statistics.uploaded_bytes = s.staged;
  s.statistics.device_bytes = s.assets.device_bytes() + s.instances.bytes() + s.materials.bytes() + s.jobs.bytes() +
                              s.lights.bytes() + s.staging.size();
  s.statistics.host_milliseconds += milliseconds_since(start);
}

void GpuScene::forget() {
  impl_->assets.forget();
  impl_->copies.forget();
  impl_->rays.forget();
  impl_->recorded = impl_->has_lights = false;
}

void GpuScene::record(gpu::Commands& commands) {
  const VkAccelerationStructureKHR before = impl_->rays.top_level();
  impl_->record_tables(commands);
  impl_->record_rays(commands);
  impl_->recorded = impl_->has_lights = true;
  FB_CHECK(before == impl_->rays.top_level());
}

void GpuScene::add_passes(PassList& list) {
  list.add("scene", PassKind::kFrame, [this](gpu::Commands& commands) { record(commands); });
}

const SceneFeatures& GpuScene::features() const { return impl_->features; }
const SceneStatistics& GpuScene::statistics() const { return impl_->statistics; }
GpuScene::Lights GpuScene::lights() const {
  const LightList& list = impl_->light_list;
  return {impl_->light_texel(),  static_cast<std::uint32_t>(list.lights().size()),
          impl_->lamp_texel(),   list.power(),
          impl_->former_texel(), static_cast<std::uint32_t>(impl_->former.places().size())};
}
SceneBuffers GpuScene::buffers() const {
  return {&impl_->assets.nodes().buffer(), &impl_->assets.triangles().buffer(), &impl_->instances.buffer()};
}

}  // namespace fb::render
