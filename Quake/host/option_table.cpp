#include "host/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "base/number.h"

namespace fb::host {
namespace {

constexpr std::uint32_t kMostPlayers = 16, kUsualPlayers = 8;
constexpr std::uint32_t kLeastConsole = 16, kMostConsole = 1024 * 1024;  // KB
constexpr std::uint32_t kLeastParticles = 512, kMostParticles = 32768;   // QuakeSpasm's

Result<std::uint32_t> number_from(const std::string& text, std::uint32_t least, std::uint32_t most) {
  const auto number = parse_whole_number_unsigned(text);
  if (!number || *number < least || *number > most)
    return Error{fmt::format("a whole number from {} to {} is wanted", least, most)};
  return static_cast<std::uint32_t>(*number);
}

Status take_number(const std::string& text, std::uint32_t least, std::uint32_t most, std::uint32_t& to) {
  const auto number = number_from(text, least, most);
  if (!number) return number.error();
  to = *number;
  return ok_status();
}

Status take_rate(const std::string& text, std::uint32_t least, std::uint32_t most, std::optional<std::uint32_t>& to) {
  std::uint32_t rate = 0;
  const Status status = take_number(text, least, most, rate);
  if (status) to = rate;
  return status;
}

Status take_players(GameOptions& options, const std::string& text) {
  std::uint32_t count = kUsualPlayers;
  const Status status = text.empty() ? ok_status() : take_number(text, 1, kMostPlayers, count);
  if (status) options.max_clients = static_cast<int>(count);
  return status;
}

Status take_port(GameOptions& options, const std::string& text) { return take_number(text, 1, 65535, options.port); }

Status take_protocol(GameOptions& options, const std::string& text) {
  const auto protocol = parse_whole_number(text);
  if (protocol != 15 && protocol != 666 && protocol != 999)
    return Error{"15 (NetQuake), 666 (FitzQuake) or 999 (RMQ) is wanted"};
  options.protocol = static_cast<int>(*protocol);
  return ok_status();
}

Status take_address(GameOptions& options, const std::string& text) {
  const auto address = net::parse_address(text);
  if (!address) return Error{"one of this machine's addresses in numbers is wanted, such as 192.0.2.1"};
  options.network.own_address = address;
  return ok_status();
}

Status take_size(GameOptions& options, const std::string& text) {
  const auto size = parse_size(text);
  if (!size) return size.error();
  options.size = *size;
  return ok_status();
}

Status take_seed(GameOptions& options, const std::string& text) {
  const auto seed = parse_whole_number_unsigned(text);
  if (!seed) return Error{"a whole number, not below 0, is wanted"};
  options.seed = seed;
  return ok_status();
}

Status take_safe(GameOptions& options, const std::string&) {
  options.network.ipv4 = options.network.ipv6 = options.mouse = options.sound = false;
  return ok_status();
}

Status switch_off_network(GameOptions& options, const std::string&) {
  options.network.ipv4 = options.network.ipv6 = false;
  return ok_status();
}

// fs/options.h and base_game.h read these; here they only have to be known.
Status read_elsewhere(GameOptions&, const std::string&) { return ok_status(); }

template <bool GameOptions::*kMember, bool kValue = true>
Status flag(GameOptions& options, const std::string&) {
  options.*kMember = kValue;
  return ok_status();
}

// Why an option has no effect. -help lists options with the same reason together.
constexpr const char* kDisc = "music comes from files, not from a disc";
constexpr const char* kMemory = "memory is allocated as needed";
constexpr const char* kDisplay = "full screen keeps the display's mode, and the path tracer does its own anti-aliasing";
constexpr const char* kOpenGl = "there is no OpenGL renderer";
constexpr const char* kStores = "Quake is looked for in -basedir, by Steam and by GOG; the re-release is preferred";
constexpr const char* kLooks = "there is no other look to choose";
constexpr const char* kNothing = "there is no such feature to switch";

constexpr Option kOptions[] = {
    {"-basedir", "DIR", read_elsewhere,
     "folder that holds id1 (default: the current one; else Quake of Steam or GOG, or the base game)"},
    {"-steam", "", read_elsewhere, "play Steam's Quake, not GOG's; also -gog; -nosteam, -nogog: look for none there"},
    {"-gog", "", read_elsewhere, nullptr},
    {"-nosteam", "", read_elsewhere, nullptr},
    {"-nogog", "", read_elsewhere, nullptr},
    {"-preforiginal", "", read_elsewhere,
     "of a store's Quake the original, not the re-release of 2021; also -original"},
    {"-original", "", read_elsewhere, nullptr},
    {"-game", "DIR", read_elsewhere, "a mod's folder beside id1; may be repeated, later ones take precedence"},
    {"-hipnotic", "", read_elsewhere, "play a mission pack or mod of this name; also -rogue, -quoth"},
    {"-rogue", "", read_elsewhere, nullptr},
    {"-quoth", "", read_elsewhere, nullptr},
    {"-userdir", "DIR", read_elsewhere, "folder for saves, demos and configuration (default: ~/.fullbright)"},
    {"-nohome", "", read_elsewhere, "write saves, demos and configuration beside the game data"},
    {"-basegame", "DIR", read_elsewhere,
     "folder of the base game (default: beside the program); its rules play data without a progs.dat"},
    {"-headless", "", flag<&GameOptions::headless>, "run without a window; needs a command, e.g. +timedemo demo1"},
    {"-size", "WxH", take_size, "size of the picture, pixels (default 1280x720, headless 640x360)"},
    {"-width", "N", [](GameOptions& o, const std::string& v) { return take_number(v, 1, kLargestSide, o.size.x); },
     "width of the picture, pixels; without -height it is 16:9"},
    {"-height", "N", [](GameOptions& o, const std::string& v) { return take_number(v, 1, kLargestSide, o.size.y); },
     "height of the picture, pixels; without -width it is 16:9"},
    {"-fullscreen", "", flag<&GameOptions::fullscreen>, "full screen"},
    {"-window", "", flag<&GameOptions::fullscreen, false>, "a window (the default)"},
    {"-nomouse", "", flag<&GameOptions::mouse, false>, "do not use the mouse"},
    {"-nojoy", "", flag<&GameOptions::gamepads, false>, "do not use game controllers"},
    {"-device", "NAME",
     [](GameOptions& o, const std::string& v) {
       o.device = v;
       return ok_status();
     },
     "Vulkan device: part of its name, or its index in -listdevices"},
    {"-listdevices", "", flag<&GameOptions::list_devices>,
     "list the Vulkan devices: what each lacks, which one is chosen"},
    {"-particles", "N",
     [](GameOptions& o, const std::string& v) {
       std::uint32_t count = 0;
       const Status status = take_number(v, 1, 1000000000, count);
       if (status) o.particles = std::clamp(count, kLeastParticles, kMostParticles);
       return status;
     },
     "limit on particles, 512 to 32768 (2048)"},
    {"-dedicated", "[N]",
     [](GameOptions& o, const std::string& v) {
       o.dedicated = true;
       return take_players(o, v);
     },
     "dedicated server for N players (8), without window or GPU"},
    {"-listen", "[N]", take_players, "play in a window as a server for N players (8)"},
    {"-port", "N", take_port, "UDP port of the server (26000); also -udpport, -ipxport"},
    {"-udpport", "N", take_port, nullptr},
    {"-ipxport", "N", take_port, nullptr},
    {"-ip", "ADDRESS", take_address, "use this one of the machine's network addresses"},
    {"-protocol", "N", take_protocol, "protocol of the server: 15, 666 or 999 (666); sets sv_protocol"},
    {"-nolan", "", switch_off_network, "no network; also -noudp"},
    {"-noudp", "", switch_off_network, nullptr},
    {"-noudp4", "",
     [](GameOptions& o, const std::string&) {
       o.network.ipv4 = false;
       return ok_status();
     },
     "no IPv4"},
    {"-noudp6", "",
     [](GameOptions& o, const std::string&) {
       o.network.ipv6 = false;
       return ok_status();
     },
     "no IPv6"},
    {"-safe", "", take_safe, "same as -nolan -nomouse -nosound"},
    {"-condebug", "", flag<&GameOptions::console_log>,
     "log the console to qconsole.log in the player's folder (-userdir)"},
    {"-consize", "N",
     [](GameOptions& o, const std::string& v) {
       std::uint32_t size = 0;
       const Status status = take_number(v, 1, 4000000000u, size);
       if (status) o.console_kilobytes = std::clamp(size, kLeastConsole, kMostConsole);
       return status;
     },
     "size of the console's scrollback, KB (1024)"},
    {"-seed", "N", take_seed, "seed of QuakeC's random numbers: the same script gives the same game"},
    {"-capture", "DIR",
     [](GameOptions& o, const std::string& v) {
       o.capture = v;
       return ok_status();
     },
     "save frames as DIR/frame_000000.png ..."},
    {"-capture_every", "N",
     [](GameOptions& o, const std::string& v) {
       return take_number(v, 1, std::numeric_limits<std::uint32_t>::max(), o.capture_every);
     },
     "save every Nth frame only"},
    {"-nosound", "", flag<&GameOptions::sound, false>, "no sound"},
    {"-sound", "", flag<&GameOptions::sound_asked>, "sound with -headless, too"},
    {"-sndspeed", "N", [](GameOptions& o, const std::string& v) { return take_rate(v, 1000, 384000, o.sound_speed); },
     "sets sndspeed: with another rate than 11025 sounds are not filtered"},
    {"-mixspeed", "N", [](GameOptions& o, const std::string& v) { return take_rate(v, 8000, 192000, o.mix_speed); },
     "mixing rate, Hz (44100); sets snd_mixspeed"},
    {"-noextmusic", "", flag<&GameOptions::external_music, false>, "no music"},
    {"-wavcapture", "FILE",
     [](GameOptions& o, const std::string& v) {
       o.wav_capture = v;
       return ok_status();
     },
     "record the sound into FILE instead of playing it, in step with game time"},
    {"-validation", "", flag<&GameOptions::validation>, "enable Vulkan's validation layers"},
    {"-version", "", flag<&GameOptions::version>, "print the version"},
    {"--version", "", flag<&GameOptions::version>, nullptr},
    {"-help", "", flag<&GameOptions::help>, "print this help"},
    {"--help", "", flag<&GameOptions::help>, nullptr},
    {"-h", "", flag<&GameOptions::help>, nullptr},

    {"-nocdaudio", "", nullptr, kDisc},
    {"-cddev", "X", nullptr, kDisc},
    {"-heapsize", "N", nullptr, kMemory},
    {"-zone", "N", nullptr, kMemory},
    {"-mem", "N", nullptr, kMemory},
    {"-minmemory", "", nullptr, kMemory},
    {"-cachesize", "N", nullptr, kMemory},
    {"-surfcachesize", "N", nullptr, kMemory},
    {"-current", "", nullptr, kDisplay},
    {"-bpp", "N", nullptr, kDisplay},
    {"-refreshrate", "N", nullptr, kDisplay},
    {"-fsaa", "N", nullptr, kDisplay},
    {"-stdvid", "", nullptr, kDisplay},
    {"-dibonly", "", nullptr, kDisplay},
    {"-noadjustaspect", "", nullptr, kDisplay},
    {"-novbo", "", nullptr, kOpenGl},
    {"-nomtex", "", nullptr, kOpenGl},
    {"-nocombine", "", nullptr, kOpenGl},
    {"-noadd", "", nullptr, kOpenGl},
    {"-notexturenpot", "", nullptr, kOpenGl},
    {"-noglsl", "", nullptr, kOpenGl},
    {"-noglslgamma", "", nullptr, kOpenGl},
    {"-noglslalias", "", nullptr, kOpenGl},
    {"-nowarpmipmaps", "", nullptr, kOpenGl},
    {"-nopackedpixels", "", nullptr, kOpenGl},
    {"-nodepthclamp", "", nullptr, kOpenGl},
    {"-nobufferstorage", "", nullptr, kOpenGl},
    {"-nomultibind", "", nullptr, kOpenGl},
    {"-nobindless", "", nullptr, kOpenGl},
    {"-noclipcontrol", "", nullptr, kOpenGl},
    {"-nosteamapi", "", nullptr, kStores},
    {"-egs", "", nullptr, kStores},
    {"-noegs", "", nullptr, kStores},
    {"-epic", "", nullptr, kStores},
    {"-noepic", "", nullptr, kStores},
    {"-nonightdive", "", nullptr, kStores},
    {"-remaster", "", nullptr, kStores},
    {"-remastered", "", nullptr, kStores},
    {"-prefremaster", "", nullptr, kStores},
    {"-addons", "URL", nullptr, kStores},
    {"-noaddons", "", nullptr, kStores},
    {"-fitz", "", nullptr, kLooks},
    {"-noipx", "", nullptr, kNothing},
    {"-proghack", "", nullptr, kNothing},
    {"-nomapchecks", "", nullptr, kNothing},
    {"-pinnedworkers", "", nullptr, kNothing},
    {"-multiuser", "", nullptr, kNothing},
};

// Levenshtein's distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

}  // namespace

std::span<const Option> option_table() { return kOptions; }

const Option* find_option(std::string_view name) {
  const auto found = std::ranges::find(kOptions, name, &Option::name);
  return found == std::end(kOptions) ? nullptr : &*found;
}

const Option* nearest_option(std::string_view name) {
  if (name.size() < 4) return nullptr;               // every short name is near "-x"
  const std::size_t near = name.size() > 5 ? 2 : 1;  // number of mistakes
  const auto distance = [&](const Option& option) { return edit_distance(name, option.name); };
  const auto best = std::ranges::min_element(kOptions, {}, distance);
  return distance(*best) <= near ? &*best : nullptr;
}

}  // namespace fb::host
