// For the tests of the menus: facts that a test sets, a menu over them, and the page read back from its picture.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ui/menu/menu.h"
#include "ui/test_raster.h"

namespace fb::ui::menu {

struct TestFacts final : Facts {
  bool game = false, searching = false, looks = true;
  std::string no_save, preset_name;
  std::vector<SaveEntry> save_list;
  std::map<std::string, formats::RgbaImage> save_pictures;
  int pictures_read = 0;
  std::string last_save;
  std::vector<MapEntry> map_list, start_list;
  std::vector<std::string> demo_list;
  std::vector<ModEntry> mod_list;
  std::vector<ArchiveEntry> archive_list;
  InstallState install;
  std::vector<ServerEntry> server_list;
  std::uint64_t changes = 1;

  bool in_game() const override { return game; }
  std::string reason_not_to_save() const override { return no_save; }
  std::vector<SaveEntry> saves() override { return save_list; }
  std::optional<formats::RgbaImage> save_picture(const std::string& name) override {
    ++pictures_read;
    const auto found = save_pictures.find(name);
    return found == save_pictures.end() ? std::nullopt : std::optional(found->second);
  }
  std::string save_after_death() const override { return last_save; }
  std::vector<MapEntry> maps() override { return map_list; }
  std::vector<MapEntry> start_maps() override { return start_list; }
  std::vector<std::string> demos() override { return demo_list; }
  std::vector<ModEntry> mods() override { return mod_list; }
  std::vector<ArchiveEntry> archives() override { return archive_list; }
  InstallState installing() const override { return install; }
  std::vector<ServerEntry> servers() override { return server_list; }
  bool searching_servers() const override { return searching; }
  std::vector<uvec2> video_sizes() override { return {{640, 480}, {1280, 720}}; }
  std::vector<PresetEntry> presets() const override { return {{"fast", "quick"}, {"fine", "slow"}}; }
  std::string preset() const override { return preset_name; }
  bool mouse_look() const override { return looks; }
  std::string key_name(int key) const override {
    return key == 200 ? "MOUSE1" : std::string(1, static_cast<char>(key));
  }
  std::string version() const override { return "fullbright 1"; }
  std::uint64_t revision() const override { return changes; }
};

class MenuTest : public testing::Test {
 protected:
  static constexpr int kWidth = 320, kHeight = 200;

  MenuTest() {
    console.add_cvar({"skill", "1", "how hard", con::kCvarPlain, 0.0f, 3.0f, true});
    for (const char* name : {"teamplay", "fraglimit", "timelimit"}) console.add_cvar(name, "0", "a rule");
    console.add_cvar("hostname", "UNNAMED", "the server's name", con::kCvarArchive);
    console.add_cvar("_cl_name", "player", "your name", con::kCvarArchive);
    console.add_cvar("_cl_color", "0", "your colours", con::kCvarArchive);
    console.add_cvar("m_pitch", "0.022", "pitch of the mouse", con::kCvarArchive);
    console.add_cvar({"volume", "0.7", "loudness of sounds", con::kCvarArchive, 0.0f, 1.0f});
    console.add_cvar({"r_spp", "1", "samples of a pixel", con::kCvarArchive, 1.0f, 64.0f, true});
    console.add_cvar("lookspring", "0", "1: the view levels itself", con::kCvarArchive);
    // What pages run is written down instead.
    for (const char* name :
         {"map", "save", "load", "quit", "restart", "disconnect", "maxplayers", "listen", "deathmatch", "coop", "game",
          "playdemo", "connect", "slist", "name", "color", "vid_restart", "preset", "installmod"}) {
      console.add_command(name, "", [this](const con::Args& args) { ran.push_back(args.joined(0)); });
    }
  }

  // Runs what the menu has asked for.
  const std::vector<std::string>& run() {
    ran.clear();
    console.execute();
    return ran;
  }
  // The picture's lines of text.
  std::string read() {
    scene::DrawList list;
    menu.draw(list, atlas, kWidth, kHeight, {.time = 0.3});
    std::string text;
    Raster raster(kWidth, kHeight);
    // Backgrounds are no ink: opaque ones hide what is below, the others are left out.
    std::erase_if(list.quads,
                  [](const scene::DrawQuad& quad) { return quad.uv_min == quad.uv_max && quad.color.w < 1.0f; });
    for (scene::DrawQuad& quad : list.quads)
      if (quad.uv_min == quad.uv_max) quad.color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    raster.draw(list);
    // The list says where letters are, the picture which: lines from the top, each from the left.
    std::map<int, std::map<int, char>> letters;
    for (const scene::DrawQuad& quad : list.quads) {
      if (quad.uv_min == quad.uv_max || quad.max - quad.min != vec2(8.0f)) continue;
      const ivec2 at(quad.min);
      const unsigned char code = raster.character(atlas, at.x, at.y);
      letters[at.y][at.x] = code == 0 ? '?' : static_cast<char>(code);
    }
    for (const auto& [y, line] : letters) {
      int end = 0;
      for (const auto& [x, letter] : line) {
        text += std::string(static_cast<std::size_t>(std::max(0, (x - end) / 8)), ' ') + letter;
        end = x + 8;
      }
      text += '\n';
    }
    return text;
  }
  void select(const std::string& label) {
    for (int i = 0; i < 300; ++i) {
      if (menu.selected() != nullptr && menu.selected()->label == label) return;
      menu.press(Key::kDown);
    }
    FAIL() << "there is no row " << label << " in " << menu.page_name();
  }
  void choose(const std::string& label) {
    select(label);
    menu.press(Key::kEnter);
  }

  con::Console console;
  con::Bindings bindings{console, [](std::string_view name) { return name.empty() ? 0 : static_cast<int>(name[0]); },
                         [](int key) { return std::string(1, static_cast<char>(key)); }};
  TestFacts facts;
  Atlas atlas;
  std::vector<std::string> ran;
  Menu menu{console, bindings, facts};
};

}  // namespace fb::ui::menu
