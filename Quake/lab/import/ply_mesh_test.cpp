// PLY files: both codings, faces of many corners, what is damaged.
#include "lab/import/ply_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>

#include "base/bytes.h"
#include "base/test_directory.h"
#include "lab/import/test_import.h"

namespace fb::lab {
namespace {

constexpr const char* kSquare = R"(ply
format ascii 1.0
comment a square, and a thing that nobody asks for
element vertex 4
property float x
property float y
property float z
property float nx
property float ny
property float nz
property float u
property float v
element face 1
property uchar quality
property list uchar int vertex_indices
element edge 1
property int vertex1
end_header
0 0 0 0 0 1 0 0
1 0 0 0 0 1 1 0
1 1 0 0 0 1 1 1
0 1 0 0 0 1 0 1
7 4 0 1 2 3
5
)";

Bytes square_in_binary(bool big) {
  std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                     "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\n"
                     "element face 2\nproperty list uint8 uint32 vertex_index\nend_header\n";
  Bytes out(text.begin(), text.end());
  const auto put = [&](std::uint64_t bits, int bytes) {
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(bits >> (8 * (big ? bytes - 1 - i : i))));
  };
  const double x[4] = {0, 1, 1, 0};
  const float y[4] = {0, 0, 1, 1};
  for (int i = 0; i < 4; ++i) {
    put(std::bit_cast<std::uint64_t>(x[i]), 8);
    put(std::bit_cast<std::uint32_t>(y[i]), 4);
    put(static_cast<std::uint16_t>(-3), 2);
  }
  for (const int third : {2, 3}) {
    put(3, 1);
    for (const int corner : {0, third - 1, third}) put(static_cast<std::uint64_t>(corner), 4);
  }
  return out;
}

class PlyMeshTest : public testing::Test {
 protected:
  Result<ImportedMesh> read(const Bytes& bytes) {
    directory_.put("it.ply", bytes);
    return read_ply(directory_.file("it.ply"));
  }
  Result<ImportedMesh> read(const std::string& text) { return read(Bytes(text.begin(), text.end())); }
  const TestDirectory directory_;
};

TEST_F(PlyMeshTest, ReadsTextAndBothOrdersOfBytes) {
  const auto text = read(std::string(kSquare));
  ASSERT_TRUE(text.ok()) << text.error().message;
  EXPECT_EQ(text->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  ASSERT_EQ(text->positions.size(), 4u);
  EXPECT_EQ(text->positions[2], vec3(1, 1, 0));
  EXPECT_EQ(text->normals[3], vec3(0, 0, 1));
  EXPECT_EQ(text->uvs[1], vec2(1, 0));
  for (const bool big : {false, true}) {
    const auto binary = read(square_in_binary(big));
    ASSERT_TRUE(binary.ok()) << binary.error().message;
    EXPECT_EQ(binary->indices, text->indices);
    EXPECT_EQ(binary->positions[2], vec3(1, 1, -3));
    EXPECT_TRUE(binary->normals.empty());
    EXPECT_TRUE(binary->uvs.empty());
  }
}

TEST_F(PlyMeshTest, DamagedFilesAreRefused) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& why) {
    std::string text = kSquare;
    text.replace(text.find(from), from.size(), to);
    const auto mesh = read(text);
    ASSERT_FALSE(mesh.ok()) << why;
    EXPECT_THAT(mesh.error().message, testing::HasSubstr(why));
  };
  refused("ply\n", "plj\n", "no PLY file");
  refused("ascii", "ebcdic", "ebcdic");
  refused("element vertex 4", "element vertex 99999999999999", "ends within its vertices");
  refused("element vertex 4", "element vertex -4", "count");
  refused("property float x", "property quaternion x", "not understood");
  refused("property float x", "property float w", "no positions");
  refused("7 4 0 1 2 3", "7 900 0 1 2 3", "ends within");
  refused("7 4 0 1 2 3", "7 4 0 1 2 -3", "no vertex");
  refused("7 4 0 1 2 3", "7 0", "no faces");
  refused("end_header", "end_of_it", "not understood");
}

TEST_F(PlyMeshTest, AnyBytesAreTakenOrRefused) {
  const Bytes text(kSquare, kSquare + std::string(kSquare).size());
  for (std::uint64_t i = 0; i < 300; ++i) (void)read(damaged(i % 2 == 0 ? text : square_in_binary(i % 4 == 1), i));
}

}  // namespace
}  // namespace fb::lab
