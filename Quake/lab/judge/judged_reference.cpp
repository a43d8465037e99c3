#include "lab/content_key.h"
#include "lab/judge/judged_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/hash.h"
#include "base/number.h"
#include "base/progress.h"
#include "lab/image_io.h"
#include "lab/reference/replicates.h"
#include "shared/color.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kFormat = 4;  // of the kept files
constexpr const char* kExposureText = "fullbright.exposure";

template <typename Item, typename Part>
std::vector<float> plane(const std::vector<Item>& items, const Part& part) {
  std::vector<float> values(items.size());
  std::transform(items.begin(), items.end(), values.begin(),
                 [&](const Item& i) { return static_cast<float>(part(i)); });
  return values;
}

Status keep(const std::string& path, const JudgedReference& reference) {
  ExrImage exr(reference.guides.width, reference.guides.height);
  exr.add_colors("", reference.radiance.mean.pixels);
  exr.add_colors("variance.", reference.radiance.variance);
  exr.add_channel("motion.X", plane(reference.guides.motion, [](const vec2& v) { return v.x; }));
  exr.add_channel("motion.Y", plane(reference.guides.motion, [](const vec2& v) { return v.y; }));
  exr.add_channel("Z", reference.guides.depth);
  exr.add_channel("previous.Z", reference.guides.depth_before);
  exr.add_channel("id", plane(reference.guides.id, [](std::uint32_t id) { return id; }));  // below 2^24: exact
  exr.add_channel("emission", reference.guides.emission);
  exr.set_text(kExposureText, fmt::format("{}", reference.exposure));
  return write_exr(path, exr);
}

// None where the file is missing, or is not a whole reference of this size: it is made again, over it.
std::optional<JudgedReference> kept(const std::string& path, const JudgedReferenceOptions& options) {
  std::error_code ignored;
  if (path.empty() || !std::filesystem::exists(path, ignored)) return std::nullopt;
  auto picture = read_exr_picture(path);
  const auto exr = read_exr(path);
  if (!picture || !exr || exr->width() != options.width || exr->height() != options.height) return std::nullopt;
  const auto channel = [&](const char* name) { return exr->channel(name); };
  const auto *x = channel("motion.X"), *y = channel("motion.Y"), *id = channel("id");
  const auto *depth = channel("Z"), *before = channel("previous.Z"), *emission = channel("emission");
  const auto exposure = exr->texts().find(kExposureText);
  if (x == nullptr || y == nullptr || id == nullptr || depth == nullptr || before == nullptr || emission == nullptr ||
      picture->content.variance.empty() || exposure == exr->texts().end())
    return std::nullopt;
  JudgedReference reference;
  reference.radiance = std::move(picture->content);
  reference.exposure = static_cast<float>(parse_number(exposure->second).value_or(1.0));
  reference.guides = {options.width, options.height, std::vector<vec2>(x->size()),
                      *depth,        *before,        std::vector<std::uint32_t>(id->size()),
                      *emission};
  for (std::size_t i = 0; i < x->size(); ++i) {
    reference.guides.motion[i] = {(*x)[i], (*y)[i]};
    reference.guides.id[i] = static_cast<std::uint32_t>((*id)[i]);
  }
  return reference;
}

Guides read_guides(const render::Renderer& renderer) {
  const uvec2 size = renderer.render_size();
  Guides guides{size.x, size.y, {}, {}, {}, {}, {}};
  for (const shared::GBufferTexel& texel : renderer.read().gbuffer()) {
    guides.motion.emplace_back(texel.motion.x, texel.motion.y);
    guides.depth.push_back(texel.motion.z);
    guides.depth_before.push_back(texel.motion.w);
    guides.id.push_back(texel.id);
    guides.emission.push_back(shared::luminance(vec3(texel.emission_specular)));
  }
  return guides;
}

render::RenderSettings reference_settings(render::RenderSettings settings, const JudgedReferenceOptions& options) {
  settings.estimator = options.estimator;
  settings.jitter = 1;
  settings.denoise = 0;
  settings.scale = 1;
  return settings;
}

}  // namespace

std::uint64_t reference_key(const scene::FrameSnapshot& snapshot, const render::RenderSettings& settings,
                            const JudgedReferenceOptions& options) {
  std::string text =
      fmt::format("{} {} {} {}x{}", kFormat, options.estimator, options.spp, options.width, options.height);
  // All rows but those of the denoiser, of the list of lights and of techniques, which leave the mean as it is.
#define FB_TEXT(type, field, cvar, value, low, high, help) text += fmt::format(" " cvar "={}", settings.field);
  FB_FRAME_SETTINGS(FB_TEXT)
  FB_RENDERER_SETTINGS(FB_TEXT)
  FB_EMISSION_SETTINGS(FB_TEXT)
#undef FB_TEXT
  return hash_bytes(text.data(), text.size(), content_key(snapshot));
}

Result<std::vector<JudgedReference>> make_judged_references(const View& view, render::Renderer& renderer,
                                                            render::RenderSettings settings,
                                                            const JudgedReferenceOptions& options) {
  if (!options.folder.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) return Error{fmt::format("{}: {}", options.folder, failed.message())};
  }
  settings = reference_settings(settings, options);
  renderer.resize(options.width, options.height);
  const auto count = static_cast<std::uint64_t>(view.snapshots.size());
  std::vector<JudgedReference> references;
  Progress progress(options.label + ", reference sample", count * options.spp, {.quiet = options.quiet});
  for (const scene::FrameSnapshot& snapshot : view.snapshots) {
    const std::uint64_t key = reference_key(snapshot, settings, options);
    const std::string path = options.folder.empty() ? "" : fmt::format("{}/{:016x}.exr", options.folder, key);
    auto reference = kept(path, options);
    if (!reference) {
      const std::uint64_t before = references.size() * options.spp;
      reference.emplace();
      reference->radiance = render_replicates(renderer, settings, snapshot, options.spp,
                                              [&](std::uint32_t done) { progress.update(before + done); });
      reference->exposure = renderer.read().exposure();
      render::RenderSettings now = settings;
      now.jitter = 0;
      now.spp = 1;
      now.accumulate = 0;
      renderer.render(snapshot, nullptr, now);
      reference->guides = read_guides(renderer);
      if (!path.empty()) {
        if (auto status = keep(path, *reference); !status) return status.error();
      }
    }
    reference->tone_map = settings.tone_map != 0;
    references.push_back(std::move(*reference));
  }
  return references;
}

}  // namespace fb::lab
