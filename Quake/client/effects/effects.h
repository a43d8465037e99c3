// What lives for a moment and is no entity.
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
