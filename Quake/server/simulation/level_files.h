// What a level is made of, from game files: the map with what replaces parts of it, the program, models' boxes and
// hulls.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/file_data.h"
#include "base/result.h"
#include "formats/bsp.h"
#include "progs/program.h"
#include "server/simulation/level.h"

namespace fb::sv {

using FileReader = FileLoader;

// As FileSystem::obstacle: why a file that is there cannot be read.
using ObstacleFinder = std::function<std::optional<Error>(std::string_view name)>;

struct LevelFiles {
  FileReader read;
  // As FileSystem::game_index_of. This and the next may be absent.
  std::function<int(std::string_view name)> game_index_of;
  ObstacleFinder obstacle;
};

// A map's name as `map` takes it: "e1m1", also of "e1m1.bsp". Fails for what can name no file below maps/.
Result<std::string> map_name_of(std::string_view typed);

struct LoadedMap {
  std::string name;                         // "e1m1"
  std::shared_ptr<const formats::Bsp> bsp;  // its `entities` are those of entities_name
  std::string entities_name;                // the map, or the .ent file that replaces its lump
  std::shared_ptr<const progs::Program> program;
};
// maps/NAME.bsp with, where there are any, maps/NAME.vis and maps/NAME@CRC.ent or maps/NAME.ent (unless the game that
// they are from comes before the map's), and progs.dat.
Result<LoadedMap> load_map(const LevelFiles& files, std::string_view name);

// The models that a level has from the start: its world, then "*1" and on. [0] is nothing. `hulls` are bsp's.
std::vector<LevelModel> map_models(const std::string& map_name, const std::shared_ptr<const formats::Bsp>& bsp,
                                   const std::shared_ptr<const world::MapHulls>& hulls);

// A model for the precache list. Its box is what QuakeSpasm's setmodel gives: of all poses' vertices (.mdl), of the
// largest frame (.spr), of the first model and a unit more (.bsp). A .bsp brings its hulls. A file that is absent or
// malformed: a warning, and a box of nothing.
LevelModel load_model(const FileReader& read, std::string_view name);

}  // namespace fb::sv
