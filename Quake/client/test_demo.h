// For tests: messages and demos written in code, and the files of a small game to play them in.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <iterator>

#include "formats/dem.h"
#include "formats/test_bsp.h"
#include "formats/test_models.h"
#include "net/server_messages.h"
#include "scene/library/test_maps.h"

namespace fb::cl::test {

inline Bytes datagram(const std::vector<net::ServerMessage>& messages, const net::Protocol& protocol = {}) {
  net::MessageWriter writer(protocol);
  for (const auto& message : messages) net::write_server_message(writer, message);
  return writer.take();
}

inline net::svc::ServerInfo server_info(const net::Protocol& protocol = {}) {
  net::svc::ServerInfo info;
  info.protocol = protocol;
  info.max_clients = 2;
  info.level_name = "A test";
  info.models = {"maps/test.bsp", "*1", "progs/thing.mdl", "progs/star.spr"};
  info.sounds = {"misc/null.wav"};
  return info;
}

// An update of everything that a moving entity has.
inline net::svc::EntityUpdate update(int entity, int model, const vec3& origin, const vec3& angles = vec3(0.0f),
                                     std::uint32_t more_bits = 0) {
  net::svc::EntityUpdate u;
  u.bits = net::kUpdateModel | net::kUpdateOrigin1 | net::kUpdateOrigin2 | net::kUpdateOrigin3 | net::kUpdateAngle1 |
           net::kUpdateAngle2 | net::kUpdateAngle3 | more_bits;
  u.entity = entity;
  u.model = model;
  u.origin = origin;
  u.angles = angles;
  return u;
}

// A demo: signon messages, then whatever a test adds.
class DemoBuilder {
 public:
  explicit DemoBuilder(const net::Protocol& protocol = {}) : protocol_(protocol) {
    bytes_ = {'-', '1', '\n'};
    level();
  }
  // A level begins; `first` is said before anything of it, in the same message.
  DemoBuilder& level(std::vector<net::ServerMessage> first = {}) {
    first.insert(first.end(), {server_info(protocol_), net::svc::SetView{1}, net::svc::SignonNum{1}});
    add(first);
    add({net::svc::SpawnBaseline{1, {}, false}, net::svc::SignonNum{2}});
    return add({net::svc::SignonNum{3}});
  }
  DemoBuilder& add(const std::vector<net::ServerMessage>& messages, const vec3& view_angles = vec3(0.0f)) {
    formats::append_dem_message(bytes_, view_angles, datagram(messages, protocol_));
    return *this;
  }
  // A moment of the game: the player at an x and a z, and whatever else.
  DemoBuilder& moment(float time, float x, std::vector<net::ServerMessage> more = {}, float z = 24.0f) {
    net::svc::ClientData data;
    data.health = 100;
    data.on_ground = true;
    std::vector<net::ServerMessage> messages{net::svc::Time{time}, data, update(1, 3, {x, 0, z})};
    messages.insert(messages.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    return add(messages);
  }
  DemoBuilder& raw(const Bytes& message) {
    formats::append_dem_message(bytes_, vec3(0.0f), message);
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  net::Protocol protocol_;
  Bytes bytes_;
};

// The files that server_info() names.
inline scene::test::TestFiles game_files() {
  scene::test::TestFiles files;
  files.add_palette();
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  room.entities =
      "{\"classname\" \"worldspawn\" \"fog\" \"0.1 0.2 0.3 0.4\"}"
      "{\"classname\" \"info_player_start\" \"origin\" \"8 -8 0\" \"angle\" \"90\"}"
      "{\"classname\" \"light\" \"origin\" \"0 0 32\" \"light\" \"200\" \"style\" \"4\"}";
  files.files["maps/test.bsp"] = formats::testing::write_bsp(room);
  formats::Mdl thing = formats::testing::tetrahedron();
  thing.flags = 0;  // no trail
  for (std::size_t i = 0; i < thing.vertices.size(); ++i)
    thing.vertices[i] = {static_cast<std::uint8_t>(i % 4 == 1 ? 80 : 10 + i),
                         static_cast<std::uint8_t>(i % 4 == 2 ? 80 : 10),
                         static_cast<std::uint8_t>(i % 4 == 3 ? 80 : 10), 0};
  files.files["progs/thing.mdl"] = formats::testing::write_mdl(thing);
  files.files["progs/star.spr"] =
      formats::testing::write_spr(formats::testing::small_sprite(formats::SpriteOrientation::kParallel));
  return files;
}

}  // namespace fb::cl::test
