// The panel: that it draws, what is pointed at in it, and what that changes. Where things are is asked of ImGui by
// looking at what is drawn.
#include "panel/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "panel/draw_data.h"
#include "platform/keys.h"
#include "render/passes/settings.h"
#include "ui/test_raster.h"

namespace fb::panel {
namespace {

constexpr uvec2 kOutput{640, 360};
constexpr int kLetterWidth = 7, kLetterHeight = 13;  // of ImGui's own font

class PanelTest : public testing::Test {
 protected:
  PanelTest() {
    render::register_render_cvars(console);
    snapshot.sky.suns.resize(2);
    snapshot.instances.resize(3);
    snapshot.instances[1].id = scene::kIdDynamicLight + 3;
    snapshot.instances[2].id = scene::kIdEntityLight + 5;
  }
  const scene::DrawList& draw() {
    list.clear();
    Facts facts{snapshot};
    facts.scene.lights = 1234;
    facts.device = "a device";
    facts.rays = "bvh";
    facts.rendered = {320, 180};
    panel.draw(list, atlas, facts, kOutput, now += 0.05);
    return list;
  }
  void open() {
    console.execute("togglepanel");
    draw();
    draw();  // windows settle in their second frame
  }
  bool key(int number, bool down) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kKey;
    event.key = number;
    event.down = down;
    return panel.handle(event);
  }
  bool move(vec2 to) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kMouseMotion;
    event.x = to.x;
    event.y = to.y;
    const bool taken = panel.handle(event);
    draw();
    return taken;
  }
  void click(vec2 at) {
    move(at);
    move(at);
    key(platform::kKeyMouse1, true);
    draw();
    key(platform::kKeyMouse1, false);
    draw();
    draw();
  }
  void type(const std::string& letters) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kText;
    event.text = letters;
    EXPECT_TRUE(panel.handle(event));
    draw();
  }
  // Where this text begins that is drawn last, output pixels a little inside its first letter; none of it: negative.
  vec2 find(const std::string& text) {
    for (std::size_t i = list.quads.size(); i-- > 0;) {
      std::size_t same = 0;
      const vec2 begin = list.quads[i].min;
      for (std::size_t k = i; k < list.quads.size() && same < text.size(); ++k) {
        while (text[same] == ' ') ++same;
        const scene::DrawQuad& quad = list.quads[k];
        if (quad.uv_min != letter_texels(text[same])) break;
        if (quad.min.x < begin.x || quad.min.x > begin.x + static_cast<float>((same + 1) * kLetterWidth)) break;
        ++same;
      }
      if (same == text.size()) return begin + vec2(2.0f, 3.0f);
    }
    return vec2(-1.0f);
  }
  bool shows(const std::string& text) { return find(text).x >= 0.0f; }
  vec2 letter_texels(char letter) {
    const ImFontGlyph* glyph = ImGui::GetIO().Fonts->Fonts[0]->FindGlyph(static_cast<ImWchar>(letter));
    const ui::Picture* font = atlas.find("panel font");
    return vec2(font->x, font->y) + vec2(glyph->U0, glyph->V0) * vec2(font->width, font->height);
  }

  con::Console console;
  ui::Atlas atlas;
  scene::FrameSnapshot snapshot;
  scene::DrawList list;
  Panel panel{console};
  double now = 1.0;
};

TEST_F(PanelTest, IsThereWhereItIsAskedFor) {
  EXPECT_TRUE(draw().quads.empty());
  EXPECT_FALSE(move({40, 40}));
  open();
  EXPECT_GT(list.quads.size(), 100u);
  EXPECT_TRUE(shows("Times"));
  EXPECT_TRUE(shows("a device, rays by bvh"));
  for (const scene::DrawQuad& quad : list.quads) {
    EXPECT_TRUE(quad.min.x >= 0.0f && quad.min.y >= 0.0f && quad.max.x <= 640.0f && quad.max.y <= 360.0f);
    EXPECT_TRUE(quad.min.x < quad.max.x && quad.min.y < quad.max.y);
  }
  move({40, 60});
  EXPECT_TRUE(move({40, 61})) << "the mouse over it is its own";
  move({600, 340});
  EXPECT_FALSE(move({601, 340})) << "beside it, it is the game's";
  EXPECT_FALSE(key('w', true)) << "and so are keys";
  EXPECT_TRUE(key(platform::kKeyEscape, true));
  EXPECT_FALSE(panel.open());
  EXPECT_TRUE(draw().quads.empty());
}

TEST_F(PanelTest, ShowsThePassesOfTheLatestFrames) {
  open();
  EXPECT_TRUE(shows("No frame has been shown yet."));
  for (int i = 0; i < 200; ++i) panel.add_frame({{"gbuffer", 8.0}, {"paths", 24.0}}, 40.0);
  draw();
  EXPECT_TRUE(shows("320x180, 40.0 ms a frame, 25.0 frames a second"));
  EXPECT_TRUE(shows("the last 120 frames; up to 32.0 ms; means, ms:"));
  EXPECT_TRUE(shows("8.00 gbuffer"));
  EXPECT_TRUE(shows("24.00 paths"));
  // A full column: a quarter is the first pass, the rest the second.
  ui::Raster raster(640, 360);
  raster.draw(list);
  const vec2 under = find("the last 120 frames");
  const int x = 150, bottom = static_cast<int>(under.y) - 11;
  int first = 0, second = 0;
  for (int y = bottom - 88; y < bottom - 1; ++y) (raster.at(x, y) == raster.at(x, bottom - 2) ? first : second) += 1;
  EXPECT_NEAR(static_cast<float>(first) / static_cast<float>(first + second), 0.25f, 0.05f);
}

TEST_F(PanelTest, SettingsChangeThroughIt) {
  open();
  click(find("Settings"));
  EXPECT_TRUE(shows("Denoiser"));
  EXPECT_FALSE(shows("r_taa")) << "groups are closed";
  click(find("search") - vec2(40.0f, 0.0f));
  EXPECT_TRUE(panel.typing());
  EXPECT_TRUE(key('w', true)) << "while something is typed, keys are its own";
  type("r_taa");
  ASSERT_TRUE(shows("r_taa")) << "what is found is open";
  EXPECT_FALSE(shows("r_spp"));
  EXPECT_EQ(console.cvar("r_taa").string(), "1");
  click(find("r_taa") - vec2(14.0f, 0.0f));
  EXPECT_EQ(console.cvar("r_taa").string(), "0") << "a box of a switch";
  key(platform::kKeyMouse2, true);
  draw();
  draw();
  EXPECT_EQ(console.cvar("r_taa").string(), "1") << "the right button: its default";
  key(platform::kKeyMouse2, false);
}

TEST_F(PanelTest, SlidersGoThroughTheirRange) {
  open();
  click(find("Settings"));
  click(find("search") - vec2(40.0f, 0.0f));
  type("r_exposure_target");
  const vec2 name = find("r_exposure_target");
  ASSERT_GT(name.x, 0.0f);
  click(name - vec2(20.0f, 0.0f));
  const float right = console.cvar("r_exposure_target").value();
  click({24.0f, name.y});
  const float left = console.cvar("r_exposure_target").value();
  EXPECT_LT(left, 0.01f);
  EXPECT_GT(right, 1.0f);
}

TEST_F(PanelTest, EverySettingOfTheRendererIsInAGroup) {
  std::size_t count = 0;
  for (const render::SettingGroup& group : render::setting_groups())
    for (const std::string_view name : group.cvars) {
      EXPECT_NE(console.find_cvar(name), nullptr) << name;
      ++count;
    }
  EXPECT_GT(count, 60u);
}

TEST_F(PanelTest, AClickShorterThanAFrameIsOne) {
  open();
  const vec2 tab = find("Scene");
  move(tab);
  move(tab);
  key(platform::kKeyMouse1, true);
  key(platform::kKeyMouse1, false);
  for (int i = 0; i < 3; ++i) draw();
  EXPECT_TRUE(shows("sky: black, 2 suns"));
}

TEST_F(PanelTest, ChoosesADebugView) {
  open();
  click(find("Views"));
  click(find("shading_normals"));
  EXPECT_EQ(console.cvar("r_debug").integer(), 2);
  click(find("off"));
  EXPECT_EQ(console.cvar("r_debug").integer(), 0);
}

TEST_F(PanelTest, TellsWhatLightThereIs) {
  open();
  click(find("Scene"));
  EXPECT_TRUE(shows("1234 triangles glow"));
  EXPECT_TRUE(shows("light entities 1, dynamic lights 1, particles 0"));
  EXPECT_TRUE(shows("sky: black, 2 suns"));
}

// A triangle that is no half of a rectangle, and a box that is cut off.
TEST(DrawData, TrianglesBecomeRows) {
  ImGuiContext* const context = ImGui::CreateContext();
  ImGui::SetCurrentContext(context);
  ImGui::GetIO().IniFilename = nullptr;  // else it leaves a file where the test runs
  ImGui::GetIO().DisplaySize = {64.0f, 64.0f};
  unsigned char* texels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
  ImGui::NewFrame();
  ImDrawList& foreground = *ImGui::GetForegroundDrawList();
  foreground.Flags = ImDrawListFlags_None;
  foreground.AddTriangleFilled({8.0f, 8.0f}, {24.0f, 8.0f}, {8.0f, 24.0f}, IM_COL32(255, 0, 0, 255));
  foreground.PushClipRect({32.0f, 32.0f}, {40.0f, 48.0f});
  foreground.AddRectFilled({30.0f, 30.0f}, {60.0f, 60.0f}, IM_COL32(0, 255, 0, 255));
  foreground.PopClipRect();
  ImGui::Render();
  scene::DrawList list;
  ui::Raster raster(128, 128);
  ui::Atlas atlas;
  list.atlas = atlas.image();
  append_draw_data(list, *ImGui::GetDrawData(), {0, 0, width, height}, 2.0f);
  raster.draw(list);
  int red = 0, green = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      red += raster.at(x, y).x > 0.5f;
      green += raster.at(x, y).y > 0.5f;
    }
  EXPECT_NEAR(red, 32 * 32 / 2, 20);
  EXPECT_EQ(green, 16 * 32);
  EXPECT_GT(raster.at(18, 18).x, 0.5f);
  EXPECT_EQ(raster.at(46, 46).x, 0.0f);
  EXPECT_GT(raster.at(65, 65).y, 0.5f);
  ImGui::DestroyContext(context);
}

}  // namespace
}  // namespace fb::panel
