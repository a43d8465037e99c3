// Engine: the parts of the game that every mode of running needs: files, console, models, and a client, a server, or
// both, connected by a loopback. They are put together here and nowhere else. No GPU, no window.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audio/sound_system.h"
#include "base/result.h"
#include "base/rng.h"
#include "client/client.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "fs/mod_files.h"
#include "host/game/console_log.h"
#include "host/game/frame_timer.h"
#include "host/game/mod_installer.h"
#include "host/options.h"
#include "host/game/server_list.h"
#include "net/datagram_listener.h"
#include "net/loopback.h"
#include "net/network.h"
#include "scene/library/library.h"
#include "server/server.h"
#include "ui/hud_view.h"

namespace fb::host {

struct EngineOptions {
  bool client = true;
  bool server = true;
  bool dedicated = false;  // a server whose console is the program's
  int max_clients = 1;     // above 1, others may join over the network
  std::uint16_t port = net::kDefaultPort;
  std::uint64_t seed = 0;  // of QuakeC's random numbers
  net::NetworkOptions network = {};
  std::optional<int> protocol = std::nullopt;  // initial value of sv_protocol; none: its default
  bool console_log = false;                    // into qconsole.log, see console_log.h
  bool autosaves = false;                      // games save themselves: sv_autosave
  std::optional<std::uint32_t> console_kilobytes = std::nullopt, particles = std::nullopt;
};

// Options with a client; without -seed, the seed is random.
EngineOptions engine_options(const GameOptions& options);

class Engine {
 public:
  // `arguments`: the command line without the program's name; the options about files are read here (fs/options.h).
  // Fails with a message that says what is missing if there is no game data, or if a dedicated server's port is in use.
  static Result<std::unique_ptr<Engine>> create(const std::vector<std::string>& arguments,
                                                const EngineOptions& options = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  con::Console& console() { return console_; }
  fs::FileSystem& files() { return files_; }
  fs::ModFiles& mod_files() { return mod_files_; }
  scene::ModelLibrary& library() { return library_; }
  // Whose items the game has: a mission pack's by its option or its folder.
  ui::Rules rules() const;
  // Only if the options ask for one.
  cl::Client& client() { return *client_; }
  const cl::Client& client() const { return *client_; }
  const ServerList& server_list() const { return server_list_; }
  ModInstaller& mod_installer() { return mod_installer_; }
  audio::SoundSystem& sound() { return *sound_; }  // of what the client hears; silent until somebody starts it
  sv::Server& server() { return *server_; }

  // Called before a level is loaded, which takes a while.
  void set_loading(const std::function<void()>& loading);
  // Queues the commands that configure a game, as Quake does: quake.rc, or the same steps if there is none; they
  // include those of the command line.
  void queue_configuration(const GameOptions& options);
  // Bindings and kept cvars as a file of the game's folder, whole or not at all.
  Status write_config(std::string_view name) const;
  // Where the console's lines are kept between runs, for all games.
  std::filesystem::path history_file() const;
  // Executes queued commands. A `wait` lasts until the server has ticked.
  void execute_commands(double now);
  // One frame of the game: the player's view turns, the server ticks, the client reads its messages. mouse: counts to
  // the right and downwards.
  void frame(const FramePlan& plan, const vec2& mouse, double now);
  // Whether a game, a demo, a connection, a search for servers or an installation is running, or a command is queued.
  bool busy();
  // Whether a game, a demo or a map is shown, or a game runs here.
  bool playing() const;
  // Ends the game because of an error: prints one message and returns to the console.
  void give_up(const Error& why);
  // Whether a command failed, or the last game or demo ended with an error.
  bool went_wrong() const;

 private:
  Engine(fs::FileSystem files, const EngineOptions& options, const std::vector<std::string>& arguments);
  void open_log();
  void make_server(const EngineOptions& options);
  void make_client();
  Status listen();
  void stop_listening();
  void register_listen();

  fs::FileSystem files_;
  fs::ModFiles mod_files_{files_};
  std::unique_ptr<ConsoleLog> log_;
  con::Console console_;
  scene::ModelLibrary library_;
  Rng rng_;
  std::unique_ptr<net::Network> network_;
  ServerList server_list_;
  ModInstaller mod_installer_;
  net::LoopbackListener loopback_;
  std::unique_ptr<net::DatagramListener> listener_;
  std::unique_ptr<sv::Server> server_;
  std::unique_ptr<audio::SoundSystem> sound_;
  std::unique_ptr<cl::Client> client_;  // destroyed before the server and the sound
  std::uint16_t port_;
  bool network_on_;  // not switched off by the command line
  double now_ = 0.0;
  bool ticked_ = true;
};

}  // namespace fb::host
