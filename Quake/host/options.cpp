#include "host/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "base/number.h"

namespace fb::host {
namespace {

constexpr std::uint32_t kMostPlayers = 16, kUsualPlayers = 8, kLargestSide = 16384;

template <typename T>
Status read_whole_number(const std::string& option, const std::string& text, T& value, T low,
                         T high = std::numeric_limits<T>::max()) {
  const auto number = whole_number_in<T>(option, text, low, high);
  if (!number) return number.error();
  value = *number;
  return ok_status();
}

}  // namespace

Result<uvec2> parse_size(const std::string& text) {
  const std::size_t x = std::min(text.find('x'), text.size());
  const auto side = [](std::string_view side) { return whole_number_in<std::uint32_t>("", side, 1, kLargestSide); };
  const auto width = side(std::string_view(text).substr(0, x));
  const auto height = side(std::string_view(text).substr(std::min(x + 1, text.size())));
  if (!width || !height)
    return Error{fmt::format("a size is WIDTHxHEIGHT, each 1 to {}, not '{}'", kLargestSide, text)};
  return uvec2(*width, *height);
}

Result<GameOptions> parse_game_options(const std::vector<std::string>& arguments) {
  GameOptions options;
  options.arguments = arguments;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    const auto value = [&](std::string& out) -> Status {
      if (i + 1 >= arguments.size()) return Error{fmt::format("{}: needs a value; -help lists the options", a)};
      out = arguments[++i];
      return ok_status();
    };
    if (!a.empty() && a[0] == '+') {
      // What follows, up to the next '+' or '-', is the command's.
      options.has_commands = true;
      while (i + 1 < arguments.size() && arguments[i + 1][0] != '+' &&
             (arguments[i + 1][0] != '-' ||
              (arguments[i + 1].size() > 1 && (std::isdigit(arguments[i + 1][1]) || arguments[i + 1][1] == '.')))) {
        ++i;
      }
      continue;
    }
    std::string text;
    // -dedicated and -listen: how many may play, if it says so.
    const auto players = [&]() -> Status {
      std::uint32_t count = kUsualPlayers;
      const bool given = i + 1 < arguments.size() && !arguments[i + 1].empty() && std::isdigit(arguments[i + 1][0]);
      if (given) {
        if (auto s = read_whole_number(a, arguments[++i], count, 1u, kMostPlayers); !s) return s;
      }
      options.max_clients = static_cast<int>(count);
      return ok_status();
    };
    if (a == "-help" || a == "--help" || a == "-h")
      options.help = true;
    else if (a == "-version" || a == "--version")
      options.version = true;
    else if (a == "-listdevices")
      options.list_devices = true;
    else if (a == "-headless")
      options.headless = true;
    else if (a == "-fullscreen")
      options.fullscreen = true;
    else if (a == "-window")
      options.fullscreen = false;
    else if (a == "-validation")
      options.validation = true;
    else if (a == "-hipnotic" || a == "-rogue" || a == "-quoth")
      continue;  // fs/options.h
    else if (a == "-basedir" || a == "-basegame" || a == "-game" || a == "-userdir") {
      if (auto s = value(text); !s) return s.error();
    } else if (a == "-device") {
      if (auto s = value(options.device); !s) return s.error();
    } else if (a == "-size") {
      if (auto s = value(text); !s) return s.error();
      auto size = parse_size(text);
      if (!size) return Error{"-size: " + size.error().message};
      options.size = *size;
    } else if (a == "-width" || a == "-height") {
      if (auto s = value(text); !s) return s.error();
      std::uint32_t& side = a == "-width" ? options.size.x : options.size.y;
      if (auto s = read_whole_number(a, text, side, 1u, kLargestSide); !s) return s.error();
    } else if (a == "-dedicated" || a == "-listen") {
      options.dedicated = options.dedicated || a == "-dedicated";
      if (auto s = players(); !s) return s.error();
    } else if (a == "-port") {
      if (auto s = value(text); !s) return s.error();
      if (auto s = read_whole_number(a, text, options.port, 1u, 65535u); !s) return s.error();
    } else if (a == "-seed") {
      if (auto s = value(text); !s) return s.error();
      std::uint64_t seed = 0;
      if (auto s = read_whole_number(a, text, seed, std::uint64_t{0}); !s) return s.error();
      options.seed = seed;
    } else if (a == "-capture") {
      if (auto s = value(options.capture); !s) return s.error();
    } else if (a == "-capture_every") {
      if (auto s = value(text); !s) return s.error();
      if (auto s = read_whole_number(a, text, options.capture_every, 1u); !s) return s.error();
    } else {
      return Error{fmt::format("{}: there is no such option; -help lists them", a)};
    }
  }
  if (options.size.x == 0 || options.size.y == 0) {
    if (options.size.x != 0)
      options.size.y = std::max(1u, options.size.x * 9 / 16);
    else if (options.size.y != 0)
      options.size.x = std::max(1u, options.size.y * 16 / 9);
  }
  return options;
}

std::string version_text() { return "fullbright " FULLBRIGHT_VERSION; }

std::string game_help() {
  return version_text() +
         R"(: Quake, path traced.

usage: fullbright [options] [+command arguments ...]

  -basedir DIR         folder that holds id1 (default: the current one if it does, else the base game)
  -game DIR            a mod's folder beside id1; several count, the last wins
  -hipnotic -rogue -quoth   the mission packs
  -userdir DIR         the player's own files (default: ~/.fullbright)
  -basegame DIR        the game in the box (default: beside the program); its code plays data that has no progs.dat
  -headless            no window; needs a command, e.g. +timedemo demo1
  -size WxH            of the picture (default 1280x720, headless 640x360)
  -fullscreen -window  how the window opens
  -device NAME         part of a device's name, or its index
  -listdevices         what devices there are, what each lacks, which would be chosen
  -dedicated [N]       a server for N players (8), without window or device
  -listen [N]          a game that others may join
  -port N              where (26000)
  -seed N              the same game again: seeds its random numbers
  -capture DIR         write frames as DIR/frame_000000.png ...
  -capture_every N     only every N-th frame
  -validation          Vulkan's validation layers
  -version -help

Commands run in order; a timedemo is over before the next one runs:
  fullbright -basedir ~/quake +map start
  fullbright -basedir ~/quake -headless +timedemo demo1 +quit
  fullbright -basedir ~/quake -game ad +playdemo demo1
At the console: cvarlist, cmdlist, apropos WORD, help NAME.
)";
}

}  // namespace fb::host
