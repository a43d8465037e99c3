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
