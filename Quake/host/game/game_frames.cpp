// The game's pictures: what is drawn of a frame, with which settings, and who is given it.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "base/stop.h"
#include "host/game/game.h"
#include "host/game/save_picture.h"
#include "platform/clock.h"
#include "render/passes/debug_views.h"
#include "render/picture/picture_size.h"

namespace fb::host {
namespace {

constexpr double kLongestLoading = 60.0, kLongestLeaving = 0.5;  // seconds that a plaque stays where no level comes
constexpr double kShortestStart = 0.04;                          // seconds between two of the start's pictures

double milliseconds_of(const std::vector<render::PassTime>& passes, std::string_view name) {
  double sum = 0.0;
  for (const render::PassTime& pass : passes) sum += pass.name == name ? pass.milliseconds : 0.0;
  return sum;
}

}  // namespace

render::RenderSettings Game::settings() const {
  render::RenderSettings settings =
      render::as_in_game(render::read_render_settings(engine_->console()), device_->is_software());
  settings.scale = governor_.scale(largest_scale());
  // A picture of another size has no past; it must not take longer for that.
  if (governor_.changed()) settings.first_spp = 1;
  return settings;
}

// Of the rendered picture, as r_scale and r_cpu_pixels allow it.
float Game::largest_scale() const {
  const render::RenderSettings settings = render::read_render_settings(engine_->console());
  const float scale = render::rendered_fraction(settings), most = engine_->console().cvar("r_cpu_pixels").value();
  if (!window_ || !device_->is_software() || most <= 0) return scale;
  return std::min(scale, render::scale_for_pixels(drawer_->size(settings), most));
}

// The first picture is the level's, where one comes: shaders for an empty world would be compiled for nothing.
bool Game::starts_with_level() const {
  if (pictured_ || !window_ || engine_->client().active() || keys_.menu_open() || keys_.console_open()) return false;
  return !configured_ || (engine_->busy() && platform::now_seconds() - start_since_ < kLongestLoading);
}

// Until the renderer's first picture something moves, whatever takes long.
void Game::show_start(std::string_view what) {
  if (!swapchain_ || pictured_) return;
  const double now = platform::now_seconds();
  if (start_since_ < 0) start_since_ = now;
  if (now - start_shown_ < kShortestStart) return;
  start_shown_ = now;
  const uvec2 size(swapchain_->width(), swapchain_->height());
  start_picture_.show(*device_, *swapchain_, screen_.draw_start(engine_->client(), size, now - start_since_, what));
}

// The level that is left, with a plaque over it; it stays till the next one can be shown.
void Game::show_loading() {
  pictured_save_.clear();
  if (!window_ || !engine_->client().active() || loading_since_ >= 0.0) return;
  renderer_->finish();
  const render::RenderSettings wanted = settings();
  drawer_->draw(snapshot_, &screen_.draw_loading(engine_->client(), drawer_->size(wanted)), wanted);
  drawn_ = {frame_, renderer_->output_size(), input_time_, false, 0, 0, governor_.step()};
  renderer_->finish();
  snapshot_.frame = ++frame_;
  loading_since_ = platform::now_seconds();
  left_level_ = false;
}

// The plaque stays till the client has left the old level and joined the next one, or till it is clear that none comes.
bool Game::waits_for_level() {
  if (loading_since_ < 0.0) return false;
  const cl::Client& client = engine_->client();
  const bool active = client.active();
  const bool coming = client.connected() || client.connecting() || engine_->server().active();
  const double longest = active ? kLongestLeaving : coming ? kLongestLoading : 0.0;
  left_level_ |= !active;
  if (!(active && left_level_) && platform::now_seconds() - loading_since_ < longest) return true;
  loading_since_ = -1.0;
  return false;
}

void Game::govern() {
  // What is measured or recorded must not depend on the machine's load.
  const bool window = window_ != nullptr && !records() && !engine_->client().timing();
  governor_.follow(target_milliseconds(engine_->console(), window, device_->is_software()), largest_scale());
  renderer_->set_hurries(window);
}

// What the device can do is not known yet; the preset that is likely to fit draws what it is measured by.
void Game::measure_device() {
  if (!window_) return log_info("preset: without a window nothing is measured");
  chooser_.begin(*find_preset(device_->is_software() ? "lavapipe" : "balanced"));
}

// A frame of a level took the device so long, without what the window's pixels took.
void Game::follow_measurement(double milliseconds, double now) {
  if (!window_ || records() || !renderer_->settled()) return;
  const uvec2 rendered = renderer_->render_size();
  const std::string said =
      chooser_.add(static_cast<double>(rendered.x) * rendered.y, milliseconds, drawer_->size(settings()), now);
  if (!said.empty()) log_info("{}", said);
}

// Before a frame that may want shaders which are not there: what is shown meanwhile.
void Game::keep_picture(const render::RenderSettings& wanted) {
  if (!swapchain_ || !pictured_) return;
  render::RenderSettings same = wanted;
  same.scale = 1;  // the governor's, which no shader depends on
  same.first_spp = 0;
  const bool changed = drawn_settings_ && *drawn_settings_ != same;
  drawn_settings_ = same;
  if (changed)
    waiting_picture_ = {renderer_->output_size(), read_picture()};
  else
    waiting_picture_ = {};
}

// Some twenty times a second; false: nobody waits any more. The former picture stays, and says why; keys that are
// pressed meanwhile are nobody's.
bool Game::wait_for_shaders() {
  if (window_) follow_waiting_window();
  if (!pictured_)
    show_start("compiling shaders");
  else
    show_waiting();
  return !quit_ && !stop_wanted();
}

void Game::follow_waiting_window() {
  for (const platform::InputEvent& event : window_->poll_events()) {
    using Kind = platform::InputEvent::Kind;
    if (event.kind == Kind::kQuit) quit_ = true;
    if (event.kind == Kind::kResize) resized_while_waiting_ = true;
    if (counts_while_waiting(event)) keys_.handle(event);
  }
}

void Game::show_waiting() {
  if (!swapchain_ || waiting_picture_.pixels.empty() || resized_while_waiting_) return;
  const uvec2 size(swapchain_->width(), swapchain_->height());
  const double now = platform::now_seconds();
  start_picture_.show(*device_, *swapchain_, screen_.draw_start(engine_->client(), size, now, "compiling shaders"),
                      waiting_picture_);
}

bool Game::draw_frame() {
  cl::Client& client = engine_->client();
  if (!client.active() && !window_) return false;
  if (waits_for_level() || starts_with_level()) return false;
  if (!window_ && !records() && engine_->console().cvar("r_norefresh").on()) return false;
  govern();
  const render::RenderSettings wanted = settings();
  const uvec2 view = screen_.picture_area(client, drawer_->size(wanted)).size;
  client.set_view_size(static_cast<int>(view.x), static_cast<int>(view.y));
  client.authored().show_baked(render::shows_baked_light(static_cast<std::uint32_t>(wanted.debug_view)));
  // Nobody waits where there is no window, and what is recorded or measured must not depend on how long a fit takes.
  if (!window_ || records() || demo_capture_.active() || client.timing()) client.settle();
  client.build_snapshot(snapshot_);
  if (!client.active()) snapshot_.assets = nullptr;  // frees the GPU memory of a level that was left
  snapshot_.frame = frame_;
  const double now = platform::now_seconds();
  // Recorded frames show what the game shows, but not what the console says, which would not repeat.
  const bool pictured = takes_save_picture();
  Screen::Moment moment{drawer_->size(wanted), now, now - std::exchange(drawn_time_, now),
                        window_ != nullptr && !pictured && !demo_capture_.active()};
  if (window_ && !records() && !pictured) {
    moment.demo_bar = demo_controls_.frame(moment.size, now);
    if (panel_.open() && !client.timing())
      moment.panel = [&](scene::DrawList& list, ui::Atlas& atlas) { draw_panel(list, atlas, moment.size, now); };
  }
  keep_picture(wanted);
  drawer_->draw(snapshot_, &screen_.draw(client, moment), wanted);
  start_picture_.release();
  drawn_ = {frame_,
            renderer_->output_size(),
            input_time_,
            client.timing(),
            client.messages_read(),
            client.time(),
            governor_.step(),
            demo_capture_.active() && client.playing()};
  // What a timedemo's first frame loads and compiles is done before its clock starts, which is at the second.
  const bool first_timed = client.timing() && first_timed_;
  if (pictured || first_timed || !frames_ahead()) renderer_->finish();
  if (pictured) take_save_picture();
  ++frame_;
  return true;
}

// Tells of the frame before this one.
void Game::draw_panel(scene::DrawList& list, ui::Atlas& atlas, uvec2 output, double now) {
  panel::Facts facts{snapshot_};
  facts.scene = renderer_->scene_statistics();
  facts.device = device_->report().name;
  facts.rays = renderer_->intersector_name();
  facts.rendered = renderer_->render_size();
  facts.device_bytes = renderer_->device_bytes();
  facts.learnt_bytes = renderer_->learnt_bytes();
  facts.accumulated = renderer_->accumulated_frames();
  panel_.draw(list, atlas, facts, output, now);
}

bool Game::takes_save_picture() const {
  return !pictured_save_.empty() && engine_->client().active() && !keys_.menu_open() && !keys_.console_open();
}

void Game::take_save_picture() {
  const Status status = write_save_picture(engine_->files(), std::exchange(pictured_save_, std::string()),
                                           read_picture(), renderer_->output_size());
  if (!status) log_warning("{}", status.error().message);
}

// Where the device draws a frame while the host prepares the next, that one's input waits for it.
bool Game::frames_ahead() const {
  return draws_ahead(engine_->console().cvar("r_frames_ahead").value(), engine_->client().playing(),
                     keys_.menu_open() || keys_.console_open());
}

// The renderer has finished the frame that it was given last.
void Game::show_drawn() {
  const Drawn drawn = drawn_;
  if (!std::exchange(pictured_, true)) start_picture_.release();
  const double drawn_at = platform::now_seconds();
  if (swapchain_ && !swapchain_->present({&renderer_->output_pixels(), drawn.size.x, drawn.size.y})) fit_to_window();
  const double now = platform::now_seconds();
  const FrameTimes times{1e3 * (now - std::exchange(shown_time_, now)), renderer_->wait_milliseconds(),
                         1e3 * (now - drawn.input_time)};
  // Of a frame that is drawn ahead the device's work goes on while the host sleeps.
  const double shown = 1e3 * (now - drawn_at);  // by the window system: nothing else goes on beside it
  const double host = std::max(0.0, times.whole - times.waited - shown - 1e3 * std::exchange(slept_, 0.0));
  const double device = std::max(renderer_->gpu_milliseconds(), times.waited);
  const bool ahead = frames_ahead();
  if (engine_->client().active())
    governor_.add(drawn.governed, shown + (ahead ? std::max(host, device) : host + device),
                  shown + milliseconds_of(renderer_->pass_times(), "present") + (ahead ? 0.0 : host), times.whole, now);
  if (engine_->client().active() && !engine_->client().timing())
    follow_measurement(device - milliseconds_of(renderer_->pass_times(), "present"), now);
  if (drawn.timed && !std::exchange(first_timed_, false)) {
    pass_report_.add(renderer_->pass_times(), times);
    timedemo_report_.add(drawn.message, drawn.demo_seconds, renderer_->pass_times(), times);
  }
  panel_.add_frame(renderer_->pass_times(), times.whole);
  if (engine_->console().cvar("host_speeds").on())
    log_info("{:7.2f} ms, host {:6.2f}, shown in {:6.2f}, input to picture {:7.2f}", times.whole,
             times.whole - times.waited, shown, times.latency);
  capture(drawn.number);
  if (drawn.captured) demo_capture_.add(drawn.size, read_picture());
}

void Game::report_timing() {
  const bool timing = engine_->client().timing();
  if (timing && !was_timing_) {
    first_timed_ = true;
    pass_report_.clear();
    if (const Status writable = timedemo_report_.begin(); !writable) {
      engine_->console().fail_unless(writable);
      engine_->console().insert("stopdemo\n");
    }
  }
  if (!timing && was_timing_) {
    renderer_->finish();
    for (const std::string& line : {pass_report_.line(), pass_report_.times_line()}) {
      if (!line.empty()) log_info("{}", line);
    }
    const auto& result = engine_->client().last_time_demo();
    engine_->console().fail_unless(timedemo_report_.end(*result, device_->report(), renderer_->output_size()));
  }
  was_timing_ = timing;
}

void Game::capture(std::uint64_t frame) {
  if (options_.capture.empty() || frame % options_.capture_every != 0) return;
  const std::string path = fmt::format("{}/frame_{:06}.png", options_.capture, frame);
  end_unless(write_picture(path, fs::Flush::kLater));
}

}  // namespace fb::host
