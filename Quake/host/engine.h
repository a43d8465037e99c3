// Engine: what every way of running needs of the game: files, console, models, and a client, a server, or both, joined
// by a loopback; put together here and nowhere else. No device, no window.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/rng.h"
#include "client/client.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "host/console_log.h"
#include "host/frame_timer.h"
#include "host/options.h"
#include "host/server_list.h"
#include "net/datagram_listener.h"
#include "net/loopback.h"
#include "net/network.h"
#include "scene/library.h"
#include "server/server.h"

namespace fb::host {

struct EngineOptions {
  bool client = true;
  bool server = true;
  bool dedicated = false;  // a server whose console is the program's
  int max_clients = 1;     // above 1 others may join over the network
  std::uint16_t port = net::kDefaultPort;
  std::uint64_t seed = 0;  // of QuakeC's random numbers
  net::NetworkOptions network = {};
  std::optional<int> protocol = std::nullopt;  // what sv_protocol begins with; none: its default
  bool console_log = false;                    // into qconsole.log, see console_log.h
  std::optional<std::uint32_t> console_kilobytes = std::nullopt, particles = std::nullopt;
};

// With a client; without -seed the seed is another one each time.
EngineOptions engine_options(const GameOptions& options);

class Engine {
 public:
  // `arguments`: the command line without the program's name; those about files are taken (fs/options.h).
  // Fails with a sentence that says what to give where there is no game data, and where a dedicated server's port is
  // taken.
  static Result<std::unique_ptr<Engine>> create(const std::vector<std::string>& arguments,
                                                const EngineOptions& options = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  con::Console& console() { return console_; }
  fs::FileSystem& files() { return files_; }
  scene::ModelLibrary& library() { return library_; }
  // Only where the options ask for one.
  cl::Client& client() { return *client_; }
  sv::Server& server() { return *server_; }

  // Commands that configure a game, as Quake has them: quake.rc, or what it does where there is none; in it the command
  // line's own.
  void queue_configuration(const std::vector<std::string>& arguments);
  // Commands that wait. A `wait` lasts until the server has ticked.
  void execute_commands(double now);
  // One frame of the game: the player looks, ticks go by, the client hears of them. mouse: counts to the right and
  // downwards.
  void frame(const FramePlan& plan, const vec2& mouse, double now);
  // Is there a game, a demo, a connection or a search for servers under way, or a command to come?
  bool busy();
  // A game, a demo or a map is shown, or a game runs here.
  bool playing() const;
  // Ends it, for something that went wrong: one sentence, and the console goes on.
  void give_up(const Error& why);
  // A command could not do what it was asked to, or the last game or demo ended for something that went wrong.
  bool went_wrong() const;

 private:
  Engine(fs::FileSystem files, const EngineOptions& options, const std::vector<std::string>& arguments);
  void open_log();
  void make_server(const EngineOptions& options, const std::vector<std::string>& arguments);
  void make_client();
  Status listen(const EngineOptions& options);

  fs::FileSystem files_;
  std::unique_ptr<ConsoleLog> log_;
  con::Console console_;
  scene::ModelLibrary library_;
  Rng rng_;
  std::unique_ptr<net::Network> network_;
  ServerList server_list_;
  net::LoopbackListener loopback_;
  std::unique_ptr<net::DatagramListener> listener_;
  std::unique_ptr<sv::Server> server_;
  std::unique_ptr<cl::Client> client_;  // ends before the server
  double now_ = 0.0;
  bool ticked_ = true;
};

}  // namespace fb::host
