#include "csqc/mod_hud.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "base/out_of_memory.h"
#include "progs/builtins/builtins.h"
#include "ui/canvas.h"
#include "ui/hud_view.h"

namespace fb::csqc {
namespace {

namespace globals = progs::globals;
namespace fields = progs::fields;
using progs::FunctionId;

constexpr const char *kNoCsqc = "cl_nocsqc", *kOwnProgram = "csprogs.dat", *kSharedProgram = "progs.dat";
constexpr float kApiLevel = 0.0f, kVersion = 100.0f;  // of CSQC_Init: this interface only; 10000 * major + 100 * minor
constexpr float kSolidBsp = 4.0f, kMovePush = 7.0f;

// kNull where the program has none with a body.
FunctionId find_function(const progs::Program& program, std::string_view name) {
  const FunctionId id = program.find_function(name);
  return id != FunctionId::kNull && !program.functions[index(id)].is_builtin() ? id : FunctionId::kNull;
}

// A global that progs.dat need not have.
void set_named(progs::Vm& vm, std::string_view name, double value) {
  vm.set(vm.program().global<float>(name), static_cast<float>(value));
}

}  // namespace

ModHud::ModHud(con::Console& console, ui::Atlas& atlas, ModHudServices services)
    : console_(console), services_(std::move(services)), context_(console, atlas) {
  console.add_cvar({kNoCsqc, "0", "1: no status bar of the mod's own (csprogs.dat), but the game's", con::kCvarPlain,
                    0.0f, 1.0f, true});
  context_.play_sound = services_.play_sound;
  context_.register_command = [this](const std::string& name) { register_command(name); };
}

ModHud::~ModHud() { end_game(); }

// Without extensions of QuakeC there is none (vkQuake).
bool ModHud::wanted() const {
  const con::Cvar* extensions = console_.find_cvar("pr_checkextension");
  return !console_.cvar(kNoCsqc).on() && (!extensions || extensions->on());
}

// --- levels ---

std::optional<progs::Program> ModHud::load_program() const {
  if (!services_.read_file) return std::nullopt;
  if (const auto bytes = services_.read_file(kOwnProgram)) {
    auto program = progs::load_program(*bytes, kOwnProgram);
    if (program && find_function(*program, "CSQC_DrawHud") != FunctionId::kNull) return std::move(*program);
    log_info("{}: the game's own status bar is shown",
             program ? "csprogs.dat has no function CSQC_DrawHud" : program.error().message);
  }
  // Somebody may have put both into one; what is wrong with it is the server's to say.
  const auto bytes = services_.read_file(kSharedProgram);
  if (!bytes) return std::nullopt;
  auto program = progs::load_program(*bytes, kSharedProgram);
  if (!program || find_function(*program, "CSQC_DrawHud") == FunctionId::kNull) return std::nullopt;
  return std::move(*program);
}

void ModHud::start() {
  auto program = load_program();
  if (!program) return;
  for (const std::string& warning : program->warnings) log_warning("{}", warning);
  progs::Services services;
  services.console = &console_;
  services.read_file = services_.read_for_mod ? services_.read_for_mod : services_.read_file;
  services.write_file = services_.write_for_mod;
  services.flush_files = services_.flush_for_mod;
  progs::BuiltinTable table = progs::standard_builtins(services);
  add_hud_builtins(table, context_);
  auto vm = progs::Vm::create(std::make_shared<const progs::Program>(std::move(*program)), std::move(table));
  if (!vm) return log_warning("{}: the game's own status bar is shown", vm.error().message);
  vm_ = std::move(*vm);
  vm_->edicts().start_level(0);
  autocvars_.emplace(*vm_, console_);
  draw_hud_ = find_function(vm_->program(), "CSQC_DrawHud");
  draw_scores_ = find_function(vm_->program(), "CSQC_DrawScores");
  set_world();
  set_globals();
  vm_->set_parm(0, kApiLevel);
  vm_->set_parm(1, vm_->strings().intern("Fullbright"));
  vm_->set_parm(2, kVersion);
  call(find_function(vm_->program(), "CSQC_Init"));
}

void ModHud::stop() {
  if (vm_ && !failed_) call(find_function(vm_->program(), "CSQC_Shutdown"));
  for (const std::string& name : std::exchange(commands_, {})) console_.remove_command(name);
  autocvars_.reset();
  vm_.reset();
  tried_ = failed_ = false;
}

void ModHud::begin_frame(int level, const cl::Hud& hud, const Moment& moment) {
  context_.hud = &hud;
  context_.moment = moment;
  if (level_ != level) stop();
  level_ = level;
  if (tried_ || !wanted()) return;
  tried_ = true;
  start();
}

void ModHud::end_game() {
  stop();
  level_.reset();
  context_.hud = nullptr;
}

void ModHud::set_world() {
  progs::Vm& vm = *vm_;
  const cl::Hud& hud = *context_.hud;
  vm.set(globals::mapname, vm.strings().intern(hud.map_name));
  progs::Edict world = vm.edict(progs::EdictId::kWorld);
  world.set(fields::solid, kSolidBsp);
  world.set(fields::movetype, kMovePush);
  world.set(fields::modelindex, 1.0f);
  world.set(fields::model, vm.strings().intern(fmt::format("maps/{}.bsp", hud.map_name)));
  world.set(fields::message, vm.strings().intern(hud.level_name));
}

void ModHud::set_globals() {
  progs::Vm& vm = *vm_;
  const cl::Hud& hud = *context_.hud;
  const Moment& moment = context_.moment;
  const bool deathmatch = hud.game_type == 1;
  const auto stat = [&](int i) { return static_cast<float>(hud.stats[static_cast<std::size_t>(i)]); };
  vm.set(globals::time, static_cast<float>(hud.time));
  vm.set(globals::frametime, static_cast<float>(moment.seconds));
  vm.set(globals::deathmatch, deathmatch ? 1.0f : 0.0f);
  vm.set(globals::coop, !deathmatch && hud.max_clients > 1 ? 1.0f : 0.0f);
  vm.set(globals::total_secrets, stat(net::kStatTotalSecrets));
  vm.set(globals::total_monsters, stat(net::kStatTotalMonsters));
  vm.set(globals::found_secrets, stat(net::kStatSecrets));
  vm.set(globals::killed_monsters, stat(net::kStatMonsters));
  set_named(vm, "cltime", moment.now);
  set_named(vm, "clframetime", moment.seconds);
  set_named(vm, "maxclients", hud.max_clients);
  set_named(vm, "player_localnum", hud.player);
  set_named(vm, "player_localentnum", hud.player + 1);
  set_named(vm, "intermission", static_cast<int>(hud.intermission));
  set_named(vm, "intermission_time", hud.completed_time);
  vm.set(vm.program().global<vec3>("view_angles"), moment.view_angles);
  autocvars_->refresh();
}

// --- running ---

void ModHud::fail(const Error& why) {
  failed_ = true;
  log_warning("{}: the game's own status bar is shown until the next level", why.message);
}

void ModHud::call(FunctionId function) {
  if (function == FunctionId::kNull || failed_) return;
  if (const Status status = within_memory([&] { return vm_->execute(function); }); !status) fail(status.error());
}

bool ModHud::draw(scene::DrawList& list, const ui::HudView& view, std::initializer_list<FunctionId> functions) {
  const std::size_t before = list.quads.size();
  // As wide as a status bar at least.
  const vec2 output(view.output);
  const float scale = std::max(1.0f, std::min(view.settings.bar_scale, output.x / 320.0f));
  ui::Painter painter(list, context_.pictures.atlas(), ui::screen_canvas(view.output, scale));
  context_.painter = &painter;
  context_.drawn = 0;
  for (const FunctionId function : functions) {
    painter.clip_nothing();
    set_globals();
    vm_->set_parm(0, vec3(output / scale, 0.0f));
    vm_->set_parm(1, view.show_scores ? 1.0f : 0.0f);
    call(function);
  }
  context_.painter = nullptr;
  if (failed_) list.quads.resize(before);
  return !failed_;
}

bool ModHud::has_bar() const { return usable() && draw_hud_ != FunctionId::kNull; }

ui::ModBar::Drawn ModHud::draw_bar(scene::DrawList& list, const ui::HudView& view) {
  if (!usable()) return Drawn::kNothing;
  const bool scores = !context_.moment.menu_open;
  if (!draw(list, view, {draw_hud_, scores ? draw_scores_ : FunctionId::kNull})) return Drawn::kNothing;
  return draw_scores_ == FunctionId::kNull ? Drawn::kBar : Drawn::kBarAndScores;
}

bool ModHud::draw_level_end(scene::DrawList& list, const ui::HudView& view) {
  return usable() && draw_scores_ != FunctionId::kNull && draw(list, view, {draw_scores_});
}

// --- commands ---

void ModHud::register_command(const std::string& name) {
  const bool ours = std::find(commands_.begin(), commands_.end(), name) != commands_.end();
  if (ours || name.empty()) return;
  constexpr std::size_t kMostCommands = 256;
  if (console_.has_command(name) || console_.find_cvar(name) || commands_.size() >= kMostCommands)
    return log_warning("registercommand {}: {}", name,
                       commands_.size() >= kMostCommands ? "there are too many" : "the console has that name already");
  console_.add_command(name, name + ": a command of the mod's status bar",
                       [this](const con::Args& args) { run_command(args); });
  commands_.push_back(name);
}

void ModHud::run_command(const con::Args& args) {
  if (!usable() || vm_->running()) return;
  set_globals();
  vm_->set_parm(0, vm_->strings().temporary(args.rest().empty() ? args[0] : args[0] + " " + args.rest()));
  call(find_function(vm_->program(), "CSQC_ConsoleCommand"));
}

}  // namespace fb::csqc
