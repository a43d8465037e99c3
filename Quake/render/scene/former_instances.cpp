#include "render/scene/former_instances.h"

#include <utility>

#include "shared/scene_gpu.h"

namespace fb::render {

void FormerInstances::begin_frame(std::vector<Row> rows) {
  by_id_.clear();
  for (std::uint32_t i = 0; i < rows.size(); ++i)
    if (!rows[i].is_new) by_id_.emplace(rows[i].id, i);
  places_.clear();
  places_.reserve(rows_.size());
  for (const Row& former : rows_) {
    const auto found = by_id_.find(former.id);
    const bool same = found != by_id_.end() && rows[found->second].mesh == former.mesh;
    places_.push_back(same ? found->second : shared::kNoIndex);
  }
  rows_ = std::move(rows);
}

}  // namespace fb::render
