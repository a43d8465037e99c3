// A suite: the views that the judge looks at, read from a small JSON file (Misc/docs/formats.md).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "lab/json_reader.h"

namespace fb::lab {

// Letters, digits and _: what names files.
bool names_files(std::string_view name);

struct SuiteView {
  enum class Data { kNone, kGame, kLibreQuake };
  std::string name;                   // letters, digits and _: it names files
  std::string scene, map, demo;       // one of them, as `render` takes it
  Data data = Data::kNone;            // whose game data; none for scenes in code
  std::string camera;                 // "x,y,z,pitch,yaw,roll"; empty: the player's
  double frames_per_second = 60;      // of game time
  std::vector<std::string> sets;      // "cvar=value", for the reference, too
  std::uint64_t first = 0, last = 0;  // frames that are judged, inclusive
  std::uint32_t warmup = 0;           // frames before them that are rendered, at most `first`; 0: `first` follows a cut
  bool quick = false;                 // in the quick selection, too
  std::uint64_t frames() const { return last - first + 1; }
};

struct Suite {
  std::vector<SuiteView> views;
};

// "hub_300: demo hub.dem, frames 300 to 301 after 32 of warm-up".
std::string view_title(const SuiteView& view);

// One view, an object of a file. Demos are taken relative to the file's folder where they are there, else as names in
// the game data.
Result<SuiteView> read_suite_view(const JsonFile& file, const Json& value, const std::string& place);
// A suite may include others: their views come first. Fails with the file, the line and the cause.
Result<Suite> read_suite(const std::string& path);

}  // namespace fb::lab
