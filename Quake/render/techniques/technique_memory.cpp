#include "render/techniques/technique_memory.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/check.h"
#include "shared/bindings.h"

namespace fb::render {

TechniqueMemory::TechniqueMemory(gpu::Device& device, gpu::BindingTable& table, std::span<const ArrayRow> rows,
                                 std::string zeroed)
    : device_(device), table_(table), zeroed_(std::move(zeroed)) {
  for (const ArrayRow& row : rows) {
    FB_CHECK_LT(row.binding, shared::kTechniqueArrays);
    arrays_.push_back({&row, 0, 0, {}});
  }
}

TechniqueMemory::~TechniqueMemory() {
  for (const Array& array : arrays_) table_.set_array(shared::kSetTechnique, array.row->binding, gpu::Buffer());
}

TechniqueMemory::Array& TechniqueMemory::of(std::uint32_t binding) {
  const auto found = std::ranges::find_if(arrays_, [&](const Array& array) { return array.row->binding == binding; });
  FB_CHECK(found != arrays_.end());
  return *found;
}
const TechniqueMemory::Array& TechniqueMemory::of(std::uint32_t binding) const {
  return const_cast<TechniqueMemory*>(this)->of(binding);
}

std::uint64_t TechniqueMemory::bytes_of(const Array& array) {
  return array.count * array.row->bytes * (array.row->former ? 2 : 1) + array.extra;
}

std::uint64_t TechniqueMemory::most_elements(std::uint32_t binding, std::uint64_t extra) const {
  const Array& array = of(binding);
  const std::uint64_t most = gpu::largest_buffer(device_, gpu::BufferUse::kStorage);
  return (most - std::min(extra, most)) / (array.row->bytes * (array.row->former ? 2u : 1u));
}

void TechniqueMemory::set_count(std::uint32_t binding, std::uint64_t count, std::uint64_t extra) {
  Array& array = of(binding);
  FB_CHECK(array.row->per != ArrayRow::Per::kPixel);
  array.count = count;
  array.extra = extra;
}

void TechniqueMemory::make(uvec2 lit) {
  const bool reshaped = std::exchange(lit_, lit) != lit;
  for (Array& array : arrays_) {
    if (array.row->per == ArrayRow::Per::kPixel) {
      array.count = std::uint64_t{lit.x} * lit.y;
      forget_ = forget_ || reshaped;
    }
    const std::uint64_t bytes = (std::max<std::uint64_t>(bytes_of(array), 16) + 15) / 16 * 16;
    if (array.buffer && array.buffer.size() == bytes) continue;
    forget_ = true;
    array.buffer = gpu::Buffer();  // the old one's memory goes first
    table_.set_array(shared::kSetTechnique, array.row->binding, array.buffer);
    array.buffer = gpu::Buffer(device_, gpu::BufferUse::kStorage, bytes, array.row->name);
    table_.set_array(shared::kSetTechnique, array.row->binding, array.buffer);
  }
}

bool TechniqueMemory::begin_frame(uvec2 lit) {
  make(lit);
  half_ = 1 - half_;
  zero_ = std::exchange(forget_, false) || zero_;
  return zero_;
}

void TechniqueMemory::add_reset(PassList& list) {
  if (!std::exchange(zero_, false)) return;
  list.add(zeroed_, PassKind::kEstimator, [this](gpu::Commands& commands) {
    for (const Array& array : arrays_) commands.fill(array.buffer, 0);
    commands.barrier();
  });
}

std::uint32_t TechniqueMemory::now(std::uint32_t binding) const {
  const Array& array = of(binding);
  return array.row->former && half_ != 0 ? static_cast<std::uint32_t>(array.count) : 0;
}
std::uint32_t TechniqueMemory::former(std::uint32_t binding) const {
  const Array& array = of(binding);
  return array.row->former && half_ == 0 ? static_cast<std::uint32_t>(array.count) : 0;
}

std::uint64_t TechniqueMemory::bytes() const {
  std::uint64_t sum = 0;
  for (const Array& array : arrays_) sum += array.buffer.size();
  return sum;
}

}  // namespace fb::render
