// The saved games of the game that is played, as menus list them.
#pragma once

#include <string_view>
#include <vector>

#include "fs/filesystem.h"
#include "ui/menu/facts.h"

namespace fb::host {

constexpr int kSaveSlots = 20;  // s0 to s19, as in QuakeSpasm

// A saved game's text. A file that is broken has one sentence in `failure`.
ui::menu::SaveEntry describe_save(std::string_view name, std::string_view text);
// The slots in order, the player's other saves by name, then the autosaves by name.
std::vector<ui::menu::SaveEntry> list_saves(const fs::FileSystem& files);

}  // namespace fb::host
