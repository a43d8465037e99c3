// Saving and loading: what Server does with save_game.h's text.
#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "base/out_of_memory.h"
#include "fs/path.h"
#include "server/save_game.h"
#include "server/server.h"
#include "server/simulation/link.h"
#include "server/simulation/spawn.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;

constexpr std::string_view kExtension = ".sav";
constexpr std::size_t kMostSaveBytes = 64u << 20u;  // an edict's text is some 1000

// NAME.sav; fails for names that lead out of the game's directory.
Result<std::string> save_file_name(std::string_view typed) {
  const auto name = fs::normalise(typed);
  if (!name || name->empty()) return Error{fmt::format("\"{}\" is no name for a saved game", typed)};
  return fs::ends_with_ignoring_case(*name, kExtension) ? *name : *name + std::string(kExtension);
}

// Reads the whole save into a machine that nobody sees, so that nothing can go wrong with it afterwards.
Status rehearse(const SaveGame& save, const LoadedMap& map, std::uint32_t max_edicts, std::string_view name) {
  auto vm = progs::Vm::create(map.program, {}, {.max_edicts = max_edicts});
  if (!vm) return vm.error();
  (*vm)->edicts().start_level(1);
  return read_saved_entities(**vm, save.entities, name);
}

// What the level does not precache by itself, in the order in which it came before. Those models whose number is
// another than it was.
std::vector<SavedPrecache> precache_again(GameContext& context, const std::vector<SavedPrecache>& precaches) {
  std::vector<SavedPrecache> renumbered;
  Level& level = *context.level;
  const auto& sounds = level.sounds;
  level.loading = true;  // the player has the list yet to come
  for (const SavedPrecache& saved : precaches) {
    if (saved.name.empty()) continue;
    if (!saved.is_model && std::find(sounds.begin() + 1, sounds.end(), saved.name) == sounds.end())
      add_sound(context, saved.name);
    if (!saved.is_model || level.model_index(saved.name) != 0) continue;
    if (add_model(context, saved.name) != saved.number) renumbered.push_back(saved);
  }
  level.loading = false;
  return renumbered;
}

// Edicts know models by number and by name.
void renumber(Level& level, EdictId id, const std::vector<SavedPrecache>& models) {
  Edict edict = level.edict(id);
  const int number = progs::to_int(edict.get(fields::modelindex));
  for (const SavedPrecache& saved : models)
    if (saved.number == number && saved.name == level.vm->text(edict.get(fields::model)))
      edict.set(fields::modelindex, static_cast<float>(level.model_index(saved.name)));
}

}  // namespace

bool Server::player_is_dead() {
  if (!active() || max_clients() != 1) return false;
  const ServerClient& player = clients()[0];
  return player.active() && player.spawned() && level_->edict(player.edict_id()).get(fields::health) <= 0.0f;
}

// QuakeC's `kill` leaves the health, and sets deadflag.
std::string Server::save_after_death() {
  if (!active() || max_clients() != 1 || !clients()[0].active() || !clients()[0].spawned()) return {};
  const bool lies = level_->edict(clients()[0].edict_id()).get(fields::deadflag) != 0.0f;
  return lies || player_is_dead() ? last_save_ : std::string();
}

std::optional<Error> Server::reason_not_to_save() {
  if (!active()) return Error{"no game runs here that could be saved"};
  if (max_clients() != 1) return Error{"a game for several players cannot be saved"};
  const auto intermission = level_->vm->program().global<float>("intermission_running");
  if (level_->vm->get(intermission) != 0.0f) return Error{"the game cannot be saved during the intermission"};
  if (player_is_dead()) return Error{"a game with a dead player cannot be saved"};
  return std::nullopt;
}

Status Server::save(std::string_view typed) {
  const auto name = save_file_name(typed);
  if (!name) return name.error();
  if (auto reason = reason_not_to_save()) return *reason;
  if (!services_.write_file) return Error{fmt::format("{}: there is nowhere to save to", *name)};
  const std::string text = write_save(*level_, (*clients_)[0].spawn_parms, skill_);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  autosave_.saved(level_->time);
  if (Status status = services_.write_file(*name, ByteView(bytes, text.size())); !status) return status;
  last_save_ = name->substr(0, name->size() - kExtension.size());
  if (saved_) saved_(last_save_);
  return ok_status();
}

// What cannot be written is told once, and tried again when the next one is due.
void Server::autosave_if_due() {
  if (!options_.autosaves || stands_still() || max_clients() != 1) return;
  const ServerClient& player = clients()[0];
  if (!player.active() || !player.spawned()) return;
  const double interval = static_cast<double>(console_.cvar("sv_autosave_interval").value());
  if (!autosave_.due(autosave_moment(*level_, player.edict_id()), interval)) return;
  if (!console_.cvar("sv_autosave").on() || reason_not_to_save()) return;
  const std::string name = fmt::format("autosave/{}", level_->map_name);
  const Status status = save(name);
  if (status)
    log_info("Autosaved as {}.", name);
  else if (!autosave_failed_)
    log_error("{}", status.error().message);
  autosave_failed_ = !status;
}

Status Server::load(std::string_view name) {
  return note_failure(within_memory([&] { return load_game(name); }));
}

Status Server::load_game(std::string_view typed) {
  const auto name = save_file_name(typed);
  if (!name) return name.error();
  if (options_.max_clients != 1) return Error{"a saved game is for one player: set maxplayers to 1"};
  if (services_.obstacle) {
    if (auto obstacle = services_.obstacle(*name)) return *std::move(obstacle);
  }
  const auto bytes = services_.read_save ? services_.read_save(*name) : services_.read_file(*name);
  if (!bytes) return Error{fmt::format("{}: no such saved game", *name)};
  if (bytes->size() > kMostSaveBytes)
    return Error{
        fmt::format("{}: a saved game of {} bytes; at most {} are taken", *name, bytes->size(), kMostSaveBytes)};
  const auto save = parse_save(bytes->text(), *name);
  if (!save) return save.error();
  const std::string& game = save->header.game;
  if (!game.empty() && services_.game && fs::lower_case(game) != fs::lower_case(services_.game()))
    return Error{fmt::format("{}: a saved game of \"{}\", and \"{}\" is played; `game {}` changes that", *name, game,
                             services_.game(), game)};
  const auto map_name = map_name_of(save->header.map);
  if (!map_name) return Error{fmt::format("{}: {}", *name, map_name.error().message)};
  if (loading_) loading_();
  const auto map = load_map(level_files(), *map_name);
  if (!map) return Error{fmt::format("{}: {}", *name, map.error().message)};
  if (Status status = rehearse(*save, *map, edict_limit(), *name); !status) return status;

  shutdown();
  console_.set("skill", std::to_string(save->header.skill));
  const Status resumed = within_memory([&]() -> Status {
    if (Status status = spawn_server(*map); !status) return status;
    if (Status status = resume(*save, *name); !status) return status;
    clients_->finish_level();
    return level_->failed() ? Status(*level_->error()) : ok_status();
  });
  if (!resumed) return end_level(resumed.error());
  last_error_.reset();
  last_save_ = name->substr(0, name->size() - kExtension.size());
  return start_locally();
}

Status Server::resume(const SaveGame& save, std::string_view name) {
  Level& level = *level_;
  level.light_styles = save.header.light_styles;
  const std::vector<SavedPrecache> renumbered = precache_again(context_, save.precaches);
  const auto place = [&](EdictId id, const progs::EdictText& text) {
    if (text.empty) return;
    renumber(level, id, renumbered);
    take_looks(level, id, text);
    link_edict(level, id);
  };
  if (Status status = read_saved_entities(*level.vm, save.entities, name, place); !status) return status;
  level.time = save.header.time;
  level.vm->level_time = level.time;
  level.last_check_time = 0.0;
  (*clients_)[0].spawn_parms = save.header.spawn_parms;
  server_flags_ = level.vm->get(globals::serverflags);  // a restart keeps what the save has
  level.paused = true;                                  // until the player is there
  level.loaded = true;
  autosave_ = Autosave(true);
  return ok_status();
}

}  // namespace fb::sv
