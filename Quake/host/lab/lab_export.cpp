// fullbright-lab export: a frame as a glTF scene.
#include <fmt/format.h>

#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "host/options.h"
#include "lab/gltf/gltf_export.h"

namespace fb::host {
namespace {

struct ExportOptions {
  StageOptions stage;
  std::uint64_t frame = 0;
};

int run_export(const ExportOptions& options) {
  Stage stage;
  if (auto status = open_view(stage, options.stage); !status) return fail(status.error());
  scene::FrameSnapshot snapshot;
  for (std::uint64_t frame = 0; frame <= options.frame; ++frame) {
    const auto more = stage.source->next(snapshot);
    if (!more) return fail(more.error());
    if (!*more)
      return fail(Error{fmt::format("--frame {}: the demo has {} frames at this rate", options.frame, frame)});
  }
  const auto summary =
      lab::export_gltf(snapshot, stage.settings, stage.size, options.stage.out, "fullbright-lab " + version_text());
  if (!summary) return fail(summary.error());
  fmt::print("{}: {} triangles, {} materials, {} images\n", options.stage.out, summary->triangles, summary->materials,
             summary->images);
  for (const std::string& sentence : summary->missing) fmt::print("  {}\n", sentence);
  return 0;
}

}  // namespace

LabCommand add_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "writes a frame as a glTF 2.0 scene, which Blender opens");
  add_stage_options(*command, options->stage);
  add_number(*command, "--frame", options->frame, std::uint64_t{0}, std::uint64_t{kMostFrames},
             "number of the frame, from 0");
  command->add_option("--out", options->stage.out, "the scene: FILE.gltf, with FILE.bin beside it, or FILE.glb")
      ->required()
      ->check([](const std::string& path) {
        return path.ends_with(".gltf") || path.ends_with(".glb") ? "" : "a name that ends with .gltf or .glb is wanted";
      });
  return {command, [options] { return run_export(*options); }};
}

}  // namespace fb::host
