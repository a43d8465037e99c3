#include "lab/client_source.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "fs/file.h"

namespace fb::lab {
namespace {

// Frame 0 is the first at which the client has a world; every later one is a step of time further.
class ClientSource : public FrameSource {
 public:
  ClientSource(cl::Client& client, double step, bool demo) : client_(client), step_(step), demo_(demo) {}

  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    if (!started_) {
      // Signon messages are read at once; a demo that never gets through them is not one.
      constexpr int kMaxSignonSteps = 10000;
      for (int i = 0; !client_.active() && i < kMaxSignonSteps; ++i) {
        client_.advance(0.0);
        if (demo_ && !client_.playing()) break;
      }
      if (!client_.active()) return failure("ends before there is anything to see");
      started_ = true;
    } else {
      client_.advance(step_);
    }
    if (demo_ && !client_.playing()) {
      if (client_.last_error()) return *client_.last_error();
      return false;
    }
    client_.settle();
    client_.build_snapshot(snapshot);
    return true;
  }

 private:
  Error failure(std::string_view why) const {
    if (client_.last_error()) return *client_.last_error();
    return Error{fmt::format("{}: {}", demo_ ? client_.demo_name() : "map", why)};
  }

  cl::Client& client_;
  double step_;
  bool demo_;
  bool started_ = false;
};

std::unique_ptr<FrameSource> make(cl::Client& client, const ClientSourceOptions& options, bool demo) {
  client.set_view_size(options.width, options.height);
  client.set_camera(options.camera);
  return std::make_unique<ClientSource>(client, 1.0 / options.frames_per_second, demo);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> demo_source(cl::Client& client, std::string_view demo,
                                                 const ClientSourceOptions& options) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(demo, ignored)) {
    auto data = fs::read_whole_file(demo);
    if (!data) return data.error();
    if (auto status = client.start_demo(*std::move(data), demo, cl::DemoMode::kPlay); !status) return status.error();
  } else if (auto status = client.start_demo(demo, cl::DemoMode::kPlay); !status) {
    return status.error();
  }
  return make(client, options, true);
}

Result<std::unique_ptr<FrameSource>> map_source(cl::Client& client, std::string_view map,
                                                const ClientSourceOptions& options) {
  if (auto status = client.map_view(map); !status) return status.error();
  return make(client, options, false);
}

}  // namespace fb::lab
