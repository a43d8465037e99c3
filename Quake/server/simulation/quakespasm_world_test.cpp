// Traces, contents, falls to the floor and the order of touches, to the last bit those of QuakeSpasm: it runs QuakeC
// that asks at places chosen by arithmetic which is exact in floats, and prints every number in whole pieces; the same
// is asked here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "fs/filesystem.h"
#include "progs/test_qc.h"
#include "server/test_quakespasm.h"
#include "world/area_nodes.h"
#include "world/trace.h"

namespace fb::sv {
namespace {

constexpr const char* kDeclarations = R"(
void(entity e, vector o) setorigin = #2;
void(entity e, vector min, vector max) setsize = #4;
entity() spawn = #14;
void(entity e) remove = #15;
void(vector v1, vector v2, float nomonsters, entity forent) traceline = #16;
string(string s) precache_model = #20;
void(string s) dprint = #25;
string(float f) ftos = #26;
float() droptofloor = #34;
float(float v) floor = #37;
float(vector v) pointcontents = #41;
void(string s) localcmd = #46;
)";

constexpr const char* kSource = R"(
void() worldspawn = { precache_model("progs/player.mdl"); };
float frames, stage, at;
entity mover;
vector() random_point = {
  local vector v;
  v_x = random_from(LOW_X);
  v_y = random_from(LOW_Y);
  v_z = random_from(LOW_Z);
  return v;
};

void() lines = {
  local vector a, b;
  local float k;
  if (at == 0) seed = 7;
  k = 0;
  while (k < 100) {
    a = random_point();
    b = random_point();
    if (at >= 500) b = a + (b - a) * 0.0625;
    traceline(a, b, 1, world);
    dprint("L");
    say(trace_fraction); say3(trace_endpos); say3(trace_plane_normal); say(trace_plane_dist);
    say(trace_allsolid); say(trace_startsolid); say(trace_inopen); say(trace_inwater); say(pointcontents(a));
    dprint("\n");
    at = at + 1;
    k = k + 1;
  }
};
void(vector mins, vector maxs) falls = {
  local float k, landed;
  local entity e, was;
  if (at == 0) seed = 99;
  was = self;
  self = e = spawn();
  e.solid = 3;
  setsize(e, mins, maxs);
  k = 0;
  while (k < 100) {
    setorigin(e, random_point());
    landed = droptofloor();
    dprint("D");
    say(landed); say3(e.origin); say3(e.absmin);
    dprint("\n");
    at = at + 1;
    k = k + 1;
  }
  self = was;
  remove(e);
};
void() touched = { dprint("T "); dprint(ftos(self.frags)); dprint("\n"); };
void() triggers = {
  local float i;
  local entity e;
  local vector s;
  i = 0;
  seed = 1234;
  while (i < 120) {
    e = spawn();
    e.solid = 1;
    e.touch = touched;
    e.frags = i;
    s_x = random_from(0) / 8;
    s_y = random_from(0) / 8;
    s_z = random_from(0) / 4;
    setsize(e, s * -1, s);
    setorigin(e, random_point());
    i = i + 1;
  }
};
void() StartFrame = {
  frames = frames + 1;
  if (frames < 3) return;
  if (stage == 0) lines();
  else if (stage == 1) falls('-16 -16 -24', '16 16 32');
  else if (stage == 2) falls('-32 -32 -24', '32 32 64');
  else if (stage == 3) falls('-8 -8 0', '8 8 30');
  else if (stage == 4) falls('-0.5 -0.5 -0.5', '0.5 0.5 0.5');
  else if (stage == 5) {
    mover = spawn();
    mover.movetype = 5;
    setsize(mover, '-100 -100 -100', '100 100 100');
    triggers();
    seed = 4321;
    stage = 6;
    return;
  } else {
    dprint("M"); say3(mover.absmin); say3(mover.absmax); dprint("\n");
    setorigin(mover, random_point());
    mover.velocity = '8 8 0';
    mover.solid = 2;
    mover.health = mover.health + 1;
    if (mover.health > 150) localcmd("quit\n");
    return;
  }
  if (at == 1000) {
    at = 0;
    stage = stage + 1;
  }
};
)";

constexpr int kEach = 1000;

// The same arithmetic as in QuakeC above.
class Mirror {
 public:
  explicit Mirror(const vec3& low) : low_(low) {}
  float seed = 0.0f;
  std::string line;

  float random_from(float low) {
    seed = seed * 109.0f + 1021.0f;
    seed = seed - std::floor(seed / 65536.0f) * 65536.0f;
    return low + seed / 16.0f;
  }
  vec3 random_point() {
    const float x = random_from(low_.x), y = random_from(low_.y);
    return {x, y, random_from(low_.z)};
  }
  void put(float f) {
    const float whole = std::floor(f), rest = (f - whole) * 4096.0f, part = std::floor(rest);
    line += fmt::format(" {} {} {}", static_cast<int>(whole), static_cast<int>(part),
                        static_cast<int>(std::floor((rest - part) * 65536.0f)));
  }
  void put(const vec3& v) {
    for (int axis = 0; axis < 3; ++axis) put(v[axis]);
  }

 private:
  vec3 low_;
};

struct MapCase {
  const char* name;
  vec3 low;  // of the box of 4096 units to a side that is looked at
  friend std::ostream& operator<<(std::ostream& out, const MapCase& map) { return out << map.name; }
};
class QuakeSpasmWorld : public ::testing::TestWithParam<MapCase> {
 protected:
  void SetUp() override {
    if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    std::string source = std::string(kDeclarations) + testing::kIdleMod + testing::kExactNumbers + kSource;
    const vec3 low = GetParam().low;
    for (const auto& [name, value] : {std::pair("LOW_X", low.x), {"LOW_Y", low.y}, {"LOW_Z", low.z}})
      source.replace(source.find(name), 5, fmt::format("{}", value));
    const progs::testing::Compiled compiled = progs::testing::compile(source);
    if (!compiled.has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    static std::map<std::string, std::string> outputs;  // both tests look at the same run
    std::string& output = outputs[GetParam().name];
    if (output.empty()) output = testing::run_quakespasm(compiled.progs, GetParam().name);
    std::stringstream out(output);
    SCOPED_TRACE(output.substr(output.size() - std::min<std::size_t>(output.size(), 1000)));
    for (std::string line; std::getline(out, line);)
      if (line.size() > 2 && line[1] == ' ' && std::string_view("LDTM").find(line[0]) != std::string_view::npos)
        said_.push_back(line);
    ASSERT_GE(said_.size(), static_cast<std::size_t>(5 * kEach)) << "QuakeSpasm said too little";

    const auto files = fs::FileSystem::open(testing::game_data_options());
    ASSERT_TRUE(files.ok());
    const auto bytes = files->load(fmt::format("maps/{}.bsp", GetParam().name));
    ASSERT_TRUE(bytes.ok());
    auto bsp = formats::parse_bsp(*bytes, GetParam().name);
    ASSERT_TRUE(bsp.ok());
    bsp_ = std::move(*bsp);
  }
  std::vector<std::string> said_;
  formats::Bsp bsp_;
};

TEST_P(QuakeSpasmWorld, IsTheSameToTheBit) {
  const world::MapHulls map(bsp_);
  Mirror mirror(GetParam().low);
  std::size_t at = 0;
  int hits = 0, landings = 0;
  const auto compare = [&] {
    EXPECT_EQ(mirror.line, said_[at]) << "line " << at;
    mirror.line.clear();
    ++at;
  };

  mirror.seed = 7.0f;
  for (int i = 0; i < kEach && !HasFailure(); ++i) {
    const vec3 a = mirror.random_point();
    vec3 b = mirror.random_point();
    if (i >= 500) b = a + (b - a) * 0.0625f;
    const world::Trace trace = clip_move_to_model(map, 0, vec3(0.0f), {a, vec3(0.0f), vec3(0.0f), b});
    if (trace.fraction < 1.0f) ++hits;
    mirror.line = "L";
    mirror.put(trace.fraction);
    mirror.put(trace.end_pos);
    mirror.put(trace.plane.normal);
    mirror.put(trace.plane.distance);
    for (const bool flag : {trace.all_solid, trace.start_solid, trace.in_open, trace.in_water})
      mirror.put(flag ? 1.0f : 0.0f);
    mirror.put(static_cast<float>(sv_point_contents(map, a)));
    compare();
  }

  const std::pair<vec3, vec3> boxes[] = {{vec3(-16, -16, -24), vec3(16, 16, 32)},
                                         {vec3(-32, -32, -24), vec3(32, 32, 64)},
                                         {vec3(-8, -8, 0), vec3(8, 8, 30)},
                                         {vec3(-0.5f), vec3(0.5f)}};
  for (const auto& [mins, maxs] : boxes) {
    mirror.seed = 99.0f;
    for (int i = 0; i < kEach && !HasFailure(); ++i) {
      vec3 p = mirror.random_point();
      const world::Trace trace = clip_move_to_model(map, 0, vec3(0.0f), {p, mins, maxs, p - vec3(0, 0, 256)});
      const bool landed = trace.fraction != 1.0f && !trace.all_solid;
      if (landed) p = trace.end_pos;
      landings += landed ? 1 : 0;
      mirror.line = "D";
      mirror.put(landed ? 1.0f : 0.0f);
      mirror.put(p);
      mirror.put((p + mins) - vec3(1.0f));
      compare();
    }
  }
  EXPECT_GT(hits, 15);
  EXPECT_GT(landings, 50);
}

TEST_P(QuakeSpasmWorld, TouchesInTheSameOrder) {
  // A model's box is a unit wider on each side in QuakeSpasm.
  const formats::BspModel& world_model = bsp_.models[0];
  world::AreaNodes areas(world_model.mins - vec3(1.0f), world_model.maxs + vec3(1.0f));
  Mirror mirror(GetParam().low);
  mirror.seed = 1234.0f;
  std::vector<Bounds> boxes;
  for (int id = 0; id < 120; ++id) {
    const float x = mirror.random_from(0.0f) / 8.0f, y = mirror.random_from(0.0f) / 8.0f;
    const vec3 half(x, y, mirror.random_from(0.0f) / 4.0f);
    const vec3 origin = mirror.random_point();
    boxes.push_back({(origin - half) - vec3(1.0f), (origin + half) + vec3(1.0f)});
    areas.link(id, world::AreaList::kTrigger, boxes.back());
  }
  std::vector<int> touched;
  int moves = 0, touches = 0, not_by_number = 0;
  for (const std::string& line : said_) {
    if (line[0] == 'T') touched.push_back(std::atoi(line.c_str() + 2));
    if (line[0] != 'M') continue;
    std::stringstream numbers(line.substr(1));
    float box[6];
    for (float& value : box) {
      float whole = 0.0f, part = 0.0f, rest = 0.0f;
      numbers >> whole >> part >> rest;
      value = whole + (part + rest / 65536.0f) / 4096.0f;
    }
    const Bounds swept{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
    std::vector<int> ids;
    areas.collect(world::AreaList::kTrigger, swept, ids);
    std::erase_if(ids, [&](int id) { return !world::boxes_meet(swept, boxes[static_cast<std::size_t>(id)]); });
    if (moves++ > 0) {  // before the first it was nowhere
      EXPECT_EQ(ids, touched) << "move " << moves;
      touches += static_cast<int>(ids.size());
      if (!std::ranges::is_sorted(ids)) ++not_by_number;
    }
    touched.clear();
  }
  EXPECT_GT(moves, 100);
  EXPECT_GT(touches, 50);
  EXPECT_GT(not_by_number, 2) << "else this could not tell";
}

INSTANTIATE_TEST_SUITE_P(Maps, QuakeSpasmWorld,
                         ::testing::Values(MapCase{"lq_e1m7", vec3(-1400, -1400, -2048)},
                                           MapCase{"lqdm3", vec3(-3000, -639, -2000)}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace fb::sv
