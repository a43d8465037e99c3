#include "server/clients/send_entities.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fb::sv {
namespace {

namespace fields = progs::fields;
using progs::to_int;

// What protocol 15 cannot number is not shown.
bool has_model(Level& level, const Edict& edict, const net::Protocol& protocol) {
  const std::int32_t model = to_int(edict.get(fields::modelindex));
  if (model == 0 || level.vm->text(edict.get(fields::model)).empty()) return false;
  return protocol.extended() || (model & 0xff00) == 0;
}

std::vector<EdictId> visible_entities(Level& level, EdictId player, const net::Protocol& protocol) {
  const Edict eyes = level.edict(player);
  world::LeafSet pvs = world::fat_pvs(*level.bsp, eyes.get(fields::origin) + eyes.get(fields::view_ofs));
  const float clear = level.cvars.clear_liquids.value();
  if (clear < 0 ? level.max_clients == 1 : clear != 0) level.liquid_windows.add(*level.bsp, pvs);
  std::vector<EdictId> seen;
  for (std::uint32_t i = 1; i < level.edicts().count(); ++i) {
    const EdictId id{i};
    if (id == player || (has_model(level, level.edict(id), protocol) && level.extra(id).leafs.visible_in(pvs)))
      seen.push_back(id);
  }
  return seen;
}

// Squared, from a point to the nearest of a box: big doors are near before their middle is.
float distance_to_box(const vec3& point, const Edict& edict) {
  const vec3 away =
      glm::max(vec3(0.0f), glm::max(edict.get(fields::absmin) - point, point - edict.get(fields::absmax)));
  return glm::dot(away, away);
}

void sort_by_distance(Level& level, EdictId player, std::vector<EdictId>& ids) {
  const vec3 eyes = level.edict(player).get(fields::origin);
  std::vector<std::pair<float, EdictId>> order;
  for (const EdictId id : ids) {
    const float distance = distance_to_box(eyes, level.edict(id));
    order.emplace_back(id == player ? -1.0f : std::isfinite(distance) ? distance : 1e30f, id);
  }
  std::sort(order.begin(), order.end());
  std::transform(order.begin(), order.end(), ids.begin(), [](const auto& entry) { return entry.second; });
}

// False where not all fit; those that do are in the writer.
bool write_updates(net::MessageWriter& writer, Level& level, const std::vector<EdictId>& ids, std::size_t most,
                   std::int32_t mask) {
  const std::size_t begin = writer.size();
  for (const EdictId id : ids) {
    const auto update = entity_update(level, id, writer.protocol, mask);
    if (!update) continue;
    const std::size_t before = writer.size();
    net::write_server_message(writer, *update);
    if (writer.size() - begin > most) {
      writer.truncate(before);
      return false;
    }
  }
  return true;
}

}  // namespace

std::int32_t effects_mask(const progs::Vm& vm) {
  constexpr std::int32_t kQuadLight = 16, kPentaLight = 32, kCandleLight = 64;
  const auto means = [&](std::string_view name, std::int32_t value) {
    return vm.get(vm.program().global<float>(name)) == static_cast<float>(value);
  };
  const bool rerelease =
      means("EF_QUADLIGHT", kQuadLight) && (means("EF_PENTLIGHT", kPentaLight) || means("EF_PENTALIGHT", kPentaLight));
  return rerelease ? -1 : ~(kQuadLight | kPentaLight | kCandleLight);
}

std::optional<net::svc::EntityUpdate> entity_update(Level& level, EdictId id, const net::Protocol& protocol,
                                                    std::int32_t effects_mask) {
  const Edict edict = level.edict(id);
  EdictExtra& extra = level.extra(id);
  const net::EntityState& base = extra.baseline;
  if (level.optional.alpha) extra.alpha = net::encode_alpha(edict.get(level.optional.alpha));
  extra.scale = net::encode_scale(edict.get(level.optional.scale));

  net::svc::EntityUpdate update;
  update.entity = static_cast<int>(index(id));
  update.effects = to_int(edict.get(fields::effects)) & effects_mask;
  if (extra.alpha == net::kAlphaZero && update.effects == 0) return std::nullopt;
  const auto note = [&](bool differs, std::uint32_t bit) { update.bits |= differs ? bit : 0u; };
  const auto field = [&](progs::Field<float> from, int& to, int baseline, std::uint32_t bit) {
    const float value = edict.get(from);
    to = to_int(value);
    note(value != static_cast<float>(baseline), bit);
  };
  update.origin = edict.get(fields::origin);
  update.angles = edict.get(fields::angles);
  constexpr std::uint32_t kAngleBits[] = {net::kUpdateAngle1, net::kUpdateAngle2, net::kUpdateAngle3};
  for (int axis = 0; axis < 3; ++axis) {
    note(std::abs(update.origin[axis] - base.origin[axis]) > 0.1, net::kUpdateOrigin1 << axis);
    note(update.angles[axis] != base.angles[axis], kAngleBits[axis]);
  }
  note(edict.get(fields::movetype) == static_cast<float>(kMoveStep), net::kUpdateStep);
  field(fields::colormap, update.colormap, base.colormap, net::kUpdateColormap);
  field(fields::skin, update.skin, base.skin, net::kUpdateSkin);
  field(fields::frame, update.frame, base.frame, net::kUpdateFrame);
  field(fields::modelindex, update.model, base.model, net::kUpdateModel);
  note(((base.effects ^ update.effects) & effects_mask) != 0, net::kUpdateEffects);
  if (!protocol.extended()) return update;
  update.alpha = extra.alpha;
  update.scale = extra.scale;
  note(base.alpha != extra.alpha, net::kUpdateAlpha);
  note(base.scale != extra.scale, net::kUpdateScale);
  note(extra.send_interval, net::kUpdateLerpFinish);
  update.lerp_finish = to_int(std::round((edict.get(fields::nextthink) - level.time) * 255.0)) & 0xff;
  return update;
}

bool write_entities(net::MessageWriter& writer, Level& level, EdictId player, std::size_t most, std::int32_t mask) {
  const std::size_t begin = writer.size();
  std::vector<EdictId> ids = visible_entities(level, player, writer.protocol);
  if (write_updates(writer, level, ids, most, mask)) return true;
  writer.truncate(begin);
  sort_by_distance(level, player, ids);
  (void)write_updates(writer, level, ids, most, mask);
  return false;
}

}  // namespace fb::sv
