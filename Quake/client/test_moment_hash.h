// For tests: one number for all that a client knows at a moment, and for all that it shows. Two moments that differ in
// anything that is seen, heard or goes on have other numbers. What is not of the moment is left out: how many frames
// were drawn before, where things were in the last of them and whether they have jumped since.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "base/hash.h"
#include "client/session/session.h"
#include "scene/snapshot.h"

namespace fb::cl::test {

class MomentHash {
 public:
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> MomentHash& add(T value) {
    hash_ = hash_bytes(&value, sizeof value, hash_);
    return *this;
  }
  MomentHash& add(const std::string& text) {
    add(text.size());
    hash_ = hash_bytes(text.data(), text.size(), hash_);
    return *this;
  }
  template <int N>
  MomentHash& add(const glm::vec<N, float>& v) {
    for (int i = 0; i < N; ++i) add(v[i]);
    return *this;
  }
  MomentHash& add(const mat4x3& m) {
    for (int i = 0; i < 4; ++i) add(m[i]);
    return *this;
  }
  MomentHash& add(const scene::PoseBlend& pose) { return add(pose.a).add(pose.b).add(pose.t); }
  MomentHash& add(const Rng& rng) {
    static_assert(std::is_trivially_copyable_v<Rng>);
    hash_ = hash_bytes(&rng, sizeof rng, hash_);
    return *this;
  }
  template <typename T>
  MomentHash& add_all(const T& items) {
    add(items.size());
    for (const auto& item : items) add(item);
    return *this;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

inline void add_entity(MomentHash& h, const Entity& e) {
  h.add(e.baseline.model).add(e.baseline.frame).add(e.baseline.origin).add(e.baseline.angles);
  h.add(e.model).add(e.frame).add(e.colormap).add(e.skin).add(e.effects).add(e.alpha).add(e.scale).add(e.message_time);
  h.add_all(e.message_origins).add_all(e.message_angles).add(e.force_link).add(e.sync_base).add(e.lerp_finish);
  h.add(e.lerp_flags).add(e.origin).add(e.angles).add(e.previous_pose).add(e.current_pose);
  h.add(e.pose_start).add(e.pose_interval).add(e.previous_origin).add(e.current_origin).add(e.previous_angles);
  h.add(e.current_angles).add(e.move_start).add(e.drawn_origin).add(e.drawn_angles).add(e.drawn_pose).add(e.visible);
}

inline void add_hud(MomentHash& h, const Hud& hud) {
  h.add_all(hud.stats).add(hud.items).add_all(hud.item_time).add(hud.face_pain_until).add(hud.level_name);
  h.add(hud.map_name).add(hud.max_clients).add(hud.game_type).add(hud.player).add(hud.center_print);
  h.add(hud.center_print_time).add(hud.intermission).add(hud.completed_time).add(hud.paused).add(hud.time);
  for (const Score& score : hud.scores) h.add(score.name).add(score.frags).add(score.colors);
}

inline void add_state(MomentHash& h, const ClientState& s) {
  h.add(s.protocol.version).add(s.have_server_info).add(s.signon).add_all(s.model_names).add_all(s.sound_names);
  for (const scene::Model* model : s.models) h.add(model ? model->name : std::string("none"));
  add_hud(h, s.hud);
  h.add(s.time).add(s.old_time).add_all(s.message_times).add(s.view_entity).add(s.view_height).add(s.ideal_pitch);
  h.add(s.view_angles).add_all(s.message_view_angles).add(s.velocity).add_all(s.message_velocities).add(s.punch);
  h.add_all(s.punches).add(s.on_ground).add(s.in_water).add(s.on_elevator).add(s.entities.size()).add(s.statics.size());
  for (const Entity& e : s.entities) add_entity(h, e);
  for (const Entity& e : s.statics) add_entity(h, e);
  add_entity(h, s.view_model);
  h.add_all(s.light_styles).add(s.skybox.value_or("the map's")).add(s.sky_changed);
  for (const Fog& fog : {s.fog.now, s.fog.before}) h.add(fog.density).add(fog.color);
  h.add(s.sky_fog.of_map.value_or(-1.0f)).add(s.sky_fog.cvar);
  h.add(s.fog.fade_seconds).add(s.fog.fade_done).add(s.music.track).add(s.music.loop);
  for (const ColorShift& shift : s.shifts) h.add(shift.color).add(shift.percent);
  h.add(s.empty_shift.color).add(s.empty_shift.percent).add(s.damage_time).add(s.damage_roll).add(s.damage_pitch);
}

inline void add_effects(MomentHash& h, const Effects& effects) {
  h.add(effects.particles.particles().size());
  for (const Particle& p : effects.particles.particles())
    h.add(p.origin).add(p.velocity).add(p.die).add(p.ramp).add(p.serial).add(p.color).add(p.type);
  for (const DynamicLight& l : effects.lights.lights())
    h.add(l.origin).add(l.color).add(l.radius).add(l.decay).add(l.die).add(l.key).add(l.serial);
  h.add(effects.beams.segments().size());
  for (const BeamSegment& s : effects.beams.segments())
    h.add(s.beam).add(s.index).add(s.serial).add(s.type).add(s.origin).add(s.angles);
}

inline std::uint64_t hash_of(const Session& session) {
  MomentHash h;
  add_state(h, session.state);
  add_effects(h, session.effects);
  for (const scene::SoundLoop& l : session.sounds.loops()) h.add(l.name).add(l.origin).add(l.volume).add(l.attenuation);
  for (const scene::SoundStart& s : session.sounds.sounding(session.state.time))
    h.add(s.name).add(s.entity).add(s.channel).add(s.origin).add(s.volume).add(s.attenuation).add(s.age);
  h.add(session.sounds.track()).add(session.rng).add(session.sound_rng).add(session.disconnected);
  h.add(session.reconnect).add(session.stuffed);
  return h.value();
}

// Meshes and materials count by what they are: their numbers say only what was shown first.
inline std::uint64_t hash_of(const scene::FrameSnapshot& snapshot) {
  const std::vector<scene::Mesh>& meshes = snapshot.assets->meshes;
  const std::vector<scene::Material>& materials = snapshot.assets->materials;
  MomentHash h;
  h.add(snapshot.time).add(snapshot.camera.position).add(snapshot.camera.angles).add(snapshot.camera.fov_x);
  h.add(snapshot.ambient)
      .add(snapshot.screen_tint)
      .add(snapshot.camera_liquid)
      .add(snapshot.in_liquid)
      .add(snapshot.medium.extinction);
  h.add(snapshot.medium.albedo).add(snapshot.sky.mode).add(snapshot.sky.color).add(snapshot.instances.size());
  for (const scene::Instance& i : snapshot.instances) {
    h.add(i.id).add(meshes[i.mesh].name).add(i.transform).add(i.pose).add(i.visibility).add(i.alpha);
    h.add(materials[i.material_base].name).add(materials[i.material_base].emission_kind);
    h.add(i.flags & ~static_cast<std::uint32_t>(scene::kInstanceNew)).add(i.time_offset).add(i.color).add(i.emission);
  }
  return h.value();
}

}  // namespace fb::cl::test
