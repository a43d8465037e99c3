// FormerInstances: where each instance of the former frame's table is in this frame's, for samples that name one.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace fb::render {

class FormerInstances {
 public:
  struct Row {
    std::uint32_t id;    // scene::Instance::id, unique in a frame
    std::uint32_t mesh;  // with another one it is another thing: triangles are numbered by it
    bool is_new;         // it was not in the former frame, whatever had its id then
  };
  // This frame's instances in their order, once a frame.
  void begin_frame(std::vector<Row> rows);
  void forget() { rows_.clear(); }
  // Of each of the former frame: its index in this one, or shared::kNoIndex.
  const std::vector<std::uint32_t>& places() const { return places_; }

 private:
  std::vector<Row> rows_;
  std::vector<std::uint32_t> places_;
  std::unordered_map<std::uint32_t, std::uint32_t> by_id_;
};

}  // namespace fb::render
