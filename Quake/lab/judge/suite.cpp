#include "lab/judge/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace fb::lab {
namespace {

constexpr int kMostIncludes = 4;                 // one within the other
constexpr std::uint64_t kMostFrame = 1u << 24u;  // far beyond any demo

void read_source(JsonReader& reader, SuiteView& view, const std::filesystem::path& folder) {
  view.scene = reader.text("scene");
  view.map = reader.text("map");
  view.demo = reader.text("demo");
  if (int{!view.scene.empty()} + int{!view.map.empty()} + int{!view.demo.empty()} != 1)
    reader.fail("one of \"scene\", \"map\" and \"demo\" is wanted");
  std::error_code ignored;
  if (!view.demo.empty() && std::filesystem::is_regular_file(folder / view.demo, ignored))
    view.demo = (folder / view.demo).lexically_normal().string();
  const std::string data = reader.text("data");
  if (view.scene.empty()) view.data = SuiteView::Data::kGame;
  if (data == "librequake" && view.scene.empty())
    view.data = SuiteView::Data::kLibreQuake;
  else if (!data.empty())
    reader.fail("\"data\" is librequake, for a map or a demo, or left out: the base game");
}

void read_camera(JsonReader& reader, SuiteView& view) {
  const Json* camera = reader.take("camera");
  if (camera == nullptr) return;
  if (!camera->is_array() || camera->size() != 6)
    return reader.fail("\"camera\": [x, y, z, pitch, yaw, roll] is wanted");
  for (const Json& part : *camera)
    view.camera += fmt::format("{}{}", view.camera.empty() ? "" : ",", reader.number_of(part, "camera", -1e6, 1e6));
}

void read_frames(JsonReader& reader, SuiteView& view) {
  const Json* frames = reader.take("frames");
  if (frames == nullptr || !frames->is_array() || frames->size() != 2)
    return reader.fail("\"frames\": [FIRST, LAST] is wanted");
  view.first = reader.whole_of((*frames)[0], "frames", kMostFrame);
  view.last = reader.whole_of((*frames)[1], "frames", kMostFrame);
  if (view.last < view.first) reader.fail("\"frames\": the last comes before the first");
  const Json* warmup = reader.take("warmup");
  if (warmup == nullptr) return;
  view.warmup = static_cast<std::uint32_t>(reader.whole_of(*warmup, "warmup", kMostFrame));
  if (view.warmup > view.first)
    reader.fail(fmt::format("\"warmup\": only {} frames come before the first", view.first));
}

Status add_suite(Suite& suite, const std::string& path, int depth);

Status add_include(Suite& suite, JsonReader& reader, const std::string& path, int depth) {
  const std::string include = reader.text("include");
  if (include.empty()) return ok_status();
  if (depth >= kMostIncludes) return Error{fmt::format("{}: too many suites include each other", path)};
  return add_suite(suite, (std::filesystem::path(path).parent_path() / include).lexically_normal().string(), depth + 1);
}

Status add_suite(Suite& suite, const std::string& path, int depth) {
  const auto file = JsonFile::read(path);
  if (!file) return file.error();
  JsonReader reader(*file, file->json());
  if (auto status = add_include(suite, reader, path, depth); !status) return status;
  const Json* views = reader.take("views");
  if (views == nullptr || !views->is_array()) reader.fail("\"views\": [...] is wanted");
  if (auto status = reader.end(); !status) return status;
  for (std::size_t i = 0; i < views->size(); ++i) {
    const Json& value = (*views)[i];
    auto view = read_suite_view(*file, value, fmt::format("views[{}]", i));
    if (!view) return view.error();
    for (const SuiteView& other : suite.views)
      if (other.name == view->name)
        return Error{fmt::format("{}: line {}: {} is there twice", path, file->line(value, "name"), view->name)};
    suite.views.push_back(std::move(*view));
  }
  return ok_status();
}

}  // namespace

bool names_files(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

std::string view_title(const SuiteView& view) {
  const std::string what = !view.scene.empty() ? view.scene
                           : !view.map.empty() ? view.map
                                               : std::filesystem::path(view.demo).filename().string();
  const char* kind = !view.scene.empty() ? "scene" : !view.map.empty() ? "map" : "demo";
  const std::string after = view.warmup > 0 ? fmt::format("after {} of warm-up", view.warmup) : "from a cold start";
  return fmt::format("{}: {} {}, frames {} to {} {}", view.name, kind, what, view.first, view.last, after);
}

Result<SuiteView> read_suite_view(const JsonFile& file, const Json& value, const std::string& place) {
  JsonReader reader(file, value, place);
  SuiteView view;
  view.name = reader.text("name");
  if (!names_files(view.name)) reader.fail("name", "\"name\": letters, digits and _ are wanted");
  read_source(reader, view, std::filesystem::path(file.path()).parent_path());
  read_camera(reader, view);
  read_frames(reader, view);
  view.sets = reader.settings("set");
  view.frames_per_second = reader.number("fps", 0.1, 10000, 60);
  view.quick = reader.boolean("quick");
  if (auto status = reader.end(); !status) return status.error();
  return view;
}

Result<Suite> read_suite(const std::string& path) {
  Suite suite;
  if (auto status = add_suite(suite, path, 0); !status) return status.error();
  if (suite.views.empty()) return Error{fmt::format("{}: holds no view", path)};
  return suite;
}

}  // namespace fb::lab
