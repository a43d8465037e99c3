#include "host/game/game.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/check.h"
#include "base/log.h"
#include "base/log_budget.h"
#include "base/out_of_memory.h"
#include "base/stop.h"
#include "console/history_file.h"
#include "fs/file.h"
#include "host/game/screenshot_name.h"
#include "gpu/vulkan_error.h"
#include "formats/image_write.h"
#include "host/game/file_commands.h"
#include "platform/clock.h"
#include "render/passes/shader_set.h"

namespace fb::host {
namespace {

void register_host_cvars(con::Console& console) {
  console.add_cvar({"r_cpu_pixels", "129600",
                    "in a window on a CPU no more pixels than these are rendered, and scaled up; 0: all",
                    con::kCvarArchive, 0.0f, 1e8f, true});
  console.add_cvar(
      {"r_frames_ahead", "-1",
       "frames that the host prepares while the device draws: 0 none, so that input is shown sooner; 1, for "
       "more frames a second; -1: 1 while a demo is played, else 0. While a menu or the console is open: none",
       con::kCvarArchive, -1.0f, 1.0f, true});
  console.add_cvar({"host_speeds", "0", "1: print the times of every frame: in all, the host's, from input to picture",
                    con::kCvarPlain, 0.0f, 1.0f, true});
  console.add_cvar({"r_norefresh", "0", "1: without a window draw nothing, unless pictures are captured",
                    con::kCvarPlain, 0.0f, 1.0f, true});
}

constexpr double kRumbleSeconds = 0.2;

csqc::ModHudServices bar_services(Engine& engine) {
  return {
      .read_file = engine.files().loader(),
      .read_for_mod = [&engine](std::string_view name) { return engine.mod_files().read(name); },
      .write_for_mod = [&engine](std::string_view name, ByteView data) { return engine.mod_files().write(name, data); },
      .flush_for_mod = [&engine] { engine.mod_files().flush(); },
      .play_sound = [&engine](std::string_view name) { engine.sound().play_local(name); }};
}

}  // namespace

Game::Game(const GameOptions& options, std::unique_ptr<Engine> engine)
    : options_(options),
      engine_(std::move(engine)),
      sound_(*engine_),
      facts_(*engine_),
      keys_(engine_->console(), facts_),
      demo_controls_(engine_->console(), engine_->client()),
      demo_capture_(engine_->console(), engine_->files(), sound_),
      panel_(engine_->console()),
      screen_(engine_->console(), bar_services(*engine_), keys_, engine_->rules()),
      timedemo_report_(*engine_),
      chooser_(engine_->console()) {
  facts_.set_reads_at_once(options.headless);
  facts_.set_display_size([this] { return window_ ? window_->display_size() : uvec2(0); });
  keys_.set_demo_keys([this](const platform::InputEvent& event) { return demo_controls_.handle(event); });
  keys_.set_panel([this](const platform::InputEvent& event) { return panel_.handle(event); });
  keys_.menu().set_sound([this](std::string_view name) { engine_->sound().play_local(name); });
}
Game::~Game() {
  set_reproduction_hint(nullptr);
  if (renderer_) renderer_->set_finished(nullptr);
  start_picture_.release();
  swapchain_.reset();  // before the device, the device before the window
  if (!settled()) {    // the program's end takes what they compile
    (void)renderer_.release();
    (void)device_.release();
  }
  renderer_.reset();
  device_.reset();
}

Result<std::unique_ptr<Game>> Game::assemble(const GameOptions& options) {
  auto engine = Engine::create(options.arguments, engine_options(options));
  if (!engine) return engine.error();
  std::unique_ptr<Game> game(new Game(options, std::move(*engine)));
  game->register_commands();
  game->engine_->set_loading([&game = *game] { game.show_loading(); });
  sv::Server& server = game->engine_->server();
  if (!options.headless) server.set_saved([&game = *game](const std::string& name) { game.pictured_save_ = name; });
  server.set_offer_load([&game = *game](const std::string&) { game.keys_.menu().show("dead"); });
  return game;
}

Result<std::unique_ptr<Game>> Game::create(const GameOptions& options) {
  if (options.headless && !options.has_commands) {
    return Error{"-headless: there is nothing to do; give a command, for instance +timedemo demo1"};
  }
  auto assembled = assemble(options);
  if (!assembled) return assembled.error();
  std::unique_ptr<Game> game = *std::move(assembled);
  if (!options.capture.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.capture, failed);
    if (failed) return Error{fmt::format("-capture {}: {}", options.capture, failed.message())};
  }

  // Mouse look is on unless the configuration says otherwise.
  if (!options.headless) game->engine_->console().append("+mlook\n");
  game->engine_->queue_configuration(options);

  if (!options.headless)
    if (auto status = game->open_window(); !status) return status.error();
  if (!options.headless) game->read_history();
  if (auto status = game->open_device(); !status) return status.error();
  if (auto status = game->sound_.open(options); !status) return status.error();
  return game;
}

void Game::register_commands() {
  con::Console& console = engine_->console();
  register_host_cvars(console);
  register_video();
  register_governor(console, governor_);
  register_presets(console, [this] { measure_device(); });
  keys_.set_clipboard([this] { return window_ ? window_->clipboard() : std::string(); });
  console.add_command("quit", "quit: end the program", [this](const con::Args&) {
    quit_ = true;
    engine_->console().forget_commands();
  });
  if (options_.headless) {  // the loop of demos would never end
    console.remove_command("startdemos");
    console.add_command("startdemos", "startdemos: no effect without a window: the loop would never end",
                        [](const con::Args&) {});
  }
  register_game(console, engine_->files(), options_, [this](NextStart next) {
    if (!options_.headless || !next.carried.commands.empty()) next_start_ = std::move(next);
    quit_ = true;
  });
  console.add_command("viewmap", "viewmap <map>: show a map from its first player start, without starting a game",
                      [this](const con::Args& args) {
                        if (args.size() != 2) {
                          log_info("viewmap <map>: show a map from its first player start");
                          return;
                        }
                        engine_->console().fail_unless(engine_->client().map_view(args[1]));
                      });
  complete_file_names(console, engine_->files());
  console.add_command(
      "screenshot", "screenshot [name]: save the picture as screenshots/NAME.png", [this](const con::Args& args) {
        engine_->console().fail_unless(write_screenshot(args.size() > 1 ? typed_screenshot_name(args[1])
                                                                        : free_screenshot_name(engine_->files())));
      });
}

// In the order that files have, whatever the window's is.
std::vector<std::uint32_t> Game::read_picture() const {
  std::vector<std::uint32_t> pixels = renderer_->read().output();
  if (swapchain_ && swapchain_->swaps_red_and_blue()) {
    for (std::uint32_t& p : pixels) p = (p & 0xff00ff00u) | ((p & 0xffu) << 16u) | ((p >> 16u) & 0xffu);
  }
  return pixels;
}

// Where the start leads to no game and no demo, the menu shows what to do.
void Game::open_first_menu() {
  constexpr int kFrames = 3;
  if (frames_without_game_ < 0 || !window_) return;
  if (engine_->busy())
    frames_without_game_ = engine_->playing() ? -1 : 0;
  else if (++frames_without_game_ == kFrames && !keys_.console_open())
    keys_.menu().show("main");
}

Status Game::write_picture(const std::filesystem::path& path, fs::Flush flush) {
  const uvec2 size = renderer_->output_size();
  const auto png = formats::encode_png(size.x, size.y, read_picture());
  if (!png) return Error{fmt::format("{}: cannot be written: {}", path.string(), png.error().message)};
  return fs::write_file_atomically(path, *png, flush);
}

Status Game::write_screenshot(const std::string& name) {
  const auto path = engine_->files().write_path("screenshots/" + name);
  if (!path) return path.error();
  const auto status = write_picture(*path);
  if (status) log_info("wrote {}", path->string());
  return status;
}

void Game::handle_events() {
  if (!window_) return;
  for (const platform::InputEvent& event : window_->poll_events()) {
    using Kind = platform::InputEvent::Kind;
    if (event.kind == Kind::kQuit) quit_ = true;
    if (event.kind == Kind::kMouseMotion && window_->mouse_grabbed() && !keys_.menu_open())
      mouse_ += vec2(static_cast<float>(event.dx), static_cast<float>(event.dy));
    keys_.handle(event);
    if (event.kind == Kind::kResize) event.by_user ? keep_window_size() : fit_to_window();
  }
  follow_focus();
  follow_gamepads();
}

// During play the game has the mouse. While keys go elsewhere, time stops in a single-player game.
void Game::follow_focus() {
  const cl::Client& client = engine_->client();
  const bool in_game = client.connected() && client.active();
  if (in_game && !was_in_game_) keys_.close_all();
  was_in_game_ = in_game;
  keys_.set_behind(in_game           ? KeyRouter::Behind::kGame
                   : client.active() ? KeyRouter::Behind::kDemo
                                     : KeyRouter::Behind::kNothing);
  if (std::exchange(menu_was_open_, keys_.menu_open()) && !keys_.menu_open()) save_config();
  const bool elsewhere = keys_.console_open() || keys_.menu_open() || panel_.open();
  const bool grab = options_.mouse && in_game && !elsewhere && window_->focused();
  if (grab != window_->mouse_grabbed()) window_->grab_mouse(grab);
  engine_->server().hold(in_game && keys_.holds_game());
}

void Game::follow_gamepads() {
  const con::Console& console = engine_->console();
  window_->use_gamepads(options_.gamepads && console.cvar("joy_enable").on(),
                        console.cvar("joy_deadzone_trigger").value());
  const platform::PadSticks sticks = window_->take_pad_sticks();
  const bool elsewhere = keys_.holds_game();
  engine_->client().set_sticks(elsewhere ? cl::Sticks{} : cl::Sticks{sticks.left, sticks.right, sticks.turned});
  keys_.steer(sticks.left, platform::now_seconds());
  const float jolt = console.cvar("joy_rumble").value() * engine_->client().take_jolt();
  if (jolt > 0.0f && !elsewhere) window_->rumble(jolt, kRumbleSeconds);
}

// Waits if frames are faster than allowed: in a window, and on another machine's server, where time is real.
TimeSettings Game::time_settings() const {
  TimeSettings settings = read_time_settings(engine_->console());
  if (demo_capture_.active()) settings = {demo_capture_.frame_seconds(), 0.0, settings.max_fps};
  return settings;
}

// Pictures are saved, which must show the same whatever the machine does.
bool Game::records() const { return !options_.capture.empty() || demo_capture_.active(); }

double Game::seconds_passed() {
  const cl::Client& client = engine_->client();
  const bool elsewhere = client.connecting() || (client.connected() && !engine_->server().active());
  const TimeSettings settings = time_settings();
  const bool real = settings.time_scale > 0.0 || settings.frame_rate <= 0.0;
  double now = platform::now_seconds();
  if (real && (window_ || elsewhere) && !client.timing()) {
    const double shortest = std::max(1.0 / settings.max_fps, 1e-3 * governor_.shortest());
    if (now - last_time_ < shortest) platform::sleep_seconds(shortest - (now - last_time_));
    slept_ += platform::now_seconds() - now;
    now = platform::now_seconds();
  }
  // Before the first picture a window's game joins its level in real time; without one, games start at the same moment.
  const bool counts = last_time_ >= 0.0 && (window_ || frame_ > 0);
  const double passed = counts ? now - last_time_ : 0.0;
  last_time_ = now;
  return passed;
}

// A film that cannot be saved does not end the game.
void Game::record_sound() {
  const Status status = sound_.record();
  if (!status && demo_capture_.active()) return demo_capture_.give_up(status.error().message);
  end_unless(status);
}

// What cannot go on ends the program.
void Game::end_unless(const Status& status) {
  if (status) return;
  log_error("{}", status.error().message);
  quit_ = true;
  exit_status_ = 1;
}

// Measurements must leave no trace, so the configuration is saved only after play. One that has not been read, since
// the program was ended before or may not read it, is not written over.
void Game::save_config() {
  if (!started_) return;
  if (auto obstacle = engine_->files().obstacle("config.cfg")) return log_error("{}", obstacle->message);
  std::string text = engine_->console().config_text();
  if (text == written_config_) return;
  written_config_ = std::move(text);
  engine_->console().fail_unless(engine_->write_config("config.cfg"));
}

void Game::read_history() {
  auto lines = con::read_history(engine_->history_file());
  if (!lines) return log_warning("The console's former lines are not known: {}", lines.error().message);
  keys_.console_line().set_history(*std::move(lines));
}

// What cannot be kept is no reason for an exit status.
void Game::save_history() const {
  const Status status = con::add_to_history(engine_->history_file(), keys_.console_line().entered());
  if (!status) log_error("The console's lines are not kept: {}", status.error().message);
}

// Returns false if there is nothing more to do.
bool Game::frame() {
  mouse_ = vec2(0.0f);
  if (std::exchange(resized_while_waiting_, false)) fit_to_window();
  handle_events();
  input_time_ = platform::now_seconds();
  show_start("reading the level");
  engine_->execute_commands(platform::now_seconds());
  started_ |= !stop_wanted();
  if (quit_ || stop_wanted()) return false;
  apply_video();
  open_first_menu();
  if (keys_.menu_open()) facts_.update();
  const double passed = seconds_passed();
  engine_->frame(timer_.plan(passed, time_settings()), mouse_, platform::now_seconds());
  if (demo_capture_.active()) {
    if (!engine_->client().playing()) renderer_->finish();  // its last frame
    demo_capture_.follow(engine_->client().playing());
  }
  report_timing();
  sound_.update(!window_ || window_->focused());
  if (draw_frame())
    record_sound();
  else
    renderer_->finish();
  return !options_.headless || engine_->busy();
}

bool Game::settled() const { return !renderer_ || renderer_->settled(); }

int Game::run() {
  const LogBudget budget;
  set_reproduction_hint([this] {
    return fmt::format("demo {}, frame {}, {}x{}, {}", engine_->client().demo_name(), frame_,
                       renderer_->output_size().x, renderer_->output_size().y, device_->report().name);
  });
  while (!quit_ && !stop_wanted()) {
    const bool playing = engine_->playing();
    try {
      if (!frame()) break;
    } catch (const std::bad_alloc& failure) {
      if (!playing && !engine_->playing()) throw;  // there is no game to end
      engine_->give_up(Error{sentence_of(failure)});
    } catch (const gpu::DeviceLost& loss) {
      replace_device(loss.what());
    } catch (const render::ShadersAbandoned&) {  // by wait_for_shaders(), as the program is to end
      break;
    }
  }
  try {
    if (renderer_) renderer_->finish();
  } catch (const gpu::DeviceLost&) {  // nothing is drawn any more
  }
  demo_capture_.stop();
  engine_->client().disconnect();  // ends a recording, which may fail, too
  end_unless(sound_.finish());
  if (options_.headless && engine_->went_wrong()) exit_status_ = 1;
  if (window_) {
    save_config();
    save_history();
  }
  return exit_status_;
}

}  // namespace fb::host
