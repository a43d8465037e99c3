#include "panel/panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "panel/draw_data.h"
#include "platform/keys.h"
#include "ui/canvas.h"

namespace fb::panel {
namespace {

constexpr const char* kFont = "panel font";
constexpr int kMouseButtons = 3;

struct EditKey {
  int key;
  ImGuiKey meaning;
};
constexpr std::array<EditKey, 9> kEditKeys = {{{platform::kKeyTab, ImGuiKey_Tab},
                                               {platform::kKeyLeftArrow, ImGuiKey_LeftArrow},
                                               {platform::kKeyRightArrow, ImGuiKey_RightArrow},
                                               {platform::kKeyHome, ImGuiKey_Home},
                                               {platform::kKeyEnd, ImGuiKey_End},
                                               {platform::kKeyDelete, ImGuiKey_Delete},
                                               {platform::kKeyBackspace, ImGuiKey_Backspace},
                                               {platform::kKeyEnter, ImGuiKey_Enter},
                                               {platform::kKeyEscape, ImGuiKey_Escape}}};

// Dear ImGui 1.87 took events in the place of tables of what is down.
void tell_key(int key, bool down) {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
  if (key == platform::kKeyCtrl) io.AddKeyEvent(ImGuiMod_Ctrl, down);
  if (key == platform::kKeyShift) io.AddKeyEvent(ImGuiMod_Shift, down);
  for (const EditKey& edit : kEditKeys)
    if (edit.key == key) io.AddKeyEvent(edit.meaning, down);
#else
  if (key == platform::kKeyCtrl) io.KeyCtrl = down;
  if (key == platform::kKeyShift) io.KeyShift = down;
  if (key >= 0 && key < static_cast<int>(std::size(io.KeysDown))) io.KeysDown[key] = down;
#endif
}

void tell_mouse_place(float x, float y) {
#if IMGUI_VERSION_NUM >= 18900
  ImGui::GetIO().AddMousePosEvent(x, y);
#else
  ImGui::GetIO().MousePos = {x, y};
#endif
}

void tell_mouse_button(int button, bool down) {
#if IMGUI_VERSION_NUM >= 18900
  ImGui::GetIO().AddMouseButtonEvent(button, down);
#else
  ImGui::GetIO().MouseDown[button] = down;
#endif
}

void tell_wheel(float steps) {
#if IMGUI_VERSION_NUM >= 18900
  ImGui::GetIO().AddMouseWheelEvent(0.0f, steps);
#else
  ImGui::GetIO().MouseWheel += steps;
#endif
}

bool is_mouse_button(int key) { return key >= platform::kKeyMouse1 && key < platform::kKeyMouse1 + kMouseButtons; }

void tell(int key, bool down) {
  if (is_mouse_button(key))
    tell_mouse_button(key - platform::kKeyMouse1, down);
  else
    tell_key(key, down);
}

// All corners square and no smoothed edges: rectangles, which is what is drawn here.
void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.AntiAliasedLines = style.AntiAliasedLinesUseTex = style.AntiAliasedFill = false;
  style.WindowRounding = style.ChildRounding = style.FrameRounding = style.PopupRounding = 0.0f;
  style.ScrollbarRounding = style.GrabRounding = style.TabRounding = 0.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.85f;
}

formats::RgbaImage font_image() {
  unsigned char* texels = nullptr;
  formats::RgbaImage image;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &image.width, &image.height);
  image.rgba.assign(texels, texels + std::size_t{4} * static_cast<std::size_t>(image.width * image.height));
  return image;
}

}  // namespace

Panel::Panel(con::Console& console) : console_(console), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;
#if IMGUI_VERSION_NUM < 18900
  for (const EditKey& edit : kEditKeys) io.KeyMap[edit.meaning] = edit.key;
#endif
  set_style();
  console.add_command("togglepanel", "togglepanel: show or hide the panel of the renderer's times and settings",
                      [this](const con::Args&) { open_ = !open_; });
}

Panel::~Panel() { ImGui::DestroyContext(context_); }

bool Panel::typing() const {
  ImGui::SetCurrentContext(context_);
  return open_ && ImGui::GetIO().WantTextInput;
}

bool Panel::handle(const platform::InputEvent& event) {
  using Kind = platform::InputEvent::Kind;
  ImGui::SetCurrentContext(context_);
  const ImGuiIO& io = ImGui::GetIO();
  if (event.kind == Kind::kKey && !event.down) {
    // What is let go is told wherever keys go by then, and is nobody's alone. A press shorter than a frame is one, too.
    if (std::find(pressed_.begin(), pressed_.end(), event.key) != pressed_.end())
      let_go_.push_back(event.key);
    else
      tell(event.key, false);
    return false;
  }
  if (!open_) return false;
  if (event.kind == Kind::kMouseMotion) {
    tell_mouse_place(event.x / scale_, event.y / scale_);
    return io.WantCaptureMouse;
  }
  if (event.kind == Kind::kText) {
    if (io.WantTextInput) ImGui::GetIO().AddInputCharactersUTF8(event.text.c_str());
    return io.WantTextInput;
  }
  if (event.kind != Kind::kKey) return false;
  pressed_.push_back(event.key);
  if (is_mouse_button(event.key)) {
    tell(event.key, true);
    return io.WantCaptureMouse;
  }
  if (event.key == platform::kKeyWheelUp || event.key == platform::kKeyWheelDown) {
    if (io.WantCaptureMouse) tell_wheel(event.key == platform::kKeyWheelUp ? 1.0f : -1.0f);
    return io.WantCaptureMouse;
  }
  tell(event.key, true);
  if (io.WantTextInput) return true;
  if (event.key != platform::kKeyEscape) return false;
  open_ = false;
  return true;
}

void Panel::add_frame(const std::vector<render::PassTime>& passes, double whole) {
  if (!open_) return;
  history_.push_back({passes, whole});
  if (history_.size() > kFrames) history_.pop_front();
}

void Panel::draw(scene::DrawList& list, ui::Atlas& atlas, const Facts& facts, uvec2 output, double now) {
  if (!open_ || output.x == 0 || output.y == 0) return;
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  const ui::Picture* font = atlas.find(kFont);
  if (!font) font = atlas.add(kFont, font_image());
  if (!font) return;
  list.atlas = atlas.image();
  scale_ = static_cast<float>(ui::automatic_scale(static_cast<int>(output.x), static_cast<int>(output.y)));
  io.DisplaySize = {static_cast<float>(output.x) / scale_, static_cast<float>(output.y) / scale_};
  io.DeltaTime = last_ < 0.0 ? 1.0f / 60.0f : std::clamp(static_cast<float>(now - last_), 1e-4f, 1.0f);
  last_ = now;
  ImGui::NewFrame();
  for (const int key : let_go_) tell(key, false);
  let_go_.clear();
  pressed_.clear();
  draw_pages(facts);
  ImGui::Render();
  append_draw_data(list, *ImGui::GetDrawData(), *font, scale_);
}

}  // namespace fb::panel
