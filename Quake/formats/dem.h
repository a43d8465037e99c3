// Demo files: one line with the CD track, then messages, each with the view angles at its time (degrees; angles that
// are not finite are read as 0).
#pragma once

#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"

namespace fb::formats {

struct DemMessage {
  vec3 view_angles;
  ByteView data;  // into the file's bytes
};
constexpr std::size_t kMaxDemMessage = 65536;  // QuakeSpasm's MAX_MSGLEN

// Reads a demo message by message; the bytes must outlive the reader.
class DemReader {
 public:
  static Result<DemReader> open(ByteView data, std::string_view name);
  int cd_track() const { return cd_track_; }
  bool at_end() const { return reader_.remaining() == 0; }
  // Reads one message; an error names the offset at which the file is truncated or contradicts itself.
  Result<DemMessage> next();
  std::size_t offset() const { return reader_.offset(); }
  // Goes on at an offset that offset() gave between two messages.
  void seek(std::size_t offset) { reader_.seek(offset); }

 private:
  explicit DemReader(ByteReader reader) : reader_(std::move(reader)) {}
  ByteReader reader_;
  int cd_track_ = -1;
};

// Appends one message in the file's format to `out` (for recording).
void append_dem_message(Bytes& out, const vec3& view_angles, ByteView data);

}  // namespace fb::formats
