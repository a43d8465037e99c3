#include "client/session/entities.h"

#include <fmt/format.h>

namespace fb::cl {
namespace {

constexpr std::size_t kMaxStatics = 4096;
constexpr double kMissedThink = 0.2;  // seconds: most entities think ten times a second

// The entity of this number, made if need be; null for a number out of range.
Entity* entity_at(ClientState& state, int number) {
  if (number < 0 || number >= net::kMaxEntities) return nullptr;
  const auto index = static_cast<std::size_t>(number);
  if (index >= state.entities.size()) {
    Entity fresh;
    fresh.lerp_flags = kLerpResetMove | kLerpResetAnim;
    state.entities.resize(index + 1, fresh);
  }
  return &state.entities[index];
}

}  // namespace

std::string apply_baseline(ClientState& state, const net::svc::SpawnBaseline& baseline) {
  Entity* entity = entity_at(state, baseline.entity);
  if (!entity) return fmt::format("entity {} is out of range", baseline.entity);
  entity->baseline = baseline.state;
  return {};
}

std::string apply_static(ClientState& state, const net::svc::SpawnStatic& message) {
  if (state.statics.size() >= kMaxStatics) return fmt::format("more than {} static entities", kMaxStatics);
  Entity& e = state.statics.emplace_back();
  e.baseline = message.state;
  e.model = message.state.model;
  e.frame = message.state.frame;
  e.skin = message.state.skin;
  e.alpha = message.state.alpha;
  e.scale = message.state.scale;
  e.origin = e.drawn_origin = message.state.origin;
  e.angles = e.drawn_angles = message.state.angles;
  e.lerp_flags = kLerpResetAnim | kLerpResetMove;
  return {};
}

std::string apply_update(Session& session, const net::svc::EntityUpdate& u) {
  ClientState& state = session.state;
  if (state.signon == kSignons - 1) state.signon = kSignons;  // the first update is the last stage
  Entity* entity = entity_at(state, u.entity);
  if (!entity) return fmt::format("entity {} is out of range", u.entity);
  Entity& e = *entity;
  const net::EntityState& base = e.baseline;
  const std::uint32_t bits = u.bits;

  bool unlinked = e.message_time != state.message_times[1];  // nothing to interpolate from
  if (e.message_time + kMissedThink < state.message_times[0]) e.lerp_flags |= kLerpResetAnim;
  e.message_time = state.message_times[0];

  // A high byte joins the low one, be that the update's or the baseline's.
  const auto joined = [bits](std::uint32_t low_bit, std::uint32_t high_bit, int sent, int from_baseline) {
    const int low = bits & low_bit ? sent & 0xff : from_baseline;
    return bits & high_bit ? (low & 0xff) | (sent & 0xff00) : low;
  };
  const int model = joined(net::kUpdateModel, net::kUpdateModel2, u.model, base.model);
  e.frame = joined(net::kUpdateFrame, net::kUpdateFrame2, u.frame, base.frame);
  e.colormap = bits & net::kUpdateColormap ? u.colormap : base.colormap;
  if (e.colormap > state.hud.max_clients)
    return fmt::format("entity {} wears the colours of player {} of {}", u.entity, e.colormap, state.hud.max_clients);
  e.skin = bits & net::kUpdateSkin ? u.skin : base.skin;
  e.effects = bits & net::kUpdateEffects ? u.effects : base.effects;

  e.message_origins[1] = e.message_origins[0];
  e.message_angles[1] = e.message_angles[0];
  constexpr std::array<std::uint32_t, 3> kOrigins = {net::kUpdateOrigin1, net::kUpdateOrigin2, net::kUpdateOrigin3};
  constexpr std::array<std::uint32_t, 3> kAngles = {net::kUpdateAngle1, net::kUpdateAngle2, net::kUpdateAngle3};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    e.message_origins[0][i] = bits & kOrigins[k] ? u.origin[i] : base.origin[i];
    e.message_angles[0][i] = bits & kAngles[k] ? u.angles[i] : base.angles[i];
  }
  if (bits & net::kUpdateStep) {
    e.lerp_flags |= kLerpMoveStep;
    e.force_link = true;
  } else {
    e.lerp_flags &= ~kLerpMoveStep;
  }

  e.alpha = bits & net::kUpdateAlpha ? u.alpha : base.alpha;
  e.scale = bits & net::kUpdateScale ? u.scale : base.scale;
  if (bits & net::kUpdateLerpFinish) {
    e.lerp_finish = e.message_time + u.lerp_finish / 255.0;
    e.lerp_flags |= kLerpFinish;
  } else if (state.protocol.extended()) {
    e.lerp_flags &= ~kLerpFinish;
  }

  if (model != e.model) {
    e.model = model;
    const scene::Model* known = state.model(model);
    e.sync_base = known && known->random_start ? session.rng.uniform() : 0.0f;
    if (model == 0) unlinked = true;  // so that a player without a model moves rightly
    e.lerp_flags |= kLerpResetAnim;
  }
  if (unlinked) {
    e.message_origins[1] = e.origin = e.message_origins[0];
    e.message_angles[1] = e.angles = e.message_angles[0];
    e.force_link = true;
    e.cut_frame = session.frame;
  }
  return {};
}

}  // namespace fb::cl
