// What the menus show of the rest of the program: saved games, maps, mods, servers. The host knows these; the menus
// know no host.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "formats/image.h"

namespace fb::ui::menu {

constexpr int kSavePictureWidth = 160, kSavePictureHeight = 90;  // pixels

struct SaveEntry {
  std::string name;  // for save and load: "s0"
  bool used = false;
  std::string failure{};  // one sentence: why a file that exists cannot be read
  std::string place{};    // "The Slipgate Complex"
  std::string kills{};    // "3/22"
  double seconds = 0.0;
  bool automatic = false;  // the game has saved itself
};
struct MapEntry {
  std::string name, title;     // "e1m1", "The Slipgate Complex"
  bool chooses_skill = false;  // it has places where the player chooses
};
struct ModEntry {
  std::string directory, description;
  bool active = false;
};
// A mod's archive that can be installed.
struct ArchiveEntry {
  std::string name;       // "ad.zip"
  std::string mod;        // its folder: "ad"
  std::string size;       // of the archive, "12.0 MiB"
  std::string facts{};    // "400 files, 30.0 MiB unpacked"
  std::string failure{};  // one sentence: why it cannot be installed
  bool replaces = false;  // the mod is there already
};
struct InstallState {
  std::string going_on;  // the folder of the mod that is being installed; empty: none
  int percent = 0;
  std::string installed, failure;  // how the last one ended: its folder, or one sentence
  std::string folder;              // where archives are looked for
};
struct PresetEntry {
  std::string name, purpose;
};
struct ServerEntry {
  std::string name, map, address;
  int players = 0, max_players = 0;
  bool compatible = true;
};

class Facts {
 public:
  virtual ~Facts() = default;
  // Whether there is a game of the player's own that would be lost.
  virtual bool in_game() const = 0;
  // Why the game cannot be saved now; empty if it can.
  virtual std::string reason_not_to_save() const = 0;
  virtual std::vector<SaveEntry> saves() = 0;  // 20 slots, s0 to s19, other saves, then automatic ones
  // The picture that was taken when this was saved, of the size above; nothing where there is none.
  virtual std::optional<formats::RgbaImage> save_picture(const std::string& name) = 0;
  // The save that a dead player may go back to; empty: there is none.
  virtual std::string save_after_death() const = 0;
  // All maps that can be played; their titles may come later, with another revision.
  virtual std::vector<MapEntry> maps() = 0;
  // Those among them where a game begins: "start" and what a mod calls so. Complete at once.
  virtual std::vector<MapEntry> start_maps() = 0;
  virtual std::vector<std::string> demos() = 0;
  virtual std::vector<ModEntry> mods() = 0;
  virtual std::vector<ArchiveEntry> archives() = 0;
  virtual InstallState installing() const = 0;
  virtual std::vector<ServerEntry> servers() = 0;
  virtual bool searching_servers() const = 0;
  // Sizes that a window may have here.
  virtual std::vector<uvec2> video_sizes() = 0;
  // Sets of the picture's settings, from the fastest on, and the one in force; empty: there is none.
  virtual std::vector<PresetEntry> presets() const = 0;
  virtual std::string preset() const = 0;
  virtual bool mouse_look() const = 0;  // +mlook is down
  virtual std::string key_name(int key) const = 0;
  virtual std::string version() const = 0;
  // Changes when one of the lists has changed.
  virtual std::uint64_t revision() const = 0;
};

}  // namespace fb::ui::menu
