// A demo that is being recorded: the CD track's line, then each message as it came with the view angles of that moment,
// and svc_disconnect at the end: what every NetQuake engine plays. It grows under NAME.dem.part and gets its name when
// it is whole, so that a demo that was there before is there until then, and no half-written one can be taken for one.
// Where the disk is full it ends early, and is whole all the same.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"

namespace fb::cl {

class DemoRecorder {
 public:
  // The demo will be `path`; its folder is made. track -1: the server's own choice of music. Fails where nothing can be
  // written, and where another program records a demo of this name. What a recording that was cut short has left under
  // the .part name is moved out of the way and named in the log.
  static Result<DemoRecorder> start(const std::filesystem::path& path, int track);
  DemoRecorder(DemoRecorder&&) noexcept;
  DemoRecorder& operator=(DemoRecorder&&) noexcept;
  // A recorder that is not finished leaves its .part.
  ~DemoRecorder();

  // Fails where the disk is full, say; then cut_short() is the last call.
  Status add(const vec3& view_angles, ByteView message);
  // Ends the demo, and gives it its name. Fails as add() does.
  Status finish(const vec3& view_angles);
  // After a failure: the demo ends with what was written whole, in whose last message's place its end fits. Returns its
  // name: its own, or, since it is not all that it was to be, a free one where there is a demo of that name. Fails
  // where there is no such message, or the file is lost; a .part is left then.
  Result<std::filesystem::path> cut_short();
  const std::filesystem::path& path() const;

 private:
  struct File;
  explicit DemoRecorder(std::unique_ptr<File> file);
  std::unique_ptr<File> file_;
};

}  // namespace fb::cl
