#include "lab/suite/suite_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "fs/file.h"
#include "lab/suite/fit.h"
#include "lab/suite/judged_piece.h"

namespace fb::lab {
namespace {

constexpr const char* kManifestFormat = "fullbright suite 1";

struct Member {
  const char* name;
  std::string Manifest::*value;
};
constexpr Member kMembers[] = {
    {"suite", &Manifest::suite},   {"program", &Manifest::program},         {"device", &Manifest::device},
    {"driver", &Manifest::driver}, {"intersector", &Manifest::intersector}, {"overrides", &Manifest::overrides}};

Json json_of(const Manifest& manifest) {
  Json json{{"format", kManifestFormat}};
  for (const Member& member : kMembers) json[member.name] = manifest.*member.value;
  return json;
}

Status write_json(const std::string& path, const Json& json) {
  return fs::write_text_atomically(path, json_text(json, 1));
}

Result<Manifest> read_manifest(const std::string& path) {
  const auto file = JsonFile::read(path);
  if (!file) return file.error();
  JsonReader reader(*file, file->json());
  if (reader.text("format") != kManifestFormat) return Error{fmt::format("{}: these are no results of a suite", path)};
  Manifest manifest;
  for (const Member& member : kMembers) manifest.*member.value = reader.text(member.name);
  return manifest;
}

Status same(const Manifest& a, const Manifest& b, const std::string& where) {
  for (const Member& member : kMembers) {
    if (a.*member.value == b.*member.value) continue;
    const bool settings = member.value == &Manifest::overrides;
    return Error{fmt::format("{}: the results there are of another {} ({}; now {}): choose another folder{}", where,
                             settings ? "set of options" : member.name, a.*member.value, b.*member.value,
                             settings ? ", or give the same options" : "")};
  }
  return ok_status();
}

Json vary_of(const Experiment& experiment) {
  if (experiment.vary.what.empty()) return nullptr;
  Json json{{"what", experiment.vary.what}, {"values", experiment.vary.values}};
  for (const Schedule& schedule : experiment.vary.schedules) json["schedules"].push_back(schedule_text(schedule));
  return json;
}

Json description_of(const Experiment& e) {
  Json json{{"name", e.name}, {"title", e.title.empty() ? e.name : e.title}};
  for (const auto& [key, text] :
       {std::pair("source", &e.source), std::pair("paper", &e.paper), std::pair("differs", &e.differs)})
    if (!text->empty()) json[key] = *text;
  json["view"] = e.view.name;
  json["size"] = {e.size.x, e.size.y};
  json["vary"] = vary_of(e);
  if (e.judged) json["judge"] = true;
  if (e.errors) json["reference"] = {{"estimator", e.reference_estimator}, {"samples", e.reference_samples}};
  Json configurations = Json::array();
  for (const ExperimentConfiguration& c : e.configurations)
    configurations.push_back({{"name", c.name}, {"set", c.sets}});
  json["configurations"] = std::move(configurations);
  return json;
}

// How the time follows what is varied.
Json fits_of(const Experiment& e, const Json& points) {
  Json fits = Json::array();
  if (e.vary.values.size() < 3) return fits;
  for (const ExperimentConfiguration& c : e.configurations) {
    for (const char* time : {"estimator", "frame"}) {
      std::vector<double> x, y;
      for (const Json& point : points) {
        if (point["configuration"] != c.name) continue;
        x.push_back(point["value"].get<double>());
        y.push_back(point["milliseconds"][time].get<double>());
      }
      if (const auto fit = fit_power(x, y))
        fits.push_back({{"configuration", c.name},
                        {"of", time},
                        {"exponent", fit->value},
                        {"low", fit->interval.low},
                        {"high", fit->interval.high}});
    }
  }
  return fits;
}

std::string csv_line(const std::string& experiment, const Json& point) {
  const auto error = [&](const char* name, const char* otherwise = "") {
    if (!point.contains("errors")) return std::string();
    const Json& errors = point["errors"];
    const char* there = errors.contains(name) ? name : otherwise;
    return errors.contains(there) ? errors[there].dump() : std::string();
  };
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", experiment, point["configuration"].get<std::string>(),
                     point["value"].dump(), point["repeat"].dump(), point["samples"].dump(), point["frames"].dump(),
                     point["milliseconds"]["estimator"].dump(), point["milliseconds"]["frame"].dump(),
                     error("mse_corrected"), error("relmse_corrected", info(kRelMse).key), error(info(kFlip).key));
}

}  // namespace

Result<SuiteFolder> SuiteFolder::open(const std::string& path, const Manifest& manifest) {
  std::error_code failed;
  std::filesystem::create_directories(std::filesystem::path(path) / "pieces", failed);
  if (failed) return Error{fmt::format("{}: {}", path, failed.message())};
  const std::string file = path + "/manifest.json";
  if (std::filesystem::exists(file, failed)) {
    const auto there = read_manifest(file);
    if (!there) return there.error();
    SuiteFolder begun;
    begun.path_ = path;
    const bool empty = begun.piece_names().empty();  // nothing was measured: a mistyped setting ended it
    auto status = empty ? write_json(file, json_of(manifest)) : same(*there, manifest, path);
    if (!status) return status.error();
  } else if (auto status = write_json(file, json_of(manifest)); !status) {
    return status.error();
  }
  SuiteFolder folder;
  folder.path_ = path;
  folder.manifest_ = manifest;
  return folder;
}

Result<SuiteFolder> SuiteFolder::existing(const std::string& path) {
  auto manifest = read_manifest(path + "/manifest.json");
  if (!manifest) return manifest.error();
  SuiteFolder folder;
  folder.path_ = path;
  folder.manifest_ = std::move(*manifest);
  return folder;
}

bool SuiteFolder::has(const std::string& piece) const {
  std::error_code ignored;
  return std::filesystem::exists(fmt::format("{}/pieces/{}.json", path_, piece), ignored);
}

Result<Json> SuiteFolder::piece(const std::string& name) const {
  const std::string path = fmt::format("{}/pieces/{}.json", path_, name);
  const auto file = JsonFile::read(path);
  if (!file) return Error{file.error().message + "; delete it, and the suite makes that piece again"};
  return file->json();
}

std::vector<std::string> SuiteFolder::piece_names() const {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(path_) / "pieces", ignored))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

std::string SuiteFolder::picture_path(const std::string& piece, const std::string& configuration) const {
  return fmt::format("{}/pieces/{}.{}.exr", path_, piece, configuration);
}

Status SuiteFolder::add(const std::string& piece, const Json& json) const {
  return write_json(fmt::format("{}/pieces/{}.json", path_, piece), json);
}

Status SuiteFolder::write_results(const ExperimentSuite& suite, const std::string& command, double load) const {
  Json results{{"format", "fullbright suite results 1"}, {"title", suite.title}, {"command", command}};
  results["manifest"] = json_of(manifest_);
  if (load >= 0) results["manifest"]["load"] = load;
  std::vector<Json> points(suite.experiments.size(), Json::array());
  std::map<std::size_t, std::map<std::size_t, std::string>> scenes;  // of an experiment's values
  std::vector<double> reference_errors(suite.experiments.size(), 0.0);
  std::vector<Json> truths(suite.experiments.size());  // of judged experiments
  bool complete = true;
  for (const Piece& piece : pieces_of(suite)) {
    const std::string name = piece_name(suite, piece);
    if (!has(name)) {
      complete = false;
      continue;
    }
    const auto json = this->piece(name);
    if (!json) return json.error();
    const auto scene = (*json)["scene"].get<std::string>();
    const auto [first, fresh] = scenes[piece.experiment].try_emplace(piece.value, scene);
    if (first->second != scene)
      return Error{fmt::format("{}: {} looked at another scene than its like: the game data differ", path_, name)};
    reference_errors[piece.experiment] =
        std::max(reference_errors[piece.experiment], json->value("reference_error", 0.0));
    for (const Json& point : (*json)["points"]) points[piece.experiment].push_back(point);
    if (suite.experiments[piece.experiment].judged) truths[piece.experiment] = (*json)["truth"];
  }
  results["complete"] = complete;
  Json experiments = Json::array();
  std::vector<ViewFigures> judged;
  std::vector<const Experiment*> judged_of;
  std::string csv = "experiment,configuration,value,repeat,samples,frames,estimator_ms,frame_ms,mse,relmse,flip\n";
  for (std::size_t i = 0; i < suite.experiments.size(); ++i) {
    Json experiment = description_of(suite.experiments[i]);
    experiment["command"] = fmt::format("{} --experiments {}", command, suite.experiments[i].name);
    if (suite.experiments[i].errors) experiment["reference"]["relative_error"] = reference_errors[i];
    experiment["fits"] = fits_of(suite.experiments[i], points[i]);
    if (suite.experiments[i].judged && !points[i].empty()) {
      judged.push_back(judged_figures(suite.experiments[i], points[i], truths[i]));
      judged_of.push_back(&suite.experiments[i]);
      experiment["truth"] = truths[i];
      experiment["judged"] = judged_estimates(suite.experiments[i], judged.back());
    }
    for (const Json& point : points[i]) csv += csv_line(suite.experiments[i].name, point);
    experiment["points"] = std::move(points[i]);
    experiments.push_back(std::move(experiment));
  }
  results["experiments"] = std::move(experiments);
  if (!judged.empty()) results["judged"] = judged_summary(judged_of, judged);
  results["skipped"] = Json::array();
  for (const auto& [experiment, why] : skipped_)
    results["skipped"].push_back({{"experiment", experiment}, {"why", why}});
  if (auto status = write_json(path_ + "/results.json", results); !status) return status;
  return fs::write_text_atomically(path_ + "/results.csv", csv);
}

Status SuiteFolder::copy_from(const SuiteFolder& other, const std::string& piece) const {
  std::error_code failed;
  const auto options = std::filesystem::copy_options::overwrite_existing;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(other.path_) / "pieces", failed)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(piece + ".") && !name.ends_with(".json")) files.push_back(entry.path());
  }
  files.push_back(std::filesystem::path(other.path_) / "pieces" / (piece + ".json"));  // last: it says that it is whole
  for (const std::filesystem::path& file : files) {
    std::filesystem::copy_file(file, std::filesystem::path(path_) / "pieces" / file.filename(), options, failed);
    if (failed) return Error{fmt::format("{}: {}", file.string(), failed.message())};
  }
  return ok_status();
}

Status merge_shards(const ExperimentSuite& suite, const std::vector<std::string>& folders, const std::string& to,
                    const std::string& command, const std::string& overrides) {
  std::vector<SuiteFolder> shards;
  std::map<std::string, const SuiteFolder*> from;
  for (const std::string& path : folders) {
    auto shard = SuiteFolder::existing(path);
    if (!shard) return shard.error();
    if (!shards.empty())
      if (auto status = same(shards.front().manifest(), shard->manifest(), path); !status) return status;
    shards.push_back(std::move(*shard));
  }
  // What describes the results must be what they were measured by.
  Manifest asked = shards.front().manifest();
  asked.suite = fmt::format("{:016x}", suite.hash);
  asked.overrides = overrides;
  if (auto status = same(shards.front().manifest(), asked, folders.front()); !status) return status;
  for (const SuiteFolder& shard : shards) {
    for (const std::string& piece : shard.piece_names()) {
      const auto [there, fresh] = from.try_emplace(piece, &shard);
      if (!fresh) return Error{fmt::format("{}: piece {} is in {}, too", shard.path(), piece, there->second->path())};
    }
  }
  std::vector<std::string> missing;
  std::set<std::string> wanted;
  for (const Piece& piece : pieces_of(suite)) {
    const std::string name = piece_name(suite, piece);
    wanted.insert(name);
    if (!from.contains(name)) missing.push_back(name);
  }
  constexpr std::size_t kNamed = 8;
  if (!missing.empty())
    return Error{
        fmt::format("{} of {} pieces are missing: {}{}", missing.size(), wanted.size(),
                    fmt::join(missing.begin(),
                              missing.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, missing.size())), ", "),
                    missing.size() > kNamed ? " ..." : "")};
  for (const auto& [piece, shard] : from)
    if (!wanted.contains(piece)) return Error{fmt::format("{}: the suite has no piece {}", shard->path(), piece)};
  auto merged = SuiteFolder::open(to, shards.front().manifest());
  if (!merged) return merged.error();
  for (const auto& [piece, shard] : from)
    if (auto status = merged->copy_from(*shard, piece); !status) return status;
  return merged->write_results(suite, command, -1.0);
}

}  // namespace fb::lab
