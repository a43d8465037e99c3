// For tests: a game controller that is driven through a pipe. Preloaded into a program that uses SDL;
// FULLBRIGHT_TEST_PAD names the pipe, whose lines are "button NUMBER 0|1" and "axis NUMBER VALUE", numbered as
// SDL_GameController numbers them.
#ifndef SDL_MAIN_HANDLED
#define SDL_MAIN_HANDLED
#endif
#include <SDL.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

class Pad {
 public:
  void follow() {
    if (!joystick_ && !attach()) return;
    char part[256];
    for (ssize_t n; (n = read(pipe_, part, sizeof(part))) > 0;) unread_.append(part, static_cast<std::size_t>(n));
    for (std::size_t end; (end = unread_.find('\n')) != unread_.npos; unread_.erase(0, end + 1))
      obey(unread_.substr(0, end));
  }

 private:
  bool attach() {
    const char* name = std::getenv("FULLBRIGHT_TEST_PAD");
    if (!name || !SDL_WasInit(SDL_INIT_GAMECONTROLLER)) return false;
    if (pipe_ < 0) pipe_ = open(name, O_RDONLY | O_NONBLOCK);
    const int device = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX,
                                                 SDL_CONTROLLER_BUTTON_MAX, 0);
    joystick_ = device < 0 ? nullptr : SDL_JoystickOpen(device);
    if (!joystick_) std::fprintf(stderr, "virtual pad: %s\n", SDL_GetError());
    return joystick_ != nullptr;
  }
  void obey(const std::string& line) const {
    int number = 0, value = 0;
    if (std::sscanf(line.c_str(), "button %d %d", &number, &value) == 2)
      SDL_JoystickSetVirtualButton(joystick_, number, static_cast<Uint8>(value));
    else if (std::sscanf(line.c_str(), "axis %d %d", &number, &value) == 2)
      SDL_JoystickSetVirtualAxis(joystick_, number, static_cast<Sint16>(value));
    else
      std::fprintf(stderr, "virtual pad: %s?\n", line.c_str());
  }

  SDL_Joystick* joystick_ = nullptr;
  int pipe_ = -1;
  std::string unread_;
};

bool following = false;

}  // namespace

// The program's call comes here, and goes on to SDL's own.
extern "C" int SDL_PollEvent(SDL_Event* event) {
  static Pad pad;
  static const auto real = reinterpret_cast<int (*)(SDL_Event*)>(dlsym(RTLD_NEXT, "SDL_PollEvent"));
  if (!following) {
    following = true;  // what is called below may poll, too
    pad.follow();
    following = false;
  }
  return real(event);
}
