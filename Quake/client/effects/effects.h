// The short-lived effects that are not entities.
#pragma once

#include "client/effects/beams.h"
#include "client/effects/dlights.h"
#include "client/effects/particles.h"

namespace fb::cl {

struct Effects {
  ParticleSystem particles;
  DynamicLights lights;
  Beams beams;

  void clear() {
    particles.clear();
    lights.clear();
    beams.clear();
  }
};

}  // namespace fb::cl
