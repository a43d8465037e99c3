// Names of game files: relative, with forward slashes, as "maps/start.bsp". They come from maps, mods and servers, so a
// name that could refer to something outside the game's directories is refused here, for all callers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fb::fs {

// The normalised name: backslashes become slashes, "./" and doubled slashes are removed. nullopt for a name that cannot
// be a game file: an empty or absolute one, one with "..", a colon or a control character.
std::optional<std::string> normalise(std::string_view name);

// Whether a gamedir's name is valid: one directory name, by QuakeSpasm's rules: not empty, not ".", without "..", '/',
// '\\' and ':'.
bool is_game_name(std::string_view name);

// Converts ASCII letters only, on which all file systems that ignore case agree.
std::string lower_case(std::string_view text);
bool ends_with_ignoring_case(std::string_view text, std::string_view ending);

}  // namespace fb::fs
