#include "lab/camera_source.h"

#include <utility>

namespace fb::lab {
namespace {

class CameraSource : public FrameSource {
 public:
  CameraSource(std::unique_ptr<FrameSource> source, const scene::Camera& camera)
      : source_(std::move(source)), camera_(camera) {}

  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    auto more = source_->next(snapshot);
    if (!more || !*more) return more;
    for (scene::Camera* own : {&snapshot.camera, &snapshot.prev_camera}) {
      own->position = camera_.position;
      own->angles = camera_.angles;
      if (camera_.fov_x <= 0) continue;
      own->fov_x = camera_.fov_x;
      own->fov_y = camera_.fov_y;
    }
    return more;
  }

 private:
  std::unique_ptr<FrameSource> source_;
  scene::Camera camera_;
};

}  // namespace

std::unique_ptr<FrameSource> camera_source(std::unique_ptr<FrameSource> source, const scene::Camera& camera) {
  return std::make_unique<CameraSource>(std::move(source), camera);
}

}  // namespace fb::lab
