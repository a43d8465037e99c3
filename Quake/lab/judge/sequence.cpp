#include "lab/judge/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "base/number.h"
#include "lab/judge/program.h"

namespace fb::lab {
namespace {

// The last line that says something, of a program that failed.
std::string last_line(const std::string& output) {
  const std::size_t end = output.find_last_not_of("\r\n ");
  if (end == std::string::npos) return "no message";
  const std::size_t begin = output.find_last_of('\n', end);
  return output.substr(begin == std::string::npos ? 0 : begin + 1,
                       end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

Status run_render(const SequenceRequest& request, const std::string& format, std::string& output) {
  auto end = run_program(render_arguments(request, format));
  if (!end) return end.error();
  if (end->status != 0) {
    return Error{fmt::format("{}, {}: {} render ended with status {}: {}", request.view->name, request.lane->name,
                             request.lane->program.path, end->status, last_line(end->output))};
  }
  output = std::move(end->output);
  return ok_status();
}

// A folder that is gone at the end, with all that is in it.
struct ScratchFolder {
  std::string path;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

}  // namespace

Result<Program> open_program(std::string name, std::string path) {
  const auto end = run_program({path, "render", "--help"});
  if (!end) return end.error();
  if (end->status != 0 || end->output.find("--denoised") == std::string::npos)
    return Error{fmt::format("{}: is no fullbright-lab with a render command that takes --denoised", path)};
  const bool both = end->output.find("{png,exr,both}") != std::string::npos;
  return Program{std::move(name), std::move(path), both};
}

std::vector<std::string> render_arguments(const SequenceRequest& request, const std::string& format) {
  const SuiteView& view = *request.view;
  const Lane& lane = *request.lane;
  std::vector<std::string> arguments{lane.program.path, "render", "--quiet", "--timing", "--denoised"};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  add("--scene", view.scene);
  add("--map", view.map);
  add("--demo", view.demo);
  if (view.scene.empty()) add("--basedir", request.basedir);
  add("--device", request.device);
  if (!view.camera.empty()) arguments.push_back("--camera=" + view.camera);  // may begin with a minus
  add("--fps", fmt::format("{}", view.frames_per_second));
  add("--estimator", lane.estimator);
  add("--spp", std::to_string(lane.spp));
  add("--size", fmt::format("{}x{}", request.width, request.height));
  add("--frames", fmt::format("{}:{}", view.first - view.warmup, view.last));
  for (const auto* sets : {&view.sets, &lane.sets, &request.sets})
    for (const std::string& assignment : *sets) add("--set", assignment);
  add("--format", format);
  add("--out", request.folder);
  return arguments;
}

PassTimes parse_times(const std::string& output) {
  PassTimes times;
  bool kinds = false;
  for (std::size_t begin = 0; begin < output.size();) {
    const std::size_t end = std::min(output.find('\n', begin), output.size());
    const std::string_view line = std::string_view(output).substr(begin, end - begin);
    begin = end + 1;
    const std::size_t unit = line.find(" ms a frame");
    if (unit == std::string_view::npos) continue;
    const std::size_t number = line.find_last_of(' ', unit - 1) + 1;
    const auto milliseconds = parse_number(line.substr(number, unit - number));
    if (!milliseconds) continue;
    const std::size_t name_end = line.find_last_not_of(' ', number - 1);
    PassTimes::Pass pass{std::string(line.substr(0, name_end + 1)), *milliseconds, line.ends_with(kEstimatorsPass)};
    if (pass.name == "all") {
      times.all = pass.milliseconds;
      continue;
    }
    kinds = kinds || pass.estimators;
    times.passes.push_back(std::move(pass));
  }
  for (PassTimes::Pass& pass : times.passes) {
    const std::string_view name = pass.name;
    if (!kinds) pass.estimators = name == "paths" || name.starts_with("guide ");
    if (pass.estimators) times.paths += pass.milliseconds;
    if (name == "gbuffer") times.gbuffer += pass.milliseconds;
    if (name.starts_with("denoise")) times.denoiser += pass.milliseconds;
  }
  return times;
}

Result<std::vector<JudgedFrame>> read_frames(const SequenceRequest& request) {
  std::vector<JudgedFrame> frames;
  for (std::uint64_t frame = request.view->first; frame <= request.view->last; ++frame) {
    const std::string path = fmt::format("{}/frame_{:06}", request.folder, frame);
    auto shown = read_png_picture(path + ".png");
    if (!shown) return shown.error();
    if (shown->width != request.width || shown->height != request.height)
      return Error{fmt::format("{}.png: {}x{} pixels, {}x{} were asked for", path, shown->width, shown->height,
                               request.width, request.height)};
    auto linear = read_exr_picture(path + ".exr");
    if (!linear) return linear.error();
    JudgedFrame& judged = frames.emplace_back(JudgedFrame{std::move(*shown), std::nullopt});
    if (linear->content.mean.same_size(judged.shown)) judged.linear = std::move(linear->content.mean);
  }
  return frames;
}

Result<Sequence> run_sequence(const SequenceRequest& request) {
  const ScratchFolder scratch{request.folder};
  Sequence sequence;
  std::string output;
  if (request.lane->program.writes_both) {
    if (auto status = run_render(request, "both", output); !status) return status.error();
  } else {
    for (const char* format : {"exr", "png"})
      if (auto status = run_render(request, format, output); !status) return status.error();
  }
  sequence.times = parse_times(output);
  auto frames = read_frames(request);
  if (!frames) return frames.error();
  sequence.frames = std::move(*frames);
  return sequence;
}

}  // namespace fb::lab
