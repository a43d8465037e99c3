// Engine: what every way of running needs of the game: files, console, models, client; put together here and nowhere
// else. No device, no window.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "client/client.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "scene/library.h"

namespace fb::host {

class Engine {
 public:
  // `arguments`: the command line without the program's name; those about files are taken (fs/options.h).
  // Fails with a sentence that says what to give where there is no game data.
  static Result<std::unique_ptr<Engine>> create(const std::vector<std::string>& arguments);

  con::Console& console() { return console_; }
  fs::FileSystem& files() { return files_; }
  scene::ModelLibrary& library() { return library_; }
  cl::Client& client() { return client_; }

 private:
  explicit Engine(fs::FileSystem files);
  fs::FileSystem files_;
  con::Console console_;
  scene::ModelLibrary library_;
  cl::Client client_;
};

}  // namespace fb::host
