// What tests of the judge share. Sequences are rendered here as `render` would, without a program.
#pragma once

#include "lab/judge/judge_job.h"

#include <gtest/gtest.h>

#include "base/test_directory.h"
#include "lab/jobs.h"
#include "render/test_device.h"

namespace fb::lab {

class JudgeTest : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 32, kHeight = 18;

  static SuiteView view_of(const std::string& scene, std::uint64_t first, std::uint64_t last, std::uint32_t warmup) {
    SuiteView view;
    view.name = view.scene = scene;
    view.first = first;
    view.last = last;
    view.warmup = warmup;
    return view;
  }
  static Lane lane(const std::string& name, std::uint32_t spp, std::vector<std::string> sets = {"r_denoise=0"}) {
    return {name, {"this", "fullbright-lab", true}, "pt", spp, std::move(sets)};
  }
  std::vector<JudgedReference> references_of(const SuiteView& view, std::uint32_t spp, const std::string& folder = "") {
    auto source = code_scene(view.scene, 60);
    auto collected = collect_view(**source, {view.first, view.last, 0});
    EXPECT_TRUE(collected.ok());
    auto renderer = make_renderer({}, kWidth, kHeight);
    auto made = make_judged_references(*collected, *renderer, {}, {"nee", spp, kWidth, kHeight, folder, "", true});
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return std::move(*made);
  }
  // What a program's `render` does, in this process.
  Result<Sequence> render(const SequenceRequest& request) {
    const SuiteView& view = *request.view;
    con::Console console;
    render::register_render_cvars(console);
    console.set("r_denoise", "1");
    console.set("r_estimator", request.lane->estimator);
    for (const auto* sets : {&view.sets, &request.lane->sets, &request.sets})
      for (const std::string& text : *sets)
        console.set(text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
    RenderJob job;
    job.first = view.first - view.warmup;
    job.last = view.last;
    job.width = request.width;
    job.height = request.height;
    job.spp = request.lane->spp;
    job.out = request.folder;
    job.format = ImageFormat::kBoth;
    job.quiet = true;
    const auto settings = render::read_render_settings(console);
    auto renderer = make_renderer(settings, job.width, job.height);
    auto source = code_scene(view.scene, view.frames_per_second);
    auto summary = render_frames(**source, *renderer, settings, job);
    if (!summary) return summary.error();
    Sequence sequence;
    for (const auto& pass : summary->passes) sequence.times.all += pass.median();
    auto frames = read_frames(request);
    if (!frames) return frames.error();
    sequence.frames = std::move(*frames);
    return sequence;
  }
  JudgeJob job_of(std::vector<Lane> lanes, std::uint32_t seeds) {
    JudgeJob job;
    job.lanes = std::move(lanes);
    job.width = kWidth;
    job.height = kHeight;
    job.seeds = seeds;
    job.scratch = directory_.file("scratch");
    job.pictures = directory_.file("pictures");
    job.runner = [this](const SequenceRequest& request) { return render(request); };
    return job;
  }
  const TestDirectory directory_;
};

}  // namespace fb::lab
