// What tests of bench share: views of scenes in code, references of them, and a job.
#pragma once

#include "lab/bench/bench_job.h"

#include "render/test_device.h"

namespace fb::lab {

class BenchTest : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 32, kHeight = 24;

  static View view_of(const std::string& scene, const ViewOptions& options) {
    auto source = code_scene(scene, 60);
    EXPECT_TRUE(source.ok());
    auto view = collect_view(**source, options);
    EXPECT_TRUE(view.ok()) << (view ? "" : view.error().message);
    return std::move(*view);
  }
  static Configuration configuration(const std::string& name, int spp) {
    Configuration c{name, {}};
    c.settings.spp = spp;
    c.settings.jitter = 0;
    return c;
  }
  static std::vector<Reference> references_of(const View& view, std::uint32_t spp, const std::string& folder = "") {
    render::RenderSettings settings;
    settings.jitter = 0;
    auto made = make_references(view, *device_, settings, {"pt", spp, kWidth, kHeight, folder, true});
    EXPECT_TRUE(made.ok());
    return std::move(*made);
  }
  static BenchResult run(const View& view, const std::vector<Reference>& references,
                         const std::vector<Configuration>& configurations, std::uint32_t runs) {
    BenchJob job;
    job.configurations = configurations;
    job.width = kWidth;
    job.height = kHeight;
    job.runs = runs;
    job.quiet = true;
    auto result = run_bench(*device_, view, references, job);
    EXPECT_TRUE(result.ok()) << (result ? "" : result.error().message);
    return std::move(*result);
  }
};

}  // namespace fb::lab
