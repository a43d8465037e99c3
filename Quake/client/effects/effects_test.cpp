// Particles, dynamic lights, beams.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "client/effects/dlights.h"
#include "client/effects/particles.h"
#include "client/session/test_session.h"

namespace fb::cl {
namespace {

namespace svc = net::svc;
using net::TempEntityType;

TEST(Particles, AnExplosionBurnsDownItsRampsAndEnds) {
  ParticleSystem p;
  p.explosion({100, 0, 0}, 1.0);
  ASSERT_EQ(p.particles().size(), 1024u);
  std::set<std::uint32_t> serials;
  for (const Particle& q : p.particles()) {
    serials.insert(q.serial);
    EXPECT_LE(glm::length(q.origin - vec3(100, 0, 0)), 28.0f);
    EXPECT_EQ(q.color, 0x6f);
    EXPECT_TRUE(q.glows());
  }
  EXPECT_EQ(serials.size(), 1024u);
  p.run(1.0, 0.1);  // ramps advance by 1 and 1.5
  for (const Particle& q : p.particles())
    EXPECT_TRUE(q.color == 0x6f || (q.color >= 0x61 && q.color < 0x6f)) << static_cast<int>(q.color);
  double time = 1.1;
  for (int i = 0; i < 20; ++i, time += 0.05) p.run(time, 0.05);
  EXPECT_TRUE(p.particles().empty()) << "eight steps at ten a second";
}

TEST(Particles, FallAndRise) {
  ParticleSystem p;
  p.effect({0, 0, 0}, {1, 0, 0}, 73, 1, 0.0);
  const Particle before = p.particles()[0];
  EXPECT_EQ(before.color & ~7, 72);
  EXPECT_EQ(before.velocity, vec3(15, 0, 0));
  p.run(0.0, 0.1);
  const Particle& after = p.particles()[0];
  EXPECT_NEAR(after.origin.x - before.origin.x, 1.5f, 1e-4f);
  EXPECT_NEAR(after.velocity.z, -4.0f, 1e-4f);  // a twentieth of 800 units/s^2
  ParticleSystem smoke;
  smoke.trail({0, 0, 0}, {3, 0, 0}, Trail::kRocket, 0.0);
  smoke.run(0.0, 0.1);
  EXPECT_NEAR(smoke.particles()[0].velocity.z, 4.0f, 1e-4f);
}

TEST(Particles, TrailsDropOneEveryThreeUnits) {
  ParticleSystem p;
  p.trail({0, 0, 0}, {30, 0, 0}, Trail::kBlood, 0.0);
  EXPECT_EQ(p.particles().size(), 10u);
  p.clear();
  p.trail({0, 0, 0}, {30, 0, 0}, Trail::kSlightBlood, 0.0);
  EXPECT_EQ(p.particles().size(), 5u);
  p.clear();
  p.trail({0, 0, 0}, {30, 0, 0}, Trail::kTracer2, 0.0);
  EXPECT_EQ(p.particles()[0].color, 230);
  EXPECT_EQ(p.particles()[4].color, 238);
  EXPECT_EQ(p.particles()[0].velocity.y, -p.particles()[1].velocity.y);
  p.clear();
  p.trail({5, 5, 5}, {5, 5, 5}, Trail::kVoor, 0.0);
  EXPECT_TRUE(p.particles().empty());
}

TEST(Particles, NeverMoreThanThereIsRoomFor) {
  ParticleSystem p(100);
  p.explosion(vec3(0.0f), 0.0);
  p.lava_splash(vec3(0.0f), 0.0);
  p.teleport_splash(vec3(0.0f), 0.0);
  p.blob_explosion(vec3(0.0f), 0.0);
  p.trail({0, 0, 0}, {1e30f, 0, 0}, Trail::kSmoke, 0.0);
  EXPECT_EQ(p.particles().size(), 100u);
}

TEST(Particles, CountsOfTheOtherEmitters) {
  ParticleSystem p(8192);
  p.lava_splash(vec3(0.0f), 0.0);
  EXPECT_EQ(p.particles().size(), 1024u);
  p.clear();
  p.teleport_splash(vec3(0.0f), 0.0);
  EXPECT_EQ(p.particles().size(), 8u * 8u * 14u);
  p.clear();
  p.color_explosion(vec3(0.0f), 16, 4, 0.0);
  EXPECT_EQ(p.particles().size(), 512u);
  for (const Particle& q : p.particles()) EXPECT_TRUE(q.color >= 16 && q.color < 20);
  p.color_explosion(vec3(0.0f), 255, 0, 0.0);  // a length of none must not divide
  p.clear();
  p.effect(vec3(0.0f), vec3(0.0f), 0, 1024, 0.0);
  EXPECT_EQ(p.particles()[0].type, ParticleType::kExplode2) << "1024 is an explosion";
}

TEST(Particles, TheSameEveryTime) {
  ParticleSystem a, b;
  for (ParticleSystem* p : {&a, &b}) {
    p->explosion({1, 2, 3}, 0.5);
    p->run(0.5, 0.1);
  }
  for (std::size_t i = 0; i < a.particles().size(); ++i) EXPECT_EQ(a.particles()[i].origin, b.particles()[i].origin);
}

TEST(DynamicLights, KeysReplaceAndDeadSlotsAreUsedAgain) {
  DynamicLights lights;
  DynamicLight& rocket = lights.allocate(5, 1.0);
  rocket.radius = 200.0f;
  rocket.die = 1.1;
  const std::uint32_t serial = rocket.serial;
  DynamicLight& other = lights.allocate(0, 1.0);
  EXPECT_NE(&other, &rocket);
  other.radius = 100.0f;
  other.die = 2.0;
  DynamicLight& again = lights.allocate(5, 1.05);
  EXPECT_EQ(&again, &lights.lights()[0]);
  EXPECT_EQ(again.serial, serial) << "the same light, moved";
  again.radius = 200.0f;
  again.die = 1.1;
  EXPECT_NE(lights.allocate(5, 1.5).serial, serial) << "it had gone out";
}

TEST(DynamicLights, Decay) {
  DynamicLights lights;
  DynamicLight& l = lights.allocate(0, 0.0);
  l.radius = 350.0f;
  l.decay = 300.0f;
  l.die = 0.5;
  lights.decay(0.1, 0.1);
  EXPECT_NEAR(l.radius, 320.0f, 1e-3f);
  lights.decay(0.2, 10.0);
  EXPECT_EQ(l.radius, 0.0f);
  EXPECT_FALSE(l.lit(0.2));
}

TEST(DynamicLights, SpheresAreAsBrightAsQuakesLightsHalfwayOut) {
  for (float radius : {100.0f, 200.0f, 350.0f}) {
    const LightSphere s = light_sphere(radius);
    const float half = radius / 2;
    EXPECT_NEAR(s.radiance * s.radius * s.radius / (half * half), radius / 256.0f, 1e-4f);
    const LightSphere wide = light_sphere(radius, true);
    EXPECT_NEAR(wide.radiance * wide.radius * wide.radius, s.radiance * s.radius * s.radius, 1e-1f);
    EXPECT_LT(wide.radiance * 15.0f, s.radiance) << "what is inside the sphere keeps its colours";
  }
  EXPECT_GT(light_sphere(400).radiance, light_sphere(200).radiance);
}

TEST(Beams, SegmentsEveryThirtyUnits) {
  Beams beams;
  beams.start(TempEntityType::kLightning2, 3, {0, 0, 0}, {0, 100, 0}, 1.0);
  beams.update(1.1, 1, vec3(0.0f));
  ASSERT_EQ(beams.segments().size(), 4u);
  EXPECT_NEAR(beams.segments()[3].origin.y, 90.0f, 1e-3f);
  EXPECT_EQ(beams.segments()[0].angles.x, 0.0f);
  EXPECT_EQ(beams.segments()[0].angles.y, 90.0f);
  const float roll = beams.segments()[0].angles.z;
  beams.update(1.1, 1, vec3(0.0f));
  EXPECT_EQ(beams.segments()[0].angles.z, roll) << "the same moment, the same bolt";
  beams.update(1.21, 1, vec3(0.0f));
  EXPECT_TRUE(beams.segments().empty());
}

TEST(Beams, ThePlayersOwnStartsAtThePlayer) {
  Beams beams;
  beams.start(TempEntityType::kLightning1, 1, {0, 0, 0}, {60, 0, 0}, 1.0);
  beams.update(1.0, 1, {30, 0, 0});
  ASSERT_EQ(beams.segments().size(), 1u);
  EXPECT_EQ(beams.segments()[0].origin, vec3(30, 0, 0));
}

TEST(Beams, HostileOnesAreBounded) {
  Beams beams;
  for (int i = 0; i < 100; ++i) beams.start(TempEntityType::kBeam, i, vec3(-3e38f), vec3(3e38f), 0.0);
  beams.start(TempEntityType::kBeam, 0, vec3(0.0f), vec3(1e9f, 0, 0), 0.0);
  beams.start(TempEntityType::kBeam, 1, vec3(5.0f), vec3(5.0f), 0.0);
  beams.update(0.1, 50, vec3(0.0f));
  EXPECT_LE(beams.segments().size(), Beams::kCount * Beams::kMaxSegments);
  EXPECT_EQ(beams.segments().size(), Beams::kMaxSegments);
}

TEST(Beams, VerticalOnesPoint) {
  Beams beams;
  beams.start(TempEntityType::kLightning1, 2, {0, 0, 0}, {0, 0, 10}, 0.0);
  beams.start(TempEntityType::kLightning1, 3, {0, 0, 0}, {0, 0, -10}, 0.0);
  beams.update(0.0, 0, vec3(0.0f));
  ASSERT_EQ(beams.segments().size(), 2u);
  EXPECT_EQ(beams.segments()[0].angles.x, 90.0f);
  EXPECT_EQ(beams.segments()[1].angles.x, 270.0f);
}

TEST(TempEntities, EachDoesItsThing) {
  const auto after = [](TempEntityType type) {
    auto s = std::make_unique<test::ToldSession>();
    svc::TempEntity t;
    t.type = type;
    t.origin = {1, 2, 3};
    t.end = {1, 2, 90};
    t.entity = 9;
    t.color_start = 10;
    t.color_length = 3;
    s->tell({t});
    s->effects.beams.update(s->state.time, 1, vec3(0.0f));
    return s;
  };
  const auto count = [&](TempEntityType type) { return after(type)->effects.particles.particles().size(); };
  const auto lit = [&](TempEntityType type) { return after(type)->effects.lights.lights()[0].lit(0.0); };
  EXPECT_EQ(count(TempEntityType::kSpike), 10u);
  EXPECT_EQ(count(TempEntityType::kSuperSpike), 20u);
  EXPECT_EQ(count(TempEntityType::kGunshot), 20u);
  EXPECT_EQ(count(TempEntityType::kWizSpike), 30u);
  EXPECT_EQ(count(TempEntityType::kKnightSpike), 20u);
  EXPECT_EQ(count(TempEntityType::kExplosion), 1024u);
  EXPECT_EQ(count(TempEntityType::kTarExplosion), 1024u);
  EXPECT_EQ(count(TempEntityType::kExplosion2), 512u);
  EXPECT_EQ(count(TempEntityType::kLavaSplash), 1024u);
  EXPECT_EQ(count(TempEntityType::kTeleport), 896u);
  EXPECT_TRUE(lit(TempEntityType::kExplosion));
  EXPECT_TRUE(lit(TempEntityType::kExplosion2));
  EXPECT_FALSE(lit(TempEntityType::kTarExplosion));
  for (TempEntityType beam :
       {TempEntityType::kLightning1, TempEntityType::kLightning2, TempEntityType::kLightning3, TempEntityType::kBeam}) {
    const auto s = after(beam);
    ASSERT_EQ(s->effects.beams.segments().size(), 3u);
    EXPECT_EQ(s->effects.beams.segments()[0].type, beam);
  }
  EXPECT_STREQ(beam_model(TempEntityType::kLightning3), "progs/bolt3.mdl");
}

}  // namespace
}  // namespace fb::cl
