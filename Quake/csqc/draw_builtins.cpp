// 2D of status bars, with FTE's and vkQuake's numbers. Coordinates are virtual pixels of the bar's canvas, colours 0 to
// 1. Drawing flags (adding, multiplying) are taken and do nothing, as in vkQuake. Outside of functions that draw
// nothing is drawn.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "csqc/hud_context.h"
#include "progs/markup.h"
#include "progs/vm.h"

namespace fb::csqc {
namespace {

using progs::BuiltinTable;
using progs::Letter;
using progs::marked_up;
using progs::Vm;

constexpr std::size_t kMostDrawn = 65536;   // letters, pictures and fills in a frame
constexpr float kFarthest = 1e6f;           // virtual pixels
constexpr int kInWad = 1, kMustLoad = 512;  // flags of precache_pic

bool usable(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::abs(v.x) <= kFarthest && std::abs(v.y) <= kFarthest;
}

vec4 color_of(const vec3& rgb, float alpha) {
  vec4 color(rgb, alpha);
  for (int i = 0; i < 4; ++i) color[i] = std::isfinite(color[i]) ? std::clamp(color[i], 0.0f, 1.0f) : 0.0f;
  return color;
}
vec4 color_parms(const Vm& vm, int first) { return color_of(vm.parm_vector(first), vm.parm_float(first + 1)); }

// Counts what is about to be drawn. False: nothing may be.
bool may_draw(Vm& vm, HudContext& context, std::size_t count, const vec3& position, const vec3& size) {
  vm.return_float(0.0f);
  if (vm.failed() || !context.painter || !usable(position) || !usable(size)) return false;
  if (count > kMostDrawn - std::min(context.drawn, kMostDrawn)) {
    vm.fail(fmt::format("draws more than {} letters, pictures and fills in a frame", kMostDrawn));
    return false;
  }
  context.drawn += count;
  vm.return_float(1.0f);
  return true;
}

void draw_letter(ui::Painter& painter, const vec2& at, const vec2& size, const Letter& letter) {
  if ((letter.code & 127) == ' ' || letter.code == 0) return;
  painter.picture(at.x, at.y, size.x, size.y, painter.atlas().glyph(letter.code), letter.color);
}

// drawcharacter(position, character, size, rgb, alpha, flags)
void drawcharacter(Vm& vm, HudContext& context) {
  const vec3 at = vm.parm_vector(0), size = vm.parm_vector(2);
  const auto code = static_cast<unsigned char>(vm.parm_int(1) & 255);
  if (may_draw(vm, context, 1, at, size)) draw_letter(*context.painter, at, size, {code, color_parms(vm, 3)});
}

// drawstring(position, text, size, rgb, alpha, flags); drawrawstring knows no marks of colour.
void draw_text(Vm& vm, HudContext& context, bool marks) {
  const vec3 at = vm.parm_vector(0), size = vm.parm_vector(2);
  const std::string_view text = vm.parm_string(1);
  const vec4 color = color_parms(vm, 3);
  if (!may_draw(vm, context, text.size(), at, size)) return;
  vec2 place(at);
  const auto put = [&](const Letter& letter) {
    draw_letter(*context.painter, place, size, letter);
    place.x += size.x;
  };
  if (!marks) {
    for (const char c : text) put({static_cast<unsigned char>(c), color});
    return;
  }
  for (const Letter& letter : marked_up(text, color)) put(letter);
}

// stringwidth(text, whether marks count as such, size of a letter)
void stringwidth(Vm& vm, HudContext&) {
  const std::string_view text = vm.parm_string(0);
  const bool marks = vm.parm_float(1) != 0.0f;
  const float letter = vm.parm_count() > 2 ? vm.parm_vector(2).x : ui::kGlyph;
  const std::size_t letters = marks ? marked_up(text, vec4(1.0f)).size() : text.size();
  vm.return_float(static_cast<float>(letters) * letter);
}

// drawpic(position, name, size, rgb, alpha, flags)
void drawpic(Vm& vm, HudContext& context) {
  const vec3 at = vm.parm_vector(0), size = vm.parm_vector(2);
  const std::string_view name = vm.parm_string(1);
  if (!may_draw(vm, context, 1, at, size)) return;
  if (const ui::Picture* picture = context.pictures.find(name))
    context.painter->picture(at.x, at.y, size.x, size.y, *picture, color_parms(vm, 3));
}

// drawsubpic(position, size, name, first corner and size of the part as shares of the picture, rgb, alpha, flags)
void drawsubpic(Vm& vm, HudContext& context) {
  const vec3 at = vm.parm_vector(0), size = vm.parm_vector(1), from = vm.parm_vector(3), part = vm.parm_vector(4);
  const std::string_view name = vm.parm_string(2);
  if (!may_draw(vm, context, 1, at, size) || !usable(from) || !usable(part)) return;
  const ui::Picture* picture = context.pictures.find(name);
  if (!picture) return;
  const vec2 texels(picture->width, picture->height);
  context.painter->stretched_part(at, size, *picture, vec2(from) * texels, vec2(from + part) * texels,
                                  color_parms(vm, 5));
}

// drawfill(position, size, rgb, alpha, flags)
void drawfill(Vm& vm, HudContext& context) {
  const vec3 at = vm.parm_vector(0), size = vm.parm_vector(1);
  if (may_draw(vm, context, 1, at, size)) context.painter->fill(at.x, at.y, size.x, size.y, color_parms(vm, 2));
}

// drawsetcliparea(x, y, width, height)
void drawsetcliparea(Vm& vm, HudContext& context) {
  const vec3 at(vm.parm_float(0), vm.parm_float(1), 0.0f), size(vm.parm_float(2), vm.parm_float(3), 0.0f);
  if (context.painter && usable(at) && usable(size)) context.painter->clip(vec2(at), vec2(at + size));
}

// precache_pic(name, flags): the name.
void precache_pic(Vm& vm, HudContext& context) {
  const std::string_view name = vm.parm_string(0);
  const int flags = vm.parm_count() > 1 ? vm.parm_int(1) : 0;
  vm.return_string_id(vm.parm_string_id(0));
  if (!vm.failed() && !context.pictures.find(name, (flags & kInWad) != 0) && (flags & kMustLoad) != 0)
    vm.return_string_id(progs::StringId::kNull);
}

void drawgetimagesize(Vm& vm, HudContext& context) {
  const std::string_view name = vm.parm_string(0);
  const ui::Picture* picture = vm.failed() ? nullptr : context.pictures.find(name);
  vm.return_vector(picture ? vec3(picture->width, picture->height, 0.0f) : vec3(0.0f));
}

}  // namespace

void add_draw_builtins(BuiltinTable& table, HudContext& context) {
  const auto set = [&](std::uint32_t number, std::string_view name, void (*builtin)(Vm&, HudContext&)) {
    table.set(number, name, [&context, builtin](Vm& vm) { builtin(vm, context); });
  };
  set(316, "iscachedpic",
      [](Vm& vm, HudContext& in) { vm.return_float(in.pictures.knows(vm.parm_string(0)) ? 1.0f : 0.0f); });
  set(317, "precache_pic", precache_pic);
  set(318, "drawgetimagesize", drawgetimagesize);
  table.set_idle(319, "freepic");
  set(320, "drawcharacter", drawcharacter);
  set(321, "drawrawstring", [](Vm& vm, HudContext& in) { draw_text(vm, in, false); });
  set(322, "drawpic", drawpic);
  set(323, "drawfill", drawfill);
  set(324, "drawsetcliparea", drawsetcliparea);
  set(325, "drawresetcliparea", [](Vm&, HudContext& in) {
    if (in.painter) in.painter->clip_nothing();
  });
  set(326, "drawstring", [](Vm& vm, HudContext& in) { draw_text(vm, in, true); });
  set(327, "stringwidth", stringwidth);
  set(328, "drawsubpic", drawsubpic);
}

}  // namespace fb::csqc
