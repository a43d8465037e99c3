// For tests of status bars in QuakeC: compiles them behind the list of builtins of Misc/docs/quakec.md, and shows them
// with pictures whose colours say which they are (ui/test_hud.h).
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "csqc/mod_hud.h"
#include "fs/test_log.h"
#include "progs/test_builtin_list.h"
#include "progs/test_compile.h"
#include "ui/hud.h"
#include "ui/test_hud.h"

namespace fb::csqc {

inline std::vector<progs::testing::ListedBuiltin> bar_builtins() {
  return progs::testing::listed_builtins({"Of every program", "Of a status bar's program"});
}

// getstatf is declared with parameters that may be left out.
inline std::string bar_declarations() {
  std::string text = progs::testing::declarations(bar_builtins());
  const std::string whole = "float index, float first_bit, float bits";
  text.replace(text.find(whole), whole.size(), "float index, ...");
  return text;
}

class BarTest : public ui::HudTest {
 protected:
  void SetUp() override {
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << "fteqcc is not installed";
  }

  // The program of this text as csprogs.dat.
  void put_program(const std::string& source, const std::string& name = "csprogs.dat") {
    const auto compiled = progs::testing::compile(bar_declarations() + source, "-O2");
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    files[name] = compiled.progs;
  }
  void begin(int level = 1) {
    if (!bar) {
      bar = std::make_unique<ModHud>(
          console, atlas,
          ModHudServices{.read_file = [this](std::string_view name) -> std::optional<FileData> {
                           const auto found = files.find(std::string(name));
                           return found == files.end() ? std::nullopt : std::optional(FileData(found->second));
                         },
                         .play_sound = [this](std::string_view name) { sounds.emplace_back(name); }});
    }
    bar->begin_frame(level, hud, moment);
  }
  // A frame of everything, with the mod's bar in it.
  scene::DrawList frame(const ui::HudView& view, ui::Attention attention = ui::Attention::kGame) {
    begin(level);
    ui::HudView with_bar = view;
    with_bar.mod_bar = bar.get();
    scene::DrawList list;
    ui::draw_hud(list, atlas, with_bar, attention);
    list.atlas = atlas.image();
    return list;
  }
  scene::DrawList frame(int width = 320, int height = 200) { return frame(view(width, height)); }
  static ui::Raster raster(const scene::DrawList& list, int width = 320, int height = 200) {
    ui::Raster picture(width, height);
    picture.draw(list);
    return picture;
  }
  bool shows_games_bar(const scene::DrawList& list) const {
    return picture_at(raster(list), 20, 180) == "sbar" || picture_at(raster(list), 20, 180) == "num_0";
  }

  con::Console console;
  std::map<std::string, Bytes> files;
  std::vector<std::string> sounds;
  Moment moment{.now = 500.0, .seconds = 0.05};
  int level = 1;
  std::unique_ptr<ModHud> bar;
};

}  // namespace fb::csqc
