#include "host/engine.h"

#include "render/settings.h"

namespace fb::host {

Result<std::unique_ptr<Engine>> Engine::create(const std::vector<std::string>& arguments) {
  auto options = fs::options_from_arguments(arguments);
  if (!options) return options.error();
  auto files = fs::FileSystem::open(*options);
  if (!files) return Error{files.error().message + " (-basedir DIR says where the game data is: DIR holds id1)"};
  return std::unique_ptr<Engine>(new Engine(std::move(*files)));
}

Engine::Engine(fs::FileSystem files)
    : files_(std::move(files)), library_(files_.loader()), client_(console_, library_, files_.loader()) {
  console_.set_file_loader(files_.loader());
  render::register_render_cvars(console_);
}

}  // namespace fb::host
