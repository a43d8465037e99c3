// Values of a game for the status bar, the scoreboard, music and fog.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "net/protocol.h"

namespace fb::cl {

// How much of the fog covers the sky where the map says it ("skyfog"): until r_skyfog is changed.
struct SkyFog {
  std::optional<float> of_map;
  float cvar = 0.0f;  // r_skyfog when the map was loaded
  float now(float r_skyfog) const { return of_map && r_skyfog == cvar ? *of_map : r_skyfog; }
};

struct Fog {
  float density = 0.0f;  // QuakeSpasm's unit: fog 1 hides what is 64 units away, about
  vec3 color{0.3f};
};
// svc_cdtrack: what plays, and what goes on when that is over. 0: silence.
struct MusicTracks {
  int track = 0, loop = 0;
  bool operator==(const MusicTracks&) const = default;
};
struct Score {
  std::string name;
  int frags = 0;
  int colors = 0;  // 16 * shirt + trousers
};
enum class Intermission { kNone, kLevel, kFinale, kCutscene };
struct Hud {
  std::array<std::int32_t, net::kMaxStats> stats{};  // by net::Stat
  std::int32_t items = 0;
  std::array<double, 32> item_time{};  // when each bit of items was won
  double face_pain_until = 0.0;
  std::string level_name, map_name;
  int max_clients = 1, game_type = 0;
  std::vector<Score> scores;
  int player = -1;  // whose eyes these are: an index of scores; -1: nobody's
  std::string center_print;
  double center_print_time = -1000.0;  // when it came
  Intermission intermission = Intermission::kNone;
  double completed_time = 0.0;  // when intermission began
  bool paused = false;
  double time = 0.0;
};

}  // namespace fb::cl
