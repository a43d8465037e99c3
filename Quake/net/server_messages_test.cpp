#include "net/server_messages.h"

#include <gtest/gtest.h>

#include "base/rng.h"

namespace fb::net {
namespace {

const Protocol kProtocols[] = {{15, 0},
                               {666, 0},
                               {999, 0},
                               {999, kShortAngle | kCoord24 | kEdictScale},
                               {999, kShortAngle | kInt32Coord | kEdictScale},
                               {999, kFloatAngle | kFloatCoord | kAlphaSanity | kEdictScale}};

// Values that every protocol holds exactly.
const vec3 kOrigin(100.0f, -25.0f, 8.0f), kAngles(45.0f, -90.0f, 11.25f);

ServerMessage round_trip(const ServerMessage& message, const Protocol& protocol) {
  MessageWriter w(protocol);
  write_server_message(w, message);
  write_server_message(w, svc::Nop{});  // what follows must not be touched
  ServerMessageReader r(w.bytes(), "test", protocol);
  auto read = r.next();
  EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().message);
  if (!read.ok()) return svc::Nop{};
  auto rest = r.next();
  EXPECT_TRUE(rest.ok());
  EXPECT_TRUE(rest.ok() && std::holds_alternative<svc::Nop>(*rest));
  EXPECT_TRUE(r.at_end());
  return *read;
}

TEST(ServerMessages, PlainOnesSurviveEveryProtocol) {
  svc::TempEntity explosion2;
  explosion2.type = TempEntityType::kExplosion2;
  explosion2.origin = kOrigin;
  explosion2.color_start = 230;
  explosion2.color_length = 5;
  svc::TempEntity beam;
  beam.type = TempEntityType::kLightning2;
  beam.origin = kOrigin;
  beam.end = {1, 2, 3};
  beam.entity = 321;
  svc::SpawnStaticSound hum;
  hum.origin = kOrigin;
  hum.sound = 12;
  hum.volume = 200;
  hum.attenuation = 64;
  const ServerMessage messages[] = {svc::Nop{},
                                    svc::Disconnect{},
                                    svc::UpdateStat{14, -70000},
                                    svc::SetView{300},
                                    svc::Time{12.25f},
                                    svc::Print{"a line\n"},
                                    svc::Achievement{"ACH"},
                                    svc::LocalSound{0, 200},
                                    svc::LocalSound{16, 300},
                                    svc::StuffText{"bf\n"},
                                    svc::SetAngle{kAngles},
                                    svc::LightStyle{63, "mamama"},
                                    svc::UpdateName{3, "ranger"},
                                    svc::UpdateFrags{3, -2},
                                    svc::UpdateColors{3, 0x4d},
                                    svc::StopSound{900, 5},
                                    svc::Particle{kOrigin, {-128, 5, 127}, 255, 73},
                                    svc::Damage{10, 20, kOrigin},
                                    svc::SpawnStatic{{kOrigin, kAngles, 7, 3, 1, 2}, false},
                                    svc::SpawnBaseline{600, {kOrigin, kAngles, 7, 3, 1, 2}, false},
                                    explosion2,
                                    beam,
                                    svc::SetPause{true},
                                    svc::SignonNum{3},
                                    svc::CenterPrint{"You found a secret"},
                                    svc::KilledMonster{},
                                    svc::FoundSecret{},
                                    hum,
                                    svc::Intermission{},
                                    svc::Finale{"The end"},
                                    svc::CdTrack{4, 5},
                                    svc::SellScreen{},
                                    svc::Cutscene{"Meanwhile"},
                                    svc::Skybox{"dusk_"},
                                    svc::BonusFlash{},
                                    svc::Fog{10, 20, 30, 40, 250}};
  for (const Protocol& p : kProtocols)
    for (const ServerMessage& m : messages) EXPECT_EQ(round_trip(m, p), m) << p.version << " " << m.index();
}

// What protocol 15 (and, for the last ones, 666) has on the wire, byte by byte: demos and other engines know no other.
TEST(ServerMessages, TheirBytesAreTheProtocols) {
  const vec3 at(1, -1, 0.125f);  // in eighths
  svc::TempEntity explosion2{TempEntityType::kExplosion2, at, 0, {}, 230, 5};
  svc::TempEntity beam{TempEntityType::kLightning2, at, 258, {0, 0, 1}, 0, 1};
  svc::ServerInfo info;
  info.max_clients = 4;
  info.game_type = 1;
  info.level_name = "A";
  info.models = {"m", "n"};
  info.sounds = {"s"};
  svc::ClientData data;
  data.view_height = 20;
  data.punch = {-5, 0, 0};
  data.items = 0x04030201;
  data.on_ground = true;
  data.weapon_frame = 3;
  data.armor = 150;
  data.weapon = 2;
  data.health = 100;
  data.ammo = 25;
  data.ammo_counts = {1, 2, 3, 4};
  data.active_weapon = 32;
  svc::EntityUpdate update;
  update.bits = kUpdateOrigin1 | kUpdateFrame | kUpdateModel;
  update.entity = 7;
  update.origin.x = 1;
  update.model = 2;
  update.frame = 3;
  const struct {
    ServerMessage message;
    Bytes bytes;
  } cases[] = {
      {svc::Nop{}, {1}},
      {svc::Disconnect{}, {2}},
      {svc::UpdateStat{kStatMonsters, -2}, {3, 14, 254, 255, 255, 255}},
      {svc::Version{15}, {4, 15, 0, 0, 0}},
      {svc::SetView{258}, {5, 2, 1}},
      {svc::Sound{258, 3, 9, 255, 64, at}, {6, 0, 19, 8, 9, 8, 0, 248, 255, 1, 0}},
      {svc::Sound{258, 3, 9, 100, 32, at}, {6, 3, 100, 32, 19, 8, 9, 8, 0, 248, 255, 1, 0}},
      {svc::Time{1.0f}, {7, 0, 0, 128, 63}},
      {svc::Print{"hi"}, {8, 'h', 'i', 0}},
      {svc::StuffText{"bf"}, {9, 'b', 'f', 0}},
      {svc::SetAngle{{90, -90, 45}}, {10, 64, 192, 32}},
      {info, {11, 15, 0, 0, 0, 4, 1, 'A', 0, 'm', 0, 'n', 0, 0, 's', 0, 0}},
      {svc::LightStyle{63, "az"}, {12, 63, 'a', 'z', 0}},
      {svc::UpdateName{3, "r"}, {13, 3, 'r', 0}},
      {svc::UpdateFrags{3, -2}, {14, 3, 254, 255}},
      {data, {15, 5, 0x76, 20, 251, 1, 2, 3, 4, 3, 150, 2, 100, 0, 25, 1, 2, 3, 4, 32}},
      {svc::StopSound{258, 3}, {16, 19, 8}},
      {svc::UpdateColors{3, 0x4d}, {17, 3, 0x4d}},
      {svc::Particle{at, {-128, 5, 127}, 255, 73}, {18, 8, 0, 248, 255, 1, 0, 128, 5, 127, 255, 73}},
      {svc::Damage{10, 20, at}, {19, 10, 20, 8, 0, 248, 255, 1, 0}},
      {svc::SpawnStatic{{at, {90, 0, 45}, 7, 3, 1, 2}, false}, {20, 7, 3, 1, 2, 8, 0, 64, 248, 255, 0, 1, 0, 32}},
      {svc::SpawnBaseline{258, {at, {90, 0, 45}, 7, 3, 1, 2}, false},
       {22, 2, 1, 7, 3, 1, 2, 8, 0, 64, 248, 255, 0, 1, 0, 32}},
      {svc::TempEntity{TempEntityType::kGunshot, at, 0, {}, 0, 1}, {23, 2, 8, 0, 248, 255, 1, 0}},
      {explosion2, {23, 12, 8, 0, 248, 255, 1, 0, 230, 5}},
      {beam, {23, 6, 2, 1, 8, 0, 248, 255, 1, 0, 0, 0, 0, 0, 8, 0}},
      {svc::SetPause{true}, {24, 1}},
      {svc::SignonNum{3}, {25, 3}},
      {svc::CenterPrint{"c"}, {26, 'c', 0}},
      {svc::KilledMonster{}, {27}},
      {svc::FoundSecret{}, {28}},
      {svc::SpawnStaticSound{at, 12, 200, 64, false}, {29, 8, 0, 248, 255, 1, 0, 12, 200, 64}},
      {svc::Intermission{}, {30}},
      {svc::Finale{"f"}, {31, 'f', 0}},
      {svc::CdTrack{4, 5}, {32, 4, 5}},
      {svc::SellScreen{}, {33}},
      {svc::Cutscene{"c"}, {34, 'c', 0}},
      {svc::Skybox{"d"}, {37, 'd', 0}},
      {svc::BonusFlash{}, {40}},
      {svc::Fog{10, 20, 30, 40, 258}, {41, 10, 20, 30, 40, 2, 1}},
      {update, {0xc3, 4, 7, 2, 3, 8, 0}},
      {svc::SpawnBaseline{258, {at, {90, 0, 45}, 258, 3, 1, 2, 0, 100}, true},
       {42, 2, 1, 5, 2, 1, 3, 1, 2, 8, 0, 64, 248, 255, 0, 1, 0, 32, 100}},
      {svc::SpawnStatic{{at, {90, 0, 45}, 7, 258, 1, 2, 0, 0, 32}, true},
       {43, 10, 7, 2, 1, 1, 2, 8, 0, 64, 248, 255, 0, 1, 0, 32, 32}},
      {svc::SpawnStaticSound{at, 258, 200, 64, true}, {44, 8, 0, 248, 255, 1, 0, 2, 1, 200, 64}},
  };
  for (const auto& c : cases) {
    MessageWriter writer;
    write_server_message(writer, c.message);
    EXPECT_EQ(writer.bytes(), c.bytes) << c.message.index();
    ServerMessageReader reader(c.bytes, "test", Protocol{c.bytes[0] >= 42 && c.bytes[0] < 128 ? 666 : 15, 0});
    const auto read = reader.next();
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->index(), c.message.index());
    EXPECT_TRUE(reader.at_end());
  }
}

TEST(ServerMessages, HaveNames) {
  EXPECT_EQ(svc_name(7), "svc_time");
  EXPECT_EQ(svc_name(44), "svc_spawnstaticsound2");
  EXPECT_EQ(svc_name(36), "svc_?");
  EXPECT_EQ(svc_name(99), "svc_?");
  EXPECT_EQ(svc_name(129), "fast update");
}

TEST(ServerMessages, EveryTempEntityTypeSurvives) {
  for (int type = 0; type <= 13; ++type) {
    svc::TempEntity t;
    t.type = static_cast<TempEntityType>(type);
    t.origin = kOrigin;
    EXPECT_EQ(round_trip(t, {15, 0}), ServerMessage(t)) << type;
  }
}

TEST(ServerMessages, ServerInfoChangesTheProtocolForWhatFollows) {
  svc::ServerInfo info;
  info.protocol = {999, kFloatCoord | kShortAngle};
  info.max_clients = 4;
  info.game_type = 1;
  info.level_name = "the hub";
  info.models = {"maps/start.bsp", "*1", "progs/player.mdl"};
  info.sounds = {"misc/null.wav"};
  MessageWriter w;  // starts as protocol 15
  write_server_message(w, info);
  write_server_message(w, svc::Damage{1, 2, {0.123f, 45678.9f, -3.0f}});
  ServerMessageReader r(w.bytes(), "test");
  auto first = r.next();
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_EQ(*first, ServerMessage(info));
  EXPECT_EQ(r.protocol(), info.protocol);
  auto second = r.next();
  ASSERT_TRUE(second.ok()) << second.error().message;
  EXPECT_EQ(*second, ServerMessage(svc::Damage{1, 2, {0.123f, 45678.9f, -3.0f}}));
}

TEST(ServerMessages, ExtendedStatesSurvive) {
  for (const Protocol& p : {kProtocols[1], kProtocols[3]}) {
    EntityState s{kOrigin, kAngles, 700, 300, 1, 2};
    s.alpha = 100;
    s.scale = 40;
    EXPECT_EQ(round_trip(svc::SpawnStatic{s, true}, p), ServerMessage(svc::SpawnStatic{s, true}));
    EXPECT_EQ(round_trip(svc::SpawnBaseline{9000, s, true}, p), ServerMessage(svc::SpawnBaseline{9000, s, true}));
    svc::SpawnStaticSound hum{kOrigin, 1000, 200, 64, true};
    EXPECT_EQ(round_trip(hum, p), ServerMessage(hum));
    svc::Sound sound;
    sound.entity = 9000;
    sound.channel = 12;
    sound.sound = 400;
    sound.volume = 100;
    sound.attenuation = 32;
    sound.origin = kOrigin;
    EXPECT_EQ(round_trip(sound, p), ServerMessage(sound));
  }
  svc::Sound plain;
  plain.entity = 500;
  plain.channel = 7;
  plain.sound = 255;
  plain.origin = kOrigin;
  EXPECT_EQ(round_trip(plain, {15, 0}), ServerMessage(plain));
}

TEST(ServerMessages, ClientDataSurvives) {
  svc::ClientData plain;
  EXPECT_EQ(round_trip(plain, {15, 0}), ServerMessage(plain));
  svc::ClientData d;
  d.view_height = -8;
  d.ideal_pitch = -20;
  d.punch = {-5, 1, 2};
  d.velocity = {20, -20, 127};
  d.items = static_cast<std::int32_t>(0x80001234u);
  d.on_ground = d.in_water = true;
  d.weapon_frame = 3;
  d.armor = 150;
  d.weapon = 44;
  d.health = -40;
  d.ammo = 25;
  d.ammo_counts = {25, 100, 3, 255};
  d.active_weapon = 32;
  for (const Protocol& p : kProtocols) EXPECT_EQ(round_trip(d, p), ServerMessage(d)) << p.version;
  d.weapon = 700;
  d.armor = 999;
  d.ammo = 300;
  d.ammo_counts = {300, 301, 302, 303};
  d.weapon_frame = 260;
  d.weapon_alpha = 77;
  d.on_elevator = true;
  for (const Protocol& p : {kProtocols[1], kProtocols[3]}) EXPECT_EQ(round_trip(d, p), ServerMessage(d)) << p.version;
}

// Random sets of fields, written and read back; only what the bits name must agree.
TEST(ServerMessages, EntityUpdatesSurvive) {
  Rng rng(42);
  constexpr std::uint32_t kShape = kUpdateMoreBits | kUpdateSignal | kUpdateLongEntity | kUpdateExtend1 |
                                   kUpdateExtend2 | kUpdateFrame2 | kUpdateModel2;
  for (const Protocol& p : kProtocols) {
    const bool extended = p.extended();
    const std::uint32_t mask = (extended ? 0x1fffffu : 0x7fffu) & ~kShape;
    for (int i = 0; i < 2000; ++i) {
      svc::EntityUpdate u;
      u.bits = rng.next() & mask;
      u.entity = static_cast<int>(rng.below(i % 2 ? 256 : 32768));
      const int wide = extended ? 65536 : 256;
      if (u.bits & kUpdateModel) u.model = static_cast<int>(rng.below(wide));
      if (u.bits & kUpdateFrame) u.frame = static_cast<int>(rng.below(wide));
      if (u.bits & kUpdateColormap) u.colormap = static_cast<int>(rng.below(256));
      if (u.bits & kUpdateSkin) u.skin = static_cast<int>(rng.below(256));
      if (u.bits & kUpdateEffects) u.effects = static_cast<int>(rng.below(256));
      if (u.bits & kUpdateAlpha) u.alpha = static_cast<int>(rng.below(256));
      if (u.bits & kUpdateScale) u.scale = static_cast<int>(rng.below(256));
      if (u.bits & kUpdateLerpFinish) u.lerp_finish = static_cast<int>(rng.below(256));
      const std::uint32_t origins[] = {kUpdateOrigin1, kUpdateOrigin2, kUpdateOrigin3};
      const std::uint32_t angles[] = {kUpdateAngle1, kUpdateAngle2, kUpdateAngle3};
      for (int k = 0; k < 3; ++k) {
        if (u.bits & origins[k]) u.origin[k] = static_cast<float>(static_cast<int>(rng.below(8000)) - 4000);
        if (u.bits & angles[k]) u.angles[k] = 45.0f * static_cast<float>(static_cast<int>(rng.below(8)) - 4);
      }
      const ServerMessage read = round_trip(u, p);
      ASSERT_TRUE(std::holds_alternative<svc::EntityUpdate>(read));
      svc::EntityUpdate got = std::get<svc::EntityUpdate>(read);
      got.bits &= ~kShape;
      ASSERT_EQ(got, u) << "protocol " << p.version << " bits " << u.bits;
    }
  }
}

TEST(ServerMessages, NehahraAlphaInProtocol15) {
  MessageWriter w;
  w.u8(0x81);  // update with more bits
  w.u8(0x80);  // transparency
  w.u8(5);
  w.f32(2.0f);
  w.f32(0.5f);
  w.f32(1.0f);
  ServerMessageReader r(w.bytes(), "test");
  auto read = r.next();
  ASSERT_TRUE(read.ok()) << read.error().message;
  const auto& u = std::get<svc::EntityUpdate>(*read);
  EXPECT_EQ(u.entity, 5);
  EXPECT_TRUE(u.bits & kUpdateAlpha);
  EXPECT_EQ(u.alpha, encode_alpha(0.5f));
  EXPECT_TRUE(r.at_end());
}

TEST(ServerMessages, ErrorsNameMessageOffsetAndCause) {
  struct Case {
    Bytes bytes;
    const char* expected;
  };
  const Case cases[] = {
      {{1, 7, 0, 0}, "demo: offset 1: svc_time (after svc_nop): the message is cut short"},
      {{0}, "demo: offset 0: svc_bad (after svc_bad): command 0 is unknown"},
      {{1, 77}, "demo: offset 1: svc_? (after svc_nop): command 77 is unknown"},
      {{8, 'a', 'b'}, "svc_print (after svc_bad): the message is cut short"},
      {{7, 0, 0, 0xc0, 0x7f}, "svc_time (after svc_bad): a number is not finite"},
      {{11, 16, 0, 0, 0}, "the server speaks protocol 16"},
      {{11, 15, 0, 0, 0, 0, 0, 0, 0, 0}, "0 players"},
      {{23, 14}, "temporary entity 14 is unknown"},
  };
  for (const Case& c : cases) {
    ServerMessageReader r(c.bytes, "demo");
    auto read = r.next();
    while (read.ok()) read = r.next();
    EXPECT_NE(read.error().message.find(c.expected), std::string::npos) << read.error().message;
  }
}

TEST(ServerMessages, TooManyPrecachesAreRefused) {
  MessageWriter w;
  w.u8(11);
  w.i32(666);
  w.u8(1);
  w.u8(0);
  w.string("level");
  for (std::size_t i = 0; i < kMaxPrecaches; ++i) w.string("m");
  ServerMessageReader r(w.bytes(), "demo");
  auto read = r.next();
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("precaches"), std::string::npos) << read.error().message;
}

// No bytes whatever make the reader read outside, loop for ever, or return without progress.
TEST(ServerMessages, RandomBytesEndInTheEndOrAnError) {
  Rng rng(7);
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(rng.below(200));
    for (auto& b : bytes) b = static_cast<std::uint8_t>(rng.next() >> 24);
    if (!bytes.empty() && round % 2) bytes[0] = static_cast<std::uint8_t>(rng.below(45));
    ServerMessageReader r(bytes, "noise", kProtocols[round % 6]);
    std::size_t steps = 0;
    while (!r.at_end()) {
      if (!r.next().ok()) break;
      ASSERT_LE(++steps, bytes.size());
    }
  }
}

}  // namespace
}  // namespace fb::net
