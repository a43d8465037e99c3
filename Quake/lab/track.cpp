#include "lab/track.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <variant>

#include "formats/dem.h"
#include "net/server_messages.h"

namespace fb::lab {
namespace {

// The player as a demo's messages tell of it, one after the other.
class Player {
 public:
  void take(const net::ServerMessage& message) {
    std::visit([this](const auto& m) { apply(m); }, message);
  }
  // The state after a datagram, if that told the time and had the player.
  std::optional<TrackPoint> take_point() {
    const bool complete = timed_ && seen_;
    timed_ = seen_ = false;
    return complete ? std::optional(point_) : std::nullopt;
  }
  TrackPoint& point() { return point_; }

 private:
  template <typename T>
  void apply(const T&) {}
  void apply(const net::svc::ServerInfo&) {
    baselines_.clear();
    view_entity_ = 0;
  }
  void apply(const net::svc::SetView& m) { view_entity_ = m.entity; }
  void apply(const net::svc::Time& m) {
    timed_ = true;
    point_.time = m.time;
  }
  void apply(const net::svc::SpawnBaseline& m) { baselines_[m.entity] = m.state.origin; }
  void apply(const net::svc::ClientData& m) {
    point_.velocity = 16.0f * vec3(m.velocity[0], m.velocity[1], m.velocity[2]);
    point_.on_ground = m.on_ground;
    point_.in_water = m.in_water;
    point_.health = m.health;
  }
  void apply(const net::svc::EntityUpdate& m) {
    if (m.entity != view_entity_) return;
    seen_ = true;
    const vec3 baseline = baselines_[m.entity];
    constexpr std::uint32_t kBits[] = {net::kUpdateOrigin1, net::kUpdateOrigin2, net::kUpdateOrigin3};
    for (int i = 0; i < 3; ++i) point_.origin[i] = (m.bits & kBits[i]) != 0 ? m.origin[i] : baseline[i];
  }

  std::map<int, vec3> baselines_;
  int view_entity_ = 0;
  bool timed_ = false, seen_ = false;
  TrackPoint point_;
};

TrackDifference compare_shifted(const std::vector<TrackPoint>& a, const std::vector<TrackPoint>& b, float tolerance,
                                int shift) {
  TrackDifference result;
  result.shift = shift;
  for (std::size_t i = shift < 0 ? static_cast<std::size_t>(-shift) : 0; i < a.size(); ++i) {
    const std::size_t beside = shift < 0 ? i - static_cast<std::size_t>(-shift) : i + static_cast<std::size_t>(shift);
    if (beside >= b.size()) break;
    ++result.points;
    const vec3 d = glm::abs(a[i].origin - b[beside].origin);
    const float apart = std::max({d.x, d.y, d.z});
    if (apart > tolerance && result.within) {
      result.within = false;
      result.first = i;
    }
    if (apart > result.largest) {
      result.largest = apart;
      result.at = i;
    }
  }
  return result;
}

}  // namespace

Result<std::vector<TrackPoint>> read_track(ByteView demo, std::string_view name) {
  auto reader = formats::DemReader::open(demo, name);
  if (!reader) return reader.error();
  std::vector<TrackPoint> track;
  Player player;
  net::Protocol protocol;
  while (!reader->at_end()) {
    const std::size_t offset = reader->offset();
    const auto message = reader->next();
    if (!message) return message.error();
    player.point().view_angles = message->view_angles;
    net::ServerMessageReader parts(message->data, fmt::format("{}: message at {}", name, offset), protocol);
    while (!parts.at_end()) {
      const auto part = parts.next();
      if (!part) return part.error();
      player.take(*part);
    }
    protocol = parts.protocol();
    const auto point = player.take_point();
    if (point && (track.empty() || point->time != track.back().time)) track.push_back(*point);
  }
  return track;
}

TrackDifference compare_tracks(const std::vector<TrackPoint>& a, const std::vector<TrackPoint>& b, float tolerance,
                               int most_shift) {
  TrackDifference best = compare_shifted(a, b, tolerance, 0);
  for (int shift = 1; shift <= most_shift; ++shift) {
    for (const int s : {shift, -shift}) {
      const TrackDifference d = compare_shifted(a, b, tolerance, s);
      if (d.points > 0 && d.largest < best.largest) best = d;
    }
  }
  return best;
}

std::string track_csv(const std::vector<TrackPoint>& track) {
  std::string text = "time,x,y,z,vx,vy,vz,ground,water,health\n";
  for (const TrackPoint& p : track) {
    text += fmt::format("{},{},{},{},{},{},{},{:d},{:d},{}\n", p.time, p.origin.x, p.origin.y, p.origin.z, p.velocity.x,
                        p.velocity.y, p.velocity.z, p.on_ground, p.in_water, p.health);
  }
  return text;
}

}  // namespace fb::lab
