// Traversal against Embree on the same rays: what the camera sees of a scene (coherent), and where cosine-distributed
// bounces go from there (incoherent). Each row traces its rays on the device and through Embree's rtcIntersect1 in
// turn, on as many threads as the device's driver uses (LP_NUM_THREADS, else all), and reports millions of rays a
// second and the ratio of the medians. `cpu_ratio`, for devices that are the CPU, compares processor time, which other
// work on the machine disturbs less. LibreQuake's maps are used where they are (FULLBRIGHT_TEST_DATA,
// ../shared/librequake).
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define FB_EMBREE_4 1
#else
#include <embree3/rtcore.h>
#define FB_EMBREE_4 0
#endif
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <thread>

#include "base/librequake.h"
#include "base/rng.h"
#include "fs/filesystem.h"
#include "render/scene/ray_list.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/library/library.h"
#include "scene/shapes.h"
#include "shared/scene_gpu.h"
#include "world/entity_lump.h"

namespace fb::render {
namespace {

using shared::ListRay;

constexpr int kWidth = 320, kHeight = 180;

std::size_t device_threads() {
  const char* set = std::getenv("LP_NUM_THREADS");
  int threads = set != nullptr ? std::atoi(set) : 0;
  return threads > 0 ? static_cast<std::size_t>(threads) : std::max(1u, std::thread::hardware_concurrency());
}

// A scene flattened into one triangle mesh for Embree.
class EmbreeScene {
 public:
  explicit EmbreeScene(const scene::FrameSnapshot& snapshot)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    std::vector<vec3> corners;
    for (const scene::Instance& instance : snapshot.instances) {
      const scene::Mesh& mesh = snapshot.assets->meshes[instance.mesh];
      for (const scene::MeshTriangle& t : mesh.triangles) {
        for (std::uint32_t v : t.vertices) {
          vec3 p = mesh.posed() ? glm::mix(scene::vertex_position(mesh, v, instance.pose.a),
                                           scene::vertex_position(mesh, v, instance.pose.b), instance.pose.t)
                                : mesh.positions[v];
          corners.push_back(transform_point(instance.transform, p));
        }
      }
    }
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), corners.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, corners.size() / 3));
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      vertices[i] = corners[i];
      indices[i] = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    triangles_ = corners.size() / 3;
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  std::size_t triangles() const { return triangles_; }

  // Distance, or a negative number; the normal faces the ray.
  float trace(const ListRay& ray, vec3& normal) const {
    RTCRayHit hit{};
    hit.ray.org_x = ray.origin.x, hit.ray.org_y = ray.origin.y, hit.ray.org_z = ray.origin.z;
    hit.ray.dir_x = ray.direction.x, hit.ray.dir_y = ray.direction.y, hit.ray.dir_z = ray.direction.z;
    hit.ray.tnear = ray.t_min, hit.ray.tfar = ray.t_max;
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if FB_EMBREE_4
    rtcIntersect1(scene_, &hit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &hit);
#endif
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return -1.0f;
    normal = glm::normalize(vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
    if (glm::dot(normal, ray.direction) > 0) normal = -normal;
    return hit.ray.tfar;
  }

  // All rays' distances, on so many threads.
  void trace(const std::vector<ListRay>& rays, std::vector<float>& distances, std::size_t threads) const {
    std::vector<std::thread> pool;
    for (std::size_t k = 0; k < threads; ++k) {
      pool.emplace_back([&, k] {
        vec3 normal;
        for (std::size_t i = rays.size() * k / threads; i < rays.size() * (k + 1) / threads; ++i) {
          distances[i] = trace(rays[i], normal);
        }
      });
    }
    for (std::thread& thread : pool) thread.join();
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  std::size_t triangles_ = 0;
};

// What a row traces.
struct Workload {
  scene::FrameSnapshot snapshot;
  std::unique_ptr<EmbreeScene> embree;
  std::vector<ListRay> primary, bounce;
};

// Rays in the order in which the renderer's lanes have them: tiles of 8x8, Morton within.
void make_rays(Workload& work) {
  const scene::Camera& camera = work.snapshot.camera;
  AxisVectors axes = angle_vectors(camera.angles);
  Rng rng(1);
  for (int i = 0; i < kWidth * ((kHeight + 7) / 8) * 8; ++i) {
    int in_tile = i % 64, tile = i / 64;
    int x = tile % (kWidth / 8) * 8 + ((in_tile & 1) | (in_tile >> 1 & 2) | (in_tile >> 2 & 4));
    int y = tile / (kWidth / 8) * 8 + ((in_tile >> 1 & 1) | (in_tile >> 2 & 2) | (in_tile >> 3 & 4));
    if (y >= kHeight) continue;
    ListRay ray{};
    ray.origin = camera.position;
    float right = (static_cast<float>(x) + 0.5f) / kWidth * 2 - 1,
          down = ((static_cast<float>(y) + 0.5f) * 2 - kHeight) / kWidth;
    ray.direction = glm::normalize(axes.forward + axes.right * right - axes.up * down);
    ray.t_max = 1e6f;
    ray.mask = scene::kSeenByAll;
    work.primary.push_back(ray);
    vec3 normal;
    float t = work.embree->trace(ray, normal);
    if (t < 0) continue;
    vec3 tangent = glm::normalize(glm::cross(normal, std::abs(normal.x) > 0.5f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    float u = rng.uniform(), phi = 2 * kPi * rng.uniform(), r = std::sqrt(u);
    ListRay bounce = ray;
    bounce.origin += ray.direction * t + normal * 0.01f;
    bounce.direction =
        tangent * (r * std::cos(phi)) + glm::cross(normal, tangent) * (r * std::sin(phi)) + normal * std::sqrt(1 - u);
    work.bounce.push_back(bounce);
  }
}

std::unique_ptr<Workload> finish(scene::FrameSnapshot snapshot) {
  auto work = std::make_unique<Workload>();
  work->snapshot = std::move(snapshot);
  work->embree = std::make_unique<EmbreeScene>(work->snapshot);
  make_rays(*work);
  return work;
}

std::optional<fs::FileSystem> game_data() {
  fs::FsOptions options;
  options.base_dir = librequake_folder();
  options.user_dir = std::filesystem::path();
  if (!std::filesystem::exists(options.base_dir)) return std::nullopt;
  Result<fs::FileSystem> files = fs::FileSystem::open(options);
  if (!files) return std::nullopt;
  return std::move(*files);
}

// A map as its player start sees it: the world, its brush models, and `monsters` ogres in mid-step around the camera.
std::unique_ptr<Workload> map_workload(const std::string& map, int monsters) {
  std::optional<fs::FileSystem> files = game_data();
  if (!files) return nullptr;
  scene::ModelLibrary library([&](std::string_view path) { return files->read(path); });
  const std::string path = fmt::format("maps/{}.bsp", map);
  if (!library.load_map(path)) return nullptr;
  scene::FrameSnapshot snapshot;
  auto add = [&](const scene::Model& model) {
    if (model.mesh == scene::kNone) return;
    scene::Instance instance;
    instance.id = static_cast<std::uint32_t>(snapshot.instances.size());
    instance.mesh = model.mesh;
    snapshot.instances.push_back(instance);
  };
  add(library.model(path));
  for (std::size_t i = 1; i < library.map()->models.size(); ++i) add(library.model(fmt::format("*{}", i)));
  auto entities = world::parse_entity_lump(library.map_entities(), path);
  if (!entities) return nullptr;
  for (const world::Entity& entity : *entities) {
    if (entity.classname() != "info_player_start") continue;
    snapshot.camera.position = entity.vector("origin").value_or(vec3(0.0f)) + vec3(0, 0, 22);
    snapshot.camera.angles = {0, entity.number("angle", 0), 0};
    break;
  }
  snapshot.assets = library.assets();
  if (monsters > 0) {
    const scene::Model& ogre = library.model("progs/ogre.mdl");
    if (ogre.kind != scene::ModelKind::kAlias || ogre.skin_materials.empty()) return nullptr;
    EmbreeScene world(snapshot);
    Rng rng(7);
    for (int i = 0; i < monsters; ++i) {
      ListRay ray{};
      ray.origin = snapshot.camera.position;
      float yaw = rng.uniform(0, 2 * kPi);
      ray.direction = glm::normalize(vec3(std::cos(yaw), std::sin(yaw), rng.uniform(-0.3f, 0.3f)));
      ray.t_max = 1e6f;
      vec3 normal;
      float t = std::max(world.trace(ray, normal), 100.0f);
      scene::Instance instance;
      instance.id = 1000 + static_cast<std::uint32_t>(i);
      instance.mesh = ogre.mesh;
      instance.material_base = ogre.skin_materials[0];
      instance.pose = {static_cast<std::uint32_t>(i) % 8, static_cast<std::uint32_t>(i) % 8 + 1, 0.4f};
      instance.transform =
          entity_transform(ray.origin + ray.direction * (t * rng.uniform(0.4f, 0.95f)), {0, rng.uniform(0, 360), 0});
      instance.prev_transform = instance.transform;
      snapshot.instances.push_back(instance);
    }
    snapshot.assets = library.assets();
  }
  return finish(std::move(snapshot));
}

std::unique_ptr<Workload> make_workload(const std::string& name) {
  if (name == "many_lights") return finish(scene::many_lights(500));
  if (auto plus = name.find("+ogres"); plus != std::string::npos) return map_workload(name.substr(0, plus), 10);
  return map_workload(name, 0);
}

const Workload* workload(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Workload>> made;
  auto found = made.find(name);
  if (found == made.end()) found = made.emplace(name, make_workload(name)).first;
  return found->second.get();
}

gpu::Device* device() {
  static Result<std::unique_ptr<gpu::Device>> made = gpu::Device::create({});
  return made ? made->get() : nullptr;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Cost {
  std::vector<double> wall, processor;
  template <typename Work>
  void measure(Work&& work) {
    double cpu = processor_seconds();
    auto start = std::chrono::steady_clock::now();
    work();
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    processor.push_back(processor_seconds() - cpu);
  }
  static double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  }
};

void traversal(benchmark::State& state, const std::string& name, bool bounces, bool ray_query) {
  gpu::Device* d = device();
  if (d == nullptr) return state.SkipWithError("no Vulkan device");
  if (ray_query && !d->has_ray_query()) return state.SkipWithError("the device has no ray query");
  const Workload* work = workload(name);
  if (work == nullptr) return state.SkipWithError(librequake_lacks().c_str());
  const std::vector<ListRay>& rays = bounces ? work->bounce : work->primary;
  GpuSceneOptions options;
  options.ray_query = ray_query;
  RayList list(*d, options, false);
  list.load(work->snapshot, rays);
  list.trace();  // compiles

  std::vector<float> distances(rays.size());
  Cost ours, embree, embree_alone;
  for (auto _ : state) {
    ours.measure([&] { list.trace(); });
    state.SetIterationTime(ours.wall.back());
    embree.measure([&] { work->embree->trace(rays, distances, device_threads()); });
    embree_alone.measure([&] { work->embree->trace(rays, distances, 1); });
  }
  std::vector<shared::ListHit> hits = list.hits();
  std::size_t differ = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    float t = hits[i].instance == shared::kNoIndex ? -1.0f : hits[i].t;
    differ += !(std::abs(t - distances[i]) <= 1e-3f * std::max(1.0f, std::abs(distances[i])));
  }
  auto rate = [&](const Cost& cost) { return static_cast<double>(rays.size()) / Cost::median(cost.wall) * 1e-6; };
  state.counters["Mrays"] = rate(ours);
  state.counters["embree"] = rate(embree);
  state.counters["embree_1"] = rate(embree_alone);
  state.counters["ratio"] = rate(ours) / rate(embree);
  if (d->is_software()) state.counters["cpu_ratio"] = Cost::median(embree.processor) / Cost::median(ours.processor);
  state.counters["differ"] = static_cast<double>(differ);
  state.counters["threads"] = static_cast<double>(device_threads());
}

void register_all() {
  for (const char* name : {"many_lights", "start", "start+ogres", "lq_e1m7"}) {
    for (bool bounces : {false, true}) {
      for (bool ray_query : {false, true}) {
        const std::string row =
            fmt::format("{}/{}/{}", name, bounces ? "bounce" : "primary", ray_query ? "query" : "bvh");
        benchmark::RegisterBenchmark(row.c_str(),
                                     [=](benchmark::State& state) { traversal(state, name, bounces, ray_query); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(15);
      }
    }
  }
}

}  // namespace
}  // namespace fb::render

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  fb::render::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
