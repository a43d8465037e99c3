// The command line of fullbright, in Quake's form: options with '-', console commands with '+'.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "net/network.h"

namespace fb::host {

// What a program that begins anew (`game`) takes with it.
struct CarriedScripts {
  std::string session;   // cvars and aliases as they were; runs before the configuration
  std::string commands;  // those that were still to come; run after it
};

struct GameOptions {
  bool help = false, version = false, list_devices = false;
  bool headless = false, fullscreen = false, validation = false;
  bool mouse = true, gamepads = true;
  bool console_log = false;  // -condebug
  std::string device;        // part of a name, or an index
  uvec2 size{0, 0};          // 0: the window's default
  std::string capture;       // folder for numbered PNG frames; empty: none
  std::uint32_t capture_every = 1;
  bool sound = true, sound_asked = false;               // -nosound; -sound: also if headless
  bool external_music = true;                           // music from files
  std::string wav_capture;                              // file that the sound is recorded into; empty: none
  std::optional<std::uint32_t> sound_speed, mix_speed;  // initial values of sndspeed and snd_mixspeed, Hz
  bool has_commands = false;                            // whether there is any '+'
  bool dedicated = false;
  int max_clients = 1;  // of -dedicated and -listen
  std::uint32_t port = 26000;
  net::NetworkOptions network;
  std::optional<int> protocol;                                // the server's; none: what cvar sv_protocol says
  std::optional<std::uint64_t> seed;                          // of QuakeC's random numbers; none: a random seed
  std::optional<std::uint32_t> particles, console_kilobytes;  // none: the default
  std::vector<std::string> arguments;                         // all of them, for files and stuffcmds
  CarriedScripts carried;
};

// Parses by the rows of option_table.h. Fails on an unknown option and on a missing or malformed value, with a message
// that names it.
Result<GameOptions> parse_game_options(const std::vector<std::string>& arguments);
constexpr std::uint32_t kLargestSide = 16384;  // of the picture, pixels
// Parses a size such as "640x360"; each side 1..kLargestSide.
Result<uvec2> parse_size(const std::string& text);
// The command line that plays this game folder in place of the -game folders and mission packs, without its commands.
std::vector<std::string> with_game(const std::vector<std::string>& arguments, const std::string& folder);
std::string game_help();
std::string version_text();

}  // namespace fb::host
