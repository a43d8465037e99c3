// What a demo says of its player: where the server had it at every message. Two engines that run the same rules on the
// same map with the same steps of time must say the same, to what a message's numbers resolve.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"

namespace fb::lab {

struct TrackPoint {
  double time = 0.0;       // seconds of the server's clock
  vec3 origin{0.0f};       // units, of the entity that svc_setview names
  vec3 view_angles{0.0f};  // degrees, as recorded
  vec3 velocity{0.0f};     // units a second, in steps of 16
  bool on_ground = false, in_water = false;
  int health = 0;
};

// One point a message that tells the time and moves on from the one before. Fails where the demo does not parse.
Result<std::vector<TrackPoint>> read_track(ByteView demo, std::string_view name);

struct TrackDifference {
  int shift = 0;           // point i of the one stands beside point i + shift of the other
  std::size_t points = 0;  // that both have
  float largest = 0.0f;    // units, along one axis
  std::size_t at = 0;      // the one's point of the largest
  bool within = true;      // no point is further apart than the tolerance
  std::size_t first = 0;   // if not: the one's first point that is
};
// Point by point; `tolerance` in units. Of two engines one may take more frames until its player is in the game: the
// shift of at most `most_shift` points is taken, either way, under which they are nearest.
TrackDifference compare_tracks(const std::vector<TrackPoint>& a, const std::vector<TrackPoint>& b, float tolerance,
                               int most_shift = 0);

// time,x,y,z,vx,vy,vz,ground,water,health: a line a point, with a head.
std::string track_csv(const std::vector<TrackPoint>& track);

}  // namespace fb::lab
