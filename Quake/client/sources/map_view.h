// A map without a server: what its entity lump puts where, as far as it needs no QuakeC.
#pragma once

#include <string_view>

#include "base/result.h"
#include "client/session/session.h"
#include "client/session/view.h"
#include "scene/library/library.h"

namespace fb::cl {

// "start" -> "maps/start.bsp"
std::string map_path(std::string_view name);

// Loads the map and fills a session with the brush entities that a game alone begins with (skill 1, no episode won;
// triggers left out), torches, lamps' styles and fog; sets the view into the first player start. On failure nothing
// changes but, maybe, the library.
Status load_map_view(std::string_view name, scene::ModelLibrary& library, Session& session, View& view);

// Of the worldspawn: fog, how much of it covers the sky, and the sky's name. Keys may begin with _, as tools want those
// that QuakeC does not know. Used by games, too.
void apply_worldspawn(std::string_view entities, std::string_view map_name, const Settings& settings,
                      ClientState& state);

}  // namespace fb::cl
