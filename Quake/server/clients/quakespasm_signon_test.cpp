// What a server tells a player on its way in, held to QuakeSpasm's own: the same game on the same map, message by
// message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <thread>
#include <algorithm>

#include "base/log.h"
#include "fs/filesystem.h"
#include "net/client_messages.h"
#include "net/connect_attempt.h"
#include "net/loopback.h"
#include "net/server_messages.h"
#include "server/clients/clients.h"
#include "server/server.h"
#include "server/simulation/test_rules.h"
#include "server/test_quakespasm.h"

namespace fb::sv {
namespace {

namespace svc = net::svc;

// Things to tell of, without chance in them, on top of testdemos/rules.
constexpr const char* kThings = R"qc(
.float alpha, scale, style, count;
float() droptofloor = #34;
void(entity e) makestatic = #69;
void(vector o, string sample, float volume, float attenuation) ambientsound = #74;
// Around where players begin; they look otherwise half a second later.
float made;
void() change = {
  self.angles = '10 20 30' * self.count;
  self.frame = self.count * 40;
  self.skin = self.count;
  self.effects = 4 + self.count * 8;
  self.alpha = self.count * 0.15;
  self.scale = 1 + self.count * 0.25;
  self.colormap = self.count;
  setorigin(self, self.origin + '0 0 1' * self.count);
};
void() surround = {
  local entity place, e;
  place = find(world, classname, "info_player_start");
  while (made < 12) {
    made = made + 1;
    e = spawn();
    e.count = made;
    setmodel(e, "progs/player.mdl");
    setorigin(e, place.origin + '3 2 1' * made);
    e.think = change;
    e.nextthink = time + 0.5;
  }
};
void() thing_start = { droptofloor(); if (!made) surround(); };
void(float low_frame, float a) thing = {
  self.solid = SOLID_SLIDEBOX;
  self.movetype = 4;
  self.alpha = a;
  self.scale = 1.5;
  self.frame = low_frame;
  self.skin = 1;
  setmodel(self, "progs/player.mdl");
  setsize(self, '-16 -16 -24', '16 16 40');
  self.think = thing_start;
  self.nextthink = time + 0.05;
};
void() monster_army = { thing(3, 0); };
void() monster_dog = { thing(300, 0.5); };
void() monster_knight = { thing(4, 1); };
void() monster_ogre = { thing(5, -1); };
void() item_start = { self.movetype = MOVETYPE_TOSS; if (!droptofloor()) remove(self); };
void() item = {
  precache_model("maps/b_bh25.bsp");
  setmodel(self, "maps/b_bh25.bsp");
  setsize(self, '0 0 0', '32 32 56');
  self.solid = SOLID_TRIGGER;
  self.think = item_start;
  self.nextthink = time + 0.1;
};
void() item_health = { item(); };
void() item_shells = { item(); };
void() item_spikes = { item(); };
void() barrel_explode = { remove(self); };
void() light = { if (self.style >= 32) lightstyle(self.style, "mama"); remove(self); };
void() light_torch_small_walltorch = { precache_model("progs/flame.mdl"); setmodel(self, "progs/flame.mdl");
  precache_sound("ambience/fire1.wav"); ambientsound(self.origin, "ambience/fire1.wav", 0.5, 3);
  self.alpha = 0.7; makestatic(self); };
)qc";

// What falls comes to rest about 1/32 unit, the distance that traces keep, above the floor: half a step of 32-bit
// coordinates, which the last bits of a trace round either way.
constexpr float kStepOfCoordinates = 1.0f / 16.0f;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Signs on, and keeps what it was told on the way and what it saw last.
struct Guest {
  std::unique_ptr<net::Connection> connection;
  net::Protocol protocol;
  int signon = 0;
  std::vector<net::ServerMessage> heard;      // of reliable messages
  std::map<int, svc::EntityUpdate> updates;   // of the latest datagram
  double level_time = 0.0, first_time = 0.0;  // of that, of the first one
  std::string fault;

  void listen(double now) {
    while (const auto message = connection->receive(now)) {
      if (!message->reliable) updates.clear();
      net::ServerMessageReader reader(message->data, "message", protocol);
      while (!reader.at_end() && fault.empty()) {
        auto read = reader.next();
        if (!read) {
          fault = read.error().message;
          return;
        }
        if (const auto* stage = std::get_if<svc::SignonNum>(&*read)) answer(stage->signon);
        if (const auto* time = std::get_if<svc::Time>(&*read)) level_time = time->time;
        if (const auto* update = std::get_if<svc::EntityUpdate>(&*read)) updates[update->entity] = *update;
        if (message->reliable && signon < 3) heard.push_back(std::move(*read));
      }
      protocol = reader.protocol();
      if (!updates.empty() && first_time == 0.0) first_time = level_time;
    }
    if (!waiting.empty() && connection->can_send()) {
      net::MessageWriter writer;
      net::write_client_message(writer, net::clc::StringCommand{waiting});
      (void)connection->send_reliable(writer.bytes(), now);
      waiting.clear();
    }
  }
  void answer(int stage) {
    signon = stage;
    waiting = stage == 1 ? "prespawn" : stage == 2 ? "spawn " : "begin";
  }
  std::string waiting;
  // It has fallen to the floor by then, and other things have come to rest.
  bool has_seen() const { return first_time > 0.0 && level_time > first_time + 2.0; }

  // Of the kinds that say how things stand.
  template <typename... Kinds>
  std::vector<net::ServerMessage> of() const {
    std::vector<net::ServerMessage> found;
    for (const auto& message : heard)
      if ((std::holds_alternative<Kinds>(message) || ...)) found.push_back(message);
    return found;
  }
};

std::string bytes_of(const net::ServerMessage& message, net::Protocol protocol) {
  net::MessageWriter writer(protocol);
  net::write_server_message(writer, message);
  std::string text;
  for (const std::uint8_t byte : writer.bytes()) text += fmt::format("{:02x}", byte);
  return text;
}

class QuakeSpasmSignon : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    set_log_level(LogLevel::kError);
    auto opened = fs::FileSystem::open(testing::game_data_options());
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files_.emplace(std::move(*opened));
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
    static const Bytes rules = testing::compile_rules(kThings);
    ASSERT_FALSE(rules.empty()) << "testdemos/rules do not compile";
    progs_ = rules;
  }
  void TearDown() override { set_log_level(LogLevel::kInfo); }

  Guest theirs(const char* map, int protocol) {
    testing::QuakeSpasmServer server(progs_, map, fmt::format("+sv_protocol {}", protocol));
    const auto network = net::system_network();
    const net::Address address = net::ipv4(127, 0, 0, 1, static_cast<std::uint16_t>(server.port()));
    const double end = seconds() + 30.0;
    Guest guest;
    while (!guest.connection && seconds() < end) {
      net::ConnectAttempt attempt(*network, address);
      while (attempt.poll(seconds()) == net::ConnectAttempt::State::kTrying && seconds() < end) pause();
      guest.connection = attempt.take();
    }
    while (guest.connection && !guest.has_seen() && guest.fault.empty() && seconds() < end) {
      guest.listen(seconds());
      pause();
    }
    EXPECT_EQ(guest.signon, 3) << guest.fault << server.output();
    guest.connection.reset();  // before its network
    return guest;
  }
  Guest ours(const char* map, int protocol) {
    con::Console console;
    ServerServices services;
    services.read_file = [this](std::string_view name) {
      return name == "progs.dat" ? std::optional(progs_) : files_->read(name);
    };
    Server server(console, services, {.max_clients = 4});
    net::LoopbackListener listener;
    server.clients().add_listener(listener);
    console.set("sv_protocol", std::to_string(protocol));
    console.set("deathmatch", "1");  // as QuakeSpasm has it where several may play
    const Status status = server.map(map);
    EXPECT_TRUE(status.ok()) << status.error().message;
    Guest guest;
    guest.connection = listener.connect(0.0);
    double now = 0.0;
    for (int i = 0; i < 200 && !guest.has_seen(); ++i) {
      server.frame(0.05, now += 0.05);
      guest.listen(now);
    }
    EXPECT_EQ(guest.signon, 3) << guest.fault;
    guest.connection.reset();
    return guest;
  }
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

  std::optional<fs::FileSystem> files_;
  Bytes progs_;
};
INSTANTIATE_TEST_SUITE_P(Protocols, QuakeSpasmSignon, ::testing::Values(15, 666, 999));

// A map within 4096 units: others we begin in protocol 999 where QuakeSpasm has 666 (level_protocol.h).
TEST_P(QuakeSpasmSignon, IsTheSame) {
  const Guest theirs = this->theirs("lq_e0m1", GetParam()), ours = this->ours("lq_e0m1", GetParam());
  if (HasFailure()) return;
  EXPECT_EQ(ours.protocol.flags, theirs.protocol.flags);
  const auto of = [](const Guest& guest) {
    return guest.of<svc::ServerInfo, svc::CdTrack, svc::SetView, svc::SignonNum, svc::SpawnBaseline, svc::SpawnStatic,
                    svc::SpawnStaticSound, svc::UpdateStat, svc::UpdateName, svc::UpdateColors, svc::UpdateFrags,
                    svc::LightStyle, svc::SetAngle, svc::ClientData>();
  };
  const auto expected = of(theirs), actual = of(ours);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < std::min(actual.size(), expected.size()); ++i)
    ASSERT_EQ(bytes_of(actual[i], ours.protocol), bytes_of(expected[i], theirs.protocol)) << "message " << i;
  // A message over a network may not hold everything.
  EXPECT_GT(theirs.updates.size(), 10u);
  for (const auto& [entity, update] : theirs.updates) {
    const auto found = ours.updates.find(entity);
    ASSERT_TRUE(found != ours.updates.end()) << "entity " << entity;
    // A trace's last bits depend on the steps of the fall, and theirs are of real time.
    svc::EntityUpdate actual_update = found->second;
    const vec3 off = glm::abs(actual_update.origin - update.origin);
    if (glm::all(glm::lessThanEqual(off, vec3(kStepOfCoordinates)))) actual_update.origin = update.origin;
    EXPECT_EQ(bytes_of(actual_update, ours.protocol), bytes_of(update, theirs.protocol)) << "entity " << entity;
  }
  EXPECT_GE(ours.updates.size(), theirs.updates.size());
}

}  // namespace
}  // namespace fb::sv
