// The pass that teaches mixtures of Gaussians, by itself: both ways to run it in parallel against samples one after the
// other on the host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "base/rng.h"
#include "estimators/pstf/pstf_gaussians.h"
#include "estimators/pstf/pstf.h"
#include "gpu/buffer.h"
#include "render/passes/shader_code.h"
#include "render/techniques/technique_memory.h"
#include "render/test_device.h"

namespace fb::render {
namespace {

constexpr ArrayRow kPstfPassRows[]{FB_PSTF_ARRAYS(FB_ARRAY_ROW)};
constexpr std::uint32_t kPassCells = 1024;

class PstfPassesTest : public DeviceTest {
 protected:
  void TearDown() override {
    memory_.reset();
    table_.reset();
    uniform_ = gpu::Buffer();
    DeviceTest::TearDown();
  }
  void make(std::uint32_t count) {
    count_ = count;
    memory_.reset();
    table_ = std::make_unique<gpu::BindingTable>(*device_);
    memory_ = std::make_unique<TechniqueMemory>(*device_, *table_, kPstfPassRows, "pstf reset");
    uniform_ = gpu::Buffer(*device_, gpu::BufferUse::kUniform, shared::kPstfConstantsAt + sizeof(shared::PstfConstants),
                           "constants of pstf");
    table_->set_uniform(shared::kSetTechnique, uniform_);
    memory_->set_count(shared::kPstfCells, kPassCells);
    memory_->set_count(shared::kPstfSums, kPassCells, shared::kPstfTailWords * 4);
    for (const std::uint32_t array : {shared::kPstfGaussians, shared::kPstfGaussianSums})
      memory_->set_count(array, std::uint64_t{kPassCells} * count);
    memory_->set_count(shared::kPstfSamples, kPassCells);
    memory_->make();
    device_->run([&](gpu::Commands& commands) {
      for (const ArrayRow& row : kPstfPassRows) commands.fill(memory_->buffer(row.binding), 0);
      commands.barrier();
    });
  }
  gpu::Buffer& array(std::uint32_t binding) { return const_cast<gpu::Buffer&>(memory_->buffer(binding)); }

  // Cells `first` to `end` are listed, of so many samples in this frame and in all; `taught` 0: they are given away.
  void learn(bool lane_of_sample, std::uint32_t first, std::uint32_t end, float crowd, float taught,
             const std::vector<std::uint32_t>& samples) {
    shared::PstfConstants constants{};
    copy_settings(RenderSettings{}, constants);
    constants.pstf_cells = kPassCells;
    constants.frame_number = 2;
    std::memcpy(static_cast<std::byte*>(uniform_.mapped()) + shared::kPstfConstantsAt, &constants, sizeof(constants));
    std::vector<std::uint32_t> cells(std::size_t{kPassCells} * shared::kPstfCellWords),
        sums(std::size_t{kPassCells} * (shared::kPstfSumWords + 3) + shared::kPstfTailWords);
    const std::size_t list = std::size_t{kPassCells} * (shared::kPstfSumWords + 2);
    for (std::uint32_t slot = first; slot < end; ++slot) {
      std::uint32_t* cell = &cells[std::size_t{slot} * shared::kPstfCellWords];
      cell[0] = 1;
      cell[2] = shared::floatBitsToUint(crowd);
      cell[3] = shared::floatBitsToUint(taught);
      sums[list + slot - first] = slot;
    }
    sums[list + kPassCells] = end - first;  // of frames of even numbers
    gpu::upload_now(*device_, array(shared::kPstfCells), std::span<const std::uint32_t>(cells));
    gpu::upload_now(*device_, array(shared::kPstfSums), std::span<const std::uint32_t>(sums));
    gpu::upload_now(*device_, array(shared::kPstfSamples), std::span<const std::uint32_t>(samples));
    const gpu::SpecializationConstant specs[]{{shared::kSpecLaneOfSample, lane_of_sample},
                                              {shared::kSpecGaussians, count_}};
    const gpu::ComputePipeline pipeline =
        make_pipeline(*device_, *table_, "pstf_gaussians", false, arrays_by_address(*device_), specs);
    device_->run([&](gpu::Commands& commands) {
      commands.bind(*table_);
      commands.dispatch(pipeline, 3, 1);
      commands.barrier();
    });
  }
  std::vector<shared::Gaussian> gaussians() {
    return gpu::read_now<shared::Gaussian>(*device_, array(shared::kPstfGaussians), kPassCells * count_);
  }
  std::vector<shared::GaussianSums> sums() {
    return gpu::read_now<shared::GaussianSums>(*device_, array(shared::kPstfGaussianSums), kPassCells * count_);
  }
  std::uint32_t samples_left() {
    const auto words =
        gpu::read_now<std::uint32_t>(*device_, array(shared::kPstfSamples), kPassCells * shared::kGaussianPlaces);
    return static_cast<std::uint32_t>(std::ranges::count_if(words, [](std::uint32_t word) { return word != 0; }));
  }

  std::uint32_t count_ = 0;
  std::unique_ptr<gpu::BindingTable> table_;
  std::unique_ptr<TechniqueMemory> memory_;
  gpu::Buffer uniform_;
};

// What one cell's samples teach its mixture, one after the other.
struct HostMixture {
  std::vector<shared::Gaussian> gaussians;
  std::vector<shared::GaussianSums> sums;
  float seen = 0;

  explicit HostMixture(std::uint32_t count) : sums(count, shared::no_sums()) {
    for (std::uint32_t i = 0; i < count; ++i) gaussians.push_back(shared::first_gaussian(i, count));
  }
  void learn(const std::uint32_t* words) {
    const auto count = static_cast<std::uint32_t>(sums.size());
    const float most = RenderSettings{}.pstf_window * static_cast<float>(shared::kGaussianPlaces);
    bool any = false;
    for (std::uint32_t place = 0; place < shared::kGaussianPlaces; ++place) {
      if (words[place] == 0) continue;
      any = true;
      seen = std::min(seen + 1, most);
      const vec2 p = shared::word_place(words[place]);
      float all = 0;
      for (const shared::Gaussian& g : gaussians) all += shared::gaussian_density(g, p);
      const float step = shared::gaussian_step(seen);
      for (std::uint32_t i = 0; i < count; ++i) {
        const float own = shared::responsibility_of(shared::gaussian_density(gaussians[i], p), all, count);
        sums[i] = shared::joined_sums(sums[i], 1 - step,
                                      shared::sample_sums(p, shared::word_weight(words[place]), own, step));
      }
    }
    if (!any) return;
    for (std::uint32_t i = 0; i < count; ++i) gaussians[i] = shared::learnt_gaussian(sums[i], i, count);
  }
};

// Farthest apart of all numbers, over their size where that is above 1.
double apart(const float* a, const float* b, std::size_t count) {
  double most = 0;
  for (std::size_t i = 0; i < count; ++i)
    most = std::max(most, static_cast<double>(std::abs(a[i] - b[i]) / std::max(1.0f, std::abs(a[i]))));
  return most;
}

// Cells of no sample, of one, of all places, over three frames after the one that gave them away.
TEST_F(PstfPassesTest, ParallelLearningEqualsOneSampleAfterTheOther) {
  constexpr std::uint32_t kFirst = 3, kEnd = 120;
  for (const std::uint32_t count : {4u, 8u}) {
    for (const bool lane_of_sample : {false, true}) {
      const std::string what = std::to_string(count) + (lane_of_sample ? ", a lane a sample" : ", a lane a Gaussian");
      make(count);
      std::vector<HostMixture> host(kPassCells, HostMixture(count));
      std::vector<std::uint32_t> samples(std::size_t{kPassCells} * shared::kGaussianPlaces);
      learn(lane_of_sample, kFirst, kEnd, 0, 0, samples);
      Rng rng(9);
      for (int frame = 0; frame < 3; ++frame) {
        std::ranges::fill(samples, 0u);
        for (std::uint32_t slot = kFirst; slot < kEnd; ++slot) {
          const float share = slot == kFirst ? 0 : slot == kFirst + 1 ? 1 : rng.uniform();
          for (std::uint32_t place = 0; place < shared::kGaussianPlaces; ++place)
            if ((slot == kFirst + 2 && place == 17) || (slot != kFirst + 2 && rng.uniform() < share))
              samples[slot * shared::kGaussianPlaces + place] =
                  shared::sample_word(vec2(rng.uniform(-1, 1), rng.uniform(-0.5f, 1)), rng.uniform(0, 4), 0, 0);
          host[slot].learn(&samples[slot * shared::kGaussianPlaces]);
        }
        learn(lane_of_sample, kFirst, kEnd, 10, 100, samples);
      }
      EXPECT_EQ(samples_left(), 0u) << what;
      const auto learnt = gaussians();
      const auto learnt_sums = sums();
      double most = 0, most_sums = 0;
      for (std::uint32_t slot = kFirst; slot < kEnd; ++slot) {
        for (std::uint32_t i = 0; i < count; ++i) {
          const shared::Gaussian& g = learnt[slot * count + i];
          most = std::max(most, apart(&host[slot].gaussians[i].scale, &g.scale, 7));
          most_sums = std::max(most_sums, apart(&host[slot].sums[i].a.x, &learnt_sums[slot * count + i].a.x, 8));
        }
        EXPECT_EQ(learnt[slot * count].seen, host[slot].seen) << what << ", cell " << slot;
      }
      EXPECT_LT(most, 1e-4) << what;
      EXPECT_LT(most_sums, 1e-4) << what;
      EXPECT_GT(host[kFirst + 1].gaussians[0].over_y, 0) << what;
      RecordProperty(std::to_string(count) + (lane_of_sample ? "_sample" : "_gaussian"), std::to_string(most));
      EXPECT_EQ(learnt[kEnd * count].weight, 0) << what << ": a cell that is not listed";
    }
  }
}

// Light that has changed begins the count of samples anew, so that the new ones weigh more: the cell's count of all is
// this frame's, as the pass before it leaves it.
TEST_F(PstfPassesTest, ChangedLightBeginsAnew) {
  for (const bool lane_of_sample : {false, true}) {
    make(4);
    std::vector<std::uint32_t> samples(std::size_t{kPassCells} * shared::kGaussianPlaces);
    learn(lane_of_sample, 0, 1, 0, 0, samples);
    for (int frame = 0; frame < 20; ++frame) {
      for (std::uint32_t place = 0; place < shared::kGaussianPlaces; ++place)
        samples[place] = shared::sample_word(vec2(frame < 18 ? 0.5f : -0.5f, 0.25f), 1, 0, 0);
      learn(lane_of_sample, 0, 1, 32, frame == 18 ? 32 : 1000, samples);
    }
    const auto learnt = gaussians();
    EXPECT_EQ(learnt[0].seen, 64);
    float left = 0;
    for (int i = 0; i < 4; ++i) left += learnt[i].x < 0 ? learnt[i].weight : 0;
    EXPECT_GT(left, 0.9f);
  }
}

}  // namespace
}  // namespace fb::render
