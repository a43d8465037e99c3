#include "scene/authored/authored_map.h"

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "scene/authored/authored_bytes.h"
#include "scene/authored/baked_words.h"
#include "scene/authored/lamps_apart.h"

namespace fb::scene {

void AuthoredMap::look_at_map() {
  auto map = library_.shared_map();
  if (map == map_) return;
  task_.reset();
  light_.reset();
  baked_ = {};
  map_ = std::move(map);
  lightmaps_ = library_.lightmaps();
  // The base game's lights are made for this renderer, and its lightmaps for others.
  if (!map_ || !lightmaps_ || lightmaps_->empty() || library_.of_base_game()) return;
  const LitMap lit = library_.lit_map();
  if (store_.read) {
    key_ = authored_key(lit, *lightmaps_);
    if (const auto kept = store_.read(key_)) {
      light_ = read_authored(ByteView(kept->data(), kept->size()), key_, lit);
      if (!light_)
        log_warning("{}: the light kept from an earlier run is damaged; it is found anew", store_.name(key_));
    }
  }
  if (light_) {
    apply(*light_);
    return log_info("light as baked: {} emitters, kept from an earlier run", light_->emitters.all.size());
  }
  task_ = std::make_unique<AuthoredTask>(lit, *lightmaps_);
}

void AuthoredMap::take() {
  light_ = task_->take();
  task_.reset();
  if (!light_) return log_info("the map's baked light says nothing: it is lit by its keys and textures");
  apply(*light_);
  log_info("light as baked: {} emitters at {} points, {:.2f} stops off, {:.2f} before, {:.2f} s",
           light_->emitters.all.size(), light_->points, light_->fit.stops_after, light_->fit.stops_before,
           light_->seconds);
  if (!light_->lit_through.empty())
    log_info("{} brush entities cast no shadow: their places were baked with light that came through them",
             light_->lit_through.size());
  if (store_.write) store_.write(key_, authored_bytes(*light_, key_));
}

const AuthoredLight* AuthoredMap::light() {
  look_at_map();
  if (task_ && task_->ready()) take();
  return light_ ? &*light_ : nullptr;
}

void AuthoredMap::wait() {
  look_at_map();
  if (task_) take();
}

BakedTable AuthoredMap::baked() {
  look_at_map();
  if (baked_.image == kNone && map_ != nullptr && lightmaps_ != nullptr && !lightmaps_->empty()) {
    baked_.image = library_.add_words(baked_words(*map_, *lightmaps_));
    baked_.faces = static_cast<std::uint32_t>(lightmaps_->faces().size());
  }
  return baked_;
}

void AuthoredMap::apply(const AuthoredLight& light) {
  const LitMap map = library_.lit_map();
  library_.let_light_through(light.lit_through);
  apart_ = lamps_apart(map.bsp, map.lamps);
  lamps_.assign(map.lamps.size(), vec3(1.0f));
  suns_.assign(map.suns.size(), vec3(1.0f));
  even_sky_ = vec3(0.0f);
  vec3 sky_cast(1.0f);  // of a sky as painted by itself
  for (std::size_t i = 0; i < light.emitters.all.size(); ++i) {
    const Emitter& emitter = light.emitters.all[i];
    const vec3& factor = light.fit.factors[i];
    switch (emitter.kind) {
      case EmitterKind::kLamp:
        for (const std::uint32_t lamp : emitter.lamps) lamps_[lamp] = factor;
        break;
      case EmitterKind::kTexture:
        library_.set_cast(emitter.index, factor, emitter.fall_scale, emitter.style);
        break;
      case EmitterKind::kSun:
        suns_[emitter.index] = factor;
        break;
      case EmitterKind::kSky: {
        // A sky too dark to be made bright by a factor shines evenly besides.
        const bool dark = glm::any(glm::lessThan(emitter.own, 0.25f * emitter.power));
        if (dark)
          even_sky_ = emitter.power * factor;
        else
          sky_cast = emitter.cast(factor) * library_.map_sky().color;
        break;
      }
      case EmitterKind::kAmbient:
        ambient_ = emitter.power * factor;
        break;
    }
  }
  const auto assets = library_.assets();
  for (std::uint32_t m = 0; m < assets->materials.size(); ++m)
    if (assets->materials[m].emission_kind == EmissionKind::kSky) library_.set_cast(m, sky_cast);
  for (vec3& sun : suns_) sun /= glm::max(sky_cast, vec3(1e-3f));  // suns shine through the sky's material
  const GainField& field = light.gains;
  gains_ = {};
  if (!field.empty())
    gains_ = {library_.add_words(field.cells), field.origin, field.side, field.width, field.depth, field.height};
}

void AuthoredMap::light_sky(Sky& sky) const {
  sky.color = vec3(1.0f);
  sky.even = even_sky_;
  for (std::size_t i = 0; i < std::min(sky.suns.size(), suns_.size()); ++i) sky.suns[i].irradiance *= suns_[i];
}

}  // namespace fb::scene
