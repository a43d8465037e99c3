#include "lab/bench/bench_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/hash.h"
#include "base/progress.h"
#include "lab/image_io.h"
#include "lab/jobs.h"
#include "render/shader_set.h"

namespace fb::lab {
namespace {

template <typename T>
std::uint64_t hash_vector(const std::vector<T>& items, std::uint64_t seed) {
  return hash_span(std::span<const T>(items), hash_bytes(nullptr, 0, seed ^ items.size()));
}
template <typename T>
std::uint64_t hash_value(const T& value, std::uint64_t seed) {
  static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
  return hash_bytes(&value, sizeof value, seed);
}

std::uint64_t material_key(const scene::Material& m, std::uint64_t key) {
  key = hash_vector(m.frames, hash_vector(m.alternate_frames, hash_vector(m.end_times, key)));
  const float numbers[] = {m.frames_per_second, m.base_color.x, m.base_color.y, m.base_color.z,
                           m.emission.x,        m.emission.y,   m.emission.z,   m.roughness,
                           m.specular,          m.metalness,    m.alpha,        m.absorption.x,
                           m.absorption.y,      m.absorption.z};
  key = hash_span(std::span<const float>(numbers), key);
  return hash_value(m.flags, hash_value(static_cast<std::uint32_t>(m.emission_kind), key));
}

std::uint64_t assets_key(const scene::Assets& assets) {
  std::uint64_t key = hash_bytes(&assets.palette, sizeof assets.palette);
  for (const scene::Image& image : assets.images)
    key =
        hash_vector(image.texels, hash_value(image.width, hash_value(static_cast<std::uint32_t>(image.encoding), key)));
  for (const scene::Material& material : assets.materials) key = material_key(material, key);
  for (const scene::Mesh& mesh : assets.meshes) {
    key = hash_vector(mesh.triangles, key);
    key = hash_vector(mesh.positions, hash_vector(mesh.normals, hash_vector(mesh.poses, key)));
    const float pose[] = {mesh.pose_scale.x,  mesh.pose_scale.y,  mesh.pose_scale.z,
                          mesh.pose_origin.x, mesh.pose_origin.y, mesh.pose_origin.z};
    key = hash_span(std::span<const float>(pose), key);
  }
  return key;
}

std::uint64_t sky_key(const scene::Sky& sky, std::uint64_t key) {
  const std::uint32_t images[] = {static_cast<std::uint32_t>(sky.mode), sky.solid, sky.alpha, sky.beyond_everything};
  key = hash_span(std::span<const std::uint32_t>(images), hash_bytes(&sky.color, sizeof sky.color, key));
  key = hash_span(std::span<const std::uint32_t>(sky.box), key);
  return hash_vector(sky.suns, key);
}

std::uint64_t settings_key(const render::RenderSettings& s) {
  const float numbers[] = {
#define FB_NUMBER(type, field, cvar, value, low, high, help) static_cast<float>(s.field),
      FB_RENDER_SETTINGS(FB_NUMBER)
#undef FB_NUMBER
  };
  return hash_span(std::span<const float>(numbers), hash_bytes(s.estimator.data(), s.estimator.size()));
}

std::optional<Reference> kept_reference(const std::string& path, const ReferenceOptions& options) {
  std::error_code ignored;
  if (path.empty() || !std::filesystem::exists(path, ignored)) return std::nullopt;
  auto picture = read_exr_picture(path);
  if (!picture || picture->content.mean.width != options.width || picture->content.mean.height != options.height)
    return std::nullopt;  // made anew, over it
  return std::move(picture->content);
}

Status keep_reference(const std::string& path, const Reference& reference) {
  ExrImage exr(reference.mean.width, reference.mean.height);
  exr.add_colors("", reference.mean.pixels);
  exr.add_colors("variance.", reference.variance);
  return write_exr(path, exr);
}

}  // namespace

Picture picture_of(const std::vector<vec4>& linear, uvec2 size) {
  Picture picture{size.x, size.y, std::vector<vec3>(linear.size())};
  std::transform(linear.begin(), linear.end(), picture.pixels.begin(), [](const vec4& p) { return vec3(p); });
  return picture;
}

scene::FrameSnapshot held(scene::FrameSnapshot s, double frames_per_second) {
  s.prev_time = s.time - 1.0 / frames_per_second;
  s.prev_camera = s.camera;
  s.cut = false;
  for (scene::Instance& instance : s.instances) {
    instance.prev_transform = instance.transform;
    instance.prev_pose = instance.pose;
    instance.flags &= ~static_cast<std::uint32_t>(scene::kInstanceNew);
  }
  return s;
}

std::uint64_t content_key(const scene::FrameSnapshot& s) {
  static_assert(sizeof(scene::Instance) == 4 * 43, "hashed as bytes: no padding");
  std::uint64_t key = s.assets ? assets_key(*s.assets) : 0;
  key = hash_vector(s.instances, key);
  key = sky_key(s.sky, hash_bytes(&s.camera, sizeof s.camera, key));
  key = hash_value(s.camera_liquid, hash_bytes(&s.medium, sizeof s.medium, key));
  return hash_value(s.time, hash_bytes(&s.ambient, sizeof s.ambient, key));
}

scene::FrameSnapshot View::at(std::uint32_t run, std::uint32_t index) const {
  scene::FrameSnapshot snapshot = snapshots[still ? 0 : index];
  snapshot.frame = std::uint64_t{run} * frames() + index;
  if (index == 0) snapshot.cut = true;
  return snapshot;
}

Result<View> collect_view(FrameSource& source, const ViewOptions& options) {
  View view;
  view.warmup = options.warmup;
  view.measured = static_cast<std::uint32_t>(options.last - options.first + 1);
  const std::uint64_t begin =
      options.hold ? options.first : options.first - std::min<std::uint64_t>(options.warmup, options.first);
  const std::uint64_t end = options.hold ? options.first : options.last;
  std::uint64_t key = 0;
  bool alike = true;
  for (std::uint64_t frame = 0; frame <= end; ++frame) {
    scene::FrameSnapshot snapshot;
    const auto more = source.next(snapshot);
    if (!more) return more.error();
    if (!*more) return Error{fmt::format("there is no frame {}: the demo has {} frames at this rate", frame, frame)};
    if (frame < begin) continue;
    const std::uint64_t this_key = content_key(snapshot);
    alike = alike && (view.snapshots.empty() || this_key == key);
    key = this_key;
    view.snapshots.push_back(std::move(snapshot));
  }
  view.still = alike;
  if (view.still) {
    view.snapshots = {held(view.snapshots.back(), options.frames_per_second)};
  } else if (options.first < options.warmup) {
    return Error{fmt::format("--warmup {}: the view moves, and only {} frames come before --frames {}:{}",
                             options.warmup, options.first, options.first, options.last)};
  }
  return view;
}

Result<std::vector<Reference>> make_references(const View& view, gpu::Device& device, render::RenderSettings settings,
                                               const ReferenceOptions& options) {
  settings.estimator = options.estimator;
  if (!options.folder.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) return Error{fmt::format("{}: {}", options.folder, failed.message())};
  }
  std::unique_ptr<render::Renderer> renderer;  // when the first is to be made
  const std::uint32_t count = view.still ? 1 : view.measured;
  const std::uint64_t settings_hash = settings_key(settings) ^ render::shader_hash(options.estimator);
  std::vector<Reference> references;
  Progress progress("reference sample", std::uint64_t{count} * options.spp, {.quiet = options.quiet});
  for (std::uint32_t i = 0; i < count; ++i) {
    const scene::FrameSnapshot snapshot = view.at(0, view.still ? 0 : view.warmup + i);
    const std::uint32_t shape[] = {options.spp, options.width, options.height};
    const std::uint64_t key = hash_span(std::span<const std::uint32_t>(shape), content_key(snapshot) ^ settings_hash);
    const std::string path = options.folder.empty() ? "" : fmt::format("{}/{:016x}.exr", options.folder, key);
    if (auto kept = kept_reference(path, options)) {
      references.push_back(std::move(*kept));
      continue;
    }
    if (!renderer) {
      auto made = render::Renderer::create(device, settings);
      if (!made) return made.error();
      renderer = std::move(*made);
      renderer->resize(options.width, options.height);
    }
    RenderSummary ignored;
    render_samples(*renderer, settings, snapshot, options.spp, ignored,
                   [&](std::uint32_t done) { progress.update(std::uint64_t{i} * options.spp + done); });
    Reference reference{picture_of(renderer->read().linear(), renderer->render_size()), {}};
    if (renderer->accumulated_frames() > 1)
      reference.variance = picture_of(renderer->read().variance_of_mean(), renderer->render_size()).pixels;
    if (!path.empty() && !reference.variance.empty()) {
      if (auto status = keep_reference(path, reference); !status) return status.error();
    }
    references.push_back(std::move(reference));
  }
  return references;
}

}  // namespace fb::lab
