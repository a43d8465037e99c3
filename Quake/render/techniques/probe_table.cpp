#include "render/techniques/probe_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string>

#include "base/log.h"

namespace fb::render {
namespace {

constexpr float kMostOffset = 0.45f;             // of a probe off its place in the grid, of the spacing (relocate.comp)
constexpr std::uint64_t kMostRows = 64u << 20u;  // bytes of all rows; beyond it leafs do not count

std::uint64_t elements_of(std::uint64_t words) { return (words + 3) / 4; }

vec3 place_in_grid(const ProbeGrid& grid, const glm::ivec3& cell) {
  return grid.origin + (vec3(cell) + 0.5f) * grid.spacing;
}

glm::ivec3 first_of(const ProbeGrid& grid) { return {grid.first[0], grid.first[1], grid.first[2]}; }
glm::ivec3 count_of(const ProbeGrid& grid) { return {grid.count[0], grid.count[1], grid.count[2]}; }

// Of all points that ask the volume's probes.
Bounds reach_of(const ProbeGrid& grid) {
  const glm::ivec3 first = first_of(grid), last = first + count_of(grid) - 1;
  return {place_in_grid(grid, first) - grid.spacing, place_in_grid(grid, last) + grid.spacing};
}

// Boxes that only one of both lists has.
std::vector<Bounds> of_one(const std::vector<Bounds>& a, const std::vector<Bounds>& b) {
  std::vector<Bounds> all;
  const auto add = [&](const std::vector<Bounds>& from, const std::vector<Bounds>& other) {
    for (const Bounds& box : from)
      if (std::ranges::none_of(other, [&](const Bounds& o) { return o.min == box.min && o.max == box.max; }))
        all.push_back(box);
  };
  add(a, b);
  add(b, a);
  return all;
}

float distance_to(const Bounds& box, const vec3& point) {
  return glm::length(glm::max(glm::max(box.min - point, point - box.max), vec3(0.0f)));
}

}  // namespace

bool ProbeTable::prepare(const scene::FrameSnapshot& snapshot, const ProbeGrid& grid, bool wanted) {
  std::vector<Bounds> doors;
  if (wanted) doors = finder_.find(snapshot, reach_of(grid), shared::kDdgiDoor);
  const std::shared_ptr<const formats::Bsp> map = wanted && snapshot.assets ? snapshot.assets->map : nullptr;
  bool anew = on_ && !staging_;  // memory ran out
  if (map != map_) {
    anew = true;
    map_ = map;
    graph_ = map && !map->models.empty() ? std::make_unique<LeafGraph>(map) : nullptr;
    const std::uint64_t bytes = graph_ ? std::uint64_t{shared::kDdgiMostProbes} * 4 * graph_->row_words() : 0;
    if (bytes > kMostRows) log_warning("the map has too many leafs for probes to know them");
    if (bytes > kMostRows || (graph_ && graph_->leafs() == 0)) graph_.reset();
  }
  // A door that is there once is waited for, so that a scene does not begin anew with each that goes.
  const bool on = graph_ || !doors.empty() || (on_ && wanted);
  anew = anew || on != on_ || !grid_.goes_on_as(grid);
  const bool moved = anew || grid_.first != grid.first;
  on_ = on;
  grid_ = grid;
  if (!on_) {
    elements_ = 1;
    standing_ = grid.probes();
    return anew;
  }
  if (anew) lay_out();
  const std::vector<Bounds> changed = of_one(doors, doors_);
  doors_ = std::move(doors);
  if (moved) {
    stand();
    if (graph_) write_starts();
  }
  if (moved || !changed.empty()) write_doors(changed);
  return anew;
}

void ProbeTable::lay_out() {
  const glm::ivec3 count = count_of(grid_);
  door_elements_ = grid_.probes();
  node_elements_ = door_elements_ + std::uint64_t{2} * shared::kDdgiDoor;
  const std::vector<shared::uvec4> nodes = graph_ ? graph_->nodes() : std::vector<shared::uvec4>();
  start_elements_ = node_elements_ + std::max<std::size_t>(nodes.size(), 2);
  const auto cubes = static_cast<std::uint64_t>((count.x + 1) * (count.y + 1) * (count.z + 1));
  row_elements_ = start_elements_ + elements_of(graph_ ? cubes : 0);
  elements_ = row_elements_ + elements_of(graph_ ? std::uint64_t{grid_.probes()} * graph_->row_words() : 0);
  staging_ = gpu::Buffer();
  staging_ = gpu::Buffer(device_, gpu::BufferUse::kUpload, elements_ * 16, "table of probes");
  std::memset(staging_.mapped(), 0, static_cast<std::size_t>(staging_.size()));
  if (!nodes.empty()) std::memcpy(words(node_elements_), nodes.data(), nodes.size() * sizeof(nodes[0]));
  cells_.assign(grid_.probes(), glm::ivec3(INT32_MIN));
  places_.assign(grid_.probes(), vec3(0.0f));
  stands_.assign(grid_.probes(), 0);
  doors_.clear();
  head_.add(0, row_elements_ * 16);
  rows_.add(row_elements_ * 16, elements_ * 16);
}

void ProbeTable::stand() {
  const glm::ivec3 first = first_of(grid_), count = count_of(grid_);
  std::uint32_t probe = 0;
  for (int z = 0; z < count.z; ++z)
    for (int y = 0; y < count.y; ++y)
      for (int x = 0; x < count.x; ++x, ++probe) {
        const glm::ivec3 cell(shared::ddgi_cell_of(x, first.x, count.x), shared::ddgi_cell_of(y, first.y, count.y),
                              shared::ddgi_cell_of(z, first.z, count.z));
        if (cells_[probe] != cell) place(probe, cell);
      }
  standing_ = static_cast<std::uint32_t>(std::ranges::count(stands_, 1));
}

void ProbeTable::place(std::uint32_t probe, const glm::ivec3& cell) {
  cells_[probe] = cell;
  const vec3 middle = place_in_grid(grid_, cell);
  const std::optional<vec3> found = graph_ ? graph_->open_place(middle, kMostOffset * grid_.spacing) : middle;
  stands_[probe] = found ? 1 : 0;
  const vec3 offset = found ? *found - middle : vec3(0.0f);
  for (int axis = 0; axis < 3; ++axis) words(probe)[axis] = std::bit_cast<std::uint32_t>(offset[axis]);
  words(probe)[3] = found ? 0 : shared::kDdgiNowhere;
  head_.add(std::uint64_t{probe} * 16, std::uint64_t{probe} * 16 + 16);
  places_[probe] = middle + offset;
  if (graph_) write_row(probe);
}

Bounds ProbeTable::around(std::uint32_t probe) const {
  const vec3 middle = place_in_grid(grid_, cells_[probe]);
  return {middle - grid_.spacing, middle + grid_.spacing};
}

void ProbeTable::write_row(std::uint32_t probe) {
  const std::uint64_t row_bytes = std::uint64_t{4} * graph_->row_words();
  const std::uint64_t begin = row_elements_ * 16 + probe * row_bytes;
  std::vector<std::uint32_t> row(graph_->row_words());
  if (stands_[probe] != 0) graph_->reached_from(places_[probe], around(probe), doors_, row);
  std::memcpy(static_cast<std::uint8_t*>(staging_.mapped()) + begin, row.data(), static_cast<std::size_t>(row_bytes));
  rows_.add(begin, begin + row_bytes);
}

void ProbeTable::write_starts() {
  constexpr float kAround = 0.1f;  // units: what a float may be off where a cube ends
  const glm::ivec3 first = first_of(grid_), count = count_of(grid_);
  std::uint32_t* to = words(start_elements_);
  steps_ = 0;
  for (int z = 0; z <= count.z; ++z)
    for (int y = 0; y <= count.y; ++y)
      for (int x = 0; x <= count.x; ++x) {
        const vec3 high = place_in_grid(grid_, first + glm::ivec3(x, y, z)), low = high - grid_.spacing;
        const LeafGraph::Start start = graph_->start_in({low - kAround, high + kAround});
        *to++ = static_cast<std::uint32_t>(start.at);
        steps_ = std::max(steps_, start.steps);
      }
  head_.add(start_elements_ * 16, row_elements_ * 16);
}

// Of each probe the two that are nearest among those between it and points that ask it; and who may ask it now.
void ProbeTable::write_doors(const std::vector<Bounds>& changed) {
  for (std::size_t i = 0; i < doors_.size(); ++i) {
    std::uint32_t* to = words(door_elements_ + 2 * i);
    for (int axis = 0; axis < 3; ++axis) {
      to[axis] = std::bit_cast<std::uint32_t>(doors_[i].min[axis]);
      to[4 + axis] = std::bit_cast<std::uint32_t>(doors_[i].max[axis]);
    }
  }
  for (std::uint32_t probe = 0; probe < grid_.probes(); ++probe) {
    if (stands_[probe] == 0) continue;
    const vec3 middle = place_in_grid(grid_, cells_[probe]);
    const Bounds near = around(probe);
    std::uint32_t nearest[2] = {};
    float distances[2] = {};
    for (std::uint32_t i = 0; i < doors_.size(); ++i) {
      if (!boxes_meet(doors_[i], near)) continue;
      const float distance = distance_to(doors_[i], middle);
      if (nearest[0] == 0 || distance < distances[0]) {
        nearest[1] = nearest[0], distances[1] = distances[0];
        nearest[0] = i + 1, distances[0] = distance;
      } else if (nearest[1] == 0 || distance < distances[1]) {
        nearest[1] = i + 1, distances[1] = distance;
      }
    }
    words(probe)[3] = nearest[0] | nearest[1] << 8u;
    const bool anew = std::ranges::any_of(changed, [&](const Bounds& door) { return boxes_meet(door, near); });
    if (graph_ && anew) write_row(probe);
  }
  head_.add(0, node_elements_ * 16);
}

void ProbeTable::fill(shared::DdgiConstants& c) const {
  c.stands = on_ ? 1 : 0;
  if (!on_) return;
  c.doors = static_cast<std::uint32_t>(doors_.size());
  c.table_doors = static_cast<std::uint32_t>(door_elements_);
  c.table_nodes = static_cast<std::uint32_t>(node_elements_);
  c.table_starts = static_cast<std::uint32_t>(4 * start_elements_);
  c.table_rows = static_cast<std::uint32_t>(4 * row_elements_);
  c.row_words = graph_ ? graph_->row_words() : 0;
  c.leaf_steps = steps_;
}

void ProbeTable::add_upload(PassList& list, const gpu::Buffer& table, bool all) {
  if (!on_) return;
  if (all) head_.add(0, elements_ * 16);
  std::vector<Range> ranges;
  for (Range* range : {&head_, &rows_}) {
    if (range->end > range->begin) ranges.push_back(*range);
    *range = Range();
  }
  if (ranges.empty()) return;
  list.add("probe table", PassKind::kEstimator, [this, &table, ranges](gpu::Commands& commands) {
    for (const Range& range : ranges) commands.copy(staging_, table, range.end - range.begin, range.begin, range.begin);
    commands.barrier();
  });
}

}  // namespace fb::render
