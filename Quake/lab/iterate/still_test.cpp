// fullbright-lab still: schedules and memory that are told before, and a picture that several runs make.
#include "lab/iterate/still_job.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/test_directory.h"
#include "fs/file.h"
#include "lab/bench/bench_view.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

TEST(Still, IterationsDoubleAfterFourOfTwoSamples) {
  EXPECT_THAT(schedule_of(1), testing::ElementsAre(1));
  EXPECT_THAT(schedule_of(3), testing::ElementsAre(3));
  EXPECT_THAT(schedule_of(5), testing::ElementsAre(2, 3));
  EXPECT_THAT(schedule_of(8), testing::ElementsAre(2, 2, 2, 2));
  EXPECT_THAT(schedule_of(24), testing::ElementsAre(2, 2, 2, 2, 4, 12));
  EXPECT_THAT(schedule_of(64), testing::ElementsAre(2, 2, 2, 2, 4, 8, 16, 28));
  for (std::uint32_t n = 1; n < 3000; n += 7) EXPECT_EQ(samples_of(schedule_of(n)), n);
  EXPECT_EQ(samples_of(schedule_of(kMostScheduled)), kMostScheduled);
  StillJob job;
  job.samples = 24;
  EXPECT_THAT(schedule_of(job), testing::ElementsAre(24)) << "plain";
}

TEST(Still, SaysWhatItTakes) {
  StillJob job;
  job.samples = 12;
  job.settings.estimator = "mcpg_nee";
  EXPECT_EQ(still_text(job), "plain: 12 samples a pixel by mcpg_nee, unbiased");
  job.guided = true;
  job.settings.estimator = "mir";
  EXPECT_EQ(still_text(job),
            "guided: 12 samples a pixel by mir in iterations of 2,2,2,2,4, biased: less with more samples");
  job.settings.mir_decorrelated = 1;
  EXPECT_THAT(still_text(job), testing::EndsWith("half of them seen; unbiased while all paths are stored"));
  job.settings.mir_weights = 1;
  EXPECT_THAT(still_text(job), testing::EndsWith("half of them seen"));
}

TEST(Still, RefusesWhatMemoryDoesNotHold) {
  StillJob job;
  job.guided = true;
  job.settings.bounces = 3;
  const render::IterationMemory memory{.device = 30'000'000, .pictures = 10'000'000, .stored = 60'000'000};
  EXPECT_TRUE(memory_suffices(job, memory, {70'000'000, 30'000'000, false}).ok());
  EXPECT_TRUE(memory_suffices(job, memory, {100'000'000, 0, true}).ok());
  const Status host = memory_suffices(job, memory, {99'000'000, 1'000'000'000, true});
  ASSERT_FALSE(host.ok());
  EXPECT_EQ(host.error().message,
            "--guided: up to 100 MB of the machine's memory are needed and it has 99: a smaller --size, fewer "
            "r_bounces (3) or a smaller r_mir_storage (500 MB) takes less");
  const Status device = memory_suffices(job, memory, {99'000'000, 29'000'000, false});
  ASSERT_FALSE(device.ok());
  EXPECT_THAT(device.error().message,
              testing::HasSubstr("up to 30 MB of the device's memory are needed and it has 29"));
}

class StillSequences : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 32, kHeight = 24;
  static scene::FrameSnapshot cbox() {
    auto source = code_scene("cbox", 60);
    EXPECT_TRUE(source.ok());
    auto view = collect_view(**source, {0, 0, 0, true});
    EXPECT_TRUE(view.ok());
    return view->at(0, 0);
  }
  StillJob job_of(const std::string& state = "") const {
    StillJob job;
    job.settings.estimator = "mir";
    job.settings.jitter = 0;
    job.settings.bounces = 3;
    job.settings.mir_split = 100;  // so that a small picture has leaves
    job.settings.deterministic = 1;
    job.size = {kWidth, kHeight};
    job.samples = 12;
    job.guided = true;
    job.resume = state.empty() ? "" : (directory_.path() / state).string();
    return job;
  }
  // In a renderer of its own, as another program's run would be; ends after `most` iterations.
  static Result<IteratedPicture> run(const StillJob& job, std::uint32_t most = 99,
                                     const std::function<void(std::uint32_t)>& resumed = nullptr) {
    const auto renderer = make_renderer(job.settings, job.size.x, job.size.y);
    StillTold told;
    told.resumed = resumed;
    told.iteration = [&](std::uint32_t iterations) { return iterations < most; };
    return lab::render_still(*renderer, job, cbox(), told);
  }
  // The report without the time.
  static std::string kept_of(const IteratedPicture& picture) {
    return picture.report.substr(0, picture.report.rfind(';'));
  }
  TestDirectory directory_;
};

TEST_F(StillSequences, KilledAndResumedItHasTheSameBits) {
  for (const int form : {0, 1, 2, 3}) {
    StillJob job = job_of();
    if (form == 1) job.settings.mir_decorrelated = 1;
    if (form == 2) job.settings.mir_storage = 0;  // paths are let go of, with weights
    if (form == 3) job.settings.mir_weights = 1;
    const auto whole = run(job);
    ASSERT_TRUE(whole.ok());
    ASSERT_FALSE(whole->picture.pixels.empty());
    job.resume = (directory_.path() / ("state" + std::to_string(form))).string();
    const auto killed = run(job, 2);
    ASSERT_TRUE(killed.ok());
    EXPECT_TRUE(killed->picture.pixels.empty());
    std::uint32_t from = 0;
    const auto again = run(job, 4, [&](std::uint32_t samples) { from = samples; });  // once more
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(from, 4u);
    const auto rest = run(job, 99, [&](std::uint32_t samples) { from = samples; });
    ASSERT_TRUE(rest.ok()) << rest.error().message;
    EXPECT_EQ(from, 8u);
    EXPECT_EQ(rest->samples, 12u);
    EXPECT_EQ(rest->picture.pixels, whole->picture.pixels) << form;
    EXPECT_EQ(kept_of(*rest), kept_of(*whole));
    // Keeping the state changes nothing either.
    job.resume += ".other";
    EXPECT_EQ(run(job)->picture.pixels, whole->picture.pixels) << form;
  }
}

TEST_F(StillSequences, AStateIsRefusedThatIsDamagedOrOfAnotherPicture) {
  const StillJob job = job_of("state");
  ASSERT_TRUE(run(job, 2).ok());
  const auto file = fs::read_whole_file(job.resume);
  ASSERT_TRUE(file.ok());
  const Bytes good(file->begin(), file->end());

  const auto message_of = [&](const StillJob& other) {
    const auto result = run(other, 3);
    return result ? std::string("accepted") : result.error().message.substr(job.resume.size());
  };
  const std::string of_other = ": it is of another picture (view, settings, size, samples or shaders)";
  StillJob other = job;
  other.settings.seed = 7;
  EXPECT_EQ(message_of(other), of_other);
  other = job;
  other.settings.mir_decorrelated = 1;
  EXPECT_EQ(message_of(other), of_other);
  other = job;
  other.size = {kWidth, kHeight + 1};
  EXPECT_EQ(message_of(other), of_other);
  other = job;
  other.samples = 13;
  EXPECT_EQ(message_of(other), of_other);

  const std::string is_damaged = ": it is damaged; without it the picture begins anew";
  const auto with = [&](const Bytes& bytes) {
    EXPECT_TRUE(fs::write_file_atomically(job.resume, bytes).ok());
    return message_of(job);
  };
  Bytes changed = good;
  changed[good.size() / 2] ^= 1;
  EXPECT_EQ(with(changed), is_damaged);
  EXPECT_EQ(with(Bytes(good.begin(), good.end() - 1)), is_damaged);
  changed = good;
  changed[16] ^= 1;  // the number of iterations
  EXPECT_EQ(with(changed), is_damaged);
  EXPECT_EQ(with({}), ": this is no state of a picture");
  EXPECT_EQ(with(Bytes(1000, 7)), ": this is no state of a picture");
  EXPECT_EQ(with(good), "accepted");
}

TEST_F(StillSequences, WhereNoStateCanBeWrittenThePictureGoesOn) {
  StillJob job = job_of("file/state");
  ASSERT_TRUE(fs::write_text_atomically(directory_.path() / "file", "no folder").ok());
  const auto without = run(job_of()), with = run(job);
  ASSERT_TRUE(with.ok());
  EXPECT_EQ(with->picture.pixels, without->picture.pixels);
}

TEST_F(StillSequences, TellsMoreMemoryThanItTakes) {
  StillJob job = job_of();
  job.size = {4 * kWidth, 4 * kHeight};  // so that a tenth of a MB is stored
  job.samples = 4;
  const auto renderer = make_renderer(job.settings, job.size.x, job.size.y);
  const auto picture = lab::render_still(*renderer, job, cbox(), {});
  ASSERT_TRUE(picture.ok());
  const render::IterationMemory memory = render::memory_of_iterations(job.settings, job.size, schedule_of(job));
  // The spatial tree and its nodes stand on the device, too: smaller by far than a frame's paths in larger pictures.
  EXPECT_GE(memory.device + memory.snapshots, renderer->learnt_bytes());
  EXPECT_LE(memory.device, 2 * renderer->learnt_bytes());
  double stored = 0, snapshots = 0;
  ASSERT_EQ(std::sscanf(picture->report.c_str(),
                        "%*d paths stored, %lf MB (%*d let go of); %*d leaves, distributions of "
                        "%*d iterations %lf MB",
                        &stored, &snapshots),
            2)
      << picture->report;
  EXPECT_GT(stored, 0);
  EXPECT_GE(static_cast<double>(memory.stored) / 1e6, stored);
  EXPECT_GE(static_cast<double>(memory.snapshots) / 1e6, snapshots);
  // A store of 1 MB holds no more, whatever the samples are.
  render::RenderSettings small = job.settings;
  small.mir_storage = 1;
  const std::vector<std::uint32_t> many{1000, 1000};
  EXPECT_LT(render::memory_of_iterations(small, {kWidth, kHeight}, many).stored, 3'000'000u);
  EXPECT_GT(render::memory_of_iterations(job.settings, job.size, many).stored, 100'000'000u);
}

}  // namespace
}  // namespace fb::lab
