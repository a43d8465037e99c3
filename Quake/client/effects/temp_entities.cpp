#include "client/effects/temp_entities.h"

namespace fb::cl {

void apply_temp_entity(Effects& effects, const net::svc::TempEntity& message, double time) {
  const vec3& at = message.origin;
  const auto explosion_light = [&] {
    DynamicLight& light = effects.lights.allocate(0, time);
    light.origin = at;
    light.radius = 350.0f;
    light.die = time + 0.5;
    light.decay = 300.0f;
  };
  switch (message.type) {
    case net::TempEntityType::kSpike:
      effects.particles.effect(at, vec3(0.0f), 0, 10, time);
      break;
    case net::TempEntityType::kSuperSpike:
    case net::TempEntityType::kGunshot:
      effects.particles.effect(at, vec3(0.0f), 0, 20, time);
      break;
    case net::TempEntityType::kWizSpike:
      effects.particles.effect(at, vec3(0.0f), 20, 30, time);
      break;
    case net::TempEntityType::kKnightSpike:
      effects.particles.effect(at, vec3(0.0f), 226, 20, time);
      break;
    case net::TempEntityType::kExplosion:
      effects.particles.explosion(at, time);
      explosion_light();
      break;
    case net::TempEntityType::kExplosion2:
      effects.particles.color_explosion(at, message.color_start, message.color_length, time);
      explosion_light();
      break;
    case net::TempEntityType::kTarExplosion:
      effects.particles.blob_explosion(at, time);
      break;
    case net::TempEntityType::kLavaSplash:
      effects.particles.lava_splash(at, time);
      break;
    case net::TempEntityType::kTeleport:
      effects.particles.teleport_splash(at, time);
      break;
    case net::TempEntityType::kLightning1:
    case net::TempEntityType::kLightning2:
    case net::TempEntityType::kLightning3:
    case net::TempEntityType::kBeam:
      effects.beams.start(message.type, message.entity, at, message.end, time);
      break;
  }
}

}  // namespace fb::cl
