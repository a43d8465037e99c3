// fullbright-lab: render | reference | estimators.
#include <algorithm>
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "host/engine.h"
#include "host/options.h"
#include "lab/client_source.h"
#include "lab/jobs.h"
#include "render/renderer.h"

namespace {

using namespace fb;

// What render and reference have in common.
struct StageOptions {
  std::string basedir, demo, map, scene, camera, size = "640x360", device, estimator = "pt", out;
  std::vector<std::string> games, sets;
  double fps = 60.0;
  std::uint32_t spp = 1;
  bool validation = false, quiet = false, timing = false;
};

void add_stage_options(CLI::App& app, StageOptions& o) {
  app.add_option("--basedir", o.basedir, "folder that holds id1");
  app.add_option("--game", o.games, "a mod's folder beside id1; several count");
  auto* what = app.add_option_group("what", "what to show");
  what->add_option("--demo", o.demo, "a recorded demo: a file, or the game's by name");
  what->add_option("--map", o.map, "a map's world, from its first player start");
  what->add_option("--scene", o.scene,
                   "a scene made in code: " + fmt::format("{}", fmt::join(lab::code_scene_names(), ", ")));
  what->require_option(1);
  app.add_option("--camera", o.camera, "x,y,z,pitch,yaw,roll instead of the player's eyes");
  app.add_option("--fps", o.fps, "frames a second of the demo's time")
      ->check(CLI::Range(0.1, 10000.0))
      ->capture_default_str();
  app.add_option("--estimator", o.estimator, "one of `fullbright-lab estimators`")->capture_default_str();
  app.add_option("--spp", o.spp, "samples a pixel")->check(CLI::Range(1u, 1u << 24u))->capture_default_str();
  app.add_option("--size", o.size, "WIDTHxHEIGHT")->capture_default_str();
  app.add_option("--set", o.sets, "cvar=value; several count")->expected(1)->take_all()->allow_extra_args(false);
  app.add_option("--device", o.device, "part of a device's name, or its index");
  app.add_flag("--validation", o.validation, "Vulkan's validation layers");
  app.add_flag("--quiet", o.quiet, "no progress");
  app.add_flag("--timing", o.timing, "print the GPU time of every pass, median over the frames");
}

Result<std::optional<scene::Camera>> parse_camera(const std::string& text) {
  if (text.empty()) return std::optional<scene::Camera>();
  scene::Camera camera;
  float* parts[] = {&camera.position.x, &camera.position.y, &camera.position.z,
                    &camera.angles.x,   &camera.angles.y,   &camera.angles.z};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t end = i < 5 ? text.find(',', begin) : text.size();
    const auto number = end == std::string::npos ? std::nullopt : con::parse_number(text.substr(begin, end - begin));
    if (!number) return Error{fmt::format("--camera {}: six numbers x,y,z,pitch,yaw,roll are wanted", text)};
    *parts[i] = *number;
    begin = end + 1;
  }
  camera.fov_x = 0;  // the player's
  return std::optional(camera);
}

// Device, settings and frames, ready to be rendered.
struct Stage {
  con::Console own_console;  // for scenes in code, which need no game data
  std::unique_ptr<host::Engine> engine;
  std::unique_ptr<lab::FrameSource> source;
  std::unique_ptr<gpu::Device> device;
  std::unique_ptr<render::Renderer> renderer;
  render::RenderSettings settings;
  uvec2 size{0, 0};
};

Status set_cvars(con::Console& console, const StageOptions& o) {
  for (const std::string& assignment : o.sets) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) return Error{fmt::format("--set {}: cvar=value is wanted", assignment)};
    const std::string name = assignment.substr(0, equals), value = assignment.substr(equals + 1);
    if (!console.find_cvar(name)) return Error{fmt::format("--set {}: there is no cvar {}", assignment, name)};
    if (!console.set(name, value)) return Error{fmt::format("--set {}: the value was not taken", assignment)};
  }
  return ok_status();
}

Status open_source(Stage& stage, const StageOptions& o) {
  if (!o.scene.empty()) {
    render::register_render_cvars(stage.own_console);
    if (auto status = set_cvars(stage.own_console, o); !status) return status;
    auto source = lab::code_scene(o.scene, o.fps);
    if (!source) return source.error();
    stage.source = std::move(*source);
    stage.settings = render::read_render_settings(stage.own_console);
    return ok_status();
  }
  std::vector<std::string> arguments;
  if (!o.basedir.empty()) arguments.insert(arguments.end(), {"-basedir", o.basedir});
  for (const std::string& game : o.games) arguments.insert(arguments.end(), {"-game", game});
  auto engine = host::Engine::create(arguments);
  if (!engine) return engine.error();
  stage.engine = std::move(*engine);
  if (auto status = set_cvars(stage.engine->console(), o); !status) return status;
  auto camera = parse_camera(o.camera);
  if (!camera) return camera.error();
  lab::ClientSourceOptions options;
  options.frames_per_second = o.fps;
  options.camera = *camera;
  options.width = static_cast<int>(stage.size.x);
  options.height = static_cast<int>(stage.size.y);
  auto source = o.demo.empty() ? lab::map_source(stage.engine->client(), o.map, options)
                               : lab::demo_source(stage.engine->client(), o.demo, options);
  if (!source) return source.error();
  stage.source = std::move(*source);
  stage.settings = render::read_render_settings(stage.engine->console());
  return ok_status();
}

Status open_stage(Stage& stage, const StageOptions& o) {
  auto size = host::parse_size(o.size);
  if (!size) return Error{"--size: " + size.error().message};
  stage.size = *size;
  if (auto status = open_source(stage, o); !status) return status;
  const auto& known = render::estimators();
  if (std::none_of(known.begin(), known.end(), [&](const auto& e) { return e.name == o.estimator; })) {
    return Error{
        fmt::format("--estimator {}: there is no such estimator; `fullbright-lab estimators` lists them", o.estimator)};
  }
  stage.settings.estimator = o.estimator;
  gpu::DeviceOptions wanted;
  wanted.preferred = o.device;
  wanted.validation = o.validation;
  auto device = gpu::Device::create(wanted);
  if (!device) return device.error();
  stage.device = std::move(*device);
  auto renderer = render::Renderer::create(*stage.device, stage.settings);
  if (!renderer) return renderer.error();
  stage.renderer = std::move(*renderer);
  return ok_status();
}

// "A:B" or "A".
Result<std::pair<std::uint64_t, std::uint64_t>> parse_frames(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto first = con::parse_number(text.substr(0, colon));
  const auto last = colon == std::string::npos ? first : con::parse_number(text.substr(colon + 1));
  if (!first || !last || *first < 0 || *last < *first || *last > 1e7f || *first != std::floor(*first) ||
      *last != std::floor(*last)) {
    return Error{fmt::format("--frames {}: FIRST:LAST is wanted, whole numbers from 0", text)};
  }
  return std::pair(static_cast<std::uint64_t>(*first), static_cast<std::uint64_t>(*last));
}

int fail(const Error& error) {
  fmt::print(stderr, "fullbright-lab: {}\n", error.message);
  return 1;
}

int finish(const Stage& stage) {
  if (const std::uint32_t lost = stage.renderer->nan_count(); lost > 0) {
    fmt::print(stderr, "fullbright-lab: {} samples were not finite and counted as zero\n", lost);
  }
  return stage.device->validation_messages() == 0 ? 0 : 1;
}

int run_render(const StageOptions& o, const std::string& frames, const std::string& format, bool hash) {
  auto range = parse_frames(frames);
  if (!range) return fail(range.error());
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  lab::RenderJob job;
  std::tie(job.first, job.last) = *range;
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.spp = o.spp;
  job.out = o.out;
  job.format = format == "exr" ? lab::ImageFormat::kExr : lab::ImageFormat::kPng;
  job.hash = hash;
  job.quiet = o.quiet;
  const auto summary = lab::render_frames(*stage.source, *stage.renderer, stage.settings, job);
  if (!summary) return fail(summary.error());
  if (o.timing) {
    double total = 0;
    for (const auto& pass : summary->passes) {
      total += pass.median();
      fmt::print("{:12} {:9.3f} ms a frame, first {:.0f}\n", pass.name, pass.median(), pass.milliseconds.front());
    }
    fmt::print("{:12} {:9.3f} ms a frame (sum of the passes' medians)\n", "all", total);
  }
  if (!o.out.empty() && !o.quiet) fmt::print("{} frames in {}\n", summary->frames, o.out);
  return finish(stage);
}

int run_reference(const StageOptions& o, std::uint64_t frame) {
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  lab::ReferenceJob job;
  job.frame = frame;
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.spp = o.spp;
  job.out = o.out;
  job.quiet = o.quiet;
  const auto summary = lab::render_reference(*stage.source, *stage.renderer, stage.settings, job);
  if (!summary) return fail(summary.error());
  fmt::print("{}: mean luminance {:.6g}, pixels' standard error {:.3g} of it\n", o.out, summary->mean_luminance,
             summary->relative_error);
  return finish(stage);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The laboratory of Fullbright: chosen frames and references, without a window.", "fullbright-lab");
  app.set_version_flag("--version", fb::host::version_text());
  app.require_subcommand(1);

  StageOptions stage;
  std::string frames = "0:0", format = "png";
  bool hash = false;
  CLI::App* render = app.add_subcommand("render", "renders chosen frames at fixed time steps, in order");
  add_stage_options(*render, stage);
  render->add_option("--frames", frames, "FIRST:LAST, counted from 0")->capture_default_str();
  render->add_option("--out", stage.out, "folder for the frames; none: nothing is written");
  render->add_option("--format", format, "png or exr (linear)")
      ->check(CLI::IsMember({"png", "exr"}))
      ->capture_default_str();
  render->add_flag("--hash", hash, "print one hash a frame of the linear image");

  std::uint64_t frame = 0;
  CLI::App* reference =
      app.add_subcommand("reference", "accumulates many samples of one frame, with their variance, to an EXR file");
  add_stage_options(*reference, stage);
  reference->add_option("--frame", frame, "counted from 0")->capture_default_str();
  reference->add_option("--out", stage.out, "the .exr file")->required();

  CLI::App* list = app.add_subcommand("estimators", "lists the estimators");
  CLI11_PARSE(app, argc, argv);

  if (*list) {
    for (const auto& e : fb::render::estimators())
      fmt::print("{:8} {}{}\n", e.name, e.unbiased ? "" : "(biased) ", e.description);
    return 0;
  }
  return *render ? run_render(stage, frames, format, hash) : run_reference(stage, frame);
}
