// Halls and caves made in code, each hard for a light estimator in one named way. Closed, one bounded space each, all
// emission EmissionKind::kConstant. many_lights() of scenes_in_code.h belongs with them.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/snapshot.h"

namespace fb::scene {

// Hard: some tens of tiny lights of unequal strength (a factor of 30 between the weakest and the strongest), of which
// every surface sees another few: a pillared hall, 768 x 512 x 224, with candles on its floor and on its pillars.
// Each flame is an instance; its radiance and its height flicker with time (seconds), so that two times are two frames
// of one film; all else stands still. Snapshots that share `assets` (candle_assets) are frames of one film.
constexpr std::uint32_t kCandles = 40;
constexpr std::uint32_t kCandleFlame = kIdEntityLight;  // + 0 .. kCandles - 1
std::shared_ptr<const Assets> candle_assets();
FrameSnapshot candles(const std::shared_ptr<const Assets>& assets, double time, double prev_time);

// Hard: no light reaches what the camera sees directly. Thin strips glow on the back of the ledge around a portal, and
// light only the portal's recess; the room before it has what the recess throws back (PORTAL of Alber 2025, Fig. 6).
// No point outside of the recess sees a strip: with fewer than two bounces the room is black.
FrameSnapshot strips();
constexpr float kStripsRecess = 384.0f;  // x from which on there is recess; the room is before it

// Hard the other way round: one light so large that plain BSDF sampling finds it well, so that narrow lobes can only
// lose. A dark cave of uneven blocks over a pool of lava, with a causeway on which the camera stands; nothing else
// glows. The causeway's top sees no lava: what it shows is reflected.
FrameSnapshot lava_cave();

// Hard for what keeps one direction a pixel: three small lamps, red, green and blue, of the same radiance, in a row
// across a closed room, so that each outshines the others on its part of the floor and two are alike on the borders
// (Dittebrandt 2023, Fig. 12).
FrameSnapshot three_lamps();
constexpr std::uint32_t kThreeLamps = kIdEntityLight;  // + 0 .. 2: red, green, blue

}  // namespace fb::scene
