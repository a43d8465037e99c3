#include "server/simulation/level_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "base/text_mark.h"
#include "formats/mdl.h"
#include "formats/posed_model.h"
#include "formats/spr.h"
#include "fs/path.h"

namespace fb::sv {
namespace {

void log_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) log_warning("{}", warning);
}

// Whether what stands beside a map counts: it may not be from an earlier gamedir.
bool counts_beside(const LevelFiles& files, const std::string& path, const std::string& name) {
  return !files.game_index_of || files.game_index_of(path) >= files.game_index_of(fmt::format("maps/{}.bsp", name));
}

void use_external_visibility(const LevelFiles& files, const std::string& name, formats::Bsp& bsp) {
  const std::string path = fmt::format("maps/{}.vis", name);
  if (!counts_beside(files, path, name)) return;
  const std::optional<FileData> bytes = files.read(path);
  if (!bytes) return;
  auto record = formats::parse_vis(*bytes, path, name + ".bsp", bsp);
  if (!record) return log_warning("{}", record.error().message);
  if (!*record) return;
  bsp.visibility = std::move((*record)->visibility);
  bsp.leafs = std::move((*record)->leafs);
}

// Gives the name of what the entities are from.
std::string use_external_entities(const LevelFiles& files, const std::string& name, formats::Bsp& bsp) {
  const std::string map_path = fmt::format("maps/{}.bsp", name);
  for (const std::string& path :
       {fmt::format("maps/{}@{:04x}.ent", name, bsp.entities_crc), fmt::format("maps/{}.ent", name)}) {
    if (!counts_beside(files, path, name)) continue;
    const std::optional<FileData> bytes = files.read(path);
    if (!bytes) continue;
    if (const Status fits = formats::check_entity_text(bytes->size(), path); !fits) {
      log_warning("{}", fits.error().message);
      continue;
    }
    log_info("{}: entities of the map are from here", path);
    bsp.entities = without_byte_order_mark(bytes->text());
    return path;
  }
  return map_path;
}

// Of a file that must be there. `absent` is what its absence is called.
Result<FileData> read_needed(const LevelFiles& files, const std::string& path, std::string_view absent) {
  if (files.obstacle) {
    if (auto obstacle = files.obstacle(path)) return *std::move(obstacle);
  }
  std::optional<FileData> bytes = files.read(path);
  if (!bytes) return Error{fmt::format("{}: {}", path, absent)};
  return *std::move(bytes);
}

Result<std::shared_ptr<const progs::Program>> load_level_program(const LevelFiles& files) {
  const auto bytes = read_needed(files, "progs.dat", "no such file: without it there is no game");
  if (!bytes) return bytes.error();
  auto program = progs::load_program(*bytes, "progs.dat");
  if (!program) return program.error();
  log_warnings(program->warnings);
  return std::shared_ptr<const progs::Program>(std::make_shared<progs::Program>(std::move(*program)));
}

struct Box {
  vec3 mins{0.0f}, maxs{0.0f};
};

// Quake makes the boxes of brush models a unit larger on each side.
Box brush_box(const formats::BspModel& model) { return {model.mins - vec3(1.0f), model.maxs + vec3(1.0f)}; }

Box alias_box(const formats::Mdl& mdl) {
  if (mdl.vertices.empty()) return {};
  const auto position = [&](const formats::MdlVertex& v) { return vec3(v.x, v.y, v.z) * mdl.scale + mdl.origin; };
  Box box{position(mdl.vertices.front()), position(mdl.vertices.front())};
  for (const formats::MdlVertex& vertex : mdl.vertices) {
    box.mins = glm::min(box.mins, position(vertex));
    box.maxs = glm::max(box.maxs, position(vertex));
  }
  return box;
}

Box posed_box(const formats::PosedModel& model) {
  Box box{model.positions.front(), model.positions.front()};
  for (const vec3& p : model.positions) {
    box.mins = glm::min(box.mins, p);
    box.maxs = glm::max(box.maxs, p);
  }
  return box;
}

// Halves are of whole numbers, cut.
Box sprite_box(const formats::Spr& spr) {
  const vec3 half(spr.max_width / 2, spr.max_width / 2, spr.max_height / 2);
  return {vec3(-spr.max_width / 2, -spr.max_width / 2, -spr.max_height / 2), half};
}

LevelModel with_box(std::string_view name, const Box& box) {
  return {std::string(name), std::nullopt, box.mins, box.maxs};
}

Result<LevelModel> read_brush_model(const FileData& bytes, std::string_view name) {
  auto parsed = formats::parse_bsp(bytes, name);
  if (!parsed) return parsed.error();
  LevelModel model = with_box(name, brush_box(parsed->models.at(0)));
  if (parsed->clip_nodes.empty() && parsed->models[0].head_nodes[0] >= 0) {
    log_warning(
        "{}: a model without clip nodes: nothing wider than a point would meet it; its bounding box blocks instead",
        name);
    return model;
  }
  const auto bsp = std::make_shared<const formats::Bsp>(std::move(*parsed));
  model.brush = BrushModel{bsp, std::make_shared<world::MapHulls>(*bsp), 0};
  return model;
}

Result<LevelModel> read_model(const FileData& bytes, std::string_view name) {
  const std::string_view magic = bytes.text().substr(0, 4);
  if (magic == "IDPO") {
    auto mdl = formats::parse_mdl(bytes, name);
    return mdl ? Result<LevelModel>(with_box(name, alias_box(*mdl))) : mdl.error();
  }
  if (magic == "IDP3" || magic == "MD5V") {  // as it was bound: what animates it stands in another file
    auto posed = magic == "IDP3" ? formats::parse_md3(bytes, name) : formats::parse_md5({bytes.text(), name}, {});
    return posed ? Result<LevelModel>(with_box(name, posed_box(*posed))) : posed.error();
  }
  if (magic == "IDSP") {
    auto spr = formats::parse_spr(bytes, name);
    return spr ? Result<LevelModel>(with_box(name, sprite_box(*spr))) : spr.error();
  }
  return read_brush_model(bytes, name);
}

}  // namespace

Result<std::string> map_name_of(std::string_view typed) {
  const auto normal = fs::normalise(typed);
  if (!normal) return Error{fmt::format("\"{}\" is no name of a map", typed)};
  std::string name = *normal;
  if (fs::ends_with_ignoring_case(name, ".bsp")) name.resize(name.size() - 4);
  if (name.empty() || name.size() > 60) return Error{fmt::format("\"{}\" is no name of a map", typed)};
  return name;
}

Result<LoadedMap> load_map(const LevelFiles& files, std::string_view name) {
  LoadedMap map;
  map.name = name;
  const std::string path = fmt::format("maps/{}.bsp", name);
  const auto bytes = read_needed(files, path, "no such map");
  if (!bytes) return bytes.error();
  auto bsp = formats::parse_bsp(*bytes, path);
  if (!bsp) return bsp.error();
  if (bsp->models.empty()) return Error{fmt::format("{}: a map without a world", path)};
  if (bsp->models.size() >= net::kMaxPrecaches) {
    return Error{
        fmt::format("{}: {} models, of {} that a level may have", path, bsp->models.size(), net::kMaxPrecaches - 1)};
  }
  log_warnings(bsp->warnings);
  use_external_visibility(files, map.name, *bsp);
  map.entities_name = use_external_entities(files, map.name, *bsp);
  auto program = load_level_program(files);
  if (!program) return program.error();
  map.program = std::move(*program);
  map.bsp = std::make_shared<formats::Bsp>(std::move(*bsp));
  return map;
}

std::vector<LevelModel> map_models(const std::string& map_name, const std::shared_ptr<const formats::Bsp>& bsp,
                                   const std::shared_ptr<const world::MapHulls>& hulls) {
  std::vector<LevelModel> models(1);
  for (std::uint32_t i = 0; i < bsp->models.size(); ++i) {
    models.push_back(
        with_box(i == 0 ? fmt::format("maps/{}.bsp", map_name) : fmt::format("*{}", i), brush_box(bsp->models[i])));
    models.back().brush = BrushModel{bsp, hulls, i};
  }
  return models;
}

LevelModel load_model(const FileReader& read, std::string_view name) {
  const std::optional<FileData> bytes = read ? read(name) : std::nullopt;
  if (!bytes) {
    log_warning("{}: no such model", name);
    return with_box(name, {});
  }
  auto model = read_model(*bytes, name);
  if (model) return std::move(*model);
  log_warning("{}", model.error().message);
  return with_box(name, {});
}

}  // namespace fb::sv
