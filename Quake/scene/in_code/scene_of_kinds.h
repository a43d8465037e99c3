// One room with a light of every kind that the renderer knows, for tests of what finds lights.
#pragma once

#include "scene/snapshot.h"

namespace fb::scene {

// Hard: nothing in particular, but nothing is left out. A room of 512 x 384 x 256 with a coated floor; sky of two
// layers through a hole in its ceiling, and two suns whose discs overlap; lava that swings; a wall with texels that
// glow by their index, another with a luma image; a translucent pane and a sprite with holes, both glowing; a posed
// body; a sphere that only paths see, and one that only the camera sees.
FrameSnapshot light_of_every_kind();

}  // namespace fb::scene
