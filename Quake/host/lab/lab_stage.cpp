#include "host/lab/lab_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include "base/librequake.h"
#include "fs/file.h"
#include "host/base_game.h"
#include "host/lab/lab_numbers.h"
#include "host/options.h"
#include "lab/camera_source.h"
#include "lab/client_source.h"
#include "lab/import/imported_scene.h"
#include "lab/lambert_source.h"
#include "platform/program_directory.h"
#include "render/passes/debug_views.h"

namespace fb::host {
namespace {

Result<std::optional<scene::Camera>> parse_camera(const std::string& text) {
  constexpr int kFarthest = 1000000;  // as far as a map's vertices may be
  if (text.empty()) return std::optional<scene::Camera>();
  scene::Camera camera;
  float* parts[] = {&camera.position.x, &camera.position.y, &camera.position.z,
                    &camera.angles.x,   &camera.angles.y,   &camera.angles.z};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t end = i < 5 ? text.find(',', begin) : text.size();
    const auto number = end == std::string::npos ? std::nullopt : parse_number(text.substr(begin, end - begin));
    if (!number || std::abs(*number) > kFarthest)
      return Error{fmt::format("--camera {}: six numbers x,y,z,pitch,yaw,roll are wanted, each from {} to {}", text,
                               -kFarthest, kFarthest)};
    *parts[i] = static_cast<float>(*number);
    begin = end + 1;
  }
  camera.fov_x = 0;  // the player's
  return std::optional(camera);
}

Status set_cvars(con::Console& console, const StageOptions& o) {
  for (const std::string& assignment : o.sets) {
    if (auto status = set_cvar(console, assignment, "--set " + assignment); !status) return status;
  }
  return ok_status();
}

Status open_source(Stage& stage, const StageOptions& o) {
  const auto camera = parse_camera(o.camera);
  if (!camera) return camera.error();
  stage.camera = *camera;
  if (!o.scene.empty()) {
    render::register_render_cvars(stage.own_console);
    if (auto status = set_cvars(stage.own_console, o); !status) return status;
    const bool imported = lab::is_imported_scene(o.scene);
    std::vector<std::string> left_out;
    auto source = imported ? lab::imported_source(o.scene, &left_out) : lab::code_scene(o.scene, o.fps);
    if (!source) return source.error();
    for (const std::string& sentence : left_out) fmt::print(stderr, "fullbright-lab: {}: {}\n", o.scene, sentence);
    stage.source = std::move(*source);
    if (*camera) stage.source = lab::camera_source(std::move(stage.source), **camera);
    stage.settings = render::read_render_settings(stage.own_console);
    return ok_status();
  }
  std::vector<std::string> arguments;
  if (!o.basedir.empty()) arguments.insert(arguments.end(), {"-basedir", o.basedir});
  for (const std::string& game : o.games) arguments.insert(arguments.end(), {"-game", game});
  auto engine = Engine::create(with_base_game(std::move(arguments)), {.server = false});
  if (!engine) return engine.error();
  stage.engine = std::move(*engine);
  stage.engine->console().set("r_ambient", "0");  // only traced light is measured, unless --set asks for more
  if (auto status = set_cvars(stage.engine->console(), o); !status) return status;
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
  stage.engine->client().authored().show_baked(
      render::shows_baked_light(static_cast<std::uint32_t>(stage.settings.debug_view)));
  return ok_status();
}

// Settings that may differ between configurations: the renderer's own.
bool is_renderers(const std::string& cvar) {
  static const std::set<std::string> names{
#define FB_NAME(type, field, cvar, value, low, high, help) cvar,
      FB_RENDER_SETTINGS(FB_NAME)
#undef FB_NAME
          "r_estimator",
      "r_intersector", "r_arrays", "r_lanes"};
  return names.contains(cvar);
}

}  // namespace

void add_stage_options(CLI::App& app, StageOptions& o) {
  app.add_option("--basedir", o.basedir,
                 "folder that holds id1 (default: the current folder, or the base game where id1 is not there)");
  app.add_option("--game", o.games, "a mod's folder beside id1; may be repeated");
  auto* what = app.add_option_group("view", "the view to render (one of these)");
  what->add_option("--demo", o.demo, "a demo: a file, or a name in the game data");
  what->add_option("--map", o.map, "a map, from its first player start");
  what->add_option("--scene", o.scene,
                   "a built-in scene: " + fmt::format("{}", fmt::join(lab::code_scene_names(), ", ")) +
                       "; with N lights, triangles or moving boxes many:N, triangles:N, movers:N; or a file of "
                       "glTF 2.0 or pbrt-v4: FILE.gltf, FILE.glb, FILE.pbrt");
  what->require_option(1);
  app.add_option("--camera", o.camera, "x,y,z,pitch,yaw,roll of a fixed camera, in the place of the player's");
  add_number(app, "--fps", o.fps, 0.1, 10000.0, "frames per second of game time");
  app.add_option("--estimator", o.estimator, "light transport estimator; `fullbright-lab estimators` lists them")
      ->capture_default_str();
  add_number(app, "--spp", o.spp, 1u, kMostSamples, "samples per pixel and frame");
  app.add_option("--size", o.size, "WIDTHxHEIGHT")->capture_default_str();
  app.add_option("--set", o.sets, "cvar=value, a setting; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--device", o.device, "Vulkan device: part of its name, or its index in `fullbright -listdevices`");
  app.add_flag("--lambert", o.lambert, "no coats, metals and normal maps: materials that other renderers have alike");
  app.add_flag("--validation", o.validation, "enable Vulkan's validation layers");
  app.add_flag("--quiet", o.quiet, "print no progress");
  app.add_flag("--timing", o.timing, "print the median GPU time of each pass");
}

std::string view_text(const StageOptions& o) {
  std::string text = !o.scene.empty() ? "--scene " + o.scene : o.demo.empty() ? "--map " + o.map : "--demo " + o.demo;
  if (!o.camera.empty()) text += " --camera " + o.camera;
  if (o.lambert) text += " --lambert";
  return text;
}

Status open_view(Stage& stage, const StageOptions& o) {
  auto size = parse_size(o.size);
  if (!size) return Error{"--size: " + size.error().message};
  stage.size = *size;
  auto status = open_source(stage, o);
  if (status && o.lambert) stage.source = lab::lambert_source(std::move(stage.source));
  return status;
}

Status open_stage(Stage& stage, const StageOptions& o) {
  if (auto status = open_view(stage, o); !status) return status;
  if (auto status = known_estimator(o.estimator, "--estimator"); !status) return status;
  stage.settings.estimator = o.estimator;
  if (stage.settings.light_scale > 0 && stage.settings.light_scale < 1 && stage.settings.denoise <= 0)
    fmt::print(stderr, "fullbright-lab: r_light_scale is the denoiser's: it counts with --set r_denoise=1\n");
  gpu::DeviceOptions wanted;
  wanted.preferred = o.device;
  wanted.validation = o.validation;
  auto device = gpu::Device::create(wanted);
  if (!device) return device.error();
  stage.device = std::move(*device);
  if (stage.engine) stage.engine->library().set_most_texel_bytes(render::most_texel_bytes(*stage.device));
  auto renderer = render::Renderer::create(*stage.device, stage.settings);
  if (!renderer) return renderer.error();
  stage.renderer = std::move(*renderer);
  return ok_status();
}

Status known_estimator(const std::string& name, const std::string& option) {
  if (render::find_technique(name) != nullptr) return ok_status();
  return Error{fmt::format("{} {}: there is no such estimator; `fullbright-lab estimators` lists them", option, name)};
}

// The console's settings changed by the configuration's; the console itself is not changed.
Result<lab::Configuration> configuration_of(con::Console& console, const ConfigurationText& text,
                                            const std::string& place) {
  lab::Configuration configuration{text.name, {}};
  std::vector<std::pair<std::string, std::string>> before;
  Status status = ok_status();
  for (const std::string& assignment : text.assignments) {
    const std::string name = assignment.substr(0, assignment.find('='));
    if (!console.find_cvar(name)) {
      status = Error{fmt::format("{}: there is no cvar {}", place, name)};
    } else if (!is_renderers(name)) {
      status = Error{fmt::format("{}: {} is not the renderer's; it is set for all alike", place, name)};
    } else {
      before.emplace_back(name, console.cvar(name).string());
      status = set_cvar(console, assignment, place);
    }
    if (!status) break;
  }
  configuration.settings = render::read_render_settings(console);
  for (auto it = before.rbegin(); it != before.rend(); ++it) console.set(it->first, it->second);
  if (!status) return status.error();
  if (auto known = known_estimator(configuration.settings.estimator, place + ":"); !known) return known.error();
  return configuration;
}

Status unbiased_estimator(const std::string& name, const std::string& option) {
  if (auto known = known_estimator(name, option); !known) return known;
  if (render::find_technique(name)->unbiased()) return ok_status();
  return Error{fmt::format("{} {}: it is biased; references need an unbiased one", option, name)};
}

StageOptions stage_of(const lab::SuiteView& view, const std::string& basedir, const std::string& device, uvec2 size) {
  StageOptions stage;
  stage.basedir = basedir;
  stage.scene = view.scene;
  stage.map = view.map;
  stage.demo = view.demo;
  stage.camera = view.camera;
  stage.fps = view.frames_per_second;
  stage.size = fmt::format("{}x{}", size.x, size.y);
  stage.device = device;
  stage.sets = view.sets;
  return stage;
}

Place place_of(const lab::SuiteView& view, const std::string& basedir, const std::string& librequake) {
  using Data = lab::SuiteView::Data;
  std::error_code ignored;
  if (view.data == Data::kNone) return {};
  const bool free = view.data == Data::kGame;
  std::string folder = free ? basedir : librequake;
  if (folder.empty() && free) folder = find_base_game(platform::program_directory()).string();
  if (folder.empty() && !free) folder = librequake_folder().string();
  if (!folder.empty() && std::filesystem::is_directory(std::filesystem::path(folder) / "id1", ignored))
    return {folder, ""};
  if (free)
    return {"", fmt::format("{}: skipped, there is no base game beside the program; --basedir names its folder",
                            view.name)};
  return {"",
          fmt::format("{}: skipped, there is no LibreQuake in {}; --librequake names its folder", view.name, folder)};
}

Status set_cvar(con::Console& console, const std::string& assignment, const std::string& option) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) return Error{fmt::format("{}: cvar=value is wanted", option)};
  const std::string name = assignment.substr(0, equals), value = assignment.substr(equals + 1);
  con::Cvar* cvar = console.find_cvar(name);
  if (!cvar) return Error{fmt::format("{}: there is no cvar {}", option, name)};
  if (!cvar->has_effect()) return Error{fmt::format("{}: {}: {}", option, name, cvar->spec().help)};
  if ((cvar->spec().flags & con::kCvarRom) != 0) return Error{fmt::format("{}: {} is read-only", option, name)};
  // What the cvar would be now is no matter: the program ends.
  if (const std::string sentence = cvar->set(value); !sentence.empty())
    return Error{fmt::format("{}: {}", option, sentence.substr(0, sentence.find(", so it ")))};
  return ok_status();
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

Result<ConfigurationText> parse_configuration(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == 0 || colon == std::string::npos)
    return Error{fmt::format("--config {}: NAME:cvar=value,... is wanted", text)};
  ConfigurationText configuration{text.substr(0, colon), split(text.substr(colon + 1), ',')};
  for (const std::string& assignment : configuration.assignments)
    if (assignment.find('=') == std::string::npos)
      return Error{fmt::format("--config {}: {}: cvar=value is wanted", text, assignment)};
  return configuration;
}

Result<std::vector<ConfigurationText>> parse_configurations(const std::vector<std::string>& estimators,
                                                            const std::vector<std::string>& configurations,
                                                            const std::string& otherwise) {
  std::vector<ConfigurationText> list;
  const auto add_estimator = [&](const std::string& name) { list.push_back({name, {"r_estimator=" + name}}); };
  for (const std::string& names : estimators)
    for (const std::string& name : split(names, ',')) add_estimator(name);
  for (const std::string& text : configurations) {
    auto configuration = parse_configuration(text);
    if (!configuration) return configuration.error();
    list.push_back(std::move(*configuration));
  }
  if (list.empty()) add_estimator(otherwise);
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (list[i].name == list[k].name) return Error{fmt::format("{}: two configurations of that name", list[i].name)};
  return list;
}

Result<std::pair<std::uint64_t, std::uint64_t>> parse_frames(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto first = parse_whole_number_unsigned(std::string_view(text).substr(0, colon));
  const auto last =
      colon == std::string::npos ? first : parse_whole_number_unsigned(std::string_view(text).substr(colon + 1));
  if (first && last && *last < *first)
    return Error{fmt::format("--frames {}: the last comes before the first; FIRST:LAST is wanted", text)};
  if (!first || !last || *last > kMostFrames)
    return Error{fmt::format("--frames {}: FIRST:LAST is wanted, whole numbers from 0 to {}", text, kMostFrames)};
  return std::pair(*first, *last);
}

Result<Shard> parse_shard(const std::string& text) {
  if (text.empty()) return Shard{};
  const std::size_t slash = text.find('/');
  const auto index = parse_whole_number_unsigned(std::string_view(text).substr(0, slash));
  const auto count = parse_whole_number_unsigned(slash == text.npos ? "" : std::string_view(text).substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > 100000)
    return Error{fmt::format("--shard {}: I/N is wanted, I from 1 to N", text)};
  return Shard{static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(*count)};
}

Status write_text(const std::string& path, const std::string& text) {
  if (path != "-") return fs::write_output(path, text);
  fmt::print("{}", text);
  return ok_status();
}

LabCommand add_merge_command(CLI::App& app, const std::string& name, const std::string& help,
                             const std::string& folders, const std::string& out,
                             std::function<int(const std::vector<std::string>&, const std::string&)> merge) {
  struct Options {
    std::vector<std::string> folders;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("FOLDERS", options->folders, folders)->required();
  command->add_option("--out", options->out, out)->required();
  return {command, [options, merge] { return merge(options->folders, options->out); }};
}

int fail(const Error& error) {
  fmt::print(stderr, "fullbright-lab: {}\n", error.message);
  return 1;
}

int finish(const Stage& stage) {
  if (const std::uint32_t lost = stage.renderer->read().counters().not_finite; lost > 0) {
    fmt::print(stderr, "fullbright-lab: {} samples were not finite and counted as zero\n", lost);
  }
  return stage.device->validation_messages() == 0 ? 0 : 1;
}

}  // namespace fb::host
