#include "net/message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "net/client_messages.h"

namespace fb::net {
namespace {

struct CoordCase {
  const char* name;
  Protocol protocol;
  float step;   // distance between neighbouring values
  float range;  // largest value that must survive
};
const CoordCase kCoordCases[] = {
    {"netquake", {15, 0}, 1.0f / 8, 4095.0f},
    {"fitzquake", {666, 0}, 1.0f / 8, 4095.0f},
    {"rmq 24 bit", {999, kCoord24}, 1.0f / 255, 32767.0f},
    {"rmq int32", {999, kInt32Coord}, 1.0f / 16, 1000000.0f},
    {"rmq float", {999, kFloatCoord}, 0.0f, 1000000.0f},
    {"float wins over int32", {999, kFloatCoord | kInt32Coord | kCoord24}, 0.0f, 1000000.0f},
};

TEST(Message, CoordinatesSurviveWithinHalfAStep) {
  for (const CoordCase& c : kCoordCases) {
    for (float v : {0.0f, 1.0f, -1.0f, 0.3f, -0.3f, -1.5f, 127.8749f, -2047.99f, c.range, -c.range}) {
      MessageWriter w(c.protocol);
      w.coord(v);
      MessageReader r(w.bytes(), "test", c.protocol);
      // 24 bits: (v - whole) * 255 rounds, and so does the float sum.
      EXPECT_NEAR(r.coord(), v, c.step * 0.5001f + std::abs(v) * 1e-6f) << c.name << " " << v;
      EXPECT_TRUE(r.at_end()) << c.name;
      EXPECT_FALSE(r.failed()) << c.name;
    }
  }
}

TEST(Message, CoordinatesOutOfRangeStopAtItsEnd) {
  for (const Protocol& p : {Protocol{15, 0}, Protocol{999, kCoord24}, Protocol{999, kInt32Coord}}) {
    MessageWriter w(p);
    w.coord(1e12f);
    w.coord(-1e12f);
    MessageReader r(w.bytes(), "test", p);
    EXPECT_GT(r.coord(), 4095.0f);
    EXPECT_LT(r.coord(), -4095.0f);
  }
}

TEST(Message, KnownCoordinateBytes) {
  MessageWriter w;
  w.coord(-1.25f);
  EXPECT_EQ(w.bytes(), (Bytes{0xf6, 0xff}));  // -10 eighths
  MessageWriter wide({999, kCoord24});
  wide.coord(-1.5f);  // -2 + 0.5
  ASSERT_EQ(wide.bytes().size(), 3u);
  EXPECT_EQ(wide.bytes()[0], 0xfe);
  EXPECT_EQ(wide.bytes()[1], 0xff);
  EXPECT_EQ(wide.bytes()[2], 128);
}

TEST(Message, AnglesSurvive) {
  struct Case {
    Protocol protocol;
    float step;
  };
  for (const Case& c :
       {Case{{15, 0}, 360.0f / 256}, Case{{666, 0}, 360.0f / 256}, Case{{999, kShortAngle}, 360.0f / 65536},
        Case{{999, kFloatAngle}, 0.0f}, Case{{999, kFloatAngle | kShortAngle}, 0.0f}}) {
    for (float v : {0.0f, 1.0f, -45.0f, 89.9f, -179.0f, 170.0f, 300.0f, 720.5f}) {
      MessageWriter w(c.protocol);
      w.angle(v);
      MessageReader r(w.bytes(), "test", c.protocol);
      const float difference = std::remainder(r.angle() - v, 360.0f);
      EXPECT_LE(std::abs(difference), c.step * 0.5f + 1e-4f) << v << " " << c.protocol.flags;
      EXPECT_TRUE(r.at_end());
    }
  }
}

TEST(Message, StringsEndAtTheirZero) {
  MessageWriter w;
  w.string("hello");
  w.string("");
  MessageReader r(w.bytes(), "test");
  EXPECT_EQ(r.string(), "hello");
  EXPECT_EQ(r.string(), "");
  EXPECT_FALSE(r.failed());
  EXPECT_EQ(r.string(), "");
  EXPECT_TRUE(r.failed());
}

TEST(Message, ReadingPastTheEndFailsAndReadsNothing) {
  const Bytes bytes{1, 2, 3};
  MessageReader r(bytes, "test");
  EXPECT_EQ(r.i32(), 0);
  EXPECT_TRUE(r.failed());
  EXPECT_EQ(r.u8(), 0);
  EXPECT_EQ(r.coords(), vec3(0.0f));
}

TEST(Message, FloatsThatAreNotFiniteFail) {
  for (float v : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    MessageWriter w;
    w.f32(v);
    MessageReader r(w.bytes(), "test");
    EXPECT_EQ(r.f32(), 0.0f);
    EXPECT_TRUE(r.failed());
    EXPECT_TRUE(r.not_finite());
  }
}

TEST(Message, FloatsStayInARangeThatAddsUp) {
  const Protocol p{999, kFloatCoord | kFloatAngle};
  MessageWriter w(p);
  w.coord(3e38f);
  w.coord(-3e38f);
  w.angle(3e38f);
  MessageReader r(w.bytes(), "test", p);
  EXPECT_EQ(r.coord(), 134217728.0f);
  EXPECT_EQ(r.coord(), -134217728.0f);
  EXPECT_EQ(r.angle(), 134217728.0f);
  EXPECT_FALSE(r.failed());
}

TEST(Message, AlphaBytes) {
  EXPECT_EQ(decode_alpha(kAlphaDefault), 1.0f);
  EXPECT_EQ(decode_alpha(kAlphaZero), 0.0f);
  EXPECT_EQ(decode_alpha(kAlphaOne), 1.0f);
  EXPECT_EQ(encode_alpha(0.0f), kAlphaDefault);
  EXPECT_EQ(encode_alpha(-1.0f), kAlphaZero);
  EXPECT_EQ(encode_alpha(1.0f), kAlphaOne);
  EXPECT_NEAR(decode_alpha(encode_alpha(0.4f)), 0.4f, 0.5f / 254);
}

TEST(ClientMessages, RoundTrip) {
  for (const Protocol& p :
       {Protocol{15, 0}, Protocol{666, 0}, Protocol{999, kShortAngle}, Protocol{999, kFloatAngle}}) {
    clc::Move move;
    move.time = 12.5f;
    move.view_angles = {45.0f, -90.0f, 0.0f};  // exact in every protocol
    move.forward = 400;
    move.side = -350;
    move.up = 20;
    move.buttons = 3;
    move.impulse = 7;
    const ClientMessage messages[] = {clc::Nop{}, move, clc::StringCommand{"prespawn"}, clc::Disconnect{}};
    MessageWriter w(p);
    for (const auto& m : messages) write_client_message(w, m);
    MessageReader r(w.bytes(), "test", p);
    for (const auto& m : messages) {
      auto read = read_client_message(r);
      ASSERT_TRUE(read.ok()) << read.error().message;
      EXPECT_EQ(*read, m);
    }
    EXPECT_TRUE(r.at_end());
  }
}

TEST(ClientMessages, TheirBytesAreTheProtocols) {
  const clc::Move move{1.0f, {90, -90, 45}, 258, -1, 3, 1, 7};
  MessageWriter w;
  for (const ClientMessage& m : {ClientMessage(clc::Nop{}), ClientMessage(clc::Disconnect{}), ClientMessage(move),
                                 ClientMessage(clc::StringCommand{"a"})})
    write_client_message(w, m);
  EXPECT_EQ(w.bytes(), (Bytes{1, 2, 3, 0, 0, 128, 63, 64, 192, 32, 2, 1, 255, 255, 3, 0, 1, 7, 4, 'a', 0}));
}

TEST(ClientMessages, BadOnesAreErrors) {
  for (const Bytes& bytes : {Bytes{0}, Bytes{9}, Bytes{3, 0, 0}, Bytes{4, 'a'}}) {
    MessageReader r(bytes, "from a client");
    auto read = read_client_message(r);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().message.find("from a client: offset 0"), std::string::npos);
  }
}

}  // namespace
}  // namespace fb::net
