// AuthoredMap: a library's map lit as its author lit it. Found on a thread beside the game; frames that begin before it
// is done have the light that the map's keys and textures ask for.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "scene/authored/authored_light.h"
#include "scene/library/library.h"
#include "scene/snapshot.h"

namespace fb::scene {

// Where what was found is kept from run to run.
struct AuthoredStore {
  std::function<std::optional<FileData>(std::uint64_t key)> read;
  std::function<void(std::uint64_t key, const Bytes& bytes)> write;
  std::function<std::string(std::uint64_t key)> name;  // as sentences have it
};

class AuthoredMap {
 public:
  explicit AuthoredMap(ModelLibrary& library) : library_(library) {}
  // Before the first map; none: every map is looked at anew.
  void set_store(AuthoredStore store) { store_ = std::move(store); }

  // What was found of the library's map; null where it has no baked light, and until it is found. The first question
  // about a map begins the work; the first one after its end changes the library's materials.
  const AuthoredLight* light();
  void wait();  // until there is an answer

  // Of what is found, for each frame: the library's EntityLights so that none hides another's light, factors on them,
  // the even light, and the sky with its suns.
  const std::vector<EntityLight>& lamps() const { return apart_; }
  vec3 lamp_factor(std::size_t lamp) const { return lamp < lamps_.size() ? lamps_[lamp] : vec3(1.0f); }
  const vec3& ambient() const { return ambient_; }
  const GainTable& gains() const { return gains_; }
  void light_sky(Sky& sky) const;

  // Whether the view of the map's baked light is wanted.
  void show_baked(bool wanted) { shows_baked_ = wanted; }
  bool shows_baked() const { return shows_baked_; }
  BakedTable baked();  // without styles; the first question about a map makes it

 private:
  void look_at_map();
  void take();
  void apply(const AuthoredLight& light);

  ModelLibrary& library_;
  AuthoredStore store_;
  std::uint64_t key_ = 0;                    // of the map
  std::shared_ptr<const formats::Bsp> map_;  // that all below is of
  std::shared_ptr<const Lightmaps> lightmaps_;
  std::optional<AuthoredLight> light_;
  std::vector<EntityLight> apart_;
  std::vector<vec3> lamps_, suns_;
  vec3 ambient_{0.0f}, even_sky_{0.0f};
  GainTable gains_;
  bool shows_baked_ = false;
  BakedTable baked_;
  std::unique_ptr<AuthoredTask> task_;  // last: it reads the map
};

}  // namespace fb::scene
