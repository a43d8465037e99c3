#include "server/clients/level_protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "world/entity_lump.h"

namespace fb::sv {
namespace {

// What RMQ's engine, and QuakeSpasm, speak as protocol 999.
constexpr std::uint32_t kRmqFlags = net::kInt32Coord | net::kShortAngle;
constexpr float kFarthestShort = 4096.0f;  // units: 16 bits, of which three are behind the point

float farthest(const formats::BspModel& world) {
  float most = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
    most = std::max({most, std::fabs(world.mins[axis]), std::fabs(world.maxs[axis])});
  return most;
}

bool has_scales(const Level& level) {
  const auto entities = world::parse_entity_lump(level.bsp->entities, level.map_name);
  return entities && std::ranges::any_of(*entities, [](const world::Entity& entity) {
           const float scale = entity.number("scale", 0.0f);
           return scale > 0.0f && scale != 1.0f;
         });
}

}  // namespace

std::string beyond_short_protocols(const Level& level) {
  if (const float far = farthest(level.bsp->models.at(0)); far > kFarthestShort)
    return fmt::format("the map reaches to {:.0f} units, and 16 bits to {:.0f}", far, kFarthestShort);
  if (has_scales(level)) return "entities of the map have a scale";
  return {};
}

net::Protocol protocol_for(const Level& level, const con::Cvar& sv_protocol) {
  net::Protocol protocol{sv_protocol.integer(), 0};
  if (!net::is_known_protocol(protocol.version)) {
    log_warning("sv_protocol is {}, not 15, 666 or 999: it is taken as 666", sv_protocol.string());
    protocol.version = net::kProtocolFitzQuake;
  }
  if (protocol.version != net::kProtocolRmq) {
    if (const std::string reason = beyond_short_protocols(level); !reason.empty()) {
      if (protocol.version == net::kProtocolFitzQuake) {
        log_info("{}: {}: protocol 999 in place of 666", level.map_name, reason);
        protocol.version = net::kProtocolRmq;
      } else {
        log_warning("{}: {}: protocol 15, which sv_protocol asks for, cannot say that", level.map_name, reason);
      }
    }
  }
  if (protocol.version == net::kProtocolRmq) protocol.flags = kRmqFlags;
  return protocol;
}

}  // namespace fb::sv
