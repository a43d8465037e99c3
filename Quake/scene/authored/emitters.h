// What gives light in a map, as groups whose powers can be asked of its baked light: each light entity (where there are
// too many, those near each other as one), each texture that glows, each sun, the sky, the even light.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/maths.h"
#include "formats/bsp.h"
#include "scene/library/lit_map.h"

namespace fb::scene {

enum class EmitterKind { kLamp, kTexture, kSun, kSky, kAmbient };

struct Emitter {
  EmitterKind kind = EmitterKind::kLamp;
  std::string name;
  std::uint32_t index = 0;           // kTexture: material; kSun: Sky::suns
  std::vector<std::uint32_t> lamps;  // kLamp: EntityLights
  int style = 0;
  float fall_scale = 0.0f;  // kTexture: of the linear law of distance; 0: the square's
  // As the map's rules have it. kTexture, kSky, kAmbient: radiance; kSun: irradiance / pi; kLamp: radiance times
  // radius^2, of all of them.
  vec3 power{0.0f};
  vec3 own{0.0f};  // the same without what was lent to emitters that are dark or not there, so that they can be fitted
  // The factor on its own power that gives `factor` times `power`.
  vec3 cast(const vec3& factor) const { return power * factor / glm::max(own, vec3(1e-4f)); }
};

// A piece of a face that glows, small beside what it lights.
struct EmitterPatch {
  vec3 middle, normal;
  float area;
  std::uint32_t emitter;
};

// Patches of one emitter that lie near each other and face one way: from afar they are one.
struct PatchCluster {
  std::uint32_t first, end;  // patches
  std::uint32_t emitter;
  vec3 middle, normal;  // of their area
  float area, radius;   // of a ball about the middle that has all patches' middles
};

struct MapEmitters {
  std::vector<Emitter> all;
  std::vector<EmitterPatch> patches;   // of kTexture, by cluster
  std::vector<PatchCluster> clusters;  // by emitter
};

// The world's faces and those of the submodels.
std::vector<std::uint32_t> shown_faces(const LitMap& map);

MapEmitters find_emitters(const LitMap& map);

}  // namespace fb::scene
