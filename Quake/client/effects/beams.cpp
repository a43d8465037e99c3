#include "client/effects/beams.h"

#include <algorithm>
#include <cmath>

#include "base/rng.h"

namespace fb::cl {
namespace {

constexpr double kBeamSeconds = 0.2;
constexpr float kSegmentLength = 30.0f;

// Whole degrees in 0..359, as Quake points its beams.
float whole_degrees(float radians) {
  const float d = std::trunc(degrees(radians));
  return d < 0.0f ? d + 360.0f : d;
}

vec3 beam_angles(const vec3& along) {
  if (along.x == 0.0f && along.y == 0.0f) return {along.z > 0.0f ? 90.0f : 270.0f, 0.0f, 0.0f};
  const float flat = std::sqrt(along.x * along.x + along.y * along.y);
  return {whole_degrees(std::atan2(along.z, flat)), whole_degrees(std::atan2(along.y, along.x)), 0.0f};
}

}  // namespace

const char* beam_model(net::TempEntityType type) {
  switch (type) {
    case net::TempEntityType::kLightning2:
      return "progs/bolt2.mdl";
    case net::TempEntityType::kLightning3:
      return "progs/bolt3.mdl";
    case net::TempEntityType::kBeam:
      return "progs/beam.mdl";
    default:
      return "progs/bolt.mdl";
  }
}

void Beams::clear() {
  beams_ = {};
  segments_.clear();
}

void Beams::start(net::TempEntityType type, int entity, const vec3& from, const vec3& to, double time) {
  auto slot =
      std::find_if(beams_.begin(), beams_.end(), [entity](const Beam& b) { return b.used && b.entity == entity; });
  std::uint32_t serial = 0;
  if (slot != beams_.end() && slot->end_time >= time) serial = slot->serial;  // the same beam, swept on
  if (slot == beams_.end())
    slot = std::find_if(beams_.begin(), beams_.end(), [time](const Beam& b) { return !b.used || b.end_time < time; });
  if (slot == beams_.end()) return;
  *slot = {type, true, entity, time + kBeamSeconds, from, to, serial ? serial : next_serial_++};
}

void Beams::update(double time, int view_entity, const vec3& view_origin) {
  segments_.clear();
  // The rolls change every millisecond and stand still in a pause.
  Rng rng(static_cast<std::uint64_t>(std::max(0.0, time) * 1000.0), 3);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    Beam& b = beams_[i];
    if (!b.used || b.end_time < time) continue;
    if (b.entity == view_entity) b.start = view_origin;
    const vec3 whole = b.end - b.start;
    const float length = glm::length(whole);
    if (!(length > 0.0f) || !std::isfinite(length)) continue;
    const vec3 direction = whole / length;
    vec3 angles = beam_angles(whole);
    const auto count =
        static_cast<std::uint32_t>(std::min(std::ceil(length / kSegmentLength), static_cast<float>(kMaxSegments)));
    for (std::uint32_t k = 0; k < count; ++k) {
      angles.z = static_cast<float>(rng.below(360));
      segments_.push_back(
          {i, k, b.serial, b.type, b.start + direction * (kSegmentLength * static_cast<float>(k)), angles});
    }
  }
}

}  // namespace fb::cl
