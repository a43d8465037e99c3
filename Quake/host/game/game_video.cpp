// The game's window and device: how they are opened, what vid_* cvars change, what becomes of a device that is lost.
#include <fmt/format.h>

#include <utility>

#include "base/log.h"
#include "gpu/vulkan_error.h"
#include "host/game/game.h"

namespace fb::host {
namespace {

constexpr uvec2 kWindowSize{1280, 720}, kHeadlessSize{640, 360};
constexpr std::uint64_t kFewFrames = 30;  // a device that is lost within so many will be lost ever again

platform::WindowMode asked_mode(const con::Console& console) {
  using Screen = platform::WindowMode::Screen;
  platform::WindowMode mode;
  mode.width = static_cast<std::uint32_t>(console.cvar("vid_width").integer());
  mode.height = static_cast<std::uint32_t>(console.cvar("vid_height").integer());
  mode.refresh_rate = static_cast<std::uint32_t>(console.cvar("vid_refreshrate").integer());
  mode.borderless = console.cvar("vid_borderless").on();
  mode.display = static_cast<std::uint32_t>(console.cvar("vid_display").integer());
  if (console.cvar("vid_fullscreen").on())
    mode.screen = console.cvar("vid_desktopfullscreen").on() ? Screen::kDesktop : Screen::kMode;
  return mode;
}

}  // namespace

void Game::register_video() {
  con::Console& console = engine_->console();
  constexpr float kLargest = static_cast<float>(kLargestSide);
  console.add_cvar({"vid_width", std::to_string(kWindowSize.x), "width of the window, pixels; vid_restart applies it",
                    con::kCvarArchive, 320.0f, kLargest, true});
  console.add_cvar({"vid_height", std::to_string(kWindowSize.y), "height of the window, pixels; vid_restart applies it",
                    con::kCvarArchive, 200.0f, kLargest, true});
  console.add_cvar(
      {"vid_fullscreen", "0", "1: full screen; vid_restart applies it", con::kCvarArchive, 0.0f, 1.0f, true});
  console.add_cvar({"vid_desktopfullscreen", "1",
                    "full screen: 1: in the display's mode; 0: in a mode of vid_width times vid_height pixels, with "
                    "vid_refreshrate; vid_restart applies it",
                    con::kCvarArchive, 0.0f, 1.0f, true});
  console.add_cvar({"vid_refreshrate", "60", "refresh rate of a full screen in a mode of its own, Hz; 0: any",
                    con::kCvarArchive, 0.0f, 1000.0f, true});
  console.add_cvar({"vid_borderless", "0", "1: the window has no border; vid_restart applies it", con::kCvarArchive,
                    0.0f, 1.0f, true});
  console.add_cvar({"vid_display", "0", "display that shows the window, from 1; 0: where it is; vid_restart applies it",
                    con::kCvarArchive, 0.0f, 64.0f, true});
  console.add_cvar({"vid_vsync", "0", "1: pictures wait for the display; vid_restart applies it", con::kCvarArchive,
                    0.0f, 1.0f, true});
  console.add_command("vid_restart", "vid_restart: apply the vid_ cvars to the window; the game goes on",
                      [this](const con::Args&) { video_asked_ = true; });
  console.add_command("vid_toggle", "vid_toggle: between full screen and a window, as Alt and Enter do",
                      [this](const con::Args&) {
                        con::Console& cvars = engine_->console();
                        cvars.set("vid_fullscreen", cvars.cvar("vid_fullscreen").on() ? "0" : "1");
                        video_asked_ = true;
                      });
}

Status Game::open_window() {
  platform::WindowOptions options;
  const uvec2 size = options_.size.x == 0 ? kWindowSize : options_.size;
  options.mode.width = size.x;
  options.mode.height = size.y;
  if (options_.fullscreen) options.mode.screen = platform::WindowMode::Screen::kDesktop;
  auto made = platform::Window::create(options);
  if (!made) return Error{made.error().message + " (-headless needs none)"};
  window_ = std::move(*made);
  window_->set_text_input(true);
  return ok_status();
}

Status Game::open_device() {
  gpu::DeviceOptions wanted;
  wanted.preferred = options_.device;
  wanted.validation = options_.validation;
  uvec2 size = options_.size.x == 0 ? kHeadlessSize : options_.size;
  if (window_) {
    wanted.present = true;
    wanted.instance_extensions = window_->vulkan_extensions();
    size = window_->pixel_size();
  }
  auto device = gpu::Device::create(wanted);
  if (!device) return device.error();
  device_ = std::move(*device);
  engine_->library().set_most_texel_bytes(render::most_texel_bytes(*device_));
  if (window_) {
    if (auto status = open_swapchain(); !status) return status;
    show_start("starting");
  }
  auto renderer = render::Renderer::create(*device_, render::read_render_settings(engine_->console()));
  if (!renderer) return renderer.error();
  renderer_ = std::move(*renderer);
  renderer_->set_finished([this] { show_drawn(); });
  renderer_->set_waiting([this] { return wait_for_shaders(); });
  renderer_->set_precompiles(window_ != nullptr);  // who measures or records reads times and waits for no picture
  drawer_.emplace(*renderer_);
  drawer_->resize(size);
  renderer_->resize(size.x, size.y);
  if (auto status = renderer_->fit(settings()); !status) return status.error();
  log_info("{}: {}, rays by {}", version_text(), device_->report().name, renderer_->intersector_name());
  if (swapchain_) join_swapchain();
  return ok_status();
}

Status Game::open_swapchain() {
  swapchain_.reset();  // a window has one surface at a time
  auto surface = window_->create_surface(device_->instance());
  if (!surface) return surface.error();
  const uvec2 size = window_->pixel_size();
  vsync_ = engine_->console().cvar("vid_vsync").on();
  auto made = gpu::Swapchain::create(*device_, *surface, size.x, size.y, vsync_);
  if (!made) return made.error();
  swapchain_ = std::move(*made);
  return ok_status();
}

// The renderer draws for the swapchain from now on.
void Game::join_swapchain() {
  renderer_->set_swap_red_blue(swapchain_->swaps_red_and_blue());
  fit_to_window();
}

void Game::fit_to_window() {
  const uvec2 size = window_->pixel_size();
  if (size.x == 0 || size.y == 0) return;  // minimised
  if (auto status = swapchain_->resize(size.x, size.y); !status) return end_unless(status);
  drawer_->resize({swapchain_->width(), swapchain_->height()});
}

// The next start has the size that the user has given the window. Full screen and maximised windows have the display's.
void Game::keep_window_size() {
  const platform::WindowMode mode = window_->mode();
  if (!configured_ || mode.screen != platform::WindowMode::Screen::kWindow || window_->maximised()) return;
  (void)engine_->console().cvar("vid_width").set(static_cast<float>(mode.width));  // within the cvar's limits
  (void)engine_->console().cvar("vid_height").set(static_cast<float>(mode.height));
}

// Once the configuration has been executed. A size on the command line stands until vid_restart asks for another.
void Game::apply_video() {
  if (!configured_) {
    configured_ = engine_->console().buffer_empty();
    video_asked_ = configured_ && options_.size.x == 0 && !options_.fullscreen;
    if (configured_ && window_ && options_.capture.empty() && chooser_.asked()) measure_device();
  }
  if (!window_ || !std::exchange(video_asked_, false)) return;
  renderer_->finish();  // what is under way is of the former size
  window_->set_mode(asked_mode(engine_->console()));
  if (vsync_ == engine_->console().cvar("vid_vsync").on()) return;
  const Status opened = open_swapchain();
  if (opened) join_swapchain();
  end_unless(opened);
}

// Everything on the device is made anew. The game is the host's and goes on.
void Game::replace_device(const std::string& why) {
  const bool again = lost_at_ && frame_ - *lost_at_ < kFewFrames;
  lost_at_ = frame_;
  start_picture_.release();
  swapchain_.reset();
  drawer_.reset();
  renderer_.reset();
  device_.reset();
  const Error unstable{why + ", again: it does not stay; `fullbright -listdevices` lists others"};
  if (again) return end_unless(unstable);
  log_warning("{}; it is started anew", why);
  try {
    end_unless(open_device());
  } catch (const gpu::DeviceLost&) {
    end_unless(unstable);
  }
}

}  // namespace fb::host
