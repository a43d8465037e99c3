#include "server/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "base/log.h"
#include "base/log_budget.h"
#include "base/out_of_memory.h"
#include "base/progress.h"
#include "base/stop.h"
#include "progs/builtins/builtins.h"
#include "progs/entity_text.h"
#include "server/mod_cvars.h"
#include "server/server_commands.h"
#include "server/simulation/physics.h"
#include "server/simulation/spawn.h"
#include "server/simulation/user.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
namespace globals = progs::globals;

constexpr double kSettlingFrame = 0.1;  // seconds
constexpr int kSettlingFrames = 2;      // things fall to the floor before anybody sees them
constexpr int kLeastEdicts = 256, kMostEdicts = 32000;

float cvar_value(const con::Console& console, std::string_view name) {
  const con::Cvar* cvar = console.find_cvar(name);
  return cvar ? cvar->value() : 0.0f;
}

}  // namespace

Server::Server(con::Console& console, ServerServices services, const ServerOptions& options)
    : console_(console),
      services_(std::move(services)),
      options_(options),
      clients_(std::make_unique<Clients>(
          console, ClientsOptions{.max_clients = options.max_clients, .standard_quake = options.standard_quake})),
      context_(*clients_),
      commands_(std::make_unique<Commands>(*this, options)) {
  if (!services_.rng) services_.rng = &own_rng_;
  context_.localization = &console_.localization();
  context_.load_model = [this](std::string_view name) { return model(name); };
  context_.change_level = [this](std::string name) { request_changelevel(std::move(name)); };
  // For configs that come before the first level.
  const Cvars registered(console_);
  add_autosave_cvars(console_);
  add_mod_cvars(console_, services_.read_file && services_.read_file("gfx/pop.lmp").has_value());
}

Server::~Server() {
  commands_.reset();
  shutdown();
}

LevelModel Server::model(std::string_view name) {
  auto found = models_.find(name);
  if (found == models_.end()) found = models_.emplace(std::string(name), load_model(services_.read_file, name)).first;
  return found->second;
}

Status Server::set_max_clients(int count) {
  if (active()) return Error{"the number of players cannot change while a game runs"};
  options_.max_clients = std::clamp(count, 1, net::kMaxClients);
  clients_->set_max_clients(options_.max_clients);
  return ok_status();
}

// --- levels ---

// Where nothing runs that goes on all the same, that is why nothing does.
Status Server::note_failure(Status status) {
  if (!status && !active()) last_error_ = status.error();
  return status;
}

Status Server::map(std::string_view name) {
  return note_failure(within_memory([&] { return map_game(name); }));
}

Result<LoadedMap> Server::load_level(std::string_view name) {
  return within_memory([&] {
    if (loading_) loading_();
    return load_map(level_files(), name);
  });
}

// A level that nobody joins for want of memory would run for ever.
Status Server::start_locally() {
  const Status started = within_memory([&] {
    if (local_start_) local_start_();
    return ok_status();
  });
  return started ? started : end_level(started.error());
}

Status Server::map_game(std::string_view typed) {
  const auto name = map_name_of(typed);
  if (!name) return name.error();
  const auto loaded = load_level(*name);
  if (!loaded) return loaded.error();
  shutdown();
  last_save_.clear();
  server_flags_ = 0.0f;
  if (Status status = begin(*loaded); !status) return status;
  return start_locally();
}

Status Server::changelevel(std::string_view typed) {
  if (!active()) return Error{"changelevel: no game runs here"};
  const auto name = map_name_of(typed);
  if (!name) return name.error();
  const auto loaded = load_level(*name);
  if (!loaded) return loaded.error();
  const Status left = within_memory([&]() -> Status {
    last_save_.clear();
    server_flags_ = level_->vm->get(globals::serverflags);
    clients_->save_spawn_parms();
    if (level_->failed()) return *level_->error();
    clients_->send_reconnect(now_);
    return ok_status();
  });
  return left ? begin(*loaded) : end_level(left.error());
}

Status Server::restart() {
  if (!active()) return Error{"restart: no game runs here"};
  const auto loaded = load_level(level_->map_name);
  if (!loaded) return loaded.error();
  const Status left = within_memory([&] {
    clients_->send_reconnect(now_);
    return ok_status();
  });
  return left ? begin(*loaded) : end_level(left.error());
}

void Server::request_changelevel(std::string name) {
  if (next_level_.empty() && !not_reached_.contains(name)) next_level_ = std::move(name);
}

void Server::shutdown() {
  if (!level_) return;
  try {
    clients_->drop_all(now_);
  } catch (const std::bad_alloc&) {
    // They find out for themselves.
  }
  clients_->end_level();
  level_.reset();
  context_.level = nullptr;
  next_level_.clear();
}

// What went wrong ends the game, and the program goes on. QuakeC is not asked any more.
Status Server::end_level(const Error& why) {
  last_error_ = why;
  if (level_) level_->fail(why.message);
  shutdown();
  return why;
}

Status Server::begin(const LoadedMap& map) {
  const Status begun = within_memory([&]() -> Status {
    if (Status status = spawn_server(map); !status) return status;
    clients_->finish_level();
    if (level_->failed()) return *level_->error();
    log_info("Server spawned: {}", map.name);
    not_reached_.clear();
    last_error_.reset();
    return ok_status();
  });
  return begun ? begun : end_level(begun.error());
}

void Server::choose_rules() {
  if (cvar_value(console_, "coop") != 0.0f) console_.set("deathmatch", "0");
  skill_ = std::clamp(progs::to_int(cvar_value(console_, "skill") + 0.5f), 0, 3);
  console_.set("skill", std::to_string(skill_));
}

std::uint32_t Server::edict_limit() const {
  const int wanted = progs::to_int(cvar_value(console_, "max_edicts"));
  return static_cast<std::uint32_t>(std::clamp(wanted, kLeastEdicts, kMostEdicts));
}

progs::BuiltinTable Server::builtins() {
  progs::Services services;
  services.console = &console_;
  services.read_file = services_.read_for_mod ? services_.read_for_mod : services_.read_file;
  services.write_file = services_.write_for_mod ? services_.write_for_mod : services_.write_file;
  services.flush_files = services_.flush_for_mod;
  services.rng = services_.rng;
  progs::BuiltinTable table = progs::standard_builtins(services);
  add_game_builtins(table, context_);
  return table;
}

Result<std::unique_ptr<progs::Vm>> Server::make_vm(const LoadedMap& map) {
  auto vm = progs::Vm::create(map.program, builtins(), {.max_edicts = edict_limit()});
  if (vm) (*vm)->edicts().start_level(static_cast<std::uint32_t>(options_.max_clients));
  return vm;
}

void Server::set_level_globals(const LoadedMap& map) {
  progs::Vm& vm = *level_->vm;
  Edict world = level_->world_edict();
  world.set(fields::model, vm.strings().intern(level_->models.at(1).name));
  world.set(fields::modelindex, 1.0f);
  world.set(fields::solid, static_cast<float>(kSolidBsp));
  world.set(fields::movetype, static_cast<float>(kMovePush));
  if (level_->cvars.coop.on())
    vm.set(globals::coop, level_->cvars.coop.value());
  else
    vm.set(globals::deathmatch, level_->cvars.deathmatch.value());
  vm.set(globals::mapname, vm.strings().intern(map.name));
  vm.set(globals::serverflags, server_flags_);
}

// SV_SpawnServer, in its order.
Status Server::spawn_server(const LoadedMap& map) {
  choose_rules();
  clients_->end_level();
  next_level_.clear();
  level_.reset();
  auto vm = make_vm(map);
  if (!vm) return vm.error();
  level_ = std::make_unique<Level>(map.name, map.bsp, std::move(*vm), console_, *clients_, *services_.rng);
  context_.level = level_.get();
  level_->max_clients = options_.max_clients;
  autosave_ = Autosave(false);
  level_->models = map_models(map.name, map.bsp, level_->hulls);
  level_->vm->level_time = level_->time;
  clients_->begin_level(*level_);
  set_level_globals(map);
  const SpawnRules rules{skill_, level_->cvars.deathmatch.on(), level_->cvars.nomonsters.on()};
  if (Status status = spawn_entities(*level_, map.bsp->entities, map.entities_name, rules); !status) return status;
  level_->loading = false;
  level_->loaded_models = level_->models.size();
  level_->loaded_sounds = level_->sounds.size();
  level_->vm->protect_world = true;
  for (int i = 0; i < kSettlingFrames && !level_->failed(); ++i) run_physics(kSettlingFrame);
  if (level_->failed()) return *level_->error();
  return ok_status();
}

// --- frames ---

bool Server::stands_still() const { return level_->paused || (held_ && options_.max_clients == 1); }

void Server::run_physics(double seconds) {
  level_->autocvars.refresh();
  level_->frame_time = seconds;
  level_->vm->level_time = level_->time;
  physics(*level_, [this](EdictId id) {
    const ServerClient* client = clients_->find(id);
    return client && client->active();
  });
  level_->vm->level_time = level_->time;
}

void Server::run_frame(double seconds) {
  level_->frame_time = seconds;
  level_->vm->level_time = level_->time;
  level_->vm->set(globals::frametime, static_cast<float>(seconds));
  clients_->accept_new(now_);
  clients_->receive(now_, [this](ServerClient& client) {
    if (stands_still()) return;
    const UserCommand command{static_cast<float>(client.move.forward), static_cast<float>(client.move.side),
                              static_cast<float>(client.move.up)};
    client_think(*level_, client.edict_id(), command);
  });
  if (level_->failed()) return;
  if (!stands_still()) run_physics(seconds);
  if (!level_->failed()) clients_->send(now_);
}

void Server::frame(double seconds, double now) {
  now_ = now;
  if (!level_) return;
  constexpr std::size_t kMostNotReached = 64;
  if (!next_level_.empty()) {
    const std::string name = std::exchange(next_level_, std::string());
    if (Status status = changelevel(name); !status) {
      log_error("{}", status.error().message);
      if (not_reached_.size() < kMostNotReached) not_reached_.insert(name);
    }
    if (!level_) return;
  }
  try {
    run_frame(seconds);
  } catch (const std::bad_alloc& failure) {
    level_->fail(sentence_of(failure));
  }
  if (level_->failed()) {
    const Error why = *level_->error();
    log_error("{}", why.message);
    (void)end_level(why);
    return;
  }
  autosave_if_due();
}

Status Server::run(double seconds, double step) {
  if (!active()) return Error{"no game runs here"};
  if (!(seconds > 0.0) || !(step > 0.0)) return ok_status();
  level_->paused = level_->paused && clients_->active_count() > 0;
  const double frames = std::ceil(seconds / step - 1e-6);
  Progress progress("sv_run, second of the game", static_cast<std::uint64_t>(seconds), {.lines = true});
  for (double i = 0; i < frames && !stop_wanted(); ++i) {
    frame(step, now_);
    advance_log_time(step);
    progress.update(static_cast<std::uint64_t>((i + 1) * step));
    if (!active()) return last_error_.value_or(Error{"the game has ended"});
  }
  return ok_status();
}

std::string Server::dump() {
  if (!level_) return {};
  progs::Vm& vm = *level_->vm;
  std::string text = fmt::format("map {}\ntime {:f}\nskill {}\nglobals\n{}", level_->map_name, level_->time, skill_,
                                 progs::write_globals(vm));
  for (EdictId id{}; vm.edicts().valid(id); id = next(id)) {
    text += fmt::format("edict {}{}\n", index(id), vm.edicts().is_free(id) ? " free" : "");
    if (!vm.edicts().is_free(id)) text += progs::write_edict(vm, id);
  }
  return text;
}

}  // namespace fb::sv
