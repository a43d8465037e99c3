// A window on a real display (Xvfb will do): a pattern goes through device and swapchain onto it, and is read back from
// the X server by ImageMagick's `import` where that is installed.
#include "platform/window.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "gpu/buffer.h"
#include "gpu/swapchain.h"
#include "gpu/test_failures.h"
#include "platform/clock.h"

namespace fb::platform {
namespace {

constexpr const char* kTitle = "Fullbright window test";

std::uint32_t channel(std::uint32_t x, std::uint32_t y, int which) {
  switch (which) {
    case 0:
      return x % 256;  // red runs to the right
    case 1:
      return y % 256;  // green runs down
    default:
      return (x / 16 + y / 16) % 2 ? 255 : 40;
  }
}

std::vector<std::uint32_t> pattern(std::uint32_t width, std::uint32_t height, bool blue_first) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t r = channel(x, y, 0), g = channel(x, y, 1), b = channel(x, y, 2);
      pixels.push_back(0xff000000u | (blue_first ? (r << 16u) | b : (b << 16u) | r) | (g << 8u));
    }
  return pixels;
}

// The window's inside as the X server shows it, three bytes a pixel; empty without `import`.
std::vector<unsigned char> read_screen() {
  const std::string command = std::string("import -silent -window '") + kTitle + "' -depth 8 rgb:- 2>/dev/null";
  std::vector<unsigned char> bytes;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return bytes;
  unsigned char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof(part), pipe)) > 0;) bytes.insert(bytes.end(), part, part + n);
  pclose(pipe);
  return bytes;
}

// The pattern's first columns and rows, and black beyond them.
void expect_pattern_on_screen(std::uint32_t width, std::uint32_t height, std::uint32_t columns, std::uint32_t rows) {
  const auto screen = read_screen();
  if (screen.empty()) {
    std::puts("ImageMagick's import is not installed: the screen is not looked at");
    return;
  }
  ASSERT_EQ(screen.size(), std::size_t{3} * width * height);
  std::size_t wrong = 0;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        wrong += screen[3 * (std::size_t{y} * width + x) + c] != (x < columns && y < rows ? channel(x, y, c) : 0u);
  EXPECT_EQ(wrong, 0u) << "channels of " << width << "x" << height << " pixels differ from what was presented";
}
void expect_pattern_on_screen(std::uint32_t width, std::uint32_t height) {
  expect_pattern_on_screen(width, height, width, height);
}

bool has_display() {
  const char* display = std::getenv("DISPLAY");
  return display && *display;
}

TEST(Window, WithoutADisplaySaysWhatToDo) {
  if (has_display() || std::getenv("WAYLAND_DISPLAY")) GTEST_SKIP() << "there is a display";
  const auto window = Window::create({});
  if (window) GTEST_SKIP() << "SDL found some other display";
  EXPECT_NE(window.error().message.find("-headless"), std::string::npos) << window.error().message;
}

TEST(Window, ShowsWhatIsPresented) {
  if (!has_display()) GTEST_SKIP() << "no DISPLAY (run under xvfb-run)";
  WindowOptions options;
  options.title = kTitle;
  options.mode.width = 320;
  options.mode.height = 200;
  auto made = Window::create(options);
  ASSERT_TRUE(made) << made.error().message;
  Window& window = **made;
  EXPECT_EQ(window.pixel_size(), uvec2(320, 200));

  gpu::DeviceOptions device_options;
  device_options.validation = device_options.synchronization_validation = true;
  device_options.present = true;
  device_options.instance_extensions = window.vulkan_extensions();
  auto device = gpu::Device::create(device_options);
  if (!device) GTEST_SKIP() << "no Vulkan device: " << device.error().message;
  auto surface = window.create_surface((*device)->instance());
  ASSERT_TRUE(surface) << surface.error().message;
  auto swapchain = gpu::Swapchain::create(**device, *surface, 320, 200, true);
  ASSERT_TRUE(swapchain) << swapchain.error().message;
  gpu::Swapchain& shown = **swapchain;

  const auto show = [&] {
    const auto pixels = pattern(shown.width(), shown.height(), shown.swaps_red_and_blue());
    gpu::Buffer buffer(**device, gpu::BufferUse::kStorage, pixels.size() * 4, "pattern");
    gpu::upload_now(**device, buffer, std::span<const std::uint32_t>(pixels));
    bool current = true;
    for (int frame = 0; frame < 5; ++frame) current &= shown.present({&buffer, shown.width(), shown.height()});
    return current;
  };
  window.poll_events();
  EXPECT_EQ(shown.width(), 320u);
  EXPECT_EQ(shown.height(), 200u);
  EXPECT_TRUE(show());
  expect_pattern_on_screen(320, 200);

  // The window changes size: an event says so, the swapchain follows.
  WindowMode smaller = options.mode;
  smaller.width = 250;
  smaller.height = 130;
  window.set_mode(smaller);
  bool resized = false;
  for (int i = 0; i < 100 && !resized; ++i) {
    for (const InputEvent& event : window.poll_events())
      resized |= event.kind == InputEvent::Kind::kResize && event.width == 250 && event.height == 130;
    sleep_seconds(0.02);
  }
  EXPECT_TRUE(resized);
  EXPECT_FALSE(show()) << "a swapchain of the old size is out of date";
  const Status again = shown.resize(250, 130);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(shown.width(), 250u);
  EXPECT_TRUE(show());
  expect_pattern_on_screen(250, 130);

  // The whole display, and back to a window without a border.
  const uvec2 display = window.display_size();
  WindowMode whole = smaller;
  whole.screen = WindowMode::Screen::kDesktop;
  const auto becomes = [&](const WindowMode& mode, uvec2 size) {
    window.set_mode(mode);
    for (int i = 0; i < 100 && window.pixel_size() != size; ++i) {
      window.poll_events();
      sleep_seconds(0.02);
    }
    EXPECT_EQ(window.pixel_size(), size);
    EXPECT_EQ(window.mode().screen, mode.screen);
    EXPECT_TRUE(shown.resize(size.x, size.y));
    EXPECT_TRUE(show());
  };
  becomes(whole, display);
  WindowMode own = whole;
  own.screen = WindowMode::Screen::kMode;
  own.width = display.x;
  own.height = display.y;
  becomes(own, display);
  smaller.borderless = true;
  smaller.display = 9;  // there is none: it stays
  becomes(smaller, uvec2(250, 130));
  EXPECT_TRUE(window.mode().borderless);
  expect_pattern_on_screen(250, 130);

  // A picture of another size than the window's.
  const auto show_part = [&](std::uint32_t width, std::uint32_t height) {
    const auto pixels = pattern(width, height, shown.swaps_red_and_blue());
    gpu::Buffer buffer(**device, gpu::BufferUse::kStorage, pixels.size() * 4, "part of the pattern");
    gpu::upload_now(**device, buffer, std::span<const std::uint32_t>(pixels));
    for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(shown.present({&buffer, width, height}));
  };
  show_part(99, 300);
  expect_pattern_on_screen(250, 130, 99, 130);
  show_part(300, 77);
  expect_pattern_on_screen(250, 130, 250, 77);
  EXPECT_EQ((*device)->validation_messages(), 0u);

  // Every call that may run out of memory does so once; the swapchain is then made anew.
  std::size_t nth = 0;
  for (bool failed = true; failed; ++nth) {
    {
      const gpu::FailingCall failing(nth);
      bool thrown = false, shows = false;
      const Status made_anew = shown.resize(250, 130);
      if (made_anew) {
        try {
          const auto pixels = pattern(250, 130, shown.swaps_red_and_blue());
          gpu::Buffer buffer(**device, gpu::BufferUse::kUpload, pixels.size() * 4, "pattern");
          gpu::upload_now(**device, buffer, std::span<const std::uint32_t>(pixels));
          shows = shown.present({&buffer, 250, 130});
        } catch (const std::bad_alloc&) {
          thrown = true;
        }
      }
      failed = !failing.failed().empty();
      EXPECT_EQ(failed, !shows) << failing.failed();
      EXPECT_EQ(failed, !made_anew || thrown || !shows) << failing.failed();
    }
    ASSERT_TRUE(shown.resize(250, 130)) << "after call " << nth;
    ASSERT_TRUE(show()) << "after call " << nth;
  }
  EXPECT_GT(nth, 15u);
  expect_pattern_on_screen(250, 130);
  EXPECT_EQ((*device)->validation_messages(), 0u);
}

TEST(Window, GrabsTheMouse) {
  if (!has_display()) GTEST_SKIP() << "no DISPLAY (run under xvfb-run)";
  auto window = Window::create({});
  ASSERT_TRUE(window) << window.error().message;
  EXPECT_FALSE((*window)->mouse_grabbed());
  (*window)->grab_mouse(true);
  EXPECT_TRUE((*window)->mouse_grabbed());
  (*window)->grab_mouse(false);
  EXPECT_FALSE((*window)->mouse_grabbed());
  (*window)->set_text_input(true);
}

}  // namespace
}  // namespace fb::platform
