// What the virtual machine and the builtins that need no server compute and print, to the last bit that of QuakeSpasm:
// the same progs runs in both, and every line is compared. Floats are printed whole, as an integer times a power of
// two.
#include <gtest/gtest.h>

#include <algorithm>

#include "progs/builtins/test_builtins.h"
#include "progs/test_qc.h"
#include "server/test_quakespasm.h"

namespace fb::sv {
namespace {

constexpr const char* kSource = R"(
string(string s) precache_model = #20;

void(float x) say = {
  local float power, sign;
  if (x == 0) { dprint(" 0"); return; }
  sign = 1;
  if (x < 0) { sign = -1; x = 0 - x; }
  power = 0;
  while (x < 8388608) {
    x = x * 2;
    power = power - 1;
    if (power < -150) { dprint(" none"); return; }
  }
  while (x >= 16777216) {
    x = x / 2;
    power = power + 1;
    if (power > 150) { dprint(" none"); return; }
  }
  dprint(" "); dprint(ftos(sign * x)); dprint("p"); dprint(ftos(power));
};
void(string name, vector v) say3 = { dprint(name); say(v_x); say(v_y); say(v_z); dprint("\n"); };

void(vector v) vectors = {
  dprint("vtos "); dprint(vtos(v)); dprint("\n");
  say3("normalize", normalize(v));
  dprint("vlen"); say(vlen(v)); dprint(" yaw"); say(vectoyaw(v)); dprint("\n");
  say3("angles", vectoangles(v));
  makevectors(v);
  say3("forward", v_forward);
  say3("right", v_right);
  say3("up", v_up);
  say3("sum", v * 0.3 + v_forward - v_up * 7);
  dprint("dot"); say(v * v_right); say(v_x / v_y); say(v_x & 255); say(v_y | 5); dprint("\n");
};
void(float x) numbers = {
  dprint("ftos "); dprint(ftos(x)); dprint(" "); dprint(ftos(rint(x))); dprint(" "); dprint(ftos(floor(x)));
  dprint(" "); dprint(ftos(ceil(x))); dprint(" "); dprint(ftos(fabs(x)));
  say(x & 65535); say(x | 0); say(!x);
  if (x) dprint(" true");
  if (!x) dprint(" not");
  dprint("\n");
};
void(float from, float to, float speed) turns = {
  self.angles_y = from;
  self.ideal_yaw = to;
  self.yaw_speed = speed;
  changeyaw();
  dprint("turn"); say(self.angles_y); dprint("\n");
};

void() hard_vectors = {
  vectors('1 2 3'); vectors('-100.5 33.25 0.1'); vectors('0 0 1'); vectors('0 0 -1'); vectors('0 0 0');
  vectors('0.00000001 1 0'); vectors('3000.7 -4000.3 77.7'); vectors('-1 -1 -1'); vectors('0.1 0.1 0.1');
  vectors('12 -0.001 5'); vectors('45 90 10'); vectors('359 -720.5 33');
};
void() hard_numbers = {
  numbers(16777216); numbers(100000 * 100000); numbers(-100000 * 30000); numbers(0.05); numbers(0.15);
  numbers(-0.04); numbers(0.5); numbers(2.5); numbers(1 / 3); numbers(0 * -1); numbers(-0.5); numbers(-1.5);
};
void() entities = {
  local entity a, b, c;
  self = spawn();
  turns(0, 90, 20); turns(10, 350, 30); turns(350, 10, 5); turns(90.3, 90.2, 10); turns(180, 0, 10);
  turns(0, 180, 10); turns(-45, 200, 33); turns(721, 5, 400); turns(0, 270, -20); turns(12.34567, 300.123, 7.77);
  a = spawn(); b = spawn(); c = spawn();
  a.classname = "test_x"; b.classname = "test_y"; c.classname = "test_x";
  a.origin = '1 2.25 -3'; a.enemy = b; a.think = entities; a.health = -0.5; a.netname = "some\nlines"; a.flags = 0 * -1;
  eprint(a);
  remove(b);
  eprint(b);
  eprint(find(world, classname, "test_x"));
  eprint(find(a, classname, "test_x"));
  if (find(world, classname, "test_y") == world) dprint("gone\n");
  eprint(spawn());
  remove(a);
  remove(c);
};
float frames, steps;
void() step = {
  numbers(steps * 0.37);
  vectors(steps * '1.1 -3.7 0.7' + '5 5 5');
  vectors(steps * steps * '17.1 -3.77 0.27' + '5 5 5');
  steps = steps + 1;
};
void() one_frame = {
  frames = frames + 1;
  if (frames == 1) hard_vectors();
  else if (frames == 2) hard_numbers();
  else if (frames == 3) entities();
  else step();
};

void() worldspawn = { precache_model("progs/player.mdl"); };
void() StartFrame = {
  if (frames < 60) { dprint("BEGIN\n"); one_frame(); dprint("END\n"); }
  else localcmd("quit\n");
};
)";

// What stands between lines of BEGIN and END.
std::vector<std::string> marked_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line == "BEGIN" || line == "END") {
      inside = line == "BEGIN";
    } else if (inside) {
      lines.push_back(line);
    }
  }
  return lines;
}

class QuakeSpasmBuiltins : public progs::testing::QcTest {
 protected:
  std::string printed_;
};

TEST_F(QuakeSpasmBuiltins, ComputeAndPrintTheSame) {
  if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  const std::string source = std::string(progs::testing::kBuiltinSource) + testing::kIdleMod + kSource;
  services_.print = services_.developer_print = [this](std::string_view text) { printed_ += text; };
  ASSERT_TRUE(start(source));
  vm_->edicts().start_level(4);
  const std::string output = testing::run_quakespasm(progs::testing::compile(source).progs, "lq_e1m7");
  const std::vector<std::string> theirs = marked_lines(output);
  ASSERT_GT(theirs.size(), 1000u) << output;
  for (int frame = 0; frame < 60; ++frame) {
    printed_ += "BEGIN\n";
    ASSERT_EQ(error_of("one_frame"), "");
    printed_ += "END\n";
  }
  const std::vector<std::string> ours = marked_lines(printed_);
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    ASSERT_EQ(ours[i], theirs[i]) << "line " << i << ", after " << (i > 0 ? ours[i - 1] : "the first");
  }
  EXPECT_EQ(ours.size(), theirs.size());
}

}  // namespace
}  // namespace fb::sv
