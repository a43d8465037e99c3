#include "lab/lambert_source.h"

#include <memory>
#include <utility>

namespace fb::lab {
namespace {

class LambertSource : public FrameSource {
 public:
  explicit LambertSource(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    auto more = source_->next(snapshot);
    if (!more || !*more || !snapshot.assets) return more;
    const scene::Assets& assets = *snapshot.assets;
    // Assets only grow within a generation.
    const bool same =
        lambert_ && lambert_->generation == assets.generation && lambert_->images.size() == assets.images.size() &&
        lambert_->materials.size() == assets.materials.size() && lambert_->meshes.size() == assets.meshes.size();
    if (!same) {
      auto copy = std::make_shared<scene::Assets>(assets);
      for (scene::Material& m : copy->materials) {
        m.specular = m.metalness = 0.0f;
        m.roughness = 1.0f;
        for (auto* frames : {&m.frames, &m.alternate_frames})
          for (scene::TextureSet& set : *frames) set.normal = set.gloss = scene::kNone;
      }
      lambert_ = std::move(copy);
    }
    snapshot.assets = lambert_;
    return more;
  }

 private:
  std::unique_ptr<FrameSource> source_;
  std::shared_ptr<const scene::Assets> lambert_;
};

}  // namespace

std::unique_ptr<FrameSource> lambert_source(std::unique_ptr<FrameSource> source) {
  return std::make_unique<LambertSource>(std::move(source));
}

}  // namespace fb::lab
