// The inside of Client: the session, the demo that feeds it, and what is shown of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/demo.h"
#include "client/session.h"
#include "client/snapshot.h"
#include "client/view.h"

namespace fb::con {
class Args;
}

namespace fb::cl {

struct Client::Impl {
  Impl(con::Console& console_, scene::ModelLibrary& library_, FileLoader files_);

  // console_commands.cpp
  void register_console();
  void read_settings();
  void next_demo();
  bool demo_command(const con::Args& args, DemoMode mode);

  // client.cpp
  Status start(Bytes data, std::string_view name, DemoMode mode);
  void end_demo(std::optional<Error> error);
  void finish_frame();
  void read_messages();
  void advance(double seconds);
  Status load_world(ClientState& state);
  void refresh_sky();
  void print(const std::string& text);
  const scene::Model* world() const { return session.state.model(1); }
  bool active() const { return (demo.has_value() || showing_map) && session.state.signon == kSignons; }

  con::Console& console;
  scene::ModelLibrary& library;
  FileLoader files;
  std::function<double()> clock;
  bool world_required = true;

  Session session;
  std::optional<DemoPlayback> demo;
  bool showing_map = false;
  std::uint64_t frame = 0;  // of the host: one an advance()
  double frame_seconds = 0.0;
  std::optional<Error> error;
  std::optional<TimeDemoResult> time_demo;
  std::vector<std::string> demo_loop;
  int demo_loop_next = -1;  // -1: not looping
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
