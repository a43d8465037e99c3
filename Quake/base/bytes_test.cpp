#include "base/bytes.h"

#include <gtest/gtest.h>

namespace fb {
namespace {

TEST(ByteReader, ReadsLittleEndian) {
  const Bytes data{0x01, 0x02, 0x03, 0x04, 0xff, 'a', 'b', 0, 'x'};
  ByteReader reader(data, "test");
  EXPECT_EQ(reader.u32(), 0x04030201u);
  EXPECT_EQ(reader.i8(), -1);
  EXPECT_EQ(reader.fixed_string(4), "ab");
  EXPECT_FALSE(reader.failed());
  EXPECT_EQ(reader.remaining(), 0u);
}

TEST(ByteReader, PastTheEndFailsAndStaysFailed) {
  const Bytes data{1, 2, 3};
  ByteReader reader(data, "short.bin");
  EXPECT_EQ(reader.u32(), 0u);
  EXPECT_TRUE(reader.failed());
  EXPECT_EQ(reader.u8(), 0u) << "after a failure nothing more is read";
  EXPECT_EQ(reader.error_at(7, "cut short").message, "short.bin: offset 7: cut short");
}

TEST(ByteReader, HugeCountsDoNotWrapAround) {
  const Bytes data(16);
  ByteReader reader(data, "test");
  reader.skip(8);
  EXPECT_TRUE(reader.bytes(static_cast<std::size_t>(-4)).empty());
  EXPECT_TRUE(reader.failed());
}

}  // namespace
}  // namespace fb
