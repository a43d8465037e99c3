// Each builtin that needs a server, called from QuakeC.
#include <map>

#include "formats/test_models.h"
#include "fs/test_log.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

using ::testing::HasSubstr;
namespace fields = progs::fields;

class GameBuiltinsTest : public testing::ServerTest {
 protected:
  // What was written where WriteByte(0, ...) writes, by `statements` on a level that runs.
  Bytes datagram_of(const std::string& statements, const std::string& declarations = "") {
    start(declarations + "void() go = {" + statements + "};");
    if (!server_ || !server_->active()) return {};
    const std::size_t before = server_->clients().datagram().bytes().size();
    EXPECT_TRUE(level().run(level().vm->program().find_function("go"), EdictId::kWorld)) << level().error()->message;
    const Bytes& all = server_->clients().datagram().bytes();
    return Bytes(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
  }
  // Of one temporary entity.
  net::svc::TempEntity effect_of(const std::string& statements, const std::string& before = "") {
    const Bytes bytes = datagram_of(statements, before);
    net::ServerMessageReader reader(bytes, "datagram", server_->clients().protocol());
    const auto message = reader.next();
    EXPECT_TRUE(message.ok() && reader.at_end());
    return message.ok() ? std::get<net::svc::TempEntity>(*message) : net::svc::TempEntity{};
  }
};

TEST_F(GameBuiltinsTest, OriginSizeAndModel) {
  EXPECT_EQ(says(R"(setorigin(self, '10 20 30'); saysv(self.origin);
    setsize(self, '-1 -2 -3', '4 5 6'); saysv(self.size); saysv(self.absmin); saysv(self.absmax);)"),
            "(10 20 30) (5 7 9) (8 17 26) (15 26 37) ");
  EXPECT_THAT(says("setsize(self, '0 0 1', '0 0 0');"), HasSubstr("box of entity 2 is inside out"));
  EXPECT_EQ(says("setmodel(self, \"progs/never.mdl\"); saysf(self.modelindex); says(self.model);"),
            "2 progs/never.mdl ");
  EXPECT_THAT(level().vm->warning(), HasSubstr("setmodel: progs/never.mdl is not precached"));
  EXPECT_EQ(level().models.back().name, "progs/never.mdl") << "now it is";
  EXPECT_EQ(says("setmodel(self, \"maps/test.bsp\"); saysf(self.modelindex); saysv(self.mins); saysv(self.maxs);"),
            "1 (-513 -513 -1) (513 513 257) ");
}

TEST_F(GameBuiltinsTest, BoxesOfModelFiles) {
  const formats::Mdl mdl = formats::testing::tetrahedron();
  files_["progs/t.mdl"] = formats::testing::write_mdl(mdl);
  files_["progs/s.spr"] = formats::testing::write_spr(formats::testing::small_sprite({}));
  const auto spr = formats::parse_spr(files_["progs/s.spr"], "s");
  ASSERT_TRUE(spr.ok());
  start(
      R"(void() thing = { precache_model("progs/t.mdl"); precache_model("progs/s.spr"); precache_model("progs/no.mdl");
    setmodel(self, "progs/t.mdl"); local entity e; e = spawn(); setmodel(e, "progs/s.spr");
    saysf(self.modelindex); saysf(e.modelindex); setmodel(e, "progs/no.mdl"); saysv(e.size); saysf(e.modelindex);
    says(e.model); setmodel(e, "progs/s.spr"); };)",
      "{ \"classname\" \"thing\" }");
  EXPECT_EQ(said(), "2 3 (0 0 0) 4 progs/no.mdl ");
  vec3 mins(1e9f), maxs(-1e9f);
  for (const formats::MdlVertex& v : mdl.vertices) {
    const vec3 p = vec3(v.x, v.y, v.z) * mdl.scale + mdl.origin;
    mins = glm::min(mins, p);
    maxs = glm::max(maxs, p);
  }
  EXPECT_EQ(edict(2).get(fields::mins), mins);
  EXPECT_EQ(edict(2).get(fields::maxs), maxs);
  EXPECT_EQ(edict(3).get(fields::maxs).z, static_cast<float>(spr->max_height / 2));
}

TEST_F(GameBuiltinsTest, Traces) {
  EXPECT_EQ(
      says(R"(traceline('0 0 100', '0 0 -100', 0, self); saysf(trace_fraction * 200 > 99); saysv(trace_plane_normal);
    sayse(trace_ent); saysf(trace_inopen); saysf(trace_allsolid); saysf(trace_startsolid);)"),
      "1 (0 0 1) e0 1 0 0 ");
  EXPECT_EQ(says(R"(local entity e; e = spawn(); e.solid = SOLID_BBOX; setorigin(e, '100 0 50');
    setsize(e, '-10 -10 -10', '10 10 10'); traceline('0 0 50', '200 0 50', 0, self); sayse(trace_ent);
    traceline('0 0 50', '200 0 50', 1, self); sayse(trace_ent); traceline('0 0 50', '200 0 50', 0, e); sayse(trace_ent);
    tracebox('0 0 50', '-8 -8 -8', '8 8 8', '200 0 50', 0, self); saysf(rint(trace_endpos_x));)"),
            "e3 e0 e0 82 ");
  // What is no number is 0, as in QuakeSpasm.
  EXPECT_EQ(says(R"(local vector v; v = '0 0 0'; v_x = stof("nan"); v_x = 0 / v_x; traceline('0 0 9', v, 0, self);
    saysf(trace_fraction <= 1);)"),
            "1 ");
}

TEST_F(GameBuiltinsTest, PointsAndBottoms) {
  EXPECT_EQ(says("saysf(pointcontents('0 0 10')); saysf(pointcontents('0 0 -10'));"), "-1 -2 ");
  EXPECT_EQ(says(R"(setsize(self, '-16 -16 -24', '16 16 32'); setorigin(self, '0 0 60'); saysf(checkbottom(self));
    saysf(droptofloor()); saysf(checkbottom(self)); saysf(rint(self.origin_z)); saysf((self.flags & FL_ONGROUND) > 0);
    saysf(walkmove(0, 16)); saysf(rint(self.origin_x)); self.flags = 0; saysf(walkmove(0, 16));)"),
            "0 1 1 24 1 1 16 0 ");
}

TEST_F(GameBuiltinsTest, MoveToGoal) {
  EXPECT_EQ(says(R"(setsize(self, '-16 -16 -24', '16 16 32'); setorigin(self, '0 0 30'); droptofloor();
    self.movetype = MOVETYPE_STEP; self.solid = SOLID_SLIDEBOX; self.yaw_speed = 360; local entity goal; goal = spawn();
    setorigin(goal, '300 0 24'); self.goalentity = goal; self.enemy = goal; local float i;
    for (i = 0; i < 20; i++) movetogoal(8); saysf(vlen(self.origin - goal.origin) < 250);)"),
            "1 ");
}

TEST_F(GameBuiltinsTest, FindRadius) {
  EXPECT_EQ(says(R"(local entity a, b, c, e; a = spawn(); b = spawn(); c = spawn(); a.solid = b.solid = c.solid = 2;
    setorigin(a, '10 0 0'); setorigin(b, '0 500 0'); setorigin(c, '0 0 20'); e = findradius('0 0 0', 50);
    while (e) { sayse(e); e = e.chain; } c.solid = 0; sayse(findradius('0 0 0', 50)); sayse(findradius('0 0 0', -1));)"),
            "e5 e3 e3 e0 ");
}

TEST_F(GameBuiltinsTest, Aim) {
  const std::string setup = R"(local entity e; e = spawn(); e.solid = SOLID_BBOX; e.takedamage = 2;
    setsize(e, '-16 -16 -16', '16 16 16'); setorigin(self, '0 0 30'); makevectors('0 0 0'); )";
  console_.execute("set sv_aim 0.93");
  EXPECT_EQ(
      says(setup + "setorigin(e, '200 0 100'); local vector v; v = aim(self, 1000); saysf(v_z > 0.3); saysf(v_y);"),
      "1 0 ");
  EXPECT_EQ(says(setup + "setorigin(e, '-200 0 100'); saysv(aim(self, 1000) + '0 0 0');"), "(1 0 0) ");
  console_.set("sv_aim", "1");
  EXPECT_EQ(says(setup + "setorigin(e, '200 0 100'); saysv(aim(self, 1000) + '0 0 0');"), "(1 0 0) ");
  console_.set("sv_aim", "0.93");
  EXPECT_EQ(says(setup + "remove(e); saysv(aim(e, 1000) + '0 0 0'); saysv(aim(self, 1) + '0 0 0');"),
            "(1 0 0) (1 0 0) ");
}

TEST_F(GameBuiltinsTest, EntitiesThatAreNone) {
  for (const char* call :
       {"setorigin(nobody, '0 0 0')", "setsize(nobody, '0 0 0', '1 1 1')", "setmodel(nobody, \"\")",
        "sound(nobody, 0, \"x.wav\", 1, 1)", "traceline('0 0 0', '1 1 1', 0, nobody)", "checkbottom(nobody)",
        "aim(nobody, 1)", "makestatic(nobody)", "sprint(nobody, \"x\")", "stuffcmd(nobody, \"x\")",
        "setspawnparms(nobody)", "centerprint(nobody, \"x\")", "WriteEntity(0, nobody)",
        "getsurfacenumpoints(nobody, 0)", "te_lightning1(nobody, '0 0 0', '1 1 1')"}) {
    start("entity nobody; void() go = { " + std::string(call) + "; };");
    level().vm->set(global<EdictId>("nobody"), EdictId{0x7fffffff});
    EXPECT_TRUE(level().run(level().vm->program().find_function("go"), EdictId::kWorld)) << call;
    EXPECT_THAT(level().vm->warning(), HasSubstr("is entity 2147483647")) << call;
    EXPECT_EQ(level().world_edict().get(fields::absmax).x, 0.0f) << call << ": the world is not meant";
  }
}

TEST_F(GameBuiltinsTest, Precaching) {
  EXPECT_EQ(says(R"(says(precache_sound("a.wav")); says(precache_sound2("a.wav")); says(precache_model("m.mdl"));
    says(precache_model2("m.mdl")); says(precache_file("f")); says(precache_file2("f"));)"),
            "a.wav a.wav m.mdl m.mdl f f ");
  EXPECT_EQ(level().sounds.size(), 2u);
  EXPECT_EQ(level().models.size(), 3u);
  for (const char* none : {"precache_sound(\"\");", "precache_model(\" x\");"}) {
    EXPECT_EQ(says(none), "");
    EXPECT_THAT(level().vm->warning(), HasSubstr("no name of a file"));
  }
  EXPECT_THAT(says("local float i; for (i = 0; i < 9000; i++) precache_sound(ftos(i + 1));"),
              HasSubstr("more than 8191 sounds"));
}

TEST_F(GameBuiltinsTest, Sounds) {
  const std::string before = "precache_sound(\"a.wav\"); ";
  EXPECT_EQ(says(before + "sound(self, 7, \"a.wav\", 1, 4); sound(self, 0, \"b.wav\", 0, 0);"
                          "ambientsound('0 0 0', \"a.wav\", 1, 3); ambientsound('0 0 0', \"none.wav\", 1, 3);"),
            "");
}

// As near as it goes, with a warning.
TEST_F(GameBuiltinsTest, SoundsOutOfTheirLimits) {
  const auto heard = [&](const std::string& call) {
    put_progs(std::string(testing::kModSource) +
              "void(vector o, string s, float v, float a) pointsound = #483; void() thing = { "
              "precache_sound(\"a.wav\"); }; void() go = {" +
              call + "};");
    put_map("test", room(), "{ \"classname\" \"thing\" }");
    make_server();
    EXPECT_TRUE(server_->map("test").ok());
    EXPECT_TRUE(level().run(level().vm->program().find_function("go"), EdictId::kWorld));
    net::ServerMessageReader reader(server_->clients().datagram().bytes(), "datagram", server_->clients().protocol());
    const auto message = reader.next();
    const auto* sound = message.ok() ? std::get_if<net::svc::Sound>(&*message) : nullptr;
    EXPECT_TRUE(sound) << call;
    return sound ? *sound : net::svc::Sound{};
  };
  const auto warning = [&] { return level().vm->warning(); };
  EXPECT_EQ(heard("sound(self, 9, \"a.wav\", 1, 1);").channel, 9);
  EXPECT_EQ(warning(), "") << "no sound of Quake's, but one that messages hold";
  EXPECT_EQ(heard("sound(self, -1, \"a.wav\", 1, 1);").channel, 0);
  EXPECT_THAT(warning(), HasSubstr("sound a.wav: channel -1, of 0 to 255"));
  EXPECT_EQ(heard("sound(self, 1, \"a.wav\", 1.5, 1);").volume, 255);
  EXPECT_THAT(warning(), HasSubstr("volume 1.5, of 0 to 1"));
  EXPECT_EQ(heard("sound(self, 1, \"a.wav\", 1, 4.5);").attenuation, 255);
  EXPECT_THAT(warning(), HasSubstr("attenuation 4.5, of 0 to 4"));
  EXPECT_EQ(heard("local float nan; nan = 0; nan = 0 / nan; sound(self, 1, \"a.wav\", 1, nan);").attenuation, 0);
  const auto placed = heard("pointsound('8 16 24', \"a.wav\", 1, 1);");
  EXPECT_EQ(placed.entity, 0);
  EXPECT_EQ(placed.origin, vec3(8, 16, 24));
}

TEST_F(GameBuiltinsTest, LightStyles) {
  EXPECT_EQ(says("lightstyle(0, \"m\"); lightstyle(63, \"az\"); lightstyle(64, \"x\"); lightstyle(-1, \"x\");"), "");
  EXPECT_EQ(level().light_styles.at(0), "m");
  EXPECT_EQ(level().light_styles.at(63), "az");
}

TEST_F(GameBuiltinsTest, ThoseWhoAreNoPlayers) {
  EXPECT_EQ(says("sprint(self, \"x\"); sprint(world, \"x\"); centerprint(self, \"x\"); sprint(edict_num(1), \"x\");"),
            "");
  EXPECT_THAT(says("stuffcmd(self, \"x\");"), HasSubstr("stuffcmd to entity 2, which is no player"));
  EXPECT_THAT(says("setspawnparms(self);"), HasSubstr("setspawnparms of entity 2, which is no player"));
  EXPECT_EQ(says("setspawnparms(edict_num(1)); saysf(parm1);"), "0 ");
}

// A mod's author needs to know where, and players need no line a frame.
TEST_F(GameBuiltinsTest, WhatIsNotThereIsToldOnceWithItsPlace) {
  const std::string declared =
      "void(entity e, string s) localsound = #80; void(vector o, string s, float v, float a) pointsound = #483; ";
  for (const auto& [call, told] : std::map<std::string, std::string>{
           {"sound(self, 0, \"no.wav\", 1, 1)", "the sound \"no.wav\" is not precached"},
           {"ambientsound('0 0 0', \"no.wav\", 1, 1)", "the sound \"no.wav\" is not precached"},
           {"localsound(edict_num(1), \"no.wav\")", "the sound \"no.wav\" is not precached"},
           {"pointsound('0 0 0', \"no.wav\", 1, 1)", "the sound \"no.wav\" is not precached"},
           {"localsound(self, \"a.wav\")", "localsound to entity 2, which is no player"},
           {"sprint(self, \"x\")", "sprint to entity 2, which is no player"},
           {"lightstyle(64, \"m\")", "lightstyle 64, of 0 to 63"}}) {
    const fs::LogLines log;
    set_log_level(LogLevel::kWarning);
    EXPECT_EQ(says("local float i; for (i = 0; i < 3; i++) " + call + ";", declared), "") << call;
    set_log_level(LogLevel::kError);
    EXPECT_THAT(level().vm->warning(), HasSubstr("statement")) << call;
    EXPECT_THAT(log.lines, ::testing::Contains(HasSubstr(told)).Times(1)) << call;
  }
}

TEST_F(GameBuiltinsTest, Writes) {
  const Bytes bytes = datagram_of(R"(WriteByte(0, 200); WriteChar(0, -2); WriteShort(0, -300); WriteLong(0, 70000);
    WriteString(0, "hi"); WriteEntity(0, self); WriteByte(0, 1000000 * 1000000);)");
  const Bytes expected{200, 254, 0xd4, 0xfe, 0x70, 0x11, 1, 0, 'h', 'i', 0, 0, 0, 0};
  EXPECT_EQ(bytes, expected);
  EXPECT_EQ(datagram_of("WriteCoord(0, 10.5); WriteAngle(0, 90);").size(), 3u);  // protocol 666: two bytes, and one
  EXPECT_EQ(datagram_of("WriteFloat(0, 1.5);", "void(float to, float f) WriteFloat = #280;"),
            (Bytes{0, 0, 0xc0, 0x3f}));
  EXPECT_EQ(
      datagram_of("WriteUnterminatedString(0, \"hi\");", "void(float to, string s) WriteUnterminatedString = #456;"),
      (Bytes{'h', 'i'}));
  EXPECT_THAT(says("WriteByte(6, 1);"), HasSubstr("error: "));
  EXPECT_THAT(says("WriteByte(-1, 1);"), HasSubstr("error: "));
  EXPECT_THAT(says("msg_entity = self; WriteByte(1, 1);"), HasSubstr("error: "));
}

// FTE's: what gathers in a buffer goes where the last call says.
TEST_F(GameBuiltinsTest, Multicast) {
  const std::string declared = "void(vector o, float set) multicast = #82; ";
  EXPECT_EQ(datagram_of("WriteByte(4, 1); WriteByte(5, 2); multicast('0 0 0', 2); WriteByte(4, 3);", declared),
            (Bytes{1, 2}));
  EXPECT_TRUE(
      datagram_of("WriteByte(4, 1); msg_entity = world; multicast('0 0 0', 6); multicast('0 0 0', 0);", declared)
          .empty());
  EXPECT_TRUE(datagram_of("WriteByte(4, 1); multicast('0 0 0', 99);", declared).empty());
  start(declared + "void() go = { WriteByte(4, 7); multicast('0 0 0', 8); };");
  const std::size_t before = server_->clients().signon().bytes().size();
  EXPECT_TRUE(level().run(level().vm->program().find_function("go"), EdictId::kWorld));
  EXPECT_EQ(server_->clients().signon().bytes().size(), before + 1);
}

// DarkPlaces' effects that particles can show.
TEST_F(GameBuiltinsTest, EffectsOfParticles) {
  const auto particles = [&](const std::string& declaration, const std::string& call) {
    std::vector<net::svc::Particle> all;
    const Bytes bytes = datagram_of(call, declaration);
    net::ServerMessageReader reader(bytes, "datagram", server_->clients().protocol());
    while (!reader.at_end()) {
      const auto message = reader.next();
      const auto* one = message.ok() ? std::get_if<net::svc::Particle>(&*message) : nullptr;
      EXPECT_TRUE(one) << call;
      if (!one) break;
      all.push_back(*one);
    }
    return all;
  };
  const auto blood =
      particles("void(vector o, vector v, float n) te_blood = #405; ", "te_blood('8 0 0', '1 0 -2', 30);");
  ASSERT_EQ(blood.size(), 1u);
  EXPECT_EQ(blood[0].origin, vec3(8, 0, 0));
  EXPECT_EQ(blood[0].direction, (std::array{16, 0, -32}));
  EXPECT_EQ(blood[0].count, 30);
  EXPECT_EQ(blood[0].color, 73);
  const auto sparks =
      particles("void(vector o, vector v, float n) te_spark = #411; ", "te_spark('0 0 0', '0 0 0', 1000);");
  ASSERT_EQ(sparks.size(), 1u);
  EXPECT_EQ(sparks[0].count, 254) << "255 would be an explosion";
  const auto shower = particles("void(vector a, vector b, float s, float n) te_bloodshower = #406; ",
                                "te_bloodshower('0 0 0', '64 64 64', 10, 80);");
  ASSERT_EQ(shower.size(), 8u);
  EXPECT_EQ(shower[0].origin, vec3(16));
  EXPECT_EQ(shower[7].origin, vec3(48));
  EXPECT_EQ(shower[0].count, 10);
  EXPECT_EQ(effect_of("te_gunshotquad('8 16 24');", "void(vector o) te_gunshotquad = #412;").type,
            net::TempEntityType::kGunshot);
}

TEST_F(GameBuiltinsTest, ModelsByNumberAndTriggersByHand) {
  EXPECT_EQ(says("setmodelindex(self, 1); saysf(self.modelindex); says(self.model); saysv(self.maxs);"
                 "setmodelindex(self, 99); saysf(self.modelindex);",
                 "void(entity e, float i) setmodelindex = #333;"),
            "1 maps/test.bsp (513 513 257) 1 ");
  EXPECT_THAT(level().vm->warning(), HasSubstr("setmodelindex: there is no model 99"));
  EXPECT_EQ(
      says(R"(local entity t; t = spawn(); t.solid = SOLID_TRIGGER; t.touch = touched; setsize(t, '-8 -8 -8', '8 8 8');
                    setorigin(t, '100 0 50'); self.solid = SOLID_SLIDEBOX; setsize(self, '-8 -8 -8', '8 8 8');
                    touchtriggers(self); says("not yet"); touchtriggers(self, '100 0 50'); saysv(self.origin); sayse(self);)",
           "void(entity e, ...) touchtriggers = #279; void() touched = { says(\"touched\"); sayse(other); };"),
      "not yet touched e2 (100 0 50) e2 ");
}

TEST_F(GameBuiltinsTest, CopiesStandWhereTheyAre) {
  EXPECT_EQ(
      says(R"(local entity e; self.solid = SOLID_BBOX; setsize(self, '-8 -8 -8', '8 8 8'); setorigin(self, '100 0 50');
                    e = copyentity(self); remove(self); traceline('0 0 50', '200 0 50', 0, self); sayse(trace_ent);)",
           "entity(entity from, ...) copyentity = #400;"),
      "e3 ");
}

TEST_F(GameBuiltinsTest, SightOfAPlace) {
  EXPECT_EQ(says(R"(setmodel(self, "maps/test.bsp"); setsize(self, '-8 -8 -8', '8 8 8'); setorigin(self, '100 0 50');
                    saysf(checkpvs('0 0 50', self)); saysf(checkpvs('0 0 50', world));)",
                 "float(vector o, entity e) checkpvs = #240;"),
            "1 0 ");
}

TEST_F(GameBuiltinsTest, PlayersThatAModAsksFor) {
  start(
      "float kind, place, thing, full; float(entity e) clienttype = #455; void(entity e) dropclient = #453;"
      "float(entity e) isbackbuffered = #234; float gone; void() ClientDisconnect = { gone = gone + 1; };"
      "void() ask = { kind = clienttype(edict_num(1)); place = clienttype(edict_num(2)); thing = clienttype(world);"
      "  full = isbackbuffered(edict_num(1)); };"
      "void() away = { dropclient(edict_num(1)); dropclient(world); };",
      "", {.max_clients = 2});
  Player player = join();
  const auto run = [&](const char* function) {
    EXPECT_TRUE(level().run(level().vm->program().find_function(function), EdictId::kWorld));
  };
  run("ask");
  EXPECT_EQ(level().vm->get(global<float>("kind")), 1.0f);
  EXPECT_EQ(level().vm->get(global<float>("place")), 0.0f);
  EXPECT_EQ(level().vm->get(global<float>("thing")), 3.0f);
  EXPECT_EQ(level().vm->get(global<float>("full")), 0.0f);
  run("away");
  EXPECT_EQ(server_->clients().active_count(), 1) << "not in the midst of QuakeC";
  frames(1);
  EXPECT_EQ(server_->clients().active_count(), 0);
  EXPECT_EQ(level().vm->get(global<float>("gone")), 1.0f);
  run("ask");
  EXPECT_EQ(level().vm->get(global<float>("kind")), 0.0f);
}

TEST_F(GameBuiltinsTest, Effects) {
  EXPECT_EQ(effect_of("te_gunshot('8 16 24');").origin, vec3(8, 16, 24));
  EXPECT_EQ(effect_of("te_explosion('8 16 24');").type, net::TempEntityType::kExplosion);
  const auto colored = effect_of("te_explosion2('8 16 24', 7, 9);");
  EXPECT_EQ(colored.color_start, 7);
  EXPECT_EQ(colored.color_length, 9);
  const auto beam = effect_of("te_lightning1(self, '8 0 0', '0 8 0');");
  EXPECT_EQ(beam.type, net::TempEntityType::kLightning1);
  EXPECT_EQ(beam.end, vec3(0, 8, 0));
  EXPECT_TRUE(datagram_of("pointparticles(particleeffectnum(\"x\"), '0 0 0', '0 0 0', 1);"
                          "te_particlerain('0 0 0', '1 1 1', '0 0 0', 1, 1);")
                  .empty());
}

TEST_F(GameBuiltinsTest, ExtensionsAreToldHonestly) {
  EXPECT_EQ(says(R"(saysf(checkextension("DP_QC_GETSURFACE")); saysf(checkextension("DP_QC_TRACEBOX"));
    saysf(checkextension("DP_TE_STANDARDEFFECTBUILTINS")); saysf(checkextension("DP_GFX_FOG"));
    saysf(checkextension("DP_SV_POINTPARTICLES")); saysf(checkextension("FTE_SV_POINTPARTICLES"));
    saysf(checkextension("DP_TE_PARTICLERAIN")); saysf(checkextension("DP_TE_PARTICLESNOW"));
    saysf(checkextension("DP_SV_ROTATINGBMODEL")); saysf(checkextension("FTE_ENT_SKIN_CONTENTS"));)"),
            "1 1 1 1 0 0 0 0 1 1 ");
  console_.set("pr_checkextension", "0");
  EXPECT_EQ(says("saysf(checkextension(\"DP_QC_GETSURFACE\")); saysf(checkextension(\"DP_SV_ROTATINGBMODEL\"));"),
            "0 0 ");
  EXPECT_FALSE(level().asked.rotating_pushers);
}

TEST_F(GameBuiltinsTest, MakeStatic) {
  start("void() thing = { setmodel(self, \"maps/test.bsp\"); makestatic(self); };", "{ \"classname\" \"thing\" }");
  EXPECT_TRUE(level().edicts().is_free(EdictId{2}));
  const std::size_t shown = server_->clients().signon().bytes().size();
  start("void() thing = { setmodel(self, \"maps/test.bsp\"); makestatic(self); };",
        "{ \"classname\" \"thing\" \"alpha\" \"-1\" }");
  EXPECT_TRUE(level().edicts().is_free(EdictId{2}));
  EXPECT_LT(server_->clients().signon().bytes().size(), shown);  // nobody could see it
}

TEST_F(GameBuiltinsTest, CheckClient) {
  start(
      "float found; void() thinks = { found = num_for_edict(checkclient()); self.nextthink = time + 0.1; };"
      "void() thing = { self.think = thinks; self.nextthink = time + 0.1; setorigin(self, '0 0 50'); };"
      "void() PutClientInServer = { self.health = 100; setorigin(self, '100 0 50'); };",
      "{ \"classname\" \"thing\" }");
  frames(3);
  EXPECT_EQ(level().vm->get(global<float>("found")), 0.0f);
  const Player player = join();
  frames(3);
  EXPECT_EQ(level().vm->get(global<float>("found")), 1.0f);
  edict(1).set(fields::health, 0.0f);
  frames(3);
  EXPECT_EQ(level().vm->get(global<float>("found")), 0.0f);
}

// A room of six faces, as the formats' tests have it.
class SurfaceTest : public GameBuiltinsTest {
 protected:
  std::string says_of_room(const std::string& statements, const std::string& before = "") {
    put_progs(before + "void() worldspawn = {" + statements + "};");
    formats::Bsp bsp = formats::testing::box_room(formats::BspVersion::kBsp29);
    bsp.entities = "{ \"classname\" \"worldspawn\" }";
    files_["maps/room.bsp"] = formats::testing::write_bsp(bsp);
    make_server();
    const Status status = server_->map("room");
    return status.ok() ? said() : "error: " + status.error().message;
  }
};

TEST_F(SurfaceTest, Surfaces) {
  const std::string each = "local float i; for (i = 0; getsurfacenumpoints(self, i) > 0; i++)";
  EXPECT_EQ(says_of_room(each +
                         "{} saysf(i); saysf(getsurfacenumpoints(self, -1)); saysf(getsurfacenumpoints(self, 999));"
                         "saysv(getsurfacepoint(self, 999, 0)); saysv(getsurfacepoint(self, 0, -1));"
                         "saysf(strlen(getsurfacetexture(self, 999))); saysf(strlen(getsurfacetexture(self, 0)) > 0);"),
            "6 0 0 (0 0 0) (0 0 0) 0 1 ");
  // Each face's middle, a little inside the room, is nearest to that face, and the nearest point of it is the middle.
  EXPECT_EQ(
      says_of_room(each + R"({ local vector m, p, n; local float k, c; m = '0 0 0'; c = getsurfacenumpoints(self, i);
      for (k = 0; k < c; k++) m = m + getsurfacepoint(self, i, k) * (1 / c);
      n = getsurfacenormal(self, i); p = m + n * 2;
      saysf(getsurfacenearpoint(self, p) == i); saysf(vlen(getsurfaceclippedpoint(self, i, p) - m) < 0.1);
      p = getsurfaceclippedpoint(self, i, getsurfacepoint(self, i, 0) * 10 - m * 9);
      saysf(vlen(p - getsurfacepoint(self, i, 0)) < 0.1); })"),
      "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 ");
  // A quad is two triangles around its first point; its texture's directions lie in it.
  EXPECT_EQ(
      says_of_room("saysf(getsurfacenumtriangles(self, 0)); saysv(getsurfacetriangle(self, 0, 1));"
                   "saysv(getsurfacetriangle(self, 0, 2));"
                   "saysf(getsurfacepointattribute(self, 0, 1, 0) == getsurfacepoint(self, 0, 1));"
                   "saysf(getsurfacepointattribute(self, 0, 1, 3) == getsurfacenormal(self, 0));"
                   "saysf(rint(vlen(getsurfacepointattribute(self, 0, 1, 1))));"
                   "saysv(getsurfacepointattribute(self, 0, 1, 6)); saysv(getsurfacepointattribute(self, 0, 99, 0));",
                   "float(entity e, float s) getsurfacenumtriangles = #628;"
                   "vector(entity e, float s, float n) getsurfacetriangle = #629;"
                   "vector(entity e, float s, float n, float a) getsurfacepointattribute = #486;"),
      "2 (0 2 3) (0 0 0) 1 1 1 (1 1 1) (0 0 0) ");
  EXPECT_EQ(
      says_of_room(
          "local entity e; e = spawn(); saysf(getsurfacenearpoint(e, '0 0 0')); saysf(getsurfacenumpoints(e, 0));"),
      "-1 0 ");
}

}  // namespace
}  // namespace fb::sv
