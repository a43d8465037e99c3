// What the builtins of a status bar must stand: any words as parameters, in any order, in and outside of a function
// that draws. For tests and the fuzzer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/check.h"
#include "base/rng.h"
#include "csqc/hud_context.h"
#include "progs/builtins/builtins.h"
#include "progs/test_program.h"
#include "progs/vm.h"

namespace fb::csqc {

// A machine with the builtins of bars, a painter, and a function for every builtin.
class HostileBar {
 public:
  HostileBar() : context_(console_, atlas()) {
    context_.hud = &hud_;
    hud_.scores = {{"ann", 3, 0x10}, {"bob", -7, 0xff}};
    hud_.stats[0] = -1;
    hud_.items = INT32_MIN;
    progs::Services services;
    services.console = &console_;
    progs::BuiltinTable table = progs::standard_builtins(services);
    add_hud_builtins(table, context_);
    const auto program = calls_of(table);
    auto vm = progs::Vm::create(program, std::move(table),
                                {.max_edicts = 16, .max_statements = 2000, .max_depth = 20, .max_local_words = 1000});
    FB_CHECK(vm.ok());
    vm_ = std::move(*vm);
    vm_->edicts().start_level(1);
  }

  // As it was made: globals, edicts, strings, commands that wait. What builtins keep for themselves (the words of the
  // last tokenize) stays.
  void reset() {
    vm_->edicts().start_level(1);
    vm_->strings() = progs::StringTable(vm_->program().strings);
    std::copy(vm_->program().globals.begin(), vm_->program().globals.end(), vm_->globals_data());
    console_.forget_commands();
    console_.execute("resetall");
  }

  std::uint32_t functions() const { return static_cast<std::uint32_t>(vm_->program().functions.size()); }
  // The id of a text with marks, the last of the program.
  std::uint32_t text() const { return static_cast<std::uint32_t>(vm_->program().strings.size() - kText.size() - 1); }
  std::string_view words_of(std::uint32_t text) const { return vm_->text(static_cast<progs::StringId>(text)); }
  // Sets a word of the parameters, 0 to 23.
  void set(std::uint32_t i, progs::Word word) { vm_->globals_data()[progs::kOfsParm0 + i] = word; }
  // Calls a function of the program; everything that it has drawn is a rectangle of finite numbers inside of the atlas.
  // False: QuakeC went wrong.
  bool call(std::uint32_t function, bool drawing = true) {
    scene::DrawList list;
    bool ok = false;
    {
      ui::Painter painter(list, atlas(), 320, 200, 1);
      context_.painter = drawing ? &painter : nullptr;
      context_.drawn = 0;
      ok = vm_->execute(progs::FunctionId{function % functions()}).ok();
      context_.painter = nullptr;
    }
    FB_CHECK(!vm_->running());
    FB_CHECK(drawing || list.quads.empty());
    for (const scene::DrawQuad& quad : list.quads) {
      const vec2 atlas_size(list.atlas->width, list.atlas->height);
      for (int i = 0; i < 2; ++i) {
        FB_CHECK(std::isfinite(quad.min[i]) && std::isfinite(quad.max[i]) && quad.min[i] < quad.max[i]);
        FB_CHECK(quad.uv_min[i] >= 0.0f && quad.uv_max[i] >= 0.0f);
        FB_CHECK(quad.uv_min[i] <= atlas_size[i] && quad.uv_max[i] <= atlas_size[i]);
      }
      for (int i = 0; i < 4; ++i) FB_CHECK(quad.color[i] >= 0.0f && quad.color[i] <= 1.0f);
    }
    return ok;
  }

 private:
  static constexpr std::string_view kText = "^xf80 gfx/box ^{e012}";
  // Made once, as fuzzers make many bars.
  static ui::Atlas& atlas() {
    static ui::Atlas atlas;
    return atlas;
  }
  static std::shared_ptr<const progs::Program> calls_of(const progs::BuiltinTable& table) {
    static const auto kProgram = [&] {
      progs::testing::ProgramBuilder builder;
      for (const std::uint32_t number : table.numbers()) {
        const auto callee = builder.word(builder.builtin("b", static_cast<std::int32_t>(number)));
        builder.function("f", {{progs::Op::kCall8, callee}, {progs::Op::kDone}});
      }
      builder.string(kText);
      auto loaded = progs::load_program(builder.build(), "hostile.dat");
      FB_CHECK(loaded.ok());
      return std::make_shared<const progs::Program>(std::move(*loaded));
    }();
    return kProgram;
  }

  con::Console console_;
  cl::Hud hud_;
  HudContext context_;
  std::unique_ptr<progs::Vm> vm_;
};

}  // namespace fb::csqc
