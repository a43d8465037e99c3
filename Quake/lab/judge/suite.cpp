#include "lab/judge/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "fs/file.h"
#include "lab/json_value.h"

namespace fb::lab {
namespace {

constexpr int kMostIncludes = 4;                 // one within the other
constexpr std::uint64_t kMostFrame = 1u << 24u;  // far beyond any demo

// Reads members of one object, and tells afterwards which of them nobody asked for. The first error stays.
class Reader {
 public:
  Reader(const JsonValue& object, std::string path) : object_(object), path_(std::move(path)) {
    if (object.kind != JsonValue::Kind::kObject) fail(object.line, "an object in { } is wanted");
  }

  std::string text(std::string_view key) {
    const JsonValue* value = take(key);
    if (value == nullptr) return {};
    if (value->kind != JsonValue::Kind::kText) fail(value->line, fmt::format("\"{}\": a text is wanted", key));
    return value->text;
  }
  bool boolean(std::string_view key) {
    const JsonValue* value = take(key);
    if (value == nullptr) return false;
    if (value->kind != JsonValue::Kind::kBoolean)
      fail(value->line, fmt::format("\"{}\": true or false is wanted", key));
    return value->boolean;
  }
  double number(std::string_view key, double low, double high, double otherwise) {
    const JsonValue* value = take(key);
    return value == nullptr ? otherwise : number_of(*value, key, low, high);
  }
  std::uint64_t whole(const JsonValue& value, std::string_view key, std::uint64_t high) {
    const double number = number_of(value, key, 0, static_cast<double>(high));
    if (number != std::floor(number)) fail(value.line, fmt::format("\"{}\": a whole number is wanted", key));
    return static_cast<std::uint64_t>(number);
  }
  double number_of(const JsonValue& value, std::string_view key, double low, double high) {
    if (value.kind == JsonValue::Kind::kNumber && value.number >= low && value.number <= high) return value.number;
    fail(value.line, fmt::format("\"{}\": a number from {} to {} is wanted", key, low, high));
    return low;
  }
  // Null if the member is missing.
  const JsonValue* take(std::string_view key) {
    taken_.emplace_back(key);
    return object_.find(key);
  }
  int line() const { return object_.line; }
  void fail(int line, std::string_view what) {
    if (error_.empty()) error_ = fmt::format("{}:{}: {}", path_, line, what);
  }
  Status end() {
    for (const auto& [key, value] : object_.members)
      if (std::find(taken_.begin(), taken_.end(), key) == taken_.end())
        fail(value.line, fmt::format("\"{}\" is no key here; there are {}", key, fmt::join(taken_, ", ")));
    return error_.empty() ? ok_status() : Status(Error{error_});
  }

 private:
  const JsonValue& object_;
  std::string path_, error_;
  std::vector<std::string> taken_;
};

void read_source(Reader& reader, SuiteView& view, const std::filesystem::path& folder) {
  view.scene = reader.text("scene");
  view.map = reader.text("map");
  view.demo = reader.text("demo");
  if (int{!view.scene.empty()} + int{!view.map.empty()} + int{!view.demo.empty()} != 1)
    reader.fail(reader.line(), "one of \"scene\", \"map\" and \"demo\" is wanted");
  std::error_code ignored;
  if (!view.demo.empty() && std::filesystem::is_regular_file(folder / view.demo, ignored))
    view.demo = (folder / view.demo).lexically_normal().string();
  const std::string data = reader.text("data");
  if (view.scene.empty()) view.data = SuiteView::Data::kGame;
  if (data == "librequake" && view.scene.empty())
    view.data = SuiteView::Data::kLibreQuake;
  else if (!data.empty())
    reader.fail(reader.line(), "\"data\" is librequake, for a map or a demo, or left out: the base game");
}

void read_camera(Reader& reader, SuiteView& view) {
  const JsonValue* camera = reader.take("camera");
  if (camera == nullptr) return;
  if (camera->kind != JsonValue::Kind::kArray || camera->items.size() != 6)
    return reader.fail(camera->line, "\"camera\": [x, y, z, pitch, yaw, roll] is wanted");
  for (const JsonValue& part : camera->items)
    view.camera += fmt::format("{}{}", view.camera.empty() ? "" : ",", reader.number_of(part, "camera", -1e6, 1e6));
}

void read_frames(Reader& reader, SuiteView& view) {
  const JsonValue* frames = reader.take("frames");
  if (frames == nullptr || frames->kind != JsonValue::Kind::kArray || frames->items.size() != 2)
    return reader.fail(frames != nullptr ? frames->line : reader.line(), "\"frames\": [FIRST, LAST] is wanted");
  view.first = reader.whole(frames->items[0], "frames", kMostFrame);
  view.last = reader.whole(frames->items[1], "frames", kMostFrame);
  if (view.last < view.first) reader.fail(frames->line, "\"frames\": the last comes before the first");
  const JsonValue* warmup = reader.take("warmup");
  if (warmup == nullptr) return;
  view.warmup = static_cast<std::uint32_t>(reader.whole(*warmup, "warmup", kMostFrame));
  if (view.warmup > view.first)
    reader.fail(warmup->line, fmt::format("\"warmup\": only {} frames come before the first", view.first));
}

void read_sets(Reader& reader, SuiteView& view) {
  const JsonValue* sets = reader.take("set");
  if (sets == nullptr) return;
  if (sets->kind != JsonValue::Kind::kObject) return reader.fail(sets->line, "\"set\": {\"cvar\": value} is wanted");
  for (const auto& [cvar, value] : sets->members) {
    if (value.kind != JsonValue::Kind::kNumber && value.kind != JsonValue::Kind::kText)
      return reader.fail(value.line, fmt::format("\"{}\": a number or a text is wanted", cvar));
    view.sets.push_back(cvar + "=" + value.text);
  }
}

bool names_files(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

Result<SuiteView> read_view(const JsonValue& value, const std::string& path) {
  Reader reader(value, path);
  SuiteView view;
  view.name = reader.text("name");
  if (!names_files(view.name)) reader.fail(value.line, "\"name\": letters, digits and _ are wanted");
  read_source(reader, view, std::filesystem::path(path).parent_path());
  read_camera(reader, view);
  read_frames(reader, view);
  read_sets(reader, view);
  view.frames_per_second = reader.number("fps", 0.1, 10000, 60);
  view.quick = reader.boolean("quick");
  if (auto status = reader.end(); !status) return status.error();
  return view;
}

Status add_suite(Suite& suite, const std::string& path, int depth);

Status add_include(Suite& suite, Reader& reader, const std::string& path, int depth) {
  const std::string include = reader.text("include");
  if (include.empty()) return ok_status();
  if (depth >= kMostIncludes)
    return Error{fmt::format("{}:{}: too many suites include each other", path, reader.line())};
  return add_suite(suite, (std::filesystem::path(path).parent_path() / include).lexically_normal().string(), depth + 1);
}

Status add_suite(Suite& suite, const std::string& path, int depth) {
  const auto bytes = fs::read_whole_file(path);
  if (!bytes) return bytes.error();
  const auto json = parse_json(bytes->text(), path);
  if (!json) return json.error();
  Reader reader(*json, path);
  if (auto status = add_include(suite, reader, path, depth); !status) return status;
  const JsonValue* views = reader.take("views");
  if (views == nullptr || views->kind != JsonValue::Kind::kArray) reader.fail(json->line, "\"views\": [...] is wanted");
  if (auto status = reader.end(); !status) return status;
  for (const JsonValue& item : views->items) {
    auto view = read_view(item, path);
    if (!view) return view.error();
    for (const SuiteView& other : suite.views)
      if (other.name == view->name) return Error{fmt::format("{}:{}: {} is there twice", path, item.line, view->name)};
    suite.views.push_back(std::move(*view));
  }
  return ok_status();
}

}  // namespace

Result<Suite> read_suite(const std::string& path) {
  Suite suite;
  if (auto status = add_suite(suite, path, 0); !status) return status.error();
  if (suite.views.empty()) return Error{fmt::format("{}: holds no view", path)};
  return suite;
}

}  // namespace fb::lab
