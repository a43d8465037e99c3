// The frame loop of fullbright: input, console, client, renderer, window or files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "gpu/device.h"
#include "gpu/swapchain.h"
#include "host/engine.h"
#include "host/frame_drawer.h"
#include "host/game_sound.h"
#include "host/options.h"
#include "host/pass_report.h"
#include "host/screen.h"
#include "platform/window.h"
#include "render/renderer.h"

namespace fb::host {

class Game {
 public:
  static Result<std::unique_ptr<Game>> create(const GameOptions& options);
  ~Game();
  // Runs until `quit`; headless also until there is nothing left to do. Returns the exit status. Running out of memory
  // ends a game or a demo; if nothing is played, std::bad_alloc is thrown.
  int run();

 private:
  Game(const GameOptions& options, std::unique_ptr<Engine> engine);
  Status open_device();
  Status open_swapchain();
  void fit_to_window();
  void register_commands();
  void handle_events();
  void follow_focus();
  double seconds_passed();
  render::RenderSettings settings() const;
  bool frame();
  bool draw_frame();
  bool draws_ahead() const;
  void show_drawn();
  void capture(std::uint64_t frame, uvec2 size);
  void end_unless(const Status& status);
  Status write_screenshot(const std::string& name);
  void report_timing();
  void save_config();

  GameOptions options_;
  std::unique_ptr<Engine> engine_;
  GameSound sound_;
  Screen screen_;
  std::unique_ptr<platform::Window> window_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<gpu::Swapchain> swapchain_;
  std::unique_ptr<render::Renderer> renderer_;
  std::optional<FrameDrawer> drawer_;
  scene::FrameSnapshot snapshot_;
  PassReport pass_report_;
  bool quit_ = false, was_timing_ = false;
  int exit_status_ = 0;
  double last_time_ = 0;
  FrameTimer timer_;
  vec2 mouse_{0.0f};       // mouse counts in this frame
  double input_time_ = 0;  // when this frame's input was read
  // The frame that the renderer was given last.
  struct Drawn {
    std::uint64_t number = 0;
    uvec2 size{0, 0};
    double input_time = 0;
    bool timed = false;
  };
  Drawn drawn_;
  double shown_time_ = 0;  // when a picture was shown last
  bool was_in_game_ = false;
  std::uint64_t frame_ = 0, captured_ = 0;
};

}  // namespace fb::host
