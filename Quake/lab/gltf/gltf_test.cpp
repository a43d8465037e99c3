// Exported scenes: what is said of the Cornell box, of textures, poses and lamps, and how it is laid out in files.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "base/test_directory.h"
#include "formats/image.h"
#include "lab/gltf/gltf_document.h"
#include "lab/gltf/gltf_export.h"
#include "lab/json_reader.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::lab {
namespace {

class GltfTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  static std::string bytes(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Json exported(const scene::FrameSnapshot& snapshot, const std::string& name = "scene.gltf") {
    const auto summary = export_gltf(snapshot, settings_, {96, 54}, path(name), "a test");
    EXPECT_TRUE(summary.ok());
    if (summary) summary_ = *summary;
    return Json::parse(bytes(path(name)));
  }
  // A primitive's vectors of three.
  std::vector<vec3> vectors(const Json& gltf, const Json& accessor) const {
    const Json& a = gltf["accessors"][accessor.get<std::size_t>()];
    const Json& view = gltf["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::string data = bytes(path(gltf["buffers"][0]["uri"]));
    std::vector<vec3> out(a["count"].get<std::size_t>());
    EXPECT_EQ(view["byteLength"].get<std::size_t>(), out.size() * sizeof(vec3));
    std::memcpy(out.data(), data.data() + view["byteOffset"].get<std::size_t>(), out.size() * sizeof(vec3));
    return out;
  }
  static const Json& named(const Json& list, const std::string& name) {
    const auto found = std::ranges::find_if(list, [&](const Json& item) { return item["name"] == name; });
    EXPECT_NE(found, list.end()) << name;
    return *found;
  }
  const TestDirectory directory_;
  render::RenderSettings settings_;
  GltfSummary summary_;
};

// What ends between its two files leaves the former two as they were.
TEST_F(GltfTest, TheFormerFileKeepsItsBytes) {
  const auto write = [&](std::size_t count) {
    GltfDocument document("a test");
    const std::vector<vec3> values(count);
    document.add_vec3(values);
    return document.write(path("pair.gltf"));
  };
  const auto bytes_referred_to = [&] {
    const Json buffer = Json::parse(bytes(path("pair.gltf")))["buffers"][0];
    const std::size_t size = bytes(path(buffer["uri"])).size();
    EXPECT_EQ(size, buffer["byteLength"].get<std::size_t>());
    return size;
  };
  for (const std::size_t count : {1u, 2u, 3u}) {
    ASSERT_TRUE(write(count));
    EXPECT_EQ(bytes_referred_to(), 12u * count);
    EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(path(""))), 2) << "nothing is left";
    rlimit former{};
    ::getrlimit(RLIMIT_FSIZE, &former);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{128, former.rlim_max};  // more than the vectors have, less than the text
    ::setrlimit(RLIMIT_FSIZE, &small);
    const Status failed = write(count + 4);
    ::setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, handler);
    EXPECT_FALSE(failed);
    EXPECT_EQ(bytes_referred_to(), 12u * count);
  }
}

// References are of ASCII letters (RFC 3986), and the text is UTF-8 whatever the names of files and materials are.
TEST_F(GltfTest, NamesInOtherEncodingsGiveValidText) {
  const std::string file = path("caf\xe9 1.gltf");
  for (int times = 0; times < 2; ++times) {
    GltfDocument document("caf\xe9");
    document.add_vec3(std::vector<vec3>(1));
    ASSERT_TRUE(document.write(file));
    const Json gltf = Json::parse(bytes(file), nullptr, false);
    ASSERT_FALSE(gltf.is_discarded());
    EXPECT_EQ(gltf["buffers"][0]["uri"], times == 0 ? "caf%E9%201.bin" : "caf%E9%201-2.bin");
  }
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(path(""))), 2) << "the former bytes are gone";
}

TEST_F(GltfTest, SaysWhatTheCornellBoxReflectsAndHowItGlows) {
  const Json gltf = exported(scene::cornell_box());
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  EXPECT_EQ(summary_.triangles, 36u) << "six quads and two boxes";
  EXPECT_TRUE(summary_.missing.empty());
  const Json& lamp = named(gltf["materials"], "lamp");
  EXPECT_FLOAT_EQ(lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].get<float>(), 17.0f);
  EXPECT_FLOAT_EQ(lamp["emissiveFactor"][1].get<float>(), 12.0f / 17.0f);
  EXPECT_EQ(lamp["extensions"]["KHR_materials_specular"]["specularFactor"], 0.0f) << "Lambert";
  const Json& red = named(gltf["materials"], "red");
  EXPECT_FLOAT_EQ(red["pbrMetallicRoughness"]["baseColorFactor"][1].get<float>(), 0.065f);
  EXPECT_FALSE(red.contains("emissiveFactor"));
  for (const char* extension : {"KHR_materials_emissive_strength", "KHR_materials_specular"})
    EXPECT_NE(std::ranges::find(gltf["extensionsUsed"], Json(extension)), gltf["extensionsUsed"].end()) << extension;
  EXPECT_EQ(gltf["extras"]["fullbright"]["bounces"], settings_.bounces);
}

TEST_F(GltfTest, CameraAndWorldKeepTheirPlaces) {
  const Json gltf = exported(scene::cornell_box());
  const Json& camera = named(gltf["nodes"], "camera")["matrix"];
  const float expected[] = {0, -1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, -800, 0, 280, 1};  // right is -y, up z, back -x
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(camera[i].get<float>(), expected[i], 1e-5f) << i;
  const Json& perspective = gltf["cameras"][0]["perspective"];
  EXPECT_NEAR(perspective["aspectRatio"].get<double>(), 96.0 / 54.0, 1e-6);
  EXPECT_NEAR(std::tan(0.5 * perspective["yfov"].get<double>()), std::tan(radians(39.3f) * 0.5f) * 54.0 / 96.0, 1e-6);
  const Json& root = gltf["nodes"][gltf["scenes"][0]["nodes"][0].get<std::size_t>()]["matrix"];
  EXPECT_FLOAT_EQ(root[6].get<float>(), -0.0254f) << "north is -z";
  EXPECT_FLOAT_EQ(root[9].get<float>(), 0.0254f) << "up is y, in metres";
}

TEST_F(GltfTest, TexturesAreTheTexelsAsAScreenShowsThem) {
  scene::FrameSnapshot snapshot = scene::textured_quad();
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->materials[0].flags &= ~static_cast<std::uint32_t>(scene::kMaterialNoFullbright);
  assets->materials[0].emission_kind = scene::EmissionKind::kFullbright;
  assets->materials[0].emission = vec3(1.0f);
  snapshot.assets = assets;
  const Json gltf = exported(snapshot);
  const auto texels = [&](const Json& reference) {
    const Json& texture = gltf["textures"][reference["index"].get<std::size_t>()];
    EXPECT_EQ(gltf["samplers"][texture["sampler"].get<std::size_t>()]["magFilter"], 9728) << "nearest";
    const Json& image = gltf["images"][texture["source"].get<std::size_t>()];
    const Json& view = gltf["bufferViews"][image["bufferView"].get<std::size_t>()];
    const std::string data = bytes(path(gltf["buffers"][0]["uri"]))
                                 .substr(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
    return *formats::parse_png({reinterpret_cast<const std::uint8_t*>(data.data()), data.size()}, "texture");
  };
  const Json& material = gltf["materials"][0];
  const auto color = texels(material["pbrMetallicRoughness"]["baseColorTexture"]);
  const auto glow = texels(material["emissiveTexture"]);
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(color.rgba[4 * i], 17 * (i % 16)) << i;
    EXPECT_EQ(color.rgba[4 * i + 2], 255 - i) << i;
    EXPECT_EQ(glow.rgba[4 * i + 2], i >= 224 ? 255 - i : 0) << i << ": fullbright from 224 on";
  }
  EXPECT_FLOAT_EQ(material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].get<float>(),
                  settings_.emit_fullbright);
  EXPECT_TRUE(gltf["extras"]["fullbright"]["behind_everything"].get<bool>());
}

TEST_F(GltfTest, PosesAreThoseOfTheMoment) {
  const auto assets = scene::moving_assets();
  const auto height = [&](double time) {
    const Json gltf = exported(scene::moving(assets, time, time));
    const Json& node = *std::ranges::find_if(gltf["nodes"], [](const Json& n) {
      return n["name"].get<std::string>().ends_with(fmt::format(" {}", scene::kMovingPosed));
    });
    float sum = 0;
    for (const Json& primitive : gltf["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
      const auto normals = vectors(gltf, primitive["attributes"]["NORMAL"]);
      for (const vec3& n : normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-4f);
      for (const vec3& p : vectors(gltf, primitive["attributes"]["POSITION"])) sum += glm::length(p);
    }
    return sum;
  };
  EXPECT_NE(height(0.0), height(0.3));
  EXPECT_EQ(height(0.3), height(0.3));
}

TEST_F(GltfTest, SunsAndWhatOnlySomeRaysSee) {
  scene::FrameSnapshot snapshot = scene::cornell_box();
  snapshot.sky.suns.push_back({{0, 0, 1}, {2, 1, 0}, 0.5f});
  snapshot.instances[1].visibility = scene::kSeenByIndirect;
  snapshot.instances[2].alpha = 0.25f;
  const Json gltf = exported(snapshot);
  const Json& light = gltf["extensions"]["KHR_lights_punctual"]["lights"][0];
  EXPECT_FLOAT_EQ(light["intensity"].get<float>(), 2.0f * 683.0f);
  EXPECT_FLOAT_EQ(light["color"][1].get<float>(), 0.5f);
  const Json& matrix = named(gltf["nodes"], "sun")["matrix"];
  EXPECT_FLOAT_EQ(matrix[10].get<float>(), 1.0f) << "its light runs along its own -z: down";
  const auto hidden = std::ranges::count_if(gltf["nodes"], [](const Json& n) {
    return n.contains("extras") && !n["extras"]["fullbright"]["seen_by_camera"].get<bool>();
  });
  EXPECT_EQ(hidden, 1);
  EXPECT_EQ(std::ranges::count_if(gltf["materials"], [](const Json& m) { return m.value("alphaMode", "") == "BLEND"; }),
            1);
}

TEST_F(GltfTest, OneFileHoldsBoth) {
  ASSERT_TRUE(export_gltf(scene::cornell_box(), settings_, {96, 54}, path("scene.glb"), "a test").ok());
  const std::string glb = bytes(path("scene.glb"));
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, glb.data() + at, 4);
    return value;
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(8), glb.size());
  const Json gltf = Json::parse(glb.substr(20, word(12)));
  EXPECT_FALSE(gltf["buffers"][0].contains("uri"));
  EXPECT_EQ(gltf["buffers"][0]["byteLength"], word(20 + word(12)));
  exported(scene::cornell_box());
  EXPECT_EQ(glb.substr(28 + word(12)), bytes(path("scene.bin"))) << "the same bytes";
  EXPECT_FALSE(export_gltf(scene::cornell_box(), settings_, {9, 9}, path("scene.gltf/x.gltf"), "a test").ok());
}

}  // namespace
}  // namespace fb::lab
