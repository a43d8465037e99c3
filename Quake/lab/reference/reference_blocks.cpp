#include "lab/reference/reference_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "lab/image_io.h"
#include "shared/color.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kFirstBlock = 256, kBlocksOfOneSize = 8, kMostDoublings = 14;

}  // namespace

std::uint32_t block_samples(std::uint32_t index) {
  return kFirstBlock << std::min(index / kBlocksOfOneSize, kMostDoublings);
}

std::vector<BlockPlan> plan_blocks(std::uint32_t spp) {
  std::vector<BlockPlan> blocks;
  for (BlockPlan next; next.first < spp; ++next.index) {
    const std::uint32_t size = block_samples(next.index), left = spp - next.first;
    next.samples = left < 2 * size ? left : size;
    blocks.push_back(next);
    next.first += next.samples;
  }
  return blocks;
}

void ReferenceSum::add(const ReferenceBlock& block) {
  const Picture& mean = block.content.mean;
  if (mean_.empty()) {
    width_ = mean.width;
    height_ = mean.height;
    mean_.resize(mean.pixels.size());
    variance_.resize(mean.pixels.size());
  }
  const auto n = static_cast<double>(block.plan.samples);
  samples_ += block.plan.samples;
  for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] += n * dvec3(mean.pixels[i]);
  variance_known_ = variance_known_ && !block.content.variance.empty();
  if (!variance_known_) return;
  for (std::size_t i = 0; i < mean_.size(); ++i) variance_[i] += n * n * dvec3(block.content.variance[i]);
}

Reference ReferenceSum::reference() const {
  Reference reference{Picture{width_, height_, std::vector<vec3>(mean_.size())}, {}};
  const double n = samples_;
  std::ranges::transform(mean_, reference.mean.pixels.begin(), [&](const dvec3& sum) { return vec3(sum / n); });
  if (!variance_known_) return reference;
  reference.variance.resize(variance_.size());
  std::ranges::transform(variance_, reference.variance.begin(), [&](const dvec3& sum) { return vec3(sum / (n * n)); });
  return reference;
}

ReferenceError error_of(const Reference& reference) {
  ReferenceError error;
  double squared = 0;
  for (const vec3& pixel : reference.mean.pixels) error.mean_luminance += shared::luminance(pixel);
  for (const vec3& variance : reference.variance) squared += shared::luminance(variance);
  const auto n = static_cast<double>(reference.mean.pixels.size());
  error.mean_luminance /= n;
  if (error.mean_luminance > 0) error.relative = std::sqrt(squared / n) / error.mean_luminance;
  return error;
}

Result<BlockFolder> BlockFolder::open(const std::string& folder, std::uint64_t key, uvec2 size) {
  if (folder.empty()) return existing("", size);
  BlockFolder blocks = existing(fmt::format("{}/{:016x}", folder, key), size);
  std::error_code failed;
  std::filesystem::create_directories(blocks.path_, failed);
  if (failed) return Error{fmt::format("{}: {}", blocks.path_, failed.message())};
  return blocks;
}

BlockFolder BlockFolder::existing(const std::string& path, uvec2 size) {
  BlockFolder blocks;
  blocks.path_ = path;
  blocks.size_ = size;
  return blocks;
}

std::string BlockFolder::file(const BlockPlan& plan) const {
  return fmt::format("{}/block_{:04}_{}.exr", path_, plan.index, plan.samples);
}

std::optional<ReferenceBlock> BlockFolder::read(const BlockPlan& plan) const {
  std::error_code ignored;
  if (path_.empty() || !std::filesystem::exists(file(plan), ignored)) return std::nullopt;
  auto picture = read_exr_picture(file(plan));
  if (!picture || picture->content.mean.width != size_.x || picture->content.mean.height != size_.y)
    return std::nullopt;
  return ReferenceBlock{plan, std::move(picture->content)};
}

Status BlockFolder::keep(const ReferenceBlock& block) const {
  if (path_.empty()) return ok_status();
  ExrImage exr(block.content.mean.width, block.content.mean.height);
  exr.add_colors("", block.content.mean.pixels);
  if (!block.content.variance.empty()) exr.add_colors("variance.", block.content.variance);
  return write_exr(file(block.plan), exr);
}

}  // namespace fb::lab
