// A status bar that a mod draws by QuakeC of its own ("simple CSQC" of QuakeSpasm-Spiked and vkQuake): a second virtual
// machine, on the client, for csprogs.dat or, where that has no CSQC_DrawHud, for progs.dat.
//
//   void(float api, string engine, float version) CSQC_Init;        as a level begins; may be absent
//   void(vector size, float scores) CSQC_DrawHud;                   each frame, in the status bar's place
//   void(vector size, float scores) CSQC_DrawScores;                behind it, and at a level's end; may be absent
//   float(string command) CSQC_ConsoleCommand;                      commands of registercommand; may be absent
//   void() CSQC_Shutdown;                                           as the level ends; may be absent
//
// `size` is the output's in virtual pixels of scr_sbarscale, `scores` whether +showscores is held. An error of QuakeC,
// or a loop without end, ends the bar with one sentence, and the game's own is shown until the next level.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "csqc/hud_context.h"
#include "progs/autocvars.h"
#include "progs/vm.h"
#include "ui/mod_bar.h"

namespace fb::csqc {

struct ModHudServices {
  FileLoader read_file;  // progs
  // What QuakeC reads and writes, as fs::ModFiles. Absent: read_file, and nothing is written.
  FileLoader read_for_mod = {};
  std::function<Status(std::string_view name, ByteView data)> write_for_mod = {};
  std::function<void()> flush_for_mod = {};
  std::function<void(std::string_view name)> play_sound = {};  // localsound
};

class ModHud final : public ui::ModBar {
 public:
  // Registers cl_nocsqc. Console and atlas must outlive it.
  ModHud(con::Console& console, ui::Atlas& atlas, ModHudServices services);
  ~ModHud() override;
  ModHud(const ModHud&) = delete;
  ModHud& operator=(const ModHud&) = delete;

  // Before each frame that shows a game: `level` is another number in each level. Loads the bar as a level begins.
  // `hud` must live until the next call, or end_game().
  void begin_frame(int level, const cl::Hud& hud, const Moment& moment);
  // No game is shown any more.
  void end_game();

  bool has_bar() const override;
  Drawn draw_bar(scene::DrawList& list, const ui::HudView& view) override;
  bool draw_level_end(scene::DrawList& list, const ui::HudView& view) override;

 private:
  bool wanted() const;
  bool usable() const { return vm_ && !failed_ && wanted(); }
  std::optional<progs::Program> load_program() const;
  void start();
  void stop();
  void set_world();
  void set_globals();
  void call(progs::FunctionId function);
  bool draw(scene::DrawList& list, const ui::HudView& view, std::initializer_list<progs::FunctionId> functions);
  void fail(const Error& why);
  void register_command(const std::string& name);
  void run_command(const con::Args& args);

  con::Console& console_;
  ModHudServices services_;
  HudContext context_;
  std::unique_ptr<progs::Vm> vm_;
  std::optional<progs::Autocvars> autocvars_;  // of vm_
  progs::FunctionId draw_hud_{}, draw_scores_{};
  std::optional<int> level_;
  bool tried_ = false, failed_ = false;  // in this level
  std::vector<std::string> commands_;    // of registercommand
};

}  // namespace fb::csqc
