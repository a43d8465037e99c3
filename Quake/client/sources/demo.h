// A demo that plays: its bytes, its reader, and when the next message is due. The rules of timedemo are Quake's: while
// the signon messages last they are read without end; then each frame reads one. So the first frame reads the signon,
// its first update and one message more; a change of level inside the demo takes one frame: that of its svc_serverinfo,
// which begins the signon anew, and of all that follows up to the first update. The frame that started the demo and the
// one in which it ended do not count, and the clock starts with the second frame.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/file_data.h"
#include "base/result.h"
#include "client/sources/demo_index.h"
#include "client/sources/demo_mode.h"
#include "formats/dem.h"

namespace fb::cl {

class DemoPlayback {
 public:
  // `frame` is the number of the frame in which it starts.
  static Result<DemoPlayback> open(FileData data, std::string_view name, DemoMode mode, std::uint64_t frame,
                                   double now);

  const std::string& name() const { return name_; }
  DemoMode mode() const { return mode_; }
  std::size_t messages_read() const { return messages_read_; }
  bool at_end() const { return reader_.at_end(); }
  int cd_track() const { return reader_.cd_track(); }  // played instead of the server's; -1: none

  // Is a message due in this frame? `time`: the client's; `latest`: the latest message's (seconds); `now`: the clock.
  bool due(bool signed_on, double time, double latest, std::uint64_t frame, double now);
  Result<formats::DemMessage> next();
  // "demo1.dem, message at 1234": what errors call the message that next() returned last.
  std::string message_name() const;

  // Where the next message is.
  DemoPlace place() const { return {reader_.offset(), messages_read_}; }
  void go_to(const DemoPlace& place);
  // What is where in it: read from the file when it is first asked for.
  const DemoIndex& index();

  TimeDemoResult result(std::uint64_t frame, double now) const;

 private:
  DemoPlayback(FileData data, formats::DemReader reader) : data_(std::move(data)), reader_(std::move(reader)) {}

  FileData data_;  // where the reader reads
  formats::DemReader reader_;
  std::string name_;
  DemoMode mode_ = DemoMode::kPlay;
  std::uint64_t start_frame_ = 0;
  std::optional<std::uint64_t> last_frame_;  // that read a message
  double start_time_ = 0.0;
  std::size_t messages_read_ = 0, message_offset_ = 0;
  std::optional<DemoIndex> index_;
};

// "demo1" -> "demo1.dem"; a name that has an extension keeps it.
std::string demo_path(std::string_view name);

}  // namespace fb::cl
