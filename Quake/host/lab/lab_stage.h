// Shared by the laboratory's commands: options for what is rendered and how, and the renderer and scene that they set
// up.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "host/game/engine.h"
#include "lab/bench/bench_job.h"
#include "lab/frame_source.h"
#include "lab/judge/suite.h"
#include "render/renderer.h"

namespace fb::host {

// A subcommand of fullbright-lab, and the function to run after its options are read; it returns the exit status.
struct LabCommand {
  CLI::App* app = nullptr;
  std::function<int()> run;
};
LabCommand add_render_command(CLI::App& app);
LabCommand add_render_merge_command(CLI::App& app);
LabCommand add_reference_command(CLI::App& app);
LabCommand add_reference_merge_command(CLI::App& app);
LabCommand add_export_command(CLI::App& app);
LabCommand add_compare_command(CLI::App& app);
LabCommand add_ztest_command(CLI::App& app);
// command_line: as it was typed, for the report.
LabCommand add_bench_command(CLI::App& app, std::string command_line);
LabCommand add_iterate_command(CLI::App& app, std::string command_line);
LabCommand add_still_command(CLI::App& app);
LabCommand add_picture_command(CLI::App& app, std::string command_line);
LabCommand add_film_command(CLI::App& app);
LabCommand add_timedemos_command(CLI::App& app);
LabCommand add_suite_command(CLI::App& app);
LabCommand add_suite_merge_command(CLI::App& app);
LabCommand add_report_command(CLI::App& app);
LabCommand add_authored_command(CLI::App& app);
LabCommand add_track_command(CLI::App& app);
LabCommand add_estimators_command(CLI::App& app);
LabCommand add_settings_command(CLI::App& app);
LabCommand add_commands_command(CLI::App& app);

struct StageOptions {
  std::string basedir, demo, map, scene, camera, size = "640x360", device, estimator = "pt", out;
  std::vector<std::string> games, sets;
  double fps = 60.0;
  std::uint32_t spp = 1;
  bool lambert = false, validation = false, quiet = false, timing = false;
};
void add_stage_options(CLI::App& app, StageOptions& options);
// What is seen, as its options say: "--scene cbox --lambert".
std::string view_text(const StageOptions& options);

// Device, settings and frames, ready to render.
struct Stage {
  con::Console own_console;  // for scenes in code, which need no game data
  std::unique_ptr<Engine> engine;
  std::unique_ptr<lab::FrameSource> source;
  std::unique_ptr<gpu::Device> device;
  std::unique_ptr<render::Renderer> renderer;
  render::RenderSettings settings;
  std::optional<scene::Camera> camera;  // --camera's
  uvec2 size{0, 0};

  con::Console& console() { return engine ? engine->console() : own_console; }
};
Status open_stage(Stage& stage, const StageOptions& options);
// The same without a device: settings and frames alone.
Status open_view(Stage& stage, const StageOptions& options);

// The folder that holds a suite's view's id1, or why there is none: one sentence. Empty folders: the base game beside
// the program; FULLBRIGHT_TEST_DATA, else ../shared/librequake.
struct Place {
  std::string basedir, missing;
};
Place place_of(const lab::SuiteView& view, const std::string& basedir, const std::string& librequake);
// What opens such a view in pictures of this size.
StageOptions stage_of(const lab::SuiteView& view, const std::string& basedir, const std::string& device, uvec2 size);

Status known_estimator(const std::string& name, const std::string& option);
// The same, and it may make a reference.
Status unbiased_estimator(const std::string& name, const std::string& option);
// Sets a cvar from "cvar=value"; `option` is named in the error.
Status set_cvar(con::Console& console, const std::string& assignment, const std::string& option);
// What `--config NAME:cvar=value,...` and `--estimators a,b` ask for: a name, and settings as "cvar=value".
struct ConfigurationText {
  std::string name;
  std::vector<std::string> assignments;
};
Result<ConfigurationText> parse_configuration(const std::string& text);
// All of a command's, estimators first, `otherwise` (an estimator) if there is none. No two have one name.
Result<std::vector<ConfigurationText>> parse_configurations(const std::vector<std::string>& estimators,
                                                            const std::vector<std::string>& configurations,
                                                            const std::string& otherwise);
// The console's settings changed by the configuration's; the console itself is not changed. Only the renderer's own
// settings may differ between configurations. `place` is named in errors.
Result<lab::Configuration> configuration_of(con::Console& console, const ConfigurationText& text,
                                            const std::string& place);
std::vector<std::string> split(const std::string& text, char separator);
// Parses "A:B" or "A".
Result<std::pair<std::uint64_t, std::uint64_t>> parse_frames(const std::string& text);
// Parses "I/N"; all of it, 1/1, if empty.
struct Shard {
  std::uint32_t index = 1, count = 1;  // index from 1
};
Result<Shard> parse_shard(const std::string& text);
// Writes to standard output for "-".
Status write_text(const std::string& path, const std::string& text);

// A command that joins what shards have made: folders, and --out.
LabCommand add_merge_command(CLI::App& app, const std::string& name, const std::string& help,
                             const std::string& folders, const std::string& out,
                             std::function<int(const std::vector<std::string>&, const std::string&)> merge);

// Prints the error and returns the exit status.
int fail(const Error& error);
// Reports samples that were not finite. Returns the exit status, which depends on validation messages.
int finish(const Stage& stage);

}  // namespace fb::host
