// Time of a frame's passes on the device, from the device's own timestamps, at 320x180: the view from the first player
// start of LibreQuake's maps (FULLBRIGHT_TEST_DATA, else ../shared/librequake) and a Cornell box. `forced` is the same
// with everything in the shaders that the scene does not need (r_force_features), in alternation with the plain one:
// the ratio of the two is what specialisation saves.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/librequake.h"
#include "client/client.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "render/renderer.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 180;

gpu::Device* device() {
  static std::unique_ptr<gpu::Device> made = [] {
    auto result = gpu::Device::create({});
    return result ? std::move(*result) : nullptr;
  }();
  return made.get();
}

// A map's first view; no instances where there is no such map.
scene::FrameSnapshot map_snapshot(const std::string& name) {
  scene::FrameSnapshot snapshot;
  fs::FsOptions options;
  options.base_dir = librequake_folder();
  options.user_dir.emplace();
  auto files = fs::FileSystem::open(options);
  if (!files) return snapshot;
  con::Console console;
  scene::ModelLibrary library(files->loader());
  cl::Client client(console, library, files->loader());
  client.set_view_size(kWidth, kHeight);
  if (!client.map_view(name)) return snapshot;
  client.build_snapshot(snapshot);
  return snapshot;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void run(benchmark::State& state, const scene::FrameSnapshot& still, int spp) {
  if (device() == nullptr) return state.SkipWithError("no Vulkan device");
  if (still.instances.empty()) return state.SkipWithError("no game data");
  scene::FrameSnapshot snapshot = still;
  render::RenderSettings settings[2];
  std::unique_ptr<render::Renderer> renderers[2];
  for (int forced = 0; forced < 2; ++forced) {
    settings[forced].spp = spp;
    settings[forced].accumulate = 0;
    settings[forced].force_features = forced;
    auto renderer = render::Renderer::create(*device(), settings[forced]);
    if (!renderer) return state.SkipWithError(renderer.error().message.c_str());
    renderers[forced] = std::move(*renderer);
    renderers[forced]->resize(kWidth, kHeight);
    renderers[forced]->render(snapshot, nullptr, settings[forced]);  // compiles
  }
  std::map<std::string, std::vector<double>> passes;
  std::vector<double> all[2];
  for (auto _ : state) {
    ++snapshot.frame;
    for (int forced = 0; forced < 2; ++forced) {
      renderers[forced]->render(snapshot, nullptr, settings[forced]);
      all[forced].push_back(renderers[forced]->gpu_milliseconds());
      if (forced != 0) continue;
      state.SetIterationTime(renderers[0]->gpu_milliseconds() * 1e-3);
      for (const render::PassTime& pass : renderers[0]->pass_times()) passes[pass.name].push_back(pass.milliseconds);
    }
  }
  for (const auto& [name, times] : passes) state.counters[name + "_ms"] = median(times);
  state.counters["all_ms"] = median(all[0]);
  state.counters["forced_over_plain"] = median(all[1]) / median(all[0]);
  state.SetLabel(device()->report().name + ", " + renderers[0]->intersector_name());
}

void add(const std::string& name, const scene::FrameSnapshot& snapshot) {
  for (const int spp : {1, 2}) {
    benchmark::RegisterBenchmark(("frame/" + name + "/spp:" + std::to_string(spp)).c_str(), run, snapshot, spp)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->MinTime(2.0);
  }
}

}  // namespace
}  // namespace fb::lab

int main(int argc, char** argv) {
  using namespace fb;
  for (const char* map : {"start", "lq_e0m1", "lq_e1m7"}) lab::add(map, lab::map_snapshot(map));
  lab::add("cbox", scene::cornell_box());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
