// What tests of references share: jobs in a folder of their own, and what their files hold.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/test_directory.h"
#include "lab/image_io.h"
#include "lab/reference/reference_job.h"
#include "render/test_device.h"

namespace fb::lab {

class ReferenceTest : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kSpp = 900;  // blocks of 256, 256 and 388

  std::string path(const std::string& name) const { return directory_.file(name); }
  ReferenceJob job(const std::string& name, std::uint32_t width, std::uint32_t height, std::uint32_t spp) const {
    ReferenceJob job;
    job.width = width;
    job.height = height;
    job.spp = spp;
    job.out = path(name + ".exr");
    job.blocks = path(name + ".blocks");
    job.view = "--scene " + name;
    job.quiet = true;
    return job;
  }
  Result<ReferenceSummary> make(const std::string& scene, const render::RenderSettings& settings,
                                const ReferenceJob& job) {
    auto source = code_scene(scene, 60);
    const auto renderer = make_renderer(settings, job.width, job.height);
    return render_reference(**source, *renderer, settings, job);
  }
  static std::vector<float> plane(const std::string& file, const std::string& channel) {
    const auto image = read_exr(file);
    EXPECT_TRUE(image.ok()) << file;
    return image ? *image->channel(channel) : std::vector<float>();
  }
  static void expect_same(const std::string& a, const std::string& b) {
    for (const char* channel : {"R", "G", "B", "variance.R", "variance.G", "variance.B", "albedo.R", "normal.Z", "Z"})
      EXPECT_EQ(plane(a, channel), plane(b, channel)) << channel;
  }
  static std::string remove_block(const std::string& folder, const std::string& name) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().filename() == name) return std::filesystem::remove(entry.path()) ? entry.path().string() : "";
    return "";
  }
  const TestDirectory directory_;
};

}  // namespace fb::lab
