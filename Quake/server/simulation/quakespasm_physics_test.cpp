// What falls, flies, bounces, walks and is pushed, frame by frame to the last bit as in QuakeSpasm: both run the same
// QuakeC on the same map, with frames of a twentieth and of a 72nd of a second, and print every place and speed in
// whole pieces.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "fs/filesystem.h"
#include "server/simulation/test_level.h"
#include "server/test_quakespasm.h"

namespace fb::sv {
namespace {

// Things at places chosen by arithmetic that is exact in floats; nothing asks the clock or for random numbers.
constexpr const char* kScene = R"(
.float number, yaw;
float frames, count;
vector() open_point = {
  local vector v;
  v_x = random_from(-1400); v_y = random_from(-1400); v_z = random_from(-2048);
  while (pointcontents(v) == -2) {
    v_x = random_from(-1400); v_y = random_from(-1400); v_z = random_from(-2048);
  }
  return v;
};
void() say_touch = {
  dprint("P T"); say(self.number); say(other.number); dprint("\n");
};
void() say_blocked = {
  dprint("P B"); say(self.number); say(other.number); dprint("\n");
  self.velocity = self.velocity * -1;
};
entity(vector org, float kind) thing = {
  local entity e;
  e = spawn();
  count = count + 1;
  e.classname = "thing";
  e.number = count;
  e.movetype = kind;
  e.solid = 2;
  setsize(e, '-16 -16 -24', '16 16 32');
  setorigin(e, org);
  e.touch = say_touch;
  return e;
};
void() launch = {
  local entity e;
  local float kind;
  kind = 4;
  while (count < 84) {
    e = thing(open_point(), kind);
    e.velocity_x = random_from(-2048) / 4;
    e.velocity_y = random_from(-2048) / 4;
    e.velocity_z = random_from(-2048) / 4;
    e.avelocity = '10 20 30';
    if (e.number > 28) setsize(e, '0 0 0', '0 0 0');
    if (e.number > 56) setsize(e, '-32 -32 -24', '32 32 64');
    if (e.number > 70) e.solid = 1;
    if (e.number > 77) e.solid = 0;
    setorigin(e, e.origin);
    kind = kind + 1;
    if (kind == 7) kind = 9;
    if (kind == 11) kind = 4;
  }
};
void() walkers = {
  local entity e;
  local float k;
  k = 0;
  while (k < 40) {
    e = thing(open_point(), 4);
    if (k > 20) setsize(e, '-32 -32 -24', '32 32 64');
    e.flags = 32;
    self = e;
    droptofloor();
    e.yaw = k * 17;
    if (k > 36) e.flags = 33;
    k = k + 1;
  }
};
void(string name, vector org, vector speed) pusher = {
  local entity e, rider;
  local vector top;
  e = spawn();
  count = count + 1;
  e.classname = "thing";
  e.number = count;
  e.solid = 4;
  e.movetype = 7;
  setmodel(e, name);
  setorigin(e, org);
  e.velocity = speed;
  e.nextthink = 10000;
  e.blocked = say_blocked;
  top = org + (e.mins + e.maxs) * 0.5;
  top_z = org_z + e.maxs_z + 32;
  rider = thing(top, 4);
  self = rider;
  droptofloor();
  top_x = org_x + e.mins_x - 20;
  top_z = org_z + (e.mins_z + e.maxs_z) * 0.5;
  rider = thing(top, 6);
};
void() begin = {
  seed = 7;
  launch();
  walkers();
  pusher("*1", '0 0 0', '0 0 40');
  pusher("*2", '0 0 0', '60 0 0');
  pusher("*3", '0 0 0', '0 -50 0');
  pusher("*4", '0 0 0', '0 0 -30');
  pusher("*5", '0 0 0', '-40 40 10');
  pusher("*6", '0 0 0', '0 0 90');
  pusher("maps/b_explob.bsp", open_point(), '0 0 40');
  pusher("maps/b_explob.bsp", open_point(), '-50 20 0');
  pusher("maps/b_nail1.bsp", open_point(), '0 30 60');
  pusher("maps/b_bh100.bsp", open_point(), '0 0 -70');
};
void() one_frame = {
  local entity e;
  e = find(world, classname, "thing");
  while (e != world) {
    if (e.yaw) {
      self = e;
      dprint("P W"); say(walkmove(e.yaw, 8)); dprint("\n");
      if (frames - floor(frames / 16) * 16 == 0) e.yaw = e.yaw + 61;
    }
    dprint("P O"); say(e.number); say3(e.origin); say3(e.velocity); say(e.flags); say(e.waterlevel); dprint("\n");
    e = find(e, classname, "thing");
  }
};
void() StartFrame = {
  if (frametime != FRAME) return;
  frames = frames + 1;
  if (frames == 1) begin();
  if (frames <= 120) one_frame();
  else localcmd("quit\n");
};
void() worldspawn = {
  precache_model("progs/player.mdl");
  precache_model("maps/b_explob.bsp");
  precache_model("maps/b_nail1.bsp");
  precache_model("maps/b_bh100.bsp");
  localcmd("host_framerate FRAME\n");
};
)";
constexpr const char* kModelsOfTheirOwn[] = {"maps/b_explob.bsp", "maps/b_nail1.bsp", "maps/b_bh100.bsp"};

std::vector<std::string> lines_of_things(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("P ")) lines.push_back(line);
  return lines;
}

std::string with_frame(std::string source, const std::string& seconds) {
  const std::string name = "FRAME";
  for (auto at = source.find(name); at != source.npos; at = source.find(name)) source.replace(at, name.size(), seconds);
  return source;
}

class QuakeSpasmPhysics : public testing::LevelTest {
 protected:
  void compare(const std::string& frame_seconds);
};

void QuakeSpasmPhysics::compare(const std::string& frame_seconds) {
  if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  const auto files = fs::FileSystem::open(testing::game_data_options());
  ASSERT_TRUE(files.ok());
  const auto bytes = files->load("maps/lq_e1m7.bsp");
  ASSERT_TRUE(bytes.ok());
  auto bsp = formats::parse_bsp(*bytes, "lq_e1m7");
  ASSERT_TRUE(bsp.ok());
  ASSERT_GT(bsp->models.size(), 6u);

  std::string printed;
  services_.print = services_.developer_print = [&printed](std::string_view text) { printed += text; };
  const std::string declarations = "string(string s) precache_model = #20;\n";
  const std::string scene =
      declarations + testing::kIdleMod + testing::kExactNumbers + with_frame(kScene, frame_seconds);
  start_level(scene, std::make_shared<formats::Bsp>(std::move(*bsp)));
  console_.execute("sv_gameplayfix_elevators 0");
  for (const char* name : kModelsOfTheirOwn) {
    level().models.push_back(load_model([&](std::string_view path) { return files->loader()(path); }, name));
    ASSERT_TRUE(level().models.back().brush) << name;
  }
  const std::string source = std::string(progs::testing::kBuiltinSource) + testing::kLevelSource + scene;
  const std::string output = testing::run_quakespasm(progs::testing::compile(source).progs, "lq_e1m7");
  const std::vector<std::string> theirs = lines_of_things(output);
  ASSERT_GT(theirs.size(), 10000u) << output.substr(output.size() - std::min<std::size_t>(output.size(), 2000));
  // A cvar's value is a float, so the frame is not quite that long.
  tick(static_cast<double>(std::stof(frame_seconds)), 121);
  const std::vector<std::string> ours = lines_of_things(printed);
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    ASSERT_EQ(ours[i], theirs[i]) << "line " << i << " of " << theirs.size() << ", after "
                                  << (i > 0 ? ours[i - 1] : "the first");
  }
  EXPECT_EQ(ours.size(), theirs.size());
  for (const char* kind : {"P O", "P W 1", "P W 0", "P T", "P B"}) {
    EXPECT_TRUE(std::ranges::any_of(ours, [&](const std::string& line) { return line.starts_with(kind); })) << kind;
  }
}

TEST_F(QuakeSpasmPhysics, MovesTheSameToTheBit) { compare("0.05"); }
TEST_F(QuakeSpasmPhysics, MovesTheSameToTheBitInShortFrames) { compare("0.0138888889"); }

}  // namespace
}  // namespace fb::sv
