#include "lab/judge/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "fs/file.h"

namespace fb::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostIncludes = 4;                 // one within the other
constexpr std::uint64_t kMostFrame = 1u << 24u;  // far beyond any demo

// Keeps the order of members; what an object holds twice is an error.
Result<Json> parse(std::string_view text, const std::string& path) {
  std::vector<std::set<std::string>> keys;  // of each object that is open
  std::string twice;
  const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      twice = parsed.get<std::string>();
    return true;
  };
  try {
    Json json = Json::parse(text, watch);
    if (!twice.empty()) return Error{fmt::format("{}: the key \"{}\" is there twice", path, twice)};
    return json;
  } catch (const Json::parse_error& error) {
    return Error{fmt::format("{}: {}", path, error.what())};
  }
}

// Reads members of one object, and tells afterwards which of them nobody asked for. The first error stays.
// `place`: the file and the object in it, for errors.
class Reader {
 public:
  Reader(const Json& object, std::string place) : object_(object), place_(std::move(place)) {
    if (!object.is_object()) fail("an object in { } is wanted");
  }

  std::string text(std::string_view key) {
    const Json* value = take(key);
    if (value == nullptr) return {};
    if (!value->is_string()) return fail(fmt::format("\"{}\": a text is wanted", key)), std::string();
    return value->get<std::string>();
  }
  bool boolean(std::string_view key) {
    const Json* value = take(key);
    if (value == nullptr) return false;
    if (!value->is_boolean()) return fail(fmt::format("\"{}\": true or false is wanted", key)), false;
    return value->get<bool>();
  }
  double number(std::string_view key, double low, double high, double otherwise) {
    const Json* value = take(key);
    return value == nullptr ? otherwise : number_of(*value, key, low, high);
  }
  std::uint64_t whole(const Json& value, std::string_view key, std::uint64_t high) {
    const double number = number_of(value, key, 0, static_cast<double>(high));
    if (number != std::floor(number)) fail(fmt::format("\"{}\": a whole number is wanted", key));
    return static_cast<std::uint64_t>(number);
  }
  double number_of(const Json& value, std::string_view key, double low, double high) {
    if (value.is_number() && value.get<double>() >= low && value.get<double>() <= high) return value.get<double>();
    fail(fmt::format("\"{}\": a number from {} to {} is wanted", key, low, high));
    return low;
  }
  // Null if the member is missing.
  const Json* take(std::string_view key) {
    taken_.emplace_back(key);
    const auto found = object_.find(taken_.back());
    return found == object_.end() ? nullptr : &*found;
  }
  void fail(std::string_view what) {
    if (error_.empty()) error_ = fmt::format("{}: {}", place_, what);
  }
  Status end() {
    if (object_.is_object())
      for (const auto& [key, value] : object_.items())
        if (std::find(taken_.begin(), taken_.end(), key) == taken_.end())
          fail(fmt::format("\"{}\" is no key here; there are {}", key, fmt::join(taken_, ", ")));
    return error_.empty() ? ok_status() : Status(Error{error_});
  }

 private:
  const Json& object_;
  std::string place_, error_;
  std::vector<std::string> taken_;
};

void read_source(Reader& reader, SuiteView& view, const std::filesystem::path& folder) {
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

void read_camera(Reader& reader, SuiteView& view) {
  const Json* camera = reader.take("camera");
  if (camera == nullptr) return;
  if (!camera->is_array() || camera->size() != 6)
    return reader.fail("\"camera\": [x, y, z, pitch, yaw, roll] is wanted");
  for (const Json& part : *camera)
    view.camera += fmt::format("{}{}", view.camera.empty() ? "" : ",", reader.number_of(part, "camera", -1e6, 1e6));
}

void read_frames(Reader& reader, SuiteView& view) {
  const Json* frames = reader.take("frames");
  if (frames == nullptr || !frames->is_array() || frames->size() != 2)
    return reader.fail("\"frames\": [FIRST, LAST] is wanted");
  view.first = reader.whole((*frames)[0], "frames", kMostFrame);
  view.last = reader.whole((*frames)[1], "frames", kMostFrame);
  if (view.last < view.first) reader.fail("\"frames\": the last comes before the first");
  const Json* warmup = reader.take("warmup");
  if (warmup == nullptr) return;
  view.warmup = static_cast<std::uint32_t>(reader.whole(*warmup, "warmup", kMostFrame));
  if (view.warmup > view.first)
    reader.fail(fmt::format("\"warmup\": only {} frames come before the first", view.first));
}

void read_sets(Reader& reader, SuiteView& view) {
  const Json* sets = reader.take("set");
  if (sets == nullptr) return;
  if (!sets->is_object()) return reader.fail("\"set\": {\"cvar\": value} is wanted");
  for (const auto& [cvar, value] : sets->items()) {
    if (!value.is_number() && !value.is_string())
      return reader.fail(fmt::format("\"{}\": a number or a text is wanted", cvar));
    view.sets.push_back(cvar + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
}

bool names_files(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

Result<SuiteView> read_view(const Json& value, const std::string& path, const std::string& place) {
  Reader reader(value, place);
  SuiteView view;
  view.name = reader.text("name");
  if (!names_files(view.name)) reader.fail("\"name\": letters, digits and _ are wanted");
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
  if (depth >= kMostIncludes) return Error{fmt::format("{}: too many suites include each other", path)};
  return add_suite(suite, (std::filesystem::path(path).parent_path() / include).lexically_normal().string(), depth + 1);
}

Status add_suite(Suite& suite, const std::string& path, int depth) {
  const auto bytes = fs::read_whole_file(path);
  if (!bytes) return bytes.error();
  const auto json = parse(bytes->text(), path);
  if (!json) return json.error();
  Reader reader(*json, path);
  if (auto status = add_include(suite, reader, path, depth); !status) return status;
  const Json* views = reader.take("views");
  if (views == nullptr || !views->is_array()) reader.fail("\"views\": [...] is wanted");
  if (auto status = reader.end(); !status) return status;
  for (std::size_t i = 0; i < views->size(); ++i) {
    const std::string place = fmt::format("{}: views[{}]", path, i);
    auto view = read_view((*views)[i], path, place);
    if (!view) return view.error();
    for (const SuiteView& other : suite.views)
      if (other.name == view->name) return Error{fmt::format("{}: {} is there twice", place, view->name)};
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
