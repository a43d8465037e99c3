#include "client/session/parse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "client/session/test_session.h"

namespace fb::cl {
namespace {

using test::ToldSession;
using test::update;
using testing::HasSubstr;
namespace svc = net::svc;

TEST(Parse, ServerInfoStartsAnew) {
  ToldSession s;
  EXPECT_EQ(s.state.hud.level_name, "A test");
  EXPECT_EQ(s.state.hud.map_name, "test");
  EXPECT_EQ(s.state.hud.scores.size(), 2u);
  ASSERT_EQ(s.state.model_names.size(), 5u);
  EXPECT_EQ(s.state.model_names[1], "maps/test.bsp");
  EXPECT_EQ(s.state.model(3), &s.known[2]);
  EXPECT_EQ(s.state.model(0), nullptr);
  EXPECT_EQ(s.state.model(99), nullptr);
  EXPECT_EQ(s.state.signon, 3);
  s.tell({svc::Time{1.0f}, update(7, 3, {1, 2, 3})});
  EXPECT_EQ(s.state.signon, kSignons) << "the first update is the last stage";
  s.effects.particles.explosion(vec3(0.0f), 0.0);
  s.tell({svc::StuffText{"reconnect\n"}});
  s.tell({test::server_info()});
  EXPECT_EQ(s.state.signon, 0);
  EXPECT_FALSE(s.reconnect);
  EXPECT_EQ(s.state.entities.size(), 1u);
  EXPECT_TRUE(s.effects.particles.particles().empty());
}

TEST(Parse, TextsInThePlayersLanguage) {
  con::Localization texts;
  const std::string file = "m_title = \"Ein Titel\"\nqc_got = \"Gefunden\"\n";
  ASSERT_TRUE(texts.add({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, "loc.txt").ok());
  ToldSession s;
  std::string printed;
  s.localization = &texts;
  s.print = [&](const std::string& text) { printed += text + "|"; };
  svc::ServerInfo info = test::server_info();
  info.level_name = "$m_title";
  s.tell({info, svc::Print{"$qc_got"}, svc::Print{"$none"}, svc::Print{"the $qc_got"}, svc::CenterPrint{"$qc_got"}});
  EXPECT_EQ(s.state.hud.level_name, "Ein Titel");
  EXPECT_EQ(printed, "Gefunden|$none|the $qc_got|");
  EXPECT_EQ(s.state.hud.center_print, "Gefunden");
  s.tell({svc::Finale{"$m_title"}});
  EXPECT_EQ(s.state.hud.center_print, "Ein Titel");
}

TEST(Parse, TheReReleasesMessages) {
  ToldSession s;
  std::vector<std::string> heard;
  s.sound_listener = [&](const scene::SoundEvent& event) {
    if (const auto* start = std::get_if<scene::SoundStart>(&event)) heard.push_back(start->name);
  };
  const std::string sound = s.state.sound_names.at(1);
  s.tell({svc::Achievement{"ACH_NONE"}, svc::LocalSound{0, 1}, svc::LocalSound{16, 1}, svc::LocalSound{16, 8000}});
  EXPECT_EQ(heard, std::vector<std::string>({sound, sound}));
}

TEST(Parse, UpdatesAreRelativeToTheBaseline) {
  ToldSession s({666, 0});
  svc::SpawnBaseline base;
  base.entity = 5;
  base.extended = true;
  base.state.origin = {10, 20, 30};
  base.state.angles = {0, 90, 0};
  base.state.model = 3;
  base.state.frame = 0x105;
  base.state.skin = 1;
  base.state.alpha = 128;
  s.tell({base, svc::Time{1.0f}});
  svc::EntityUpdate u;
  u.entity = 5;
  u.bits = net::kUpdateOrigin1 | net::kUpdateEffects;
  u.origin = {16, 0, 0};
  u.effects = 8;
  s.tell({u});
  const Entity& e = s.entity(5);
  EXPECT_EQ(e.message_origins[0], vec3(16, 20, 30));
  EXPECT_EQ(e.message_angles[0], vec3(0, 90, 0));
  EXPECT_EQ(e.origin, vec3(16, 20, 30)) << "nothing to come from: it stands there at once";
  EXPECT_EQ(e.model, 3);
  EXPECT_EQ(e.frame, 0x105);
  EXPECT_EQ(e.skin, 1);
  EXPECT_EQ(e.effects, 8);
  EXPECT_EQ(e.alpha, 128);
  u.bits = net::kUpdateFrame | net::kUpdateAlpha | net::kUpdateScale | net::kUpdateLerpFinish | net::kUpdateStep;
  u.frame = 7;
  u.alpha = 255;
  u.scale = 32;
  u.lerp_finish = 51;
  s.tell({svc::Time{1.5f}, u});
  EXPECT_EQ(e.frame, 7);
  EXPECT_EQ(e.alpha, 255);
  EXPECT_EQ(e.scale, 32);
  EXPECT_NEAR(e.lerp_finish, 1.5 + 0.2, 1e-9);
  EXPECT_TRUE(e.lerp_flags & kLerpFinish);
  EXPECT_TRUE(e.lerp_flags & kLerpMoveStep);
}

// A high byte may come without its low one: that is the baseline's then.
TEST(Parse, HighByteJoinsTheBaselinesLowByte) {
  ToldSession s({666, 0});
  svc::SpawnBaseline base;
  base.entity = 4;
  base.state.model = 3;
  base.state.frame = 9;
  s.tell({base, svc::Time{1.0f}});
  net::MessageWriter w({666, 0});
  w.u8(0x81);  // more bits
  w.u8(0x80);  // extend 1
  w.u8(0x02);  // frame 2
  w.u8(4);
  w.u8(0x01);
  ASSERT_TRUE(parse_server_message(s, w.bytes(), "test").ok());
  EXPECT_EQ(s.entity(4).frame, 0x109);
}

TEST(Parse, ClientDataFillsTheStatusBar) {
  ToldSession s({666, 0});
  svc::ClientData d;
  d.health = 77;
  d.armor = 300;
  d.weapon = 3;
  d.weapon_frame = 2;
  d.ammo = 25;
  d.ammo_counts = {25, 50, 5, 6};
  d.active_weapon = 2;
  d.items = 0x400002;
  d.velocity = {10, -5, 0};
  d.punch = {-4, 0, 0};
  d.view_height = 18;
  d.on_ground = true;
  d.weapon_alpha = 100;
  s.state.time = 3.0;
  s.tell({d});
  const auto& stats = s.state.hud.stats;
  EXPECT_EQ(stats[net::kStatHealth], 77);
  EXPECT_EQ(stats[net::kStatArmor], 300);
  EXPECT_EQ(stats[net::kStatViewHeight], 18);
  EXPECT_EQ(stats[net::kStatPunchPitch], -4);
  EXPECT_EQ(stats[net::kStatAmmo], 25);
  EXPECT_EQ(stats[net::kStatNails], 50);
  EXPECT_EQ(stats[net::kStatCells], 6);
  EXPECT_EQ(stats[net::kStatWeapon], 3);
  EXPECT_EQ(s.state.message_velocities[0], vec3(160, -80, 0));
  EXPECT_EQ(s.state.punches[0], vec3(-4, 0, 0));
  EXPECT_EQ(s.state.view_height, 18);
  EXPECT_TRUE(s.state.on_ground);
  EXPECT_EQ(s.state.hud.item_time[1], 3.0);
  EXPECT_EQ(s.state.hud.item_time[22], 3.0);
  EXPECT_EQ(s.state.hud.item_time[2], 0.0);
  EXPECT_EQ(s.state.view_model.alpha, 100);
  s.tell({svc::Nop{}});
  EXPECT_FALSE(s.state.on_ground) << "only a message that says so keeps the player on the ground";
}

TEST(Parse, ScoresStatsAndText) {
  ToldSession s;
  std::string printed;
  s.print = [&](const std::string& text) { printed += text; };
  s.tell({svc::UpdateName{1, "ranger"}, svc::UpdateFrags{1, -3}, svc::UpdateColors{1, 0x4d}, svc::UpdateStat{12, 40},
          svc::KilledMonster{}, svc::KilledMonster{}, svc::FoundSecret{}, svc::Print{"hello\n"},
          svc::CenterPrint{"in the middle"}, svc::SetPause{true}});
  EXPECT_EQ(s.state.hud.scores[1].name, "ranger");
  EXPECT_EQ(s.state.hud.scores[1].frags, -3);
  EXPECT_EQ(s.state.hud.scores[1].colors, 0x4d);
  EXPECT_EQ(s.state.hud.stats[net::kStatTotalMonsters], 40);
  EXPECT_EQ(s.state.hud.stats[net::kStatMonsters], 2);
  EXPECT_EQ(s.state.hud.stats[net::kStatSecrets], 1);
  EXPECT_EQ(printed, "hello\n");
  EXPECT_EQ(s.state.hud.center_print, "in the middle");
  EXPECT_TRUE(s.state.hud.paused);
}

TEST(Parse, IntermissionAndFinale) {
  ToldSession s;
  s.state.time = 60.0;
  s.tell({svc::Intermission{}});
  EXPECT_EQ(s.state.hud.intermission, Intermission::kLevel);
  EXPECT_EQ(s.state.hud.completed_time, 60.0);
  s.tell({svc::Finale{"It is over"}});
  EXPECT_EQ(s.state.hud.intermission, Intermission::kFinale);
  EXPECT_EQ(s.state.hud.center_print, "It is over");
  s.tell({svc::Cutscene{"Or not"}});
  EXPECT_EQ(s.state.hud.intermission, Intermission::kCutscene);
}

TEST(Parse, StaticsAndSky) {
  ToldSession s({666, 0});
  net::EntityState torch;
  torch.model = 3;
  torch.origin = {1, 2, 3};
  torch.alpha = 50;
  s.tell({svc::SpawnStatic{torch, true}, svc::Skybox{"dusk_"}, svc::Fog{51, 255, 0, 0, 0}});
  ASSERT_EQ(s.state.statics.size(), 1u);
  EXPECT_EQ(s.state.statics[0].model, 3);
  EXPECT_EQ(s.state.statics[0].alpha, 50);
  EXPECT_EQ(s.state.statics[0].origin, vec3(1, 2, 3));
  EXPECT_EQ(s.state.skybox, "dusk_");
  EXPECT_FLOAT_EQ(fog_at(s.state.fog, 0.0).density, 0.2f);
  EXPECT_EQ(fog_at(s.state.fog, 0.0).color, vec3(1, 0, 0));
}

TEST(Parse, FogFades) {
  ToldSession s({666, 0});
  s.tell({svc::Fog{255, 0, 0, 0, 0}});
  s.state.time = 10.0;
  s.tell({svc::Fog{0, 0, 0, 0, 200}});
  EXPECT_FLOAT_EQ(fog_at(s.state.fog, 10.0).density, 1.0f);
  EXPECT_FLOAT_EQ(fog_at(s.state.fog, 11.5).density, 0.25f);
  EXPECT_FLOAT_EQ(fog_at(s.state.fog, 12.0).density, 0.0f);
}

TEST(Parse, MusicIsKeptForWhoPlaysIt) {
  ToldSession s;
  EXPECT_EQ(s.state.music, MusicTracks{});
  s.tell({svc::CdTrack{4, 5}});
  EXPECT_EQ(s.state.music, (MusicTracks{4, 5}));
}

TEST(Parse, LightStyles) {
  EXPECT_FLOAT_EQ(light_style_value("", 1.0), 1.0f);
  EXPECT_FLOAT_EQ(light_style_value("m", 1.0), 1.0f);
  EXPECT_FLOAT_EQ(light_style_value("az", 0.05), 0.0f);
  EXPECT_FLOAT_EQ(light_style_value("az", 0.15), 25.0f / 12.0f);
  EXPECT_FLOAT_EQ(light_style_value("az", 0.25), 0.0f);
  EXPECT_FLOAT_EQ(light_style_value("\x01", 0.0), 0.0f);
  ToldSession s;
  s.tell({svc::LightStyle{63, "a"}});
  EXPECT_EQ(s.state.light_styles[63], "a");
}

TEST(Parse, StuffedTextObeysOnlyWhatShows) {
  ToldSession s;
  s.tell({svc::StuffText{"bf\n"}});
  EXPECT_EQ(s.state.shifts[kShiftBonus].percent, 50.0f);
  s.tell({svc::StuffText{"v_cshift 10 20"}, svc::StuffText{" 30 40; quit\n"}});
  EXPECT_EQ(s.state.empty_shift.color, vec3(10, 20, 30));
  EXPECT_EQ(s.state.empty_shift.percent, 40.0f);
  EXPECT_FALSE(s.reconnect);
  s.tell({svc::StuffText{"reconnect\n"}});
  EXPECT_TRUE(s.reconnect);
  s.tell({svc::StuffText{"fog 0.5 1 0 0\n"}});
  EXPECT_EQ(fog_at(s.state.fog, s.state.time).color, vec3(1, 0, 0));
}

// A server of ours says so, in a line that other engines' consoles take for a comment.
TEST(Parse, ALevelThatRunsMayGetModelsAndSounds) {
  ToldSession s;
  const std::size_t models = s.state.model_names.size(), sounds = s.state.sound_names.size();
  scene::Model late;
  std::vector<std::string> loaded;
  s.load_model = [&](const std::string& name) {
    loaded.push_back(name);
    return &late;
  };
  s.command = [](std::string_view line) { ADD_FAILURE() << line; };
  const std::string model = fmt::format("//precache model {} \"progs/a b;c.mdl\"\n", models);
  s.tell({svc::StuffText{model}, svc::StuffText{fmt::format("//precache sound {} \"late.wav\"\n", sounds)},
          svc::StuffText{"//another comment\n"}});
  EXPECT_EQ(s.state.model_names.back(), "progs/a b;c.mdl");
  EXPECT_EQ(s.state.model(static_cast<int>(models)), &late);
  EXPECT_EQ(s.state.sound_names.back(), "late.wav");
  EXPECT_EQ(s.state.late_precaches.size(), 2u);
  EXPECT_EQ(s.state.late_precaches.front(), model) << "for who records from now on";
  // Heard twice, or nonsense.
  for (const std::string& line :
       {model, std::string("//precache model 0 \"x\"\n"), std::string("//precache model 99999 \"x\"\n"),
        std::string("//precache model -1 \"x\"\n"), std::string("//precache model\n"), std::string("//precache\n"),
        std::string("//precache model 1 \"x\"\n")})
    s.tell({svc::StuffText{line}});
  EXPECT_EQ(s.state.model_names.size(), models + 1);
  EXPECT_EQ(loaded.size(), 1u);
  EXPECT_EQ(s.state.model_names[1], "maps/test.bsp");
  // A number beyond the next: those between are yet to be heard of.
  s.tell({svc::StuffText{fmt::format("//precache model {} \"x\"\n", models + 2)}});
  EXPECT_EQ(s.state.model_names.size(), models + 3);
  EXPECT_EQ(s.state.model(static_cast<int>(models) + 1), nullptr);
  ToldSession fresh;
  fresh.clear();
  fresh.tell({svc::StuffText{model}});
  EXPECT_TRUE(fresh.state.model_names.empty()) << "before a level there is none";
}

TEST(Parse, RecoilJoltsOnceAKick) {
  ToldSession s;
  svc::ClientData data;
  data.punch = {-4, 0, 0};
  s.tell({data});
  EXPECT_FLOAT_EQ(s.state.jolt, 0.4f);
  s.state.jolt = 0.0f;
  for (const int fading : {-4, -3, -1, 0}) {
    data.punch = {fading, 0, 0};
    s.tell({data});
  }
  EXPECT_EQ(s.state.jolt, 0.0f);
}

TEST(Parse, DamageKicksAndReddens) {
  ToldSession s;
  s.tell({svc::Time{1.0f}, update(1, 3, {0, 0, 0})});
  s.tell({svc::Damage{0, 40, {100, 0, 0}}});
  EXPECT_EQ(s.state.shifts[kShiftDamage].color, vec3(255, 0, 0));
  EXPECT_EQ(s.state.shifts[kShiftDamage].percent, 60.0f);
  EXPECT_FLOAT_EQ(s.state.jolt, 0.8f) << "40 of 50 points";
  EXPECT_FLOAT_EQ(s.state.damage_pitch, 20.0f * 0.6f);  // from in front
  EXPECT_NEAR(s.state.damage_roll, 0.0f, 1e-5f);
  EXPECT_FLOAT_EQ(s.state.damage_time, 0.5f);
  for (int i = 0; i < 5; ++i) s.tell({svc::Damage{40, 10, {100, 0, 0}}});
  EXPECT_EQ(s.state.shifts[kShiftDamage].percent, 150.0f);
  EXPECT_EQ(s.state.shifts[kShiftDamage].color, vec3(200, 100, 100));
}

TEST(Parse, DisconnectEndsTheDatagram) {
  ToldSession s;
  s.tell({svc::Disconnect{}, svc::UpdateStat{0, 5}});
  EXPECT_TRUE(s.disconnected);
  EXPECT_EQ(s.state.hud.stats[0], 0);
}

TEST(Parse, WhatCannotBeObeyedIsAnError) {
  const auto refused = [](const std::vector<net::ServerMessage>& messages) {
    ToldSession s;
    return s.refuse(messages);
  };
  EXPECT_THAT(refused({svc::SignonNum{3}}), HasSubstr("signon stage 3 when at 3"));
  EXPECT_THAT(refused({svc::UpdateStat{32, 1}}), HasSubstr("stat 32"));
  EXPECT_THAT(refused({svc::Time{1e30f}}), HasSubstr("the time is 1e+30 seconds"));
  EXPECT_THAT(refused({svc::LightStyle{64, "m"}}), HasSubstr("light style 64"));
  EXPECT_THAT(refused({svc::UpdateName{2, "x"}}), HasSubstr("player 2 of 2"));
  EXPECT_THAT(refused({svc::UpdateFrags{2, 1}}), HasSubstr("svc_updatefrags"));
  EXPECT_THAT(refused({svc::UpdateColors{255, 1}}), HasSubstr("player 255"));
  EXPECT_THAT(refused({svc::SpawnBaseline{-1, {}, false}}), HasSubstr("entity -1 is out of range"));
  svc::EntityUpdate u = update(3, 1, vec3(0.0f), vec3(0.0f), net::kUpdateColormap);
  u.colormap = 3;
  EXPECT_THAT(refused({svc::Nop{}, u}), HasSubstr("test: offset 1: fast update (after svc_nop)"));
}

TEST(Parse, AFailedWorldIsAnError) {
  Session s;
  s.load_world = [](ClientState&) { return Status(Error{"maps/test.bsp: no such file"}); };
  const Bytes bytes = test::datagram({test::server_info()});
  const Status status = parse_server_message(s, bytes, "demo");
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("maps/test.bsp: no such file"));
}

// Noise after a sound beginning: never a crash, whatever is left of the session.
TEST(Parse, NoiseIsSurvived) {
  Rng rng(99);
  for (int round = 0; round < 3000; ++round) {
    ToldSession s(round % 3 == 0   ? net::Protocol{15, 0}
                  : round % 3 == 1 ? net::Protocol{666, 0}
                                   : net::Protocol{999, 2});
    for (int i = 0; i < 4; ++i) {
      Bytes bytes(rng.below(120));
      for (auto& b : bytes) b = static_cast<std::uint8_t>(rng.next() >> 24);
      if (!bytes.empty()) bytes[0] = static_cast<std::uint8_t>(rng.below(256));
      (void)parse_server_message(s, bytes, "noise");
    }
  }
}

}  // namespace
}  // namespace fb::cl
