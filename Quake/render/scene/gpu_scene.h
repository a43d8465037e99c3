// GpuScene: the scene on the device. Uploads what is new in the assets, fills this frame's tables from the snapshot,
// builds a tree per mesh once (host, binned SAH). Each frame what is not the world is copied into the world's space,
// posed and refitted on the device, and hung with the world into one tree; for ray queries, VK_KHR acceleration
// structures hold the same. The layout that shaders see is Shaders/shared/scene_gpu.h; the tree's is
// Shaders/shared/bvh.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "gpu/acceleration_structure.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "render/passes/pass.h"
#include "render/passes/settings.h"
#include "scene/snapshot.h"

namespace fb::render {

struct GpuSceneOptions {
  bool ray_query = false;  // also build acceleration structures, and bind the top level
  gpu::BuildPreference build = gpu::BuildPreference::kFastTrace;
  std::optional<bool> by_address = {};  // how shaders reach arrays (arrays_by_address()); none: as suits the device
  std::optional<bool> gpu_lanes = {};   // what shaders are written for (lanes_of_gpu()); none: as the device is
};

// What the snapshot holds, so that shaders can leave out what it does not.
struct SceneFeatures {
  bool alpha_test = false;     // some triangle needs its texel asked
  bool translucent = false;    // some instance or material has alpha < 1
  bool specular = false;       // some material is not plain Lambert
  bool medium = false;         // there is one between surfaces
  bool water = false;          // some surface can be an interface of a liquid
  bool glass = false;          // some surface can be one of glass
  bool veils = false;          // some liquid is translucent and no interface
  bool turbid = false;         // behind some interface light is scattered
  std::uint32_t surfaces = 0;  // shared::kFeature*, of all assets, drawn or not, and of the sky
};

// Which surfaces that can be dielectric interfaces are: those of liquids, those of glass. The others are as their
// textures say. What is behind them scatters this much of what its materials say.
struct Interfaces {
  bool water = false, glass = false;
  float scattering = 1.0f;
};

struct SceneStatistics {
  std::uint32_t meshes = 0, triangles = 0, instances = 0, posed_instances = 0;
  std::uint32_t lights = 0;  // triangles in the list of lights, which only some estimators want
  float light_power = 0;     // of all of them: LightList::power
  std::uint64_t device_bytes = 0;
  std::uint64_t uploaded_bytes = 0;  // this frame's tables
  double host_milliseconds = 0;      // prepare() and stage(), this frame
};

// What a game's images may take on this device (scene/library/texel_budget.h): one buffer of it holds them all, and
// they leave it and the machine, which has them as well, most of their memory.
std::uint64_t most_texel_bytes(const gpu::Device& device);

// What tests look into.
struct SceneBuffers {
  const gpu::Buffer *nodes, *triangles, *instances;
};

class GpuScene {
 public:
  GpuScene(gpu::Device& device, gpu::BindingTable& table, const GpuSceneOptions& options);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  // Host part: uploads, tables, the tree over instances, the list of lights if it is wanted. The device may still draw
  // the former frame.
  void prepare(const scene::FrameSnapshot& snapshot, const EmissionScales& emission, bool wants_lights = false,
               Interfaces interfaces = {});
  // Lays what was prepared where the device takes it from. Between submissions.
  void stage();
  // What was prepared was not all done on the device: the next frame uploads and builds everything.
  void forget();
  // Device part: copies, poses, refits, acceleration structures. Ends with a barrier.
  void record(gpu::Commands& commands);
  void add_passes(PassList& list);

  const SceneFeatures& features() const;
  // The list of lights: texels where its tables begin, lights (0: none glows, or none was wanted), LightList::power,
  // instances of the former frame (0: there was none).
  struct Lights {
    std::uint32_t first, count, first_lamp;
    float power;
    std::uint32_t first_former, former_instances;
  };
  Lights lights() const;
  const SceneStatistics& statistics() const;
  SceneBuffers buffers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::render
