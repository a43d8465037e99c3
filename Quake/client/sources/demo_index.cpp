#include "client/sources/demo_index.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <variant>

#include "formats/dem.h"
#include "net/server_messages.h"

namespace fb::cl {
namespace {

constexpr double kLatestTime = 1e9;  // seconds: the client understands none beyond

// False: the demo ends in this message.
bool read_message(DemoIndex& index, ByteView data, std::string_view name, const DemoPlace& place,
                  net::Protocol& protocol) {
  net::ServerMessageReader reader(data, name, protocol);
  while (!reader.at_end()) {
    const auto message = reader.next();
    if (!message.ok() || std::holds_alternative<net::svc::Disconnect>(*message)) return false;
    if (std::holds_alternative<net::svc::ServerInfo>(*message)) {
      DemoLevel level;
      level.place = place;
      level.begins = index.seconds();
      index.levels.push_back(level);
    } else if (const auto* time = std::get_if<net::svc::Time>(&*message); time && !index.levels.empty()) {
      DemoLevel& level = index.levels.back();
      const double now = time->time;
      if (!(std::abs(now) <= kLatestTime)) return false;
      if (level.last_time < level.first_time) level.first_time = level.last_time = now;
      level.last_time = std::max(level.last_time, now);
    }
  }
  protocol = reader.protocol();
  return true;
}

}  // namespace

DemoMoment DemoIndex::moment_at(double seconds) const {
  if (levels.empty()) return {};
  auto level = std::find_if(levels.rbegin(), levels.rend(), [seconds](const DemoLevel& l) {
    return l.last_time >= l.first_time && l.begins <= seconds;
  });
  if (level == levels.rend()) level = std::prev(levels.rend());
  const double within = std::clamp(seconds - level->begins, 0.0, level->seconds());
  return {static_cast<std::size_t>(std::distance(level, levels.rend())) - 1, level->first_time + within};
}

double DemoIndex::seconds_at(const DemoMoment& moment) const {
  if (moment.level >= levels.size()) return 0.0;
  const DemoLevel& level = levels[moment.level];
  return level.begins + std::clamp(moment.time - level.first_time, 0.0, level.seconds());
}

DemoIndex read_demo_index(ByteView data, std::string_view name) {
  DemoIndex index;
  auto reader = formats::DemReader::open(data, name);
  if (!reader.ok()) return index;
  net::Protocol protocol;
  DemoPlace place;
  while (!reader->at_end()) {
    place.offset = reader->offset();
    const auto message = reader->next();
    if (!message.ok() || !read_message(index, message->data, name, place, protocol)) break;
    ++place.messages;
  }
  return index;
}

}  // namespace fb::cl
