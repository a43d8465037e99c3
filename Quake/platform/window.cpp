#include "platform/window.h"

#ifndef SDL_MAIN_HANDLED
#define SDL_MAIN_HANDLED  // SDL must not replace main()
#endif
#include <SDL.h>
#include <SDL_vulkan.h>

#include <fmt/format.h>

#include <utility>

#include "base/log.h"
#include "platform/sdl_gamepads.h"
#include "platform/sdl_events.h"

namespace fb::platform {

struct Window::Impl {
  ~Impl();
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

  Uint32 flags = SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
  if (options.fullscreen) flags |= SDL_WINDOW_FULLSCREEN_DESKTOP;
  impl->window = SDL_CreateWindow(options.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                  static_cast<int>(options.width), static_cast<int>(options.height), flags);
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

void Window::resize(std::uint32_t width, std::uint32_t height) {
  SDL_SetWindowSize(impl_->window, static_cast<int>(width), static_cast<int>(height));
}

void Window::set_fullscreen(bool fullscreen) {
  if (SDL_SetWindowFullscreen(impl_->window, fullscreen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0) != 0)
    log_warning("the window cannot be made {} ({})", fullscreen ? "full screen" : "a window", SDL_GetError());
}

bool Window::fullscreen() const {
  return (SDL_GetWindowFlags(impl_->window) & SDL_WINDOW_FULLSCREEN_DESKTOP) == SDL_WINDOW_FULLSCREEN_DESKTOP;
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

void Window::set_text_input(bool on) { on ? SDL_StartTextInput() : SDL_StopTextInput(); }

void Window::use_gamepads(bool on, float trigger_threshold) {
  impl_->pads.set_trigger_threshold(trigger_threshold);
  impl_->pads.use(on);
}

PadSticks Window::pad_sticks() const { return impl_->pads.sticks(); }

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
