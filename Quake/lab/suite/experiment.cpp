#include "lab/suite/experiment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/hash.h"

namespace fb::lab {
namespace {

constexpr std::uint64_t kMostSide = 16384, kMostValues = 64, kMostRepeats = 1000, kMostReference = 1u << 24u;

uvec2 read_size(JsonReader& reader, const Json& value, const std::string& key) {
  if (!value.is_array() || value.size() != 2) {
    reader.fail(key, fmt::format("\"{}\": [WIDTH, HEIGHT] is wanted", key));
    return uvec2(1);
  }
  const uvec2 size(reader.whole_of(value[0], key, kMostSide), reader.whole_of(value[1], key, kMostSide));
  if (size.x == 0 || size.y == 0) reader.fail(key, fmt::format("\"{}\": a picture has at least one pixel", key));
  return size;
}

Result<std::vector<ExperimentConfiguration>> read_configurations(const JsonFile& file, const Json& object) {
  JsonReader reader(file, object);
  std::vector<ExperimentConfiguration> list;
  if (object.is_object())
    for (const auto& [name, value] : object.items()) list.push_back({name, reader.settings(name)});
  if (list.empty()) reader.fail("{\"NAME\": {\"cvar\": value}} is wanted, at least one");
  if (auto status = reader.end(); !status) return status.error();
  return list;
}

void read_values(JsonReader& vary, Experiment::Vary& out) {
  const Json* values = vary.take("values");
  const Json* sizes = vary.take("sizes");
  const Json* schedules = vary.take("schedules");
  const Json* list = values != nullptr ? values : sizes != nullptr ? sizes : schedules;
  const int lists = int{values != nullptr} + int{sizes != nullptr} + int{schedules != nullptr};
  if (lists != 1 || !list->is_array() || list->empty() || list->size() > kMostValues)
    return vary.fail(
        fmt::format("\"values\": [...], \"sizes\": [[WIDTH, HEIGHT], ...] or \"schedules\": [\"1,1,2\", ...] is "
                    "wanted, up to {}",
                    kMostValues));
  out.values.clear();
  for (const Json& value : *list) {
    if (values != nullptr) {
      out.values.push_back(vary.number_of(value, "values", -1e9, 1e9));
    } else if (schedules != nullptr) {
      const auto schedule = parse_schedule(value.is_string() ? value.get<std::string>() : "");
      if (!schedule) return vary.fail("schedules", schedule.error().message);
      out.values.push_back(out.what == "iterations" ? static_cast<double>(schedule->size()) : samples_of(*schedule));
      out.schedules.push_back(*schedule);
    } else {
      out.sizes.push_back(read_size(vary, value, "sizes"));
      out.values.push_back(static_cast<double>(out.sizes.back().x) * out.sizes.back().y);
    }
  }
}

Status read_vary(const JsonFile& file, JsonReader& reader, Experiment& experiment) {
  const Json* object = reader.take("vary");
  if (object == nullptr) return ok_status();
  JsonReader vary(file, *object);
  Experiment::Vary& out = experiment.vary;
  out.what = vary.text("what");
  out.setting = vary.text("setting");
  out.scene = vary.text("scene");
  read_values(vary, out);
  if (out.what.empty()) vary.fail("\"what\" is wanted: the name of what is varied");
  const int how =
      int{!out.setting.empty()} + int{!out.scene.empty()} + int{!out.sizes.empty()} + int{!out.schedules.empty()};
  if (out.of_time() ? how != 0 : how != 1)
    vary.fail("one of \"setting\", \"scene\", \"sizes\" and \"schedules\" is wanted; none where \"what\" is \"time\"");
  if (out.of_time() && std::ranges::any_of(out.values, [](double value) { return value <= 0; }))
    vary.fail("\"values\" of time are milliseconds above 0");
  return vary.end();
}

// What all experiments have unless they say otherwise.
struct Defaults {
  Experiment experiment;
  std::vector<std::string> sets;
};

void read_common(JsonReader& reader, Experiment& e) {
  if (const Json* size = reader.take("size")) e.size = read_size(reader, *size, "size");
  e.repeats = static_cast<std::uint32_t>(reader.whole("repeats", 1, kMostRepeats, e.repeats));
  e.reference_samples =
      static_cast<std::uint32_t>(reader.whole("reference_samples", 32, kMostReference, e.reference_samples));
  if (const std::string estimator = reader.text("reference_estimator"); !estimator.empty())
    e.reference_estimator = estimator;
  e.errors = reader.boolean("errors", e.errors);
  e.picture = reader.boolean("picture", e.picture);
}

Result<Experiment> read_experiment(const JsonFile& file, const Json& object, const Defaults& defaults,
                                   const std::string& place) {
  JsonReader reader(file, object, place);
  Experiment e = defaults.experiment;
  e.name = reader.text("name");
  if (!names_files(e.name)) reader.fail("name", "\"name\": letters, digits and _ are wanted");
  e.title = reader.text("title");
  e.source = reader.text("source");
  e.paper = reader.text("paper");
  e.differs = reader.text("differs");
  read_common(reader, e);
  e.hold = reader.boolean("hold");
  if (const Json* configurations = reader.take("configurations")) {
    auto read = read_configurations(file, *configurations);
    if (!read) return read.error();
    e.configurations = std::move(*read);
  }
  if (e.configurations.empty()) reader.fail("\"configurations\" are wanted, here or for the whole suite");
  if (auto status = read_vary(file, reader, e); !status) return status.error();
  if (const Json* view = reader.take("view")) {
    auto read = read_suite_view(file, *view, place + ": view");
    if (!read) return read.error();
    e.view = std::move(*read);
  } else {
    reader.fail("\"view\" is wanted");
  }
  e.view.sets.insert(e.view.sets.begin(), defaults.sets.begin(), defaults.sets.end());
  if (e.vary.of_schedules()) {
    e.hold = true;  // a picture in iterations stands still
    if (!e.errors) reader.fail("vary", "\"schedules\" and \"errors\": false: pictures in iterations are measured");
  }
  if (auto status = reader.end(); !status) return status.error();
  return e;
}

// All that a view says, wherever the file is read from.
std::string text_of(const SuiteView& view) {
  return fmt::format("{} {} {} {}", view_title(view), view.camera, view.frames_per_second, fmt::join(view.sets, " "));
}

// An experiment of each view that is judged.
Status add_judged(const JsonFile& file, const Json& object, const Defaults& defaults, ExperimentSuite& suite) {
  JsonReader reader(file, object, "judge");
  const std::string views = reader.text("views");
  const bool quick = reader.boolean("quick");
  if (views.empty()) reader.fail("\"views\" is wanted: a file of views, such as picture.json");
  if (defaults.experiment.configurations.empty()) reader.fail("\"configurations\" are wanted for the whole suite");
  if (!defaults.experiment.errors) reader.fail("\"errors\": false leaves nothing to judge");
  if (auto status = reader.end(); !status) return status;
  auto read = read_suite((std::filesystem::path(file.path()).parent_path() / views).lexically_normal().string());
  if (!read) return read.error();
  for (SuiteView& view : read->views) {
    if (quick && !view.quick) continue;
    Experiment e = defaults.experiment;
    e.name = view.name;
    e.title = view_title(view);
    e.judged = true;
    view.sets.insert(view.sets.begin(), defaults.sets.begin(), defaults.sets.end());
    const std::string text = text_of(view);
    suite.hash = hash_bytes(text.data(), text.size(), suite.hash);
    e.view = std::move(view);
    suite.experiments.push_back(std::move(e));
  }
  return ok_status();
}

}  // namespace

Result<ExperimentSuite> read_experiments(const std::string& path) {
  const auto file = JsonFile::read(path);
  if (!file) return file.error();
  JsonReader reader(*file, file->json());
  ExperimentSuite suite;
  const std::string text = file->json().dump();
  suite.hash = hash_bytes(text.data(), text.size());
  suite.title = reader.text("title");
  Defaults defaults;
  read_common(reader, defaults.experiment);
  defaults.sets = reader.settings("set");
  if (const Json* configurations = reader.take("configurations")) {
    auto read = read_configurations(*file, *configurations);
    if (!read) return read.error();
    defaults.experiment.configurations = std::move(*read);
  }
  const Json* judge = reader.take("judge");
  const Json* list = reader.take("experiments");
  if (list == nullptr ? judge == nullptr : !list->is_array() || list->empty())
    reader.fail("\"experiments\": [...] is wanted, or \"judge\": {...}");
  if (auto status = reader.end(); !status) return status.error();
  if (judge != nullptr)
    if (auto status = add_judged(*file, *judge, defaults, suite); !status) return status.error();
  std::set<std::string> names;
  for (const Experiment& e : suite.experiments) names.insert(e.name);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    auto experiment = read_experiment(*file, (*list)[i], defaults, fmt::format("experiments[{}]", i));
    if (!experiment) return experiment.error();
    if (!names.insert(experiment->name).second)
      return Error{
          fmt::format("{}: line {}: {} is there twice", path, file->line((*list)[i], "name"), experiment->name)};
    suite.experiments.push_back(std::move(*experiment));
  }
  return suite;
}

std::vector<Piece> pieces_of(const ExperimentSuite& suite) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < suite.experiments.size(); ++i)
    for (std::size_t value = 0; value < suite.experiments[i].vary.values.size(); ++value)
      for (std::uint32_t repeat = 0; repeat < suite.experiments[i].repeats; ++repeat)
        pieces.push_back({i, value, repeat});
  return pieces;
}

std::string piece_name(const ExperimentSuite& suite, const Piece& piece) {
  return fmt::format("{}.{}.{}", suite.experiments[piece.experiment].name, piece.value, piece.repeat);
}

SuiteView view_at(const Experiment& experiment, std::size_t value) {
  SuiteView view = experiment.view;
  const double number = experiment.vary.values[value];
  if (!experiment.vary.setting.empty()) view.sets.push_back(fmt::format("{}={}", experiment.vary.setting, number));
  if (!experiment.vary.scene.empty()) view.scene = fmt::format("{}:{:.0f}", experiment.vary.scene, number);
  return view;
}

uvec2 size_at(const Experiment& experiment, std::size_t value) {
  return experiment.vary.sizes.empty() ? experiment.size : experiment.vary.sizes[value];
}

}  // namespace fb::lab
