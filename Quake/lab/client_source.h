// Frames from game data: a demo in fixed time steps, or a map's world.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "client/client.h"
#include "lab/frame_source.h"

namespace fb::lab {

struct ClientSourceOptions {
  double frames_per_second = 60.0;
  std::optional<scene::Camera> camera;  // instead of the player's eyes
  int width = 640, height = 360;        // for the field of view
};
// The client must outlive the source. A demo is a file on disk where there is one of that name, else the game's.
Result<std::unique_ptr<FrameSource>> demo_source(cl::Client& client, std::string_view demo,
                                                 const ClientSourceOptions& options);
Result<std::unique_ptr<FrameSource>> map_source(cl::Client& client, std::string_view map,
                                                const ClientSourceOptions& options);

}  // namespace fb::lab
