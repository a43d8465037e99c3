// Names of game files: relative, with forward slashes, as "maps/start.bsp". They come from maps, mods and servers, so
// whatever could name something outside the game's directories is refused here, once.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fb::fs {

// The name in its one form: backslashes become slashes, "./" and doubled slashes vanish. nullopt for what cannot be a
// game file: an empty name, an absolute one, one with "..", a colon, a control character.
std::optional<std::string> normalise(std::string_view name);

// A gamedir is one directory's name, as QuakeSpasm has it: not empty, not ".", without "..", '/', '\\' and ':'.
bool is_game_name(std::string_view name);

// ASCII only: what file systems without case agree on.
std::string lower_case(std::string_view text);
bool ends_with_ignoring_case(std::string_view text, std::string_view ending);

}  // namespace fb::fs
