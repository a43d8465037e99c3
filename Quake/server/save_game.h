// Saved games: QuakeSpasm's text, version 5, which Quake has had from the start; the re-release's version 6 is read,
// too: it has the game's folder on a line behind the version. Lines: the version; a comment of 39 letters for menus,
// with _ for blanks; the player's 16 spawn parms; the skill; the map; the time; 64 light styles; then the globals and
// each edict in braces, as in maps, a free edict as {}. What was precached while the level ran follows as DarkPlaces,
// QuakeSpasm-Spiked and vkQuake have it: lines in a comment, which QuakeSpasm skips.
//
// Files come from anywhere: reading checks the whole of one before anything of the game that runs is given up.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "progs/entity_text.h"
#include "server/simulation/level.h"

namespace fb::sv {

constexpr int kSaveVersion = 5;  // what is written
constexpr int kRereleaseSaveVersion = 6;
constexpr std::size_t kSaveCommentLength = 39;

struct SaveHeader {
  std::string game;     // of version 6: the folder that was played ("id1"); else empty
  std::string comment;  // as in the file
  std::array<float, 16> spawn_parms{};
  int skill = 1;
  std::string map;
  double time = 0.0;
  std::vector<std::string> light_styles;  // 64
};
struct SavedPrecache {
  bool is_model = false;  // or a sound
  int number = 0;
  std::string name;
};
struct SaveGame {
  SaveHeader header;
  std::string entities;                  // the globals and edicts, as text
  std::vector<SavedPrecache> precaches;  // in their order; other engines list all of the level's
};

// `name` is what errors call the file.
Result<SaveGame> parse_save(std::string_view text, std::string_view name);
std::string write_save(Level& level, const std::array<float, 16>& spawn_parms, int skill);
// "The Slipgate Complex__kills:__3/_22____".
std::string save_comment(std::string_view level_name, int kills, int monsters);

// Reads globals and edicts into a virtual machine whose level has begun: those of the save are in use or free as it
// says, those beyond are freed. Fails where the text is malformed, names what the program has not, or has more edicts
// than the machine.
// `placed` is called as each edict has been read.
using EdictVisitor = std::function<void(EdictId id, const progs::EdictText& text)>;
Status read_saved_entities(progs::Vm& vm, std::string_view entities, std::string_view name,
                           const EdictVisitor& placed = nullptr);

}  // namespace fb::sv
