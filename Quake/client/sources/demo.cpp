#include "client/sources/demo.h"

#include <fmt/format.h>

#include <algorithm>

namespace fb::cl {

std::string demo_path(std::string_view name) {
  const std::size_t slash = name.find_last_of("/\\");
  const std::size_t dot = name.rfind('.');
  const bool has_extension = dot != std::string_view::npos && (slash == std::string_view::npos || dot > slash);
  return std::string(name) + (has_extension ? "" : ".dem");
}

std::string TimeDemoResult::line() const {
  return fmt::format("{} frames {:5.1f} seconds {:5.1f} fps", frames, seconds, fps());
}

Result<DemoPlayback> DemoPlayback::open(FileData data, std::string_view name, DemoMode mode, std::uint64_t frame,
                                        double now) {
  auto reader = formats::DemReader::open(data, name);
  if (!reader.ok()) return reader.error();
  DemoPlayback demo(std::move(data), std::move(*reader));
  demo.name_ = name;
  demo.mode_ = mode;
  demo.start_frame_ = frame;
  demo.start_time_ = now;
  return demo;
}

bool DemoPlayback::due(bool signed_on, double time, double latest, std::uint64_t frame, double now) {
  if (!signed_on) return true;
  if (mode_ == DemoMode::kPlay) return time > latest;
  if (last_frame_ == frame) return false;
  last_frame_ = frame;
  if (frame == start_frame_ + 1) start_time_ = now;
  return true;
}

Result<formats::DemMessage> DemoPlayback::next() {
  message_offset_ = reader_.offset();
  auto message = reader_.next();
  if (message.ok()) ++messages_read_;
  return message;
}

void DemoPlayback::go_to(const DemoPlace& place) {
  reader_.seek(place.offset);
  messages_read_ = place.messages;
}

const DemoIndex& DemoPlayback::index() {
  if (!index_) index_ = read_demo_index({data_.data(), data_.size()}, name_);
  return *index_;
}

std::string DemoPlayback::message_name() const { return fmt::format("{}, message at {}", name_, message_offset_); }

TimeDemoResult DemoPlayback::result(std::uint64_t frame, double now) const {
  TimeDemoResult result;
  result.demo = name_;
  result.frames = std::max(0, static_cast<int>(frame - start_frame_) - 1);
  result.seconds = now - start_time_;
  if (!(result.seconds > 0.0)) result.seconds = 1.0;
  return result;
}

}  // namespace fb::cl
