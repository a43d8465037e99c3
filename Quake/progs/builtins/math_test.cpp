#include <gmock/gmock.h>

#include <cmath>

#include "progs/angles.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

class MathBuiltinsTest : public testing::QcTest {};

TEST_F(MathBuiltinsTest, Rounding) {
  EXPECT_EQ(says("put(rint(1.5)); put(rint(-1.5)); put(rint(1.4)); put(rint(0));"), "2 -2 1 0");
  EXPECT_EQ(says("put(floor(1.5)); put(floor(-1.5)); put(ceil(1.2)); put(ceil(-1.5)); put(fabs(-2.5));"),
            "1 -2 2 -1 2.5");
}

TEST_F(MathBuiltinsTest, Vectors) {
  EXPECT_EQ(says("put(vlen('3 4 0')); putv(normalize('0 0 5')); putv(normalize('0 0 0'));"), "5 (0 0 1) (0 0 0)");
  EXPECT_EQ(says("makevectors('0 90 0'); if (v_forward_y > 0.99 && v_right_x > 0.99 && v_up_z > 0.99) puts(\"ok\");"),
            "[ok]");
  EXPECT_EQ(says("vectorvectors('0 2 0'); put(v_forward_y); put(v_right_x); put(v_up_z);"), "1 1 1");
}

TEST_F(MathBuiltinsTest, AnglesAreWholeDegrees) {
  EXPECT_EQ(says("put(vectoyaw('1 1 0')); put(vectoyaw('0 -1 5')); put(vectoyaw('0 0 1')); put(vectoyaw('-1 0 0'));"),
            "45 270 0 180");
  EXPECT_EQ(says("put(vectoyaw('1 0.3 0')); put(vectoyaw('1 -0.3 0'));"), "16 344");  // 16.7, and -16.7 to -16
  EXPECT_EQ(says("putv(vectoangles('1 0 1')); putv(vectoangles('0 0 -1')); putv(vectoangles('0 0 1'));"
                 "putv(vectoangles('1 1 -0.5'));"),
            "(45 0 0) (270 0 0) (90 0 0) (341 45 0)");
}

TEST_F(MathBuiltinsTest, CsFunctions) {
  EXPECT_EQ(says("put(sin(0)); put(cos(0)); put(sqrt(2.25)); put(pow(2, 10));"), "0 1 1.5 1024");
}

TEST_F(MathBuiltinsTest, Remainders) {
  const std::string before = "float(float a, float n) mod = #245; float(float a) anglemod = #102;";
  EXPECT_EQ(says("put(mod(7, 3)); put(mod(-7, 3)); put(mod(7, -3)); put(mod(5.5, 2)); put(mod(5, 0));", before),
            "1 -1 1 1.5 0");
  EXPECT_EQ(says("put(anglemod(370)); put(anglemod(-90.5)); put(anglemod(720)); put(anglemod(12.25));", before),
            "10 269.5 0 12.25");
}

TEST_F(MathBuiltinsTest, LogarithmsOfABaseAndCrossProducts) {
  const std::string before = "float(float v, ...) log = #532; vector(vector a, vector b) crossproduct = #0;";
  EXPECT_EQ(says("put(log(1)); put(rint(log(1024, 2))); put(rint(1000 * log(2.718281828)));"
                 "putv(crossproduct('1 0 0', '0 1 0'));",
                 before),
            "0 10 1000 (0 0 1)");
}

// With an up direction vectoangles is the way back from makevectors, whose pitch is the other way round.
TEST_F(MathBuiltinsTest, VectoanglesKnowsRollByTheUpDirection) {
  const std::string before = "vector(vector v, ...) angles_of = #51;";
  for (const std::string angles : {"'10 20 30'", "'-35 200 -120'", "'0 90 0'", "'60 359 179'"})
    EXPECT_EQ(says("local vector a, f; a = " + angles +
                       "; makevectors(a); f = angles_of(v_forward, v_up); local vector u; u = v_up; local vector w;"
                       "w = v_forward; f_x = 0 - f_x; makevectors(f); put(rint(1000 * (v_up * u)));"
                       "put(rint(1000 * (v_forward * w)));",
                   before),
              "1000 1000")
        << angles;
}

TEST_F(MathBuiltinsTest, MinMaxBound) {
  EXPECT_EQ(says("put(min(3, 2)); put(min(5, 4, 3, 9)); put(max(3, 2)); put(max(1, 2, 3, -4));"), "2 3 3 3");
  EXPECT_EQ(says("put(bound(0, 5, 3)); put(bound(0, -5, 3)); put(bound(0, 2, 3));"), "3 0 2");
}

TEST_F(MathBuiltinsTest, Bitshift) {
  EXPECT_EQ(says("put(bitshift(1, 4)); put(bitshift(256, -4)); put(bitshift(-16, -2)); put(bitshift(1, 99));"
                 "put(bitshift(5, -99)); put(bitshift(-5, -99));"),
            "16 16 -4 0 0 -1");
}

TEST_F(MathBuiltinsTest, ChangeyawTurnsTheShortWayBySoMuch) {
  const auto turned = [&](const std::string& from, const std::string& ideal) {
    return says("self = spawn(); self.yaw_speed = 20; self.angles = '0 " + from + " 0'; self.ideal_yaw = " + ideal +
                "; changeyaw(); put(rint(self.angles_y));");
  };
  EXPECT_EQ(turned("0", "90"), "20");
  EXPECT_EQ(turned("10", "350"), "350");
  EXPECT_EQ(turned("350", "30"), "10");
  EXPECT_EQ(turned("90", "100"), "100");
  EXPECT_EQ(turned("0", "270"), "340");
  EXPECT_EQ(says("self = spawn(); self.yaw_speed = -20; self.ideal_yaw = 270; changeyaw(); put(rint(self.angles_y));"),
            "20");
}

TEST_F(MathBuiltinsTest, ChangepitchUsesItsOwnFields) {
  EXPECT_EQ(says("self = spawn(); self.pitch_speed = 5; self.idealpitch = 30; changepitch(self);"
                 "put(rint(self.angles_x));",
                 ".float pitch_speed;"),
            "5");
}

class RandomTest : public testing::QcTest {
 protected:
  void SetUp() override {
    QcTest::SetUp();
    services_.rng = &rng_;
  }
  Rng rng_{7};
};

TEST_F(RandomTest, IsTheEnginesAndRepeatsWithItsSeed) {
  const std::string first = says("put(random()); put(random());");
  EXPECT_NE(says("put(random()); put(random());"), first);  // the engine's went on
  rng_ = Rng(7);
  EXPECT_EQ(says("put(random()); put(random());"), first);
}

TEST_F(RandomTest, HasItsRangeAndMean) {
  // The mean of 10000 uniform numbers strays by 0.0029; five times that is a false alarm in two million.
  EXPECT_EQ(says(R"(
    local float i, sum, out; local vector v;
    for (i = 0; i < 10000; i++) { local float r; r = random(); if (r < 0 || r > 1) out = out + 1; sum = sum + r;
      if (r * 32767 != floor(r * 32767)) { if (fabs(r * 32767 - rint(r * 32767)) > 0.01) out = out + 1; } }
    put(out); put(fabs(sum / 10000 - 0.5) < 0.0145);
    out = 0; for (i = 0; i < 1000; i++) { v = randomvec(); if (v * v > 1) out = out + 1; } put(out);
  )"),
            "0 1 0");
}

TEST(Angles, ModIsIn65536thsOfATurn) {
  EXPECT_EQ(angle_mod(0.0f), 0.0f);
  EXPECT_EQ(angle_mod(-90.0f), 270.0f);
  EXPECT_EQ(angle_mod(450.0f), 90.0f);
  EXPECT_EQ(angle_mod(0.004f), 0.0f);
  EXPECT_EQ(angle_mod(359.999f), 359.99450683593750f);
}

}  // namespace
}  // namespace fb::progs
