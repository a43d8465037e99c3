// How near a picture of a map is to what its author saw of it: blocks of pixels compared by luminance and colour.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/bsp.h"
#include "lab/picture.h"
#include "scene/snapshot.h"

namespace fb::lab {

constexpr std::uint32_t kBlocksAcross = 16, kBlocksDown = 9;

struct AuthoredDistance {
  double median = 0;       // of log2(own / author's luminance), over blocks: stops that it is brighter
  double spread = 0;       // rms of the same less the median
  double correlation = 0;  // of log2 luminance; 0 where a picture has one luminance alone
  double color = 0;        // mean over blocks of the sum of absolute differences of the channels' shares
  bool black = false;      // both pictures are, on any display: there is nothing to compare
};
// Both linear, of one size, cut into 16 x 9 blocks; where a block's channel is over 1, as white as a display gets, it
// counts as 1.
AuthoredDistance authored_distance(const Picture& own, const Picture& authors);
// The root of the mean of squares of medians and of spreads, the means of the others; of what is not black.
AuthoredDistance mean_distance(const std::vector<AuthoredDistance>& distances);

// Where a map's author thought of somebody looking from.
struct MapCamera {
  std::string name;  // class and number
  vec3 position, angles;
};
struct MapCameras {
  std::vector<MapCamera> open;       // at most so many, evenly chosen
  std::vector<std::string> closed;   // names of all that are not in_open()
  std::vector<std::string> nowhere;  // names of all without an origin of three numbers
};
// Starts of players, intermissions, ends of teleports, at eye height.
MapCameras map_cameras(const formats::Bsp& bsp, std::size_t most);
// Whether a point is in air or water: not within walls, a door or lava, nor outside the map.
bool in_open(const formats::Bsp& bsp, const vec3& point);

}  // namespace fb::lab
