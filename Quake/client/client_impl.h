// The inside of Client: the session, the source of its messages, and what is shown of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/demo_control.h"
#include "client/demo_recorder.h"
#include "client/input/input.h"
#include "client/session/session.h"
#include "client/session/view.h"
#include "client/snapshot_builder.h"
#include "client/sources/message_source.h"

namespace fb::con {
class Args;
}

namespace fb::cl {

struct Client::Impl {
  Impl(con::Console& console_, scene::ModelLibrary& library_, FileLoader files_);

  // console_commands.cpp
  void register_console();
  void read_settings();

  // demo_commands.cpp
  void register_demo_commands();
  bool demo_command(const con::Args& args, DemoMode mode);
  bool play(const std::string& name, DemoMode mode);
  void time_demo_command(const con::Args& args);
  void start_next_time_demo();
  void go_through_list(int steps);

  // game.cpp: a server as the source of messages
  void register_game_commands();
  void connect(std::unique_ptr<net::Connection> connection, std::string server);
  Status connect_to(std::string_view server);
  void poll_attempt();
  void stop_asking();
  void read_server();
  bool take_server_message(ByteView data);
  void reply_to_signon(int signon);
  void forward(const std::string& text);
  void leave_game(std::optional<Error> error);
  void disconnect();
  void send();

  // input_commands.cpp
  void register_input_commands();
  void look(double seconds, const vec2& mouse);
  void drift_pitch(double seconds);

  // recording.cpp
  void register_recording_commands();
  void record(const con::Args& args);
  void record_message(ByteView data);
  void keep_for_recording(ByteView data);
  void record_game_so_far();
  void stop_recording();
  void cut_recording(const Error& why);

  // demo_play.cpp
  Status start(FileData data, std::string_view name, DemoMode mode);
  void end_demo(std::optional<Error> error, bool whole = false);  // whole: played to its end
  void read_demo();
  void play_demo(double seconds);
  void follow_rate(double rate);
  DemoMoment demo_moment() const;
  double demo_seconds();
  void take_keyframe();
  Status restore(const Keyframe& keyframe);
  void go_to_level(std::size_t level);
  bool go_to_moment(const DemoMoment& moment);
  bool pass_to(double seconds);
  bool seek_demo(double seconds);
  void play_back(double seconds);
  void nudge_demo(int steps);
  void next_demo();

  // client.cpp
  void finish_frame();
  void show_moment(double seconds);
  void step(double seconds);
  void finish_moment();
  void advance(double seconds);
  Status load_world(ClientState& state);
  Status load_models(ClientState& state);
  void find_models(ClientState& state);
  void tell_of_even_light(const std::string& map);
  void refresh_sky();
  void print(const std::string& text);
  const scene::Model* world() const { return session.state.model(1); }
  bool active() const { return (source_has_messages() || shows_map()) && session.state.signon == kSignons; }

  // The source if it is of this kind, else null.
  DemoPlayback* demo() { return std::get_if<DemoPlayback>(&source); }
  ServerLink* link() { return std::get_if<ServerLink>(&source); }
  AskedServer* asked() { return std::get_if<AskedServer>(&source); }
  bool source_has_messages() const {
    return std::holds_alternative<DemoPlayback>(source) || std::holds_alternative<ServerLink>(source);
  }
  bool shows_map() const {
    const auto* server = std::get_if<AskedServer>(&source);
    return std::holds_alternative<StillMap>(source) || (server && server->over_map);
  }
  bool times() { return timing() || next_time_demo < time_demos.size(); }
  bool timing() { return demo() && demo()->mode() == DemoMode::kTime; }

  con::Console& console;
  scene::ModelLibrary& library;
  scene::AuthoredMap authored{library};
  FileLoader files;
  std::function<double()> clock;
  bool world_required = true;

  Session session;
  MessageSource source;

  LocalServer local;
  std::function<void()> loading;
  net::Network* network = nullptr;
  std::string last_server;  // of the last game
  double last_heard = 0.0;  // by clock(): when the server's last message came
  int games = 0;            // joined so far
  bool in_step = false;
  std::vector<Bytes> head;  // messages of this level's signon, for a recording that begins later

  Buttons buttons;
  InputSettings input;
  UserMove mouse_move;  // of the frames since the last tick
  Sticks sticks;
  StickSettings stick_settings;
  float last_forward = 0.0f;
  vec2 last_mouse{0.0f};
  PitchDrift drift;

  std::function<Result<std::filesystem::path>(std::string_view)> write_path;
  std::optional<DemoRecorder> recorder;

  std::uint64_t frame = 0;  // of the host: one an advance()
  double frame_seconds = 0.0;
  std::optional<Error> error;
  std::optional<TimeDemoResult> time_demo;
  std::vector<std::string> time_demos;  // of the last timedemo's list, every run of each
  std::size_t next_time_demo = 0;       // of that list
  std::vector<std::string> demo_loop;
  int demo_loop_next = -1;  // -1: not looping
  DemoControl control;      // of the demo that plays
  int loaded_level = 0;     // by Session::levels: whose models the library holds
  bool held = false;        // a timedemo makes what follows it wait
  std::string nolerp_list;  // as last read
  std::string unfinished_line;

  View view;
  ViewMemory view_memory;
  SnapshotBuilder snapshots;
  scene::Sky sky;
  std::optional<scene::Camera> camera;
  int width = 640, height = 480;
};

}  // namespace fb::cl
