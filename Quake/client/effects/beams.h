// Beams (lightning, grappling hooks): drawn as a row of models, each with a random roll.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "net/protocol.h"

namespace fb::cl {

struct Beam {
  net::TempEntityType type = net::TempEntityType::kLightning1;
  bool used = false;
  int entity = 0;
  double end_time = -1.0;  // client time
  vec3 start{0.0f}, end{0.0f};
  std::uint32_t serial = 0;
};
struct BeamSegment {
  std::uint32_t beam = 0, index = 0;  // slot, place in the row: under 256
  std::uint32_t serial = 0;           // of the beam
  net::TempEntityType type = net::TempEntityType::kLightning1;
  vec3 origin{0.0f}, angles{0.0f};
};

class Beams {
 public:
  static constexpr std::size_t kCount = 32;
  static constexpr std::uint32_t kMaxSegments = 256;

  void clear();
  // A beam replaces the one of the same entity; when all slots are taken it is lost.
  void start(net::TempEntityType type, int entity, const vec3& from, const vec3& to, double time);
  // Places the segments for this moment; the beam of the player (`view_entity`) starts at `view_origin`.
  void update(double time, int view_entity, const vec3& view_origin);
  const std::vector<BeamSegment>& segments() const { return segments_; }

 private:
  std::array<Beam, kCount> beams_;
  std::vector<BeamSegment> segments_;
  std::uint32_t next_serial_ = 1;
};

// The model that a beam is made of.
const char* beam_model(net::TempEntityType type);

}  // namespace fb::cl
