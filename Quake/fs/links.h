// Symbolic links on the way to a file, followed by hand, so that where they lead is known before anything is opened.
// QuakeC can make no link: one in a game's folder is the user's, or came with a mod's archive. A link that leads out of
// the folder would let a mod read and write what is the user's alone.
#pragma once

#include <filesystem>

#include "base/result.h"

namespace fb::fs {

struct Followed {
  std::filesystem::path path;  // absolute and without links, if one was followed; else folder / name
  bool by_link = false;
};

// `name` below `folder`. Only links in `name` count: those on the way to `folder` are what the user has named. What
// does not exist is no link, so a link to nothing is followed to where the file would be made. Fails on a circle.
Result<Followed> follow_links(const std::filesystem::path& folder, const std::filesystem::path& name);

// Whether a path without links lies in a folder, which may be reached by links.
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace fb::fs
