// The client: plays on a server, plays demos and records them (and, for the laboratory, shows a map without a server),
// keeps what the server's messages say, moves everything between them as QuakeSpasm does, and fills the FrameSnapshot
// that the renderer draws. The loop of its user, a frame at a time:
//
//   console.execute();                 // connect, playdemo, +forward, ... are the client's commands
//   client.look(seconds, mouse);       // turns the view: who only watches demos need not
//   client.send();                     // at every tick of the server: what the player wants to do
//   server.frame(...);                 // where the server is in the same program
//   client.advance(seconds);           // messages that are due, interpolation, particles, view
//   client.build_snapshot(snapshot);   // as often as wanted; the same frame gives the same snapshot
//
// Everything random comes from one seed: the same demo with the same time steps gives the same snapshots.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/file_data.h"
#include "base/maths.h"
#include "base/result.h"
#include "client/input/sticks.h"
#include "client/session/hud.h"
#include "client/sources/demo_mode.h"
#include "scene/authored/authored_map.h"
#include "scene/library/library.h"
#include "scene/snapshot.h"
#include "scene/sounds.h"

namespace fb::con {
class Console;
}
namespace fb::net {
class Connection;
class Network;
}  // namespace fb::net

namespace fb::cl {

struct Session;

// The server in the same program, where there is one.
struct LocalServer {
  std::function<std::unique_ptr<net::Connection>()> connect;  // null: no game runs there
  std::function<void()> shut_down;                            // the player leaves, and the game ends with that
};

class Client {
 public:
  // Registers cvars and commands on the console; all three must outlive the client, and the console executes none of
  // these commands once the client is gone. `files` opens demos by name.
  Client(con::Console& console, scene::ModelLibrary& library, FileLoader files);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // Starts at the demo's first message, read by the next advance(). "demo1", "demo1.dem", "demos/x".
  Status start_demo(std::string_view name, DemoMode mode);
  Status start_demo(FileData data, std::string_view name, DemoMode mode);
  // Ends playback; a timedemo prints its line.
  void stop();
  // Of the demo that plays; none for a timedemo, which cannot be directed either.
  std::optional<DemoStatus> demo_status() const;
  // Shows the demo at this time of its own: the first frame, of those 1/72 s apart, that is not before it, and all that
  // a player of such frames would have there. False: there is no such demo, or what is read on the way ends it.
  bool seek_demo(double seconds);
  void pause_demo(bool paused);
  bool playing() const;
  bool timing() const;  // playing in DemoMode::kTime
  // Why the last demo or game ended, if not by its own end or because the player wanted it.
  const std::optional<Error>& last_error() const;
  const std::optional<TimeDemoResult>& last_time_demo() const;
  bool more_to_time() const;  // demos of a timedemo's list are left

  // A map without a server: its world, its brush entities where they stand at the start, its lamps; the camera in the
  // first info_player_start. "start" or "maps/start.bsp".
  Status map_view(std::string_view name);

  // Playing. What is given here must outlive the client; without it `connect` and `record` say what is missing.
  void set_local_server(LocalServer local);
  void set_network(net::Network& network);
  // Where to write a file of this name.
  void set_write_path(std::function<Result<std::filesystem::path>(std::string_view name)> write_path);
  // Called before a level of another machine's server is loaded, which takes a while.
  void set_loading(std::function<void()> loading);
  // Joins a game over an open connection, leaving what went on before; `server` is what sentences call it. A local
  // server's game that one joins again is not shut down thereby.
  void connect(std::unique_ptr<net::Connection> connection, std::string server);
  // "local", or a server's name or address, with or without a port. Over a network it goes on in advance().
  Status connect(std::string_view server);
  // Leaves the game, ends recording, and shuts a local server down.
  void disconnect();
  // Ends what is shown, a game, a demo or a map, for something that went wrong elsewhere; says so in last_error().
  void give_up(const Error& why);
  bool connected() const;      // to a server, be it in the midst of signing on
  bool connecting() const;     // still asking
  bool serves_itself() const;  // connected to the server in the same program
  bool recording() const;
  bool mouse_looks() const;  // +mlook is down
  // The local server runs once a frame, so the client shows its latest word instead of going there over a tick.
  void set_in_step(bool in_step);

  // Turns the view by keys and by the mouse's counts (to the right, downwards) in a frame of `seconds`.
  void look(double seconds, const vec2& mouse = vec2(0.0f));
  // Where a game controller's sticks are from now on, and how far it was turned; look() turns the view by them, too.
  void set_sticks(const Sticks& sticks);
  // How hard damage and recoil have shaken the player of a game since the last call, 0 to 1.
  float take_jolt();
  // Tells the server what the player wants to do, and commands that wait. At each tick of the server's.
  void send();

  // Waits for what is still found out about the map beside the game, so that the next frame has all of it.
  void settle();
  scene::AuthoredMap& authored();
  std::vector<float> light_style_values() const;  // as they are now, by number; 1 is a lightmap as it is
  // Moves time on by `seconds` (0 keeps it) and everything with it.
  void advance(double seconds);
  // Is there a world to show, and are the signon messages complete?
  bool active() const;
  // How many levels have begun so far: another number is another level.
  int levels() const;

  // The image's size in pixels, for the field of view (fov, fov_adapt). Default 640x480.
  void set_view_size(int width, int height);
  // The most particles that there are at a time.
  void set_particle_limit(std::size_t limit);
  // Looks from here instead of from the player's eyes; the player's body is then seen by all. fov_x 0: the player's.
  void set_camera(const std::optional<scene::Camera>& camera);

  // Everything there is to see now, and where it was in the snapshot before. Two builds without an advance() between
  // them give the same.
  void build_snapshot(scene::FrameSnapshot& snapshot);

  // Who is told what there is to hear, as it happens (also of a level's end, in which everything falls silent).
  void set_sound_listener(scene::SoundListener listener);
  // From where it is heard now, and what sounds around there.
  scene::SoundScene sound_scene() const;

  const Session& session() const;  // all that it knows of the game
  const Hud& hud() const;
  MusicTracks music() const;
  Fog fog() const;
  vec3 view_angles() const;    // degrees: where the player looks
  vec3 player_origin() const;  // of the view entity; 0 before it is known
  vec3 velocity() const;       // of the player, units a second
  double time() const;         // seconds of the server's clock
  double silence() const;      // seconds since another machine's server was heard last; 0 on a server of one's own
  int protocol() const;        // 15, 666 or 999; 0 before the first serverinfo
  const std::string& demo_name() const;
  std::size_t messages_read() const;  // of the demo that plays

  // Where timedemo and connections take the time from, seconds; default a steady clock.
  void set_clock(std::function<double()> clock);
  // Without this (the default is true) a demo whose map is missing plays on without a world: tests of messages alone.
  void set_world_required(bool required);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::cl
