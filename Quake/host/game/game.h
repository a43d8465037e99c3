// The frame loop of fullbright: input, console, client, renderer, window or files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "gpu/device.h"
#include "gpu/swapchain.h"
#include "host/game/change_game.h"
#include "host/game/demo_capture.h"
#include "host/game/demo_controls.h"
#include "host/game/engine.h"
#include "host/game/frame_drawer.h"
#include "host/game/game_sound.h"
#include "host/game/governor.h"
#include "host/game/key_router.h"
#include "host/game/menu_facts.h"
#include "host/options.h"
#include "host/game/pass_report.h"
#include "host/game/presets.h"
#include "host/game/screen.h"
#include "host/game/start_picture.h"
#include "host/game/timedemo_report.h"
#include "panel/panel.h"
#include "platform/window.h"
#include "render/renderer.h"

namespace fb::host {

class Game {
 public:
  static Result<std::unique_ptr<Game>> create(const GameOptions& options);
  // The same up to the device, which needs no window either: every command and cvar is registered.
  static Result<std::unique_ptr<Game>> assemble(const GameOptions& options);
  ~Game();
  // Runs until `quit`; headless also until there is nothing left to do. Returns the exit status. Running out of memory
  // ends a game or a demo; if nothing is played, std::bad_alloc is thrown.
  int run();
  // Nothing is being compiled. If something is, which nothing can cut short, the destructor leaves renderer and device
  // alone, and the program must end by std::_Exit.
  bool settled() const;
  const con::Console& console() const { return engine_->console(); }
  // The program's next start, if `game` has asked for one and there is anything to do there.
  const std::optional<NextStart>& next_start() const { return next_start_; }

 private:
  Game(const GameOptions& options, std::unique_ptr<Engine> engine);
  void register_video();
  Status open_window();
  Status open_device();
  Status open_swapchain();
  void join_swapchain();
  void fit_to_window();
  void keep_window_size();
  void register_commands();
  void apply_video();
  void replace_device(const std::string& why);
  void open_first_menu();
  void handle_events();
  void follow_focus();
  void follow_gamepads();
  double seconds_passed();
  TimeSettings time_settings() const;
  bool records() const;
  render::RenderSettings settings() const;
  float largest_scale() const;
  void govern();
  void measure_device();
  void follow_measurement(double milliseconds, double now);
  bool frame();
  bool draw_frame();
  void draw_panel(scene::DrawList& list, ui::Atlas& atlas, uvec2 output, double now);
  void show_loading();
  void show_start(std::string_view what);
  bool wait_for_shaders();
  void follow_waiting_window();
  void show_waiting();
  void keep_picture(const render::RenderSettings& wanted);
  bool waits_for_level();
  bool starts_with_level() const;
  bool frames_ahead() const;
  void show_drawn();
  std::vector<std::uint32_t> read_picture() const;
  void capture(std::uint64_t frame);
  void record_sound();
  void end_unless(const Status& status);
  // The last frame as a PNG; the file appears when it is whole.
  Status write_picture(const std::filesystem::path& path, fs::Flush flush = fs::Flush::kNow);
  Status write_screenshot(const std::string& name);
  void report_timing();
  void save_config();
  void read_history();
  void save_history() const;
  bool takes_save_picture() const;
  void take_save_picture();

  GameOptions options_;
  std::unique_ptr<Engine> engine_;
  GameSound sound_;
  MenuFacts facts_;
  KeyRouter keys_;
  DemoControls demo_controls_;
  DemoCapture demo_capture_;
  panel::Panel panel_;
  Screen screen_;
  std::unique_ptr<platform::Window> window_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<gpu::Swapchain> swapchain_;
  std::unique_ptr<render::Renderer> renderer_;
  std::optional<FrameDrawer> drawer_;
  scene::FrameSnapshot snapshot_;
  PassReport pass_report_;
  TimedemoReport timedemo_report_;
  std::optional<NextStart> next_start_;
  bool quit_ = false, was_timing_ = false;
  bool first_timed_ = false;              // no timed frame has been shown yet: that one loads and compiles
  bool started_ = false;                  // the configuration has been read
  bool configured_ = false;               // the configuration has been executed
  bool video_asked_ = false;              // vid_restart
  bool vsync_ = false;                    // the swapchain's
  std::optional<std::uint64_t> lost_at_;  // frame at which the device was lost last
  int frames_without_game_ = 0;
  int exit_status_ = 0;
  double last_time_ = -1;
  FrameTimer timer_;
  Governor governor_;
  PresetChooser chooser_;
  double slept_ = 0;       // seconds since a picture was shown last
  vec2 mouse_{0.0f};       // mouse counts in this frame
  double input_time_ = 0;  // when this frame's input was read
  // The frame that the renderer was given last.
  struct Drawn {
    std::uint64_t number = 0;
    uvec2 size{0, 0};
    double input_time = 0;
    bool timed = false;
    std::uint64_t message = 0;  // of the demo that plays
    double demo_seconds = 0;
    int governed = 0;       // the governor's step
    bool captured = false;  // a frame of capturedemo's film
  };
  Drawn drawn_;
  StartPicture start_picture_;
  std::optional<render::RenderSettings> drawn_settings_;  // of the last frame, but for the scale
  lab::FilmFrame waiting_picture_;  // behind what is said while shaders are compiled; may be empty
  bool resized_while_waiting_ = false;
  bool pictured_ = false;                       // the renderer has drawn a picture
  double start_since_ = -1, start_shown_ = -1;  // when the start's picture was shown first, and last
  double drawn_time_ = 0;                       // when the last frame's 2D was drawn
  double shown_time_ = 0;                       // when a picture was shown last
  bool was_in_game_ = false;
  double loading_since_ = -1.0;  // when the plaque of a level that is loaded was shown; negative: none is
  std::string pictured_save_;    // NAME of a save whose picture is to be taken; empty: none
  bool left_level_ = false;      // the client has left the level that the plaque was shown over
  std::string written_config_;   // what config.cfg holds, or could not be given
  bool menu_was_open_ = false;
  std::uint64_t frame_ = 0;
};

}  // namespace fb::host
