// The server: keeps the game from level to level, lets each level begin as Quake's SV_SpawnServer does, and takes it
// through its frames. It knows no window and no client but over a connection.
//
//   sv::Server server(console, {.read_file = files.loader(), ...}, {.max_clients = 1});
//   server.set_local_start([&] { ... connect over a loopback ... });
//   server.clients().add_listener(loopback);
//   console.execute("map start");                  // or server.map("start")
//   each frame: server.frame(seconds_of_game, now);
//
// What a map, a mod or a save gets wrong ends at most the level, with one sentence in the log and in last_error(); the
// console goes on. So does memory that runs out. One thread uses a Server.
//
// Registers the console's map, changelevel, restart, maxplayers, save, load, edict, edicts, edictcount, profile, sv_run
// and sv_dump, and the cvars of simulation, players and mods. The console must outlive it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_data.h"
#include "base/result.h"
#include "base/rng.h"
#include "console/console.h"
#include "server/autosave.h"
#include "server/builtins/game_builtins.h"
#include "server/save_game.h"
#include "server/simulation/level.h"
#include "server/simulation/level_files.h"

namespace fb::sv {

// What a server needs of the engine. All must outlive it.
struct ServerServices {
  // Game files by name, as FileSystem::read, and which game they are from, as FileSystem::game_index_of (may be
  // absent).
  FileReader read_file;
  // Saves: those of the game that is played alone, as FileSystem::read_own. Absent: read_file.
  FileReader read_save;
  std::function<int(std::string_view name)> game_index_of;
  // The folder that is played, as FileSystem::game; absent: saves of any are taken.
  std::function<std::string()> game;
  ObstacleFinder obstacle;  // of both; may be absent
  // FileSystem::write, whole or not at all.
  std::function<Status(std::string_view name, ByteView data)> write_file;
  // What QuakeC reads and writes, as fs::ModFiles. Absent: read_file and write_file.
  FileReader read_for_mod;
  std::function<Status(std::string_view name, ByteView data)> write_for_mod;
  std::function<void()> flush_for_mod;
  Rng* rng = nullptr;  // QuakeC's random(), seeded by -seed; the server's own where there is none
};

struct ServerOptions {
  int max_clients = 1;  // 1 to 16
  bool dedicated = false;
  bool standard_quake = true;  // see ClientsOptions
  bool autosaves = false;      // where a player plays and nothing is measured
};

// QuakeC's parm1 to parm16, which a player takes along from level to level.
using SpawnParms = std::array<float, 16>;

class Server {
 public:
  Server(con::Console& console, ServerServices services, const ServerOptions& options = {});
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // As the console's commands of these names. What fails before the level that runs is given up leaves it running.
  Status map(std::string_view name);          // a new game: serverflags and what players carry begin anew
  Status changelevel(std::string_view name);  // players keep what SetChangeParms says
  Status restart();                           // the level again, with what players came with
  Status save(std::string_view name);         // NAME.sav; single player only
  Status load(std::string_view name);
  // Why the game cannot be saved now; nothing if it can.
  std::optional<Error> reason_not_to_save();
  // The save that a dead player goes back to: the last one written or loaded on this level; empty where there is none,
  // or nobody is dead.
  std::string save_after_death();
  // Ends the game: everybody is dropped. Nothing happens where there is none.
  void shutdown();

  // One tick: new clients, what they say, physics unless paused, what they are told. `seconds` of game time, above 0;
  // `now` as connections have it. Nothing happens without a game.
  void frame(double seconds, double now);
  // Frames one behind the other until this much of the game has gone by, or the program is told to end
  // (base/stop.h): sv_run. Of `step` seconds each. What lasts says on stderr how far it is.
  Status run(double seconds, double step);

  // Single player's time stands while the console or a menu is open.
  void hold(bool held) { held_ = held; }

  bool active() const { return level_ != nullptr; }
  Level* level() { return level_.get(); }  // null without a game; another after each map
  Clients& clients() { return *clients_; }
  int max_clients() const { return options_.max_clients; }
  // The number of players of the games to come. Fails while a game runs.
  Status set_max_clients(int count);
  // Called when `map` or `load` has begun a game, for a client in the same program to connect.
  void set_local_start(std::function<void()> start) { local_start_ = std::move(start); }
  // Called before a level's files are read, which takes a while.
  void set_loading(std::function<void()> loading) { loading_ = std::move(loading); }
  // Called when the game has been saved, with NAME of NAME.sav.
  void set_saved(std::function<void(const std::string& name)> saved) { saved_ = std::move(saved); }
  // Called by `restart` for a dead player who may choose (sv_autoload 1); absent: the level starts over.
  void set_offer_load(std::function<void(const std::string& name)> offer) { offer_load_ = std::move(offer); }
  // Why the last game ended, or `map` or `load` began none; nothing after a level has begun well.
  const std::optional<Error>& last_error() const { return last_error_; }
  // Every edict's fields, the globals and the time as text, which is the same for the same game.
  std::string dump();

  // All that QuakeC may call.
  progs::BuiltinTable builtins();

  // For the parts of the server, and tests.
  con::Console& console() { return console_; }
  int skill() const { return skill_; }  // of the level that runs, 0 to 3
  // QuakeC's changelevel: done before the next frame; the first one counts. What has failed is not tried again on this
  // level: an exit asks every frame while somebody stands in it.
  void request_changelevel(std::string name);

 private:
  struct Commands;
  Status spawn_server(const LoadedMap& map);  // the level begins, up to its settling frames; clients know nothing yet
  Result<std::unique_ptr<progs::Vm>> make_vm(const LoadedMap& map);
  Status resume(const SaveGame& save, std::string_view name);
  void choose_rules();
  std::uint32_t edict_limit() const;
  void set_level_globals(const LoadedMap& map);
  Status begin(const LoadedMap& map);  // spawn_server, then clients are told
  Status end_level(const Error& why);
  Status load_game(std::string_view name);
  Status map_game(std::string_view name);
  Result<LoadedMap> load_level(std::string_view name);
  Status start_locally();
  Status note_failure(Status status);
  void run_frame(double seconds);
  bool player_is_dead();
  void autosave_if_due();
  void run_physics(double seconds);
  bool stands_still() const;
  LevelFiles level_files() const { return {services_.read_file, services_.game_index_of, services_.obstacle}; }
  LevelModel model(std::string_view name);

  con::Console& console_;
  ServerServices services_;
  ServerOptions options_;
  Rng own_rng_;
  std::unique_ptr<Clients> clients_;
  GameContext context_;
  std::unique_ptr<Level> level_;
  std::map<std::string, LevelModel, std::less<>> models_;  // of files read once
  std::function<void()> local_start_, loading_;
  std::function<void(const std::string&name)> saved_, offer_load_;
  Autosave autosave_;             // of this level
  std::string last_save_;         // of this level: NAME of NAME.sav; empty: none
  bool autosave_failed_ = false;  // has been told
  std::optional<Error> last_error_;
  std::string next_level_;             // of request_changelevel
  std::set<std::string> not_reached_;  // names of such that failed on this level
  float server_flags_ = 0.0f;          // QuakeC's serverflags, kept from level to level
  int skill_ = 1;
  bool held_ = false;
  double now_ = 0.0;
  std::unique_ptr<Commands> commands_;  // goes first: its handlers call all of the above
};

}  // namespace fb::sv
