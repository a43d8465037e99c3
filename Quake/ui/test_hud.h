// For tests of the status bar and its relatives: game data whose pictures each have a colour of their own, so that a
// pixel says which picture is there.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "ui/hud_view.h"
#include "ui/test_raster.h"

namespace fb::ui {

class HudTest : public testing::Test {
 protected:
  HudTest() : atlas([](std::string_view name) { return file(name); }) {
    hud.level_name = "Hall";
    hud.map_name = "e1m1";
    hud.time = 100.0;
    hud.stats[net::kStatHealth] = 100;
    settings.bar_alpha = 1.0f;
    settings.auto_scale = 0.0f;
  }

  HudView view(int width = 320, int height = 200) const { return {hud, settings, rules, {width, height}}; }
  // What `draw` draws with this view, on black.
  template <typename Draw>
  Raster drawn(const HudView& view, const Draw& draw) {
    scene::DrawList list;
    list.atlas = atlas.image();
    draw(list, atlas, view);
    list.atlas = atlas.image();
    Raster raster(view.output.x, view.output.y);
    raster.draw(list);
    return raster;
  }
  // The picture that shows at this pixel; "" if there is none, "?" if it is no picture's colour.
  static std::string picture_at(const Raster& raster, int x, int y) {
    const vec3 color = raster.at(x, y) * 255.0f;
    if (color == vec3(0.0f)) return {};
    const auto index = static_cast<std::size_t>(color.x + 0.5f);
    const bool known = index >= 1 && index <= names().size() && color.y > 254.5f - static_cast<float>(index) &&
                       color.y < 255.5f - static_cast<float>(index) && color.z > 127.5f && color.z < 128.5f;
    return known ? names()[index - 1].first : "?";
  }

  cl::Hud hud;
  HudSettings settings;
  Rules rules = Rules::kQuake;
  Atlas atlas;

 private:
  // Names and sizes; a picture's colour is its place in the list, counted from 1.
  static const std::vector<std::pair<std::string, ivec2>>& names() {
    static const auto kNames = [] {
      std::vector<std::pair<std::string, ivec2>> all = {{"sbar", {320, 24}},
                                                        {"ibar", {320, 24}},
                                                        {"scorebar", {320, 24}},
                                                        {"backtile", {64, 64}},
                                                        {"disc", {24, 24}},
                                                        {"net", {32, 32}},
                                                        {"turtle", {32, 32}},
                                                        {"num_minus", {24, 24}},
                                                        {"anum_minus", {24, 24}},
                                                        {"num_colon", {16, 24}},
                                                        {"num_slash", {16, 24}},
                                                        {"sb_key1", {16, 16}},
                                                        {"sb_key2", {16, 16}},
                                                        {"sb_invis", {16, 16}},
                                                        {"sb_invuln", {16, 16}},
                                                        {"sb_suit", {16, 16}},
                                                        {"sb_quad", {16, 16}},
                                                        {"sb_sigil1", {8, 16}},
                                                        {"sb_sigil2", {8, 16}},
                                                        {"sb_sigil3", {8, 16}},
                                                        {"sb_sigil4", {8, 16}},
                                                        {"sb_shells", {24, 24}},
                                                        {"sb_nails", {24, 24}},
                                                        {"sb_rocket", {24, 24}},
                                                        {"sb_cells", {24, 24}},
                                                        {"sb_armor1", {24, 24}},
                                                        {"sb_armor2", {24, 24}},
                                                        {"sb_armor3", {24, 24}},
                                                        {"sb_wsuit", {16, 16}},
                                                        {"sb_eshld", {16, 16}},
                                                        {"face_inv2", {24, 24}},
                                                        {"face_quad", {24, 24}},
                                                        {"face_invis", {24, 24}},
                                                        {"face_invul2", {24, 24}},
                                                        {"r_invbar1", {320, 24}},
                                                        {"r_invbar2", {320, 24}},
                                                        {"r_lava", {24, 16}},
                                                        {"r_teambord", {24, 24}},
                                                        {"r_shield1", {16, 16}},
                                                        {"r_agrav1", {16, 16}},
                                                        {"gfx/pause.lmp", {128, 24}},
                                                        {"gfx/loading.lmp", {144, 24}},
                                                        {"gfx/ranking.lmp", {160, 24}},
                                                        {"gfx/complete.lmp", {192, 24}},
                                                        {"gfx/inter.lmp", {160, 144}},
                                                        {"gfx/finale.lmp", {288, 24}}};
      for (int i = 0; i < 10; ++i) {
        all.push_back({"num_" + std::to_string(i), {24, 24}});
        all.push_back({"anum_" + std::to_string(i), {24, 24}});
      }
      for (int i = 1; i <= 5; ++i) {
        all.push_back({"face" + std::to_string(i), {24, 24}});
        all.push_back({"face_p" + std::to_string(i), {24, 24}});
      }
      for (const char* weapon : {"shotgun", "nailgun", "rlaunch", "lightng", "laser", "gren_prox"})
        for (const char* state : {"inv_", "inv2_", "inva1_", "inva3_"})
          all.push_back({std::string(state) + weapon, {24, 16}});
      return all;
    }();
    return kNames;
  }

  static void add_u32(Bytes& bytes, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift & 255u));
  }
  static Bytes picture_bytes(std::size_t i) {
    const ivec2 size = names()[i].second;
    Bytes bytes;
    add_u32(bytes, static_cast<std::size_t>(size.x));
    add_u32(bytes, static_cast<std::size_t>(size.y));
    bytes.insert(bytes.end(), static_cast<std::size_t>(size.x * size.y), static_cast<std::uint8_t>(i + 1));
    return bytes;
  }
  static Bytes wad_bytes() {
    Bytes data, directory;
    std::size_t count = 0;
    for (std::size_t i = 0; i < names().size(); ++i) {
      const std::string& name = names()[i].first;
      if (name.find('/') != name.npos) continue;
      const Bytes picture = picture_bytes(i);
      add_u32(directory, 12 + data.size());
      add_u32(directory, picture.size());
      add_u32(directory, picture.size());
      directory.insert(directory.end(), {'B', 0, 0, 0});
      std::array<std::uint8_t, 16> padded{};
      std::memcpy(padded.data(), name.data(), name.size());
      directory.insert(directory.end(), padded.begin(), padded.end());
      data.insert(data.end(), picture.begin(), picture.end());
      ++count;
    }
    Bytes wad = {'W', 'A', 'D', '2'};
    add_u32(wad, count);
    add_u32(wad, 12 + data.size());
    wad.insert(wad.end(), data.begin(), data.end());
    wad.insert(wad.end(), directory.begin(), directory.end());
    return wad;
  }
  static std::optional<FileData> file(std::string_view name) {
    if (name == "gfx.wad") return FileData(wad_bytes());
    if (name == "gfx/palette.lmp") {
      Bytes palette;
      for (int i = 0; i < 256; ++i) {
        palette.push_back(static_cast<std::uint8_t>(i));
        palette.push_back(static_cast<std::uint8_t>(255 - i));
        palette.push_back(128);
      }
      return FileData(palette);
    }
    for (std::size_t i = 0; i < names().size(); ++i)
      if (names()[i].first == name) return FileData(picture_bytes(i));
    return std::nullopt;
  }
};

}  // namespace fb::ui
