#include "client/snapshot_builder.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/rng.h"
#include "client/camera_liquid.h"
#include "scene/animation.h"
#include "scene/authored/displayed_fog.h"
#include "scene/library/lightmaps.h"
#include "scene/library/asset_builder.h"

namespace fb::cl {
namespace {

constexpr float kParticleRadius = 0.75f;   // units, near by; QuakeSpasm's dots are about 1.3 across
constexpr float kParticleEmission = 1.0f;  // radiance of one that glows, per unit of its colour

// Unit axes turned at random, the same for the same number always (Shoemake's uniform quaternions).
mat4x3 random_orientation(std::uint32_t number) {
  Rng rng(number, 11);
  const float u = rng.uniform(), a = 2.0f * kPi * rng.uniform(), b = 2.0f * kPi * rng.uniform();
  const float p = std::sqrt(1.0f - u), q = std::sqrt(u);
  const float x = p * std::sin(a), y = p * std::cos(a), z = q * std::sin(b), w = q * std::cos(b);
  return mat4x3(vec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
                vec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
                vec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)), vec3(0.0f));
}

mat4x3 ball(const vec3& centre, float radius) {
  return mat4x3(vec3(radius, 0, 0), vec3(0, radius, 0), vec3(0, 0, radius), centre);
}

std::array<vec3, 256> linear_palette(const formats::Palette& palette) {
  std::array<vec3, 256> colors;
  for (std::size_t i = 0; i < 256; ++i)
    colors[i] = {scene::linear_from_srgb(palette.rgb[i][0]), scene::linear_from_srgb(palette.rgb[i][1]),
                 scene::linear_from_srgb(palette.rgb[i][2])};
  return colors;
}

constexpr float kMaxAmbient = 1000.0f;
constexpr float kMaxExtinction = 10.0f;  // 1/unit: nothing is seen a hand away

bool is_authored(const SnapshotInput& input) {
  return input.authored != nullptr && input.session.settings.r_authored != 0.0f && input.authored->light() != nullptr;
}

vec3 ambient_light(const SnapshotInput& input, bool authored) {
  const float wanted = input.session.settings.r_ambient;
  if (wanted >= 0.0f) return vec3(std::min(wanted, kMaxAmbient));
  return authored ? input.authored->ambient() : input.library.map_ambient().radiance;
}

// Quake's fog leaves exp(-(density z / 64)^2) of the light: ours, whose logarithm is linear, leaves half at the same
// distance. Its colour is what is scattered of white light all around, so that thick fog in such light looks as
// Quake's.
scene::Medium medium_of(const Fog& fog, const SkyFog& sky_fog, const Settings& settings, bool authored) {
  scene::Medium medium;
  const float density = fog.density * std::max(settings.r_fog, 0.0f);
  if (!(density > 0.0f)) return medium;
  medium.extinction = std::min(std::sqrt(std::log(2.0f)) * density / 64.0f, kMaxExtinction);
  for (int i = 0; i < 3; ++i) medium.albedo[i] = scene::linear_from_srgb(fog.color[i]);
  medium.g = settings.r_fog_g;
  medium.alpha = settings.r_fog_alpha;
  const float covers = std::clamp(sky_fog.now(settings.r_skyfog), 0.0f, 1.0f);
  medium.sky = 1.0f - covers;
  // From Quake's own half on all of the fog's light is before the sky; less fades, and with 0 the sky is as without
  // fog.
  medium.before_sky = std::min(2.0f * covers, 1.0f);
  if (authored) scene::show_as_in_quake(medium, density, medium.albedo, covers);
  return medium;
}

// r_slimealpha 0 is r_wateralpha, as in QuakeSpasm. What glows is opaque at 0, so that no lamp is lost unasked.
scene::LiquidOpacity liquid_opacity(const Settings& settings) {
  const auto held = [](float alpha) { return alpha > 0.0f ? std::min(alpha, 1.0f) : 0.0f; };
  const float water = held(settings.r_wateralpha), slime = held(settings.r_slimealpha);
  const float lava = held(settings.r_lavaalpha), teleport = held(settings.r_telealpha);
  return {water, slime > 0.0f ? slime : water, lava > 0.0f ? lava : 1.0f, teleport > 0.0f ? teleport : 1.0f};
}

vec3 unit_or(const vec3& v, const vec3& fallback) {
  const float length = glm::length(v);
  return length > 1e-6f ? v / length : fallback;
}

}  // namespace

mat4x3 sprite_transform(formats::SpriteOrientation orientation, const vec3& origin, const vec3& angles, float scale,
                        const scene::Camera& camera) {
  const AxisVectors eye = angle_vectors(camera.angles);
  const vec3 zenith(0, 0, 1);
  vec3 right = eye.right, up = eye.up;
  switch (orientation) {
    case formats::SpriteOrientation::kParallelUpright:
      up = zenith;
      right = unit_or(glm::cross(eye.forward, zenith), eye.right);
      break;
    case formats::SpriteOrientation::kFacingUpright: {
      up = zenith;
      const vec3 away(origin.x - camera.position.x, origin.y - camera.position.y, 0.0f);
      right = glm::cross(unit_or(away, vec3(1, 0, 0)), zenith);
      break;
    }
    case formats::SpriteOrientation::kParallel:
      break;
    case formats::SpriteOrientation::kOriented: {
      const AxisVectors own = angle_vectors(angles);
      right = own.right;
      up = own.up;
      break;
    }
    case formats::SpriteOrientation::kParallelOriented: {
      const float c = std::cos(radians(angles.z)), s = std::sin(radians(angles.z));
      right = eye.right * c + eye.up * s;
      up = eye.up * c - eye.right * s;
      break;
    }
  }
  return mat4x3(glm::cross(right, up) * scale, right * scale, up * scale, origin);
}

void SnapshotBuilder::forget() { forget_ = true; }

void SnapshotBuilder::add(scene::FrameSnapshot& snapshot, scene::Instance instance, std::uint32_t key, bool cut) {
  current_[instance.id] = {key, instance.pose, instance.transform};
  const auto past = previous_.find(instance.id);
  if (cut || past == previous_.end() || past->second.key != key) {
    instance.flags |= scene::kInstanceNew;
    instance.prev_transform = instance.transform;
    instance.prev_pose = instance.pose;
  } else {
    instance.prev_transform = past->second.transform;
    instance.prev_pose = past->second.pose;
  }
  snapshot.instances.push_back(instance);
}

void SnapshotBuilder::build(const SnapshotInput& input, scene::FrameSnapshot& snapshot) {
  const ClientState& state = input.session.state;
  scene::Camera camera;
  camera.position = input.view.origin;
  camera.angles = input.view.angles;
  camera.fov_x =
      adapted_fov(input.session.settings.fov, input.session.settings.fov_adapt != 0.0f, input.width, input.height);
  if (input.camera) {
    const float fov_x = input.camera->fov_x > 0.0f ? input.camera->fov_x : camera.fov_x;
    camera = *input.camera;
    camera.fov_x = fov_x;
  }

  if (input.session.frame != built_ || forget_) {  // a new moment: the last one becomes the past
    if (forget_) {
      previous_.clear();
      built_before_ = input.session.frame;
    } else {
      previous_ = std::move(current_);
      built_before_ = built_;
    }
    ++count_;
    built_ = input.session.frame;
    prev_camera_ = forget_ ? camera : camera_;
    prev_time_ = forget_ ? state.time : time_;
    prev_in_liquid_ = in_liquid_;
    cut_ = forget_;
    forget_ = false;
  }
  current_.clear();
  camera_ = camera;
  time_ = state.time;
  const auto eye = static_cast<std::size_t>(std::max(state.view_entity, 0));
  const bool jumped = !input.camera && eye < state.entities.size() && state.entities[eye].cut_frame > built_before_;

  snapshot.instances.clear();
  snapshot.authored = is_authored(input);
  snapshot.ambient = input.active ? ambient_light(input, snapshot.authored) : vec3(0.0f);
  const bool shows_baked = input.authored != nullptr && input.authored->shows_baked();
  snapshot.medium = input.active ? medium_of(fog_at(state.fog, state.time), state.sky_fog, input.session.settings,
                                             snapshot.authored || shows_baked)
                                 : scene::Medium();
  snapshot.liquid_opacity = liquid_opacity(input.session.settings);
  snapshot.camera_liquid = scene::kNone;
  if (input.active && input.library.map())
    snapshot.camera_liquid =
        liquid_of_world(*input.library.map(), *input.library.assets(), snapshot.liquid_opacity, camera_.position);
  snapshot.time = time_;
  snapshot.prev_time = prev_time_;
  snapshot.frame = count_;
  snapshot.cut = cut_ || jumped;
  snapshot.camera = camera_;
  snapshot.prev_camera = snapshot.cut ? camera_ : prev_camera_;
  snapshot.screen_tint = input.view.tint;
  snapshot.tint_in_liquid = input.view.tint_without_contents;
  snapshot.sky = input.sky;
  snapshot.gains = snapshot.authored ? input.authored->gains() : scene::GainTable();
  if (snapshot.authored) input.authored->light_sky(snapshot.sky);
  snapshot.light_styles = scene::all_styles_of_one();
  for (std::size_t i = 0; i < std::min(snapshot.light_styles.size(), state.light_styles.size()); ++i) {
    const float value = light_style_value(state.light_styles[i], state.time);
    snapshot.light_styles[i] = snapshot.authored ? scene::light_of_display(value) : value;
  }
  snapshot.baked = snapshot.authored || (input.active && shows_baked) ? input.authored->baked() : scene::BakedTable();
  if (snapshot.baked.image != scene::kNone)
    for (std::size_t i = 0; i < std::min(snapshot.baked.styles.size(), state.light_styles.size()); ++i)
      snapshot.baked.styles[i] = light_style_value(state.light_styles[i], state.time);
  if (input.active) {
    const Settings& settings = input.session.settings;
    if (input.world && input.world->mesh != scene::kNone && settings.r_drawworld != 0.0f) {
      scene::Instance world;
      world.id = scene::kIdWorld;
      world.mesh = input.world->mesh;
      world.flags = scene::kInstanceShareTime;
      add(snapshot, world, world.mesh, false);
      snapshot.instances.back().flags &= ~static_cast<std::uint32_t>(scene::kInstanceNew);  // it never moves
    }
    if (settings.r_drawentities != 0.0f) {
      const bool outside = input.camera.has_value() || settings.chase_active != 0.0f;
      for (std::size_t i = 1; i < state.entities.size(); ++i) {
        const Entity& e = state.entities[i];
        const scene::Model* model = state.model(e.model);
        if (!e.visible || !model) continue;
        std::uint32_t visibility = scene::kSeenByAll;
        if (i == eye && !outside) {
          if (settings.r_playerbody == 0.0f || state.hud.intermission != Intermission::kNone) continue;
          visibility = scene::kSeenByIndirect;
        }
        add_entity(input, snapshot, e, *model, scene::kIdEntity + static_cast<std::uint32_t>(i), static_cast<int>(i),
                   visibility);
      }
      for (std::size_t i = 0; i < state.statics.size(); ++i) {
        const Entity& e = state.statics[i];
        const scene::Model* model = state.model(e.model);
        if (e.visible && model)
          add_entity(input, snapshot, e, *model, scene::kIdStatic + static_cast<std::uint32_t>(i), 0,
                     scene::kSeenByAll);
      }
      if (!input.camera) add_weapon(input, snapshot);
      add_beams(input, snapshot);
    }
    if (settings.r_particles != 0.0f) add_particles(input, snapshot);
    add_lights(input, snapshot);
  }
  const bool in_world = input.active && input.library.map() && liquid_is_at(*input.library.map(), camera_.position);
  in_liquid_ = snapshot.in_liquid = in_world || snapshot.camera_liquid != scene::kNone;
  snapshot.was_in_liquid = snapshot.cut ? in_liquid_ : prev_in_liquid_;
  // Last, so that models and skins that were made on the way are in it.
  snapshot.assets = input.library.assets();
}

void SnapshotBuilder::add_entity(const SnapshotInput& input, scene::FrameSnapshot& snapshot, const Entity& e,
                                 const scene::Model& model, std::uint32_t id, int number, std::uint32_t visibility) {
  scene::Instance instance;
  instance.id = id;
  instance.visibility = visibility;
  instance.alpha = net::decode_alpha(e.alpha);
  instance.flags = scene::kInstanceShareTime;
  if (!(instance.alpha > 0.0f)) return;
  const float scale = net::decode_scale(e.scale);
  if (!(scale > 0.0f)) return;
  switch (model.kind) {
    case scene::ModelKind::kMissing:
      return;
    case scene::ModelKind::kBrush:
      if (model.mesh == scene::kNone) return;
      instance.mesh = model.mesh;
      if (input.session.settings.r_ambient < 0.0f) instance.emission = model.even;
      if (snapshot.authored && model.shadowless)
        instance.visibility &= static_cast<std::uint32_t>(scene::kSeenByCamera);
      instance.transform = entity_transform(e.drawn_origin, e.drawn_angles, scale);
      if (e.frame != 0) instance.flags |= scene::kInstanceAlternate;
      add(snapshot, instance, model.mesh, e.cut_frame > built_before_);
      if (input.library.map() && model.name.starts_with('*') && snapshot.camera_liquid == scene::kNone)
        if (const auto submodel = parse_whole_number_unsigned(std::string_view(model.name).substr(1)))
          snapshot.camera_liquid =
              liquid_of_submodel(*input.library.map(), *input.library.assets(), snapshot.liquid_opacity, *submodel,
                                 model.mesh, instance.transform, camera_.position);
      return;
    case scene::ModelKind::kAlias:
      // A torch: its light is its lamp's, which baked light was asked of.
      if (snapshot.authored && model.glows && id >= scene::kIdStatic)
        instance.visibility &= static_cast<std::uint32_t>(scene::kSeenByCamera);
      instance.transform =
          entity_transform(e.drawn_origin, {-e.drawn_angles.x, e.drawn_angles.y, e.drawn_angles.z}, scale);
      add_alias(input, snapshot, instance, e, model, number);
      return;
    case scene::ModelKind::kSprite:
      add_sprite(input, snapshot, instance, e, model);
      return;
  }
}

void SnapshotBuilder::add_alias(const SnapshotInput& input, scene::FrameSnapshot& snapshot, scene::Instance instance,
                                const Entity& e, const scene::Model& model, int number) {
  if (model.mesh == scene::kNone) return;
  instance.mesh = model.mesh;
  instance.pose = e.drawn_pose;
  const auto skin = static_cast<std::uint32_t>(std::max(e.skin, 0)) < model.skin_materials.size()
                        ? static_cast<std::uint32_t>(std::max(e.skin, 0))
                        : 0u;
  instance.material_base = model.skin_materials.empty() ? 0u : model.skin_materials[skin];
  const auto& scores = input.session.state.hud.scores;
  if (e.colormap > 0 && number > 0 && !model.skin_materials.empty() &&
      static_cast<std::size_t>(number) <= scores.size()) {
    const int colors = scores[static_cast<std::size_t>(number) - 1].colors;
    instance.material_base = input.library.translated_skin(model, skin, colors >> 4 & 15, colors & 15);
  }
  add(snapshot, instance, model.mesh, e.cut_frame > built_before_);
}

void SnapshotBuilder::add_sprite(const SnapshotInput& input, scene::FrameSnapshot& snapshot, scene::Instance instance,
                                 const Entity& e, const scene::Model& model) {
  if (model.sprite_frames.empty()) return;
  const bool known = e.frame >= 0 && static_cast<std::size_t>(e.frame) < model.sprite_frames.size();
  const auto& frame = model.sprite_frames[known ? static_cast<std::size_t>(e.frame) : 0];
  const double time = input.session.state.time + static_cast<double>(e.sync_base);
  if (frame.meshes.empty()) return;
  const std::size_t image = scene::frame_of_group(frame.end_times, frame.meshes.size(), time);
  instance.mesh = frame.meshes[image];
  instance.material_base = frame.material + static_cast<std::uint32_t>(image);
  instance.transform =
      sprite_transform(model.orientation, e.drawn_origin, e.drawn_angles, net::decode_scale(e.scale), camera_);
  // The next image of the same sprite goes on where the one before it was.
  add(snapshot, instance, model.sprite_frames.front().meshes.front(), e.cut_frame > built_before_);
}

void SnapshotBuilder::add_weapon(const SnapshotInput& input, scene::FrameSnapshot& snapshot) {
  const ClientState& state = input.session.state;
  const scene::Model* model = state.model(state.hud.stats[net::kStatWeapon]);
  if (!input.view.show_weapon || !model || model->kind != scene::ModelKind::kAlias) return;
  scene::Instance instance;
  instance.id = scene::kIdViewModel;
  instance.visibility = scene::kSeenByCamera;
  instance.flags = scene::kInstanceViewModel | scene::kInstanceShareTime;
  instance.alpha = net::decode_alpha(state.view_model.alpha);
  if (!(instance.alpha > 0.0f)) return;
  const vec3& angles = input.view.weapon_angles;
  instance.transform = entity_transform(input.view.weapon_origin, {-angles.x, angles.y, angles.z});
  Entity weapon = state.view_model;
  weapon.colormap = 0;
  weapon.cut_frame = snapshot.cut ? built_before_ + 1 : 0;
  add_alias(input, snapshot, instance, weapon, *model, 0);
}

void SnapshotBuilder::add_beams(const SnapshotInput& input, scene::FrameSnapshot& snapshot) {
  for (const BeamSegment& s : input.session.effects.beams.segments()) {
    const scene::Model& model = input.library.model(beam_model(s.type));
    if (model.kind != scene::ModelKind::kAlias || model.mesh == scene::kNone) continue;
    scene::Instance instance;
    instance.id = scene::kIdBeam + s.beam * Beams::kMaxSegments + s.index;
    instance.mesh = model.mesh;
    instance.flags = scene::kInstanceShareTime;
    instance.material_base = model.skin_materials.empty() ? 0u : model.skin_materials.front();
    const std::uint32_t pose = model.frames.empty() ? 0u : scene::pose_at(model, 0, input.session.state.time);
    instance.pose = {pose, pose, 0.0f};
    instance.transform = entity_transform(s.origin, {-s.angles.x, s.angles.y, s.angles.z});
    add(snapshot, instance, s.serial, false);
  }
}

void SnapshotBuilder::add_particles(const SnapshotInput& input, scene::FrameSnapshot& snapshot) {
  const auto& particles = input.session.effects.particles.particles();
  if (particles.empty()) return;
  const std::uint32_t mesh = input.library.tetrahedron_mesh(), material = input.library.particle_material();
  const auto colors = linear_palette(input.library.assets()->palette);
  const vec3 forward = angle_vectors(camera_.angles).forward;
  for (const Particle& p : particles) {
    scene::Instance instance;
    instance.id = scene::kIdParticle + (p.serial & 0xfffffu);
    instance.mesh = mesh;
    instance.material_base = material;
    instance.flags = scene::kInstanceColor | scene::kInstanceShareTime;
    instance.color = colors[p.color];
    if (p.glows()) instance.emission = instance.color * kParticleEmission;
    // As in Quake they grow with their distance, so that they do not vanish.
    const float distance = glm::dot(p.origin - camera_.position, forward);
    const float radius = kParticleRadius * (distance < 20.0f ? 1.08f : 1.0f + distance * 0.004f);
    const mat4x3 turn = random_orientation(p.serial);
    instance.transform = mat4x3(turn[0] * radius, turn[1] * radius, turn[2] * radius, p.origin);
    add(snapshot, instance, p.serial, false);
  }
}

void SnapshotBuilder::add_lights(const SnapshotInput& input, scene::FrameSnapshot& snapshot) {
  const Settings& settings = input.session.settings;
  const ClientState& state = input.session.state;
  scene::Instance instance;
  instance.visibility = scene::kSeenByIndirect;
  instance.flags = scene::kInstanceColor | scene::kInstanceShareTime;
  instance.color = vec3(0.0f);
  if (settings.r_dynamic != 0.0f) {
    const auto& lights = input.session.effects.lights.lights();
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const DynamicLight& light = lights[i];
      if (!light.lit(state.time)) continue;
      const LightSphere sphere = light_sphere(light.radius, light.key == state.view_entity);
      instance.id = scene::kIdDynamicLight + static_cast<std::uint32_t>(i);
      instance.mesh = input.library.sphere_mesh();
      instance.material_base = input.library.dynamic_light_material();
      instance.transform = ball(light.origin, sphere.radius);
      instance.emission = light.color * sphere.radiance;
      add(snapshot, instance, light.serial, false);
    }
  }
  if (settings.r_entlights > 0.0f) {
    const auto& lights = snapshot.authored ? input.authored->lamps() : input.library.entity_lights();
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const scene::EntityLight& light = lights[i];
      const auto style = static_cast<std::size_t>(light.style);  // a negative one is out of range, too
      float brightness =
          style < state.light_styles.size() ? light_style_value(state.light_styles[style], state.time) : 1.0f;
      if (!(brightness > 0.0f)) continue;
      // Styles are factors on what a display decodes, as all of a lightmap is.
      if (snapshot.authored) brightness = scene::light_of_display(brightness);
      instance.id = scene::kIdEntityLight + static_cast<std::uint32_t>(i);
      instance.mesh = input.library.sphere_mesh();
      instance.material_base = input.library.entity_light_material();
      instance.transform = ball(light.position, light.radius);
      instance.flags &= ~(scene::kInstanceSpot | 7u << scene::kInstanceFallShift);
      instance.color = vec3(0.0f);
      if (light.axis != vec3(0.0f)) {
        instance.color = vec3(light.least_cosine, light.full_cosine, 0.0f);
        const vec3 side =
            glm::normalize(glm::cross(light.axis, std::fabs(light.axis.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0)));
        instance.transform = mat4x3(light.axis * light.radius, side * light.radius,
                                    glm::cross(light.axis, side) * light.radius, light.position);
        instance.flags |= scene::kInstanceSpot;
      }
      if (snapshot.authored && light.fall != 0) {
        if ((instance.flags & scene::kInstanceSpot) == 0) instance.color = vec3(-2.0f);  // all ways
        instance.flags |= scene::kInstanceSpot | light.fall << scene::kInstanceFallShift;
        instance.color.z = light.fall_scale;
      }
      instance.emission = light.power_color * (snapshot.authored ? input.authored->lamp_factor(i) : vec3(1.0f)) *
                          (brightness * settings.r_entlights);
      add(snapshot, instance, static_cast<std::uint32_t>(i), false);
    }
  }
}

}  // namespace fb::cl
