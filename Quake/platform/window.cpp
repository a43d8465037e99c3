#include "platform/window.h"

#ifndef SDL_MAIN_HANDLED
#define SDL_MAIN_HANDLED  // SDL must not replace main()
#endif
#include <SDL.h>
#include <SDL_vulkan.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "platform/sdl_gamepads.h"
#include "platform/sdl_events.h"

namespace fb::platform {

struct Window::Impl {
  ~Impl();
  void move_to_display(std::uint32_t display);
  bool choose_display_mode(const WindowMode& mode);
  SDL_Window* window = nullptr;
  std::vector<const char*> extensions;
  bool grabbed = false;
  Gamepads pads;
};

Window::Impl::~Impl() {
  pads.use(false);
  if (window) SDL_DestroyWindow(window);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

Result<std::unique_ptr<Window>> Window::create(const WindowOptions& options) {
  SDL_SetMainReady();
  if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0)
    return Error{fmt::format("no display could be opened ({}); -headless needs none", SDL_GetError())};
  auto impl = std::make_unique<Impl>();  // shuts SDL down if anything below fails
  SDL_StopTextInput();

  const WindowMode& mode = options.mode;
  Uint32 flags = SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
  if (mode.screen == WindowMode::Screen::kDesktop) flags |= SDL_WINDOW_FULLSCREEN_DESKTOP;
  if (mode.borderless) flags |= SDL_WINDOW_BORDERLESS;
  impl->window = SDL_CreateWindow(options.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                  static_cast<int>(mode.width), static_cast<int>(mode.height), flags);
  if (!impl->window)
    return Error{fmt::format("no window for Vulkan could be opened ({}); -headless needs none", SDL_GetError())};

  unsigned count = 0;
  if (!SDL_Vulkan_GetInstanceExtensions(impl->window, &count, nullptr))
    return Error{fmt::format("the display shows no Vulkan pictures ({})", SDL_GetError())};
  impl->extensions.resize(count);
  if (!SDL_Vulkan_GetInstanceExtensions(impl->window, &count, impl->extensions.data()))
    return Error{fmt::format("the display shows no Vulkan pictures ({})", SDL_GetError())};
  return std::unique_ptr<Window>(new Window(std::move(impl)));
}

Window::Window(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Window::~Window() = default;

const std::vector<const char*>& Window::vulkan_extensions() const { return impl_->extensions; }

Result<VkSurfaceKHR> Window::create_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (!SDL_Vulkan_CreateSurface(impl_->window, instance, &surface))
    return Error{fmt::format("the window gives Vulkan no surface ({})", SDL_GetError())};
  return surface;
}

uvec2 Window::pixel_size() const {
  if (SDL_GetWindowFlags(impl_->window) & SDL_WINDOW_MINIMIZED) return uvec2(0);
  int width = 0, height = 0;
  SDL_Vulkan_GetDrawableSize(impl_->window, &width, &height);
  return uvec2(static_cast<unsigned>(width), static_cast<unsigned>(height));
}

bool Window::focused() const { return (SDL_GetWindowFlags(impl_->window) & SDL_WINDOW_INPUT_FOCUS) != 0; }

void Window::Impl::move_to_display(std::uint32_t display) {
  const int count = SDL_GetNumVideoDisplays(), wanted = static_cast<int>(display) - 1;
  if (wanted >= count)
    return log_warning("there is no display {}: there {} {}", display, count == 1 ? "is" : "are", count);
  if (wanted < 0 || wanted == SDL_GetWindowDisplayIndex(window)) return;
  const int centre = static_cast<int>(SDL_WINDOWPOS_CENTERED_DISPLAY(static_cast<unsigned>(wanted)));
  SDL_SetWindowFullscreen(window, 0);  // it stays on its display else
  SDL_SetWindowPosition(window, centre, centre);
}

// False: the display has no such mode.
bool Window::Impl::choose_display_mode(const WindowMode& mode) {
  SDL_DisplayMode wanted{}, closest{};
  wanted.w = static_cast<int>(mode.width);
  wanted.h = static_cast<int>(mode.height);
  wanted.refresh_rate = static_cast<int>(mode.refresh_rate);
  if (!SDL_GetClosestDisplayMode(SDL_GetWindowDisplayIndex(window), &wanted, &closest)) return false;
  return closest.w == wanted.w && closest.h == wanted.h && SDL_SetWindowDisplayMode(window, &closest) == 0;
}

void Window::set_mode(const WindowMode& mode) {
  using Screen = WindowMode::Screen;
  SDL_Window* const window = impl_->window;
  impl_->move_to_display(mode.display);
  Uint32 full = mode.screen == Screen::kWindow ? 0u : static_cast<Uint32>(SDL_WINDOW_FULLSCREEN_DESKTOP);
  if (mode.screen == Screen::kMode) {
    if (impl_->choose_display_mode(mode))
      full = SDL_WINDOW_FULLSCREEN;
    else
      log_warning("the display has no mode of {}x{} pixels; it keeps its own", mode.width, mode.height);
  }
  if (SDL_SetWindowFullscreen(window, full) != 0)
    log_warning("the window cannot be made {} ({})", full ? "full screen" : "a window", SDL_GetError());
  if (full) return;
  SDL_SetWindowBordered(window, mode.borderless ? SDL_FALSE : SDL_TRUE);
  int width = 0, height = 0;
  SDL_GetWindowSize(window, &width, &height);
  if (width != static_cast<int>(mode.width) || height != static_cast<int>(mode.height))
    SDL_SetWindowSize(window, static_cast<int>(mode.width), static_cast<int>(mode.height));
}

WindowMode Window::mode() const {
  const Uint32 flags = SDL_GetWindowFlags(impl_->window);
  WindowMode mode;
  if ((flags & SDL_WINDOW_FULLSCREEN_DESKTOP) == SDL_WINDOW_FULLSCREEN_DESKTOP)
    mode.screen = WindowMode::Screen::kDesktop;
  else if (flags & SDL_WINDOW_FULLSCREEN)
    mode.screen = WindowMode::Screen::kMode;
  int width = 0, height = 0;
  SDL_GetWindowSize(impl_->window, &width, &height);
  mode.width = static_cast<std::uint32_t>(width);
  mode.height = static_cast<std::uint32_t>(height);
  mode.borderless = (flags & SDL_WINDOW_BORDERLESS) != 0;
  mode.display = static_cast<std::uint32_t>(std::max(SDL_GetWindowDisplayIndex(impl_->window), 0)) + 1;
  return mode;
}

uvec2 Window::display_size() const {
  SDL_DisplayMode mode;
  const int display = SDL_GetWindowDisplayIndex(impl_->window);
  if (display < 0 || SDL_GetDesktopDisplayMode(display, &mode) != 0) return uvec2(0);
  return uvec2(static_cast<unsigned>(mode.w), static_cast<unsigned>(mode.h));
}

void Window::grab_mouse(bool grab) {
  if (grab == impl_->grabbed) return;
  impl_->grabbed = grab;
  SDL_SetWindowMouseGrab(impl_->window, grab ? SDL_TRUE : SDL_FALSE);
  if (SDL_SetRelativeMouseMode(grab ? SDL_TRUE : SDL_FALSE) != 0)
    log_warning("the mouse cannot be {} ({})", grab ? "grabbed" : "let go", SDL_GetError());
}

bool Window::mouse_grabbed() const { return impl_->grabbed; }

bool Window::maximised() const { return (SDL_GetWindowFlags(impl_->window) & SDL_WINDOW_MAXIMIZED) != 0; }

std::string Window::clipboard() const {
  char* const text = SDL_GetClipboardText();
  std::string copy = text ? text : "";
  SDL_free(text);
  return copy;
}

void Window::set_text_input(bool on) { on ? SDL_StartTextInput() : SDL_StopTextInput(); }

void Window::use_gamepads(bool on, float trigger_threshold) {
  impl_->pads.set_trigger_threshold(trigger_threshold);
  impl_->pads.use(on);
}

PadSticks Window::take_pad_sticks() { return impl_->pads.take_sticks(); }

void Window::rumble(float strength, double seconds) { impl_->pads.rumble(strength, seconds); }

std::vector<InputEvent> Window::poll_events() {
  std::vector<InputEvent> events;
  SDL_Event event;
  while (SDL_PollEvent(&event)) {
    const std::size_t first = events.size();
    translate_event(event, events);
    impl_->pads.handle(event, events);
    for (std::size_t i = first; i < events.size(); ++i) {
      if (events[i].kind == InputEvent::Kind::kResize) {
        const uvec2 size = pixel_size();
        events[i].width = size.x;
        events[i].height = size.y;
      } else if (events[i].kind == InputEvent::Kind::kMouseMotion) {
        int width = 0, height = 0;
        SDL_GetWindowSize(impl_->window, &width, &height);
        if (width <= 0 || height <= 0) continue;
        const vec2 pixels(pixel_size());
        events[i].x *= pixels.x / static_cast<float>(width);
        events[i].y *= pixels.y / static_cast<float>(height);
      }
    }
  }
  return events;
}

}  // namespace fb::platform
