// The window: shows pictures and receives input. SDL starts with the first window and ends with the last, so that a
// program without one needs no display.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "platform/gamepad.h"
#include "platform/input_event.h"

namespace fb::platform {

// How a window lies on the displays.
struct WindowMode {
  enum class Screen {
    kWindow,
    kDesktop,  // the whole display, in the mode that it has
    kMode,     // the whole display, in a mode of its own of this size
  };
  Screen screen = Screen::kWindow;
  std::uint32_t width = 1280, height = 720;  // of the contents, in the window system's units; kDesktop has none
  std::uint32_t refresh_rate = 0;            // kMode, Hz; 0: whichever
  bool borderless = false;                   // kWindow
  std::uint32_t display = 0;                 // from 1; 0: where it is, at first the display that the system chooses
  bool operator==(const WindowMode&) const = default;
};

struct WindowOptions {
  std::string title = "Fullbright";
  WindowMode mode;
};

class Window {
 public:
  // Fails if there is no display, or none that supports Vulkan.
  static Result<std::unique_ptr<Window>> create(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // The extensions that the Vulkan instance needs; valid as long as the window.
  const std::vector<const char*>& vulkan_extensions() const;
  // Creates a surface, owned by the caller or by the swapchain that takes it; it must be destroyed before the window
  // and the instance.
  Result<VkSurfaceKHR> create_surface(VkInstance instance) const;

  // The size of the contents in pixels; 0, 0 while minimised.
  uvec2 pixel_size() const;
  bool focused() const;
  // What cannot be had is told in a warning: a display that is not there leaves the window where it is, a mode that the
  // display lacks gives the one that it has.
  void set_mode(const WindowMode& mode);
  // What it is now, whoever made it so; as in set_mode(), but for the display, which is known.
  WindowMode mode() const;
  // The size of the display that the window is on, in the window system's units; 0, 0 if it is not known.
  uvec2 display_size() const;
  // Hides the pointer and keeps it inside the window; motion then comes in mouse counts, without limit.
  void grab_mouse(bool grab);
  bool mouse_grabbed() const;
  // Whether its size is the display's because the user has maximised it, not a size to come back to.
  bool maximised() const;
  // The text that was copied last, by whichever program: UTF-8, empty if there is none.
  std::string clipboard() const;
  // Whether keys also produce text (InputEvent::Kind::kText); off at first.
  void set_text_input(bool on);

  // Game controllers: their buttons come as keys, by QuakeSpasm's names; triggers too, once they have moved by this
  // part of their way. Off at first; one that is plugged in later is found.
  void use_gamepads(bool on, float trigger_threshold);
  // The sticks of the controllers, the largest deflection of each: -1 to 1, to the right and downwards; and what their
  // gyroscopes have turned since the last call.
  PadSticks take_pad_sticks();
  // Shakes the controllers that can, for so many seconds; `strength` 0 to 1.
  void rumble(float strength, double seconds);

  // All events since the last call.
  std::vector<InputEvent> poll_events();

 private:
  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::platform
