// A level's entities from its map's text: Quake's ED_LoadFromFile.
#pragma once

#include <string_view>

#include "base/result.h"
#include "progs/entity_text.h"
#include "server/simulation/level.h"

namespace fb::sv {

struct SpawnRules {
  int skill = 1;  // 0 to 3; things may be left out on 0, on 1, and on 2 and 3
  bool deathmatch = false;
  bool no_monsters = false;  // leave out what is called monster_...
};

// Makes an edict of each entity, the first being the world, and calls the function of its classname. Entities that the
// rules leave out, and those without a class or a function for it, are freed, the latter two with a line in the log.
// `name` is what errors call the text. Fails where the text is none of entities, where there are more than max_edicts,
// and where QuakeC goes wrong.
Status spawn_entities(Level& level, std::string_view text, std::string_view name, const SpawnRules& rules);

// Alpha and scale as the text of an edict has them, which mods need no fields for (QuakeSpasm).
void take_looks(Level& level, EdictId id, const progs::EdictText& text);

}  // namespace fb::sv
