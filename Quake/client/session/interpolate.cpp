#include "client/session/interpolate.h"

#include <algorithm>
#include <cmath>

namespace fb::cl {
namespace {

constexpr double kLongestLerp = 0.1;  // seconds between messages; more is a gap
constexpr float kTeleport = 100.0f;   // units along an axis between two messages
constexpr double kStepSeconds = 0.1;

// Two angles that messages gave, f of the way; the short way round for what is at most one turn apart.
float between_angles(float from, float to, float f) {
  float d = to - from;
  if (d > 180.0f)
    d -= 360.0f;
  else if (d < -180.0f)
    d += 360.0f;
  return from + f * d;
}

vec3 between_angles(const vec3& from, const vec3& to, float f) {
  return {between_angles(from.x, to.x, f), between_angles(from.y, to.y, f), between_angles(from.z, to.z, f)};
}

// 0..1 of the way from start to end; 1 when there is no way.
float progress(double now, double start, double length) {
  if (!(length > 0.0)) return 1.0f;
  return static_cast<float>(std::clamp((now - start) / length, 0.0, 1.0));
}

// The degrees by which items turn: 100 a second.
float item_yaw(double time) { return static_cast<float>(std::fmod(100.0 * time, 360.0)); }

bool is_far(const vec3& from, const vec3& to) {
  const vec3 way = glm::abs(to - from);
  return way.x > kTeleport || way.y > kTeleport || way.z > kTeleport;
}

void move_between_messages(Entity& e, float fraction, bool lerp_move, std::uint64_t frame) {
  const vec3 old_origin = e.origin;
  if (e.force_link) {
    e.origin = e.message_origins[0];
    e.angles = e.message_angles[0];
  } else {
    float f = fraction;
    if (is_far(e.message_origins[1], e.message_origins[0])) {
      f = 1.0f;
      e.lerp_flags |= kLerpResetMove;
    }
    if (lerp_move && (e.lerp_flags & kLerpMoveStep)) f = 1.0f;
    e.origin = e.message_origins[1] + f * (e.message_origins[0] - e.message_origins[1]);
    e.angles = between_angles(e.message_angles[1], e.message_angles[0], f);
  }
  // When a frame reads several messages, the jump may lie between earlier ones.
  if (is_far(old_origin, e.origin)) {
    e.lerp_flags |= kLerpResetMove;
    e.cut_frame = frame;
  }
}

void light_up(Session& session, int number, const vec3& at, float radius, double die, const vec3& color = vec3(1.0f)) {
  DynamicLight& light = session.effects.lights.allocate(number, session.state.time);
  light.origin = at;
  light.radius = radius;
  light.die = session.state.time + die;
  light.color = color;
}

// Lights and particles that an entity's effects make.
void apply_effects(Session& session, Entity& e, int number) {
  ClientState& state = session.state;
  const auto flicker = [&session] { return static_cast<float>(session.rng.below(32)); };
  if (e.effects & kEffectBrightField) session.effects.particles.bright_field(e.origin, state.time);
  if (e.effects & kEffectMuzzleFlash) {
    const vec3 muzzle = e.origin + vec3(0, 0, 16) + 18.0f * angle_vectors(e.angles).forward;
    light_up(session, number, muzzle, 200.0f + flicker(), 0.1);
    // A flash comes with a flare in the model, which must not be blended in and out.
    if (session.settings.r_lerpmodels != 2.0f) {
      Entity& flashing = number == state.view_entity ? state.view_model : e;
      flashing.lerp_flags |= kLerpResetAnim | kLerpResetAnim2;
    }
  }
  if (e.effects & kEffectBrightLight) light_up(session, number, e.origin + vec3(0, 0, 16), 400.0f + flicker(), 0.001);
  if (e.effects & kEffectDimLight) light_up(session, number, e.origin, 200.0f + flicker(), 0.001);
  if (e.effects & kEffectQuadLight)
    light_up(session, number, e.origin, 200.0f + flicker(), 0.001, vec3(0.25f, 0.25f, 1.0f));
  if (e.effects & kEffectPentaLight)
    light_up(session, number, e.origin, 200.0f + flicker(), 0.001, vec3(1.0f, 0.25f, 0.25f));
}

void leave_trail(Session& session, const Entity& e, int number, std::uint32_t flags, const vec3& old_origin) {
  const auto trail = [&](Trail type) {
    session.effects.particles.trail(old_origin, e.origin, type, session.state.time);
  };
  if (flags & formats::kMdlGib)
    trail(Trail::kBlood);
  else if (flags & formats::kMdlZomGib)
    trail(Trail::kSlightBlood);
  else if (flags & formats::kMdlTracer)
    trail(Trail::kTracer);
  else if (flags & formats::kMdlTracer2)
    trail(Trail::kTracer2);
  else if (flags & formats::kMdlRocket) {
    trail(Trail::kRocket);
    light_up(session, number, e.origin, 200.0f, 0.01);
  } else if (flags & formats::kMdlGrenade)
    trail(Trail::kSmoke);
  else if (flags & formats::kMdlTracer3)
    trail(Trail::kVoor);
}

}  // namespace

float lerp_point(ClientState& state, bool timing, bool no_lerp) {
  auto& messages = state.message_times;
  double length = messages[0] - messages[1];
  if (length == 0.0 || timing) {
    state.time = messages[0];
    return 1.0f;
  }
  if (length > kLongestLerp) {
    messages[1] = messages[0] - kLongestLerp;
    length = kLongestLerp;
  }
  double fraction = (state.time - messages[1]) / length;
  // A little too early or too late is let be, so that time does not stutter.
  if (fraction < 0.0) {
    if (fraction < -0.01) state.time = messages[1];
    fraction = 0.0;
  } else if (fraction > 1.0) {
    if (fraction > 1.01) state.time = messages[0];
    fraction = 1.0;
  }
  return no_lerp ? 1.0f : static_cast<float>(fraction);
}

void relink(Session& session, bool demo, bool timing) {
  ClientState& state = session.state;
  const Settings& settings = session.settings;
  const float fraction = lerp_point(state, timing, settings.cl_nolerp != 0.0f);

  state.velocity = glm::mix(state.message_velocities[1], state.message_velocities[0], fraction);
  if (demo) state.view_angles = between_angles(state.message_view_angles[1], state.message_view_angles[0], fraction);

  for (std::size_t i = 1; i < state.entities.size(); ++i) {
    Entity& e = state.entities[i];
    e.visible = false;
    if (e.model == 0) continue;
    if (e.message_time != state.message_times[0]) {  // not in the latest message: gone
      e.model = 0;
      e.lerp_flags |= kLerpResetMove | kLerpResetAnim;
      continue;
    }
    const int number = static_cast<int>(i);
    const scene::Model* model = state.model(e.model);
    const std::uint32_t flags = model ? model->flags : 0u;
    const vec3 old_origin = e.origin;
    move_between_messages(e, fraction, settings.r_lerpmove != 0.0f, session.frame);
    if (flags & formats::kMdlRotate) e.angles.y = item_yaw(state.time);
    apply_effects(session, e, number);
    leave_trail(session, e, number, flags, old_origin);
    e.force_link = false;
    e.visible = true;
  }
}

bool animates_smoothly(const Settings& settings, const std::string& model_name) {
  if (settings.r_lerpmodels == 0.0f) return false;
  if (settings.r_lerpmodels == 2.0f) return true;
  const auto& names = settings.nolerp_models;
  return std::find(names.begin(), names.end(), model_name) == names.end();
}

void animate_entity(Entity& e, const scene::Model& model, double time, bool smooth) {
  if (model.frames.empty()) return;
  const bool known = e.frame >= 0 && static_cast<std::size_t>(e.frame) < model.frames.size();
  const auto index = known ? static_cast<std::uint32_t>(e.frame) : 0u;
  const scene::Model::Frame& frame = model.frames[index];
  const bool group = frame.pose_count > 1;
  const std::uint32_t pose = scene::pose_at(model, index, time);
  e.pose_interval = group && !frame.end_times.empty() ? frame.end_times.front() : kStepSeconds;

  const auto jump = [&](std::uint32_t flag) {
    e.pose_start = 0.0;
    e.previous_pose = e.current_pose = pose;
    e.lerp_flags &= ~flag;
  };
  if (e.lerp_flags & kLerpResetAnim) {
    jump(kLerpResetAnim);
  } else if (e.current_pose != pose) {
    if (e.lerp_flags & kLerpResetAnim2) {
      jump(kLerpResetAnim2);
    } else {
      e.pose_start = time;
      e.previous_pose = e.current_pose;
      e.current_pose = pose;
    }
  }
  if (!smooth || e.previous_pose == e.current_pose) {
    e.drawn_pose = {pose, pose, 0.0f};
    return;
  }
  const bool finish = (e.lerp_flags & kLerpFinish) && !group;
  const double length = finish ? e.lerp_finish - e.pose_start : e.pose_interval;
  e.drawn_pose = {e.previous_pose, e.current_pose, progress(time, e.pose_start, length)};
}

void place_entity(Entity& e, double time, bool lerp_move) {
  if (e.lerp_flags & kLerpResetMove) {
    e.move_start = 0.0;
    e.previous_origin = e.current_origin = e.origin;
    e.previous_angles = e.current_angles = e.angles;
    e.lerp_flags &= ~kLerpResetMove;
  } else if (e.origin != e.current_origin || e.angles != e.current_angles) {
    e.move_start = time;
    e.previous_origin = e.current_origin;
    e.current_origin = e.origin;
    e.previous_angles = e.current_angles;
    e.current_angles = e.angles;
  }
  e.drawn_origin = e.origin;
  e.drawn_angles = e.angles;
  if (!lerp_move || !(e.lerp_flags & kLerpMoveStep)) return;
  const double length = e.lerp_flags & kLerpFinish ? e.lerp_finish - e.move_start : kStepSeconds;
  const float f = progress(time, e.move_start, length);
  e.drawn_origin = glm::mix(e.previous_origin, e.current_origin, f);
  e.drawn_angles = between_angles(e.previous_angles, e.current_angles, f);
}

void place_entities(Session& session) {
  ClientState& state = session.state;
  const bool lerp_move = session.settings.r_lerpmove != 0.0f;
  const auto prepare = [&](Entity& e) {
    const scene::Model* model = state.model(e.model);
    if (model && model->kind == scene::ModelKind::kAlias)
      animate_entity(e, *model, state.time, animates_smoothly(session.settings, model->name));
    place_entity(e, state.time, lerp_move);
  };
  for (std::size_t i = 1; i < state.entities.size(); ++i)
    if (state.entities[i].visible) prepare(state.entities[i]);
  for (Entity& e : state.statics) {
    e.visible = true;
    prepare(e);
  }
}

}  // namespace fb::cl
