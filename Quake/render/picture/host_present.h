// The frame's last step on the host, for devices that are processors: the anti-aliased picture is scaled up to its
// place in the output by a sharpened cubic filter (Mitchell and Netravali 1988, B = 0; C is its sharpness), and the 2D
// is drawn over it. present.comp does the same on a device, bilinearly; as a shader of lavapipe it takes some ten times
// as long (Misc/docs/measurements.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "scene/draw_list.h"

namespace fb::render {

// Of present.comp's part of FrameConstants.
struct PresentedPicture {
  uvec2 size{1, 1};               // of the anti-aliased picture
  uvec2 output{1, 1};             // pixels
  scene::Area place;              // in the output; black around it
  vec4 tint{0.0f};                // colour, and its share
  float sharpness = 0.5f;         // C
  float gamma = 1, contrast = 1;  // of everything
  bool warps = false;             // distorted by waves (shared/picture_warp.h)
  float warp_phase = 0;           // radians
  bool swap_red_blue = false;
};

class HostPresent {
 public:
  // Before the frame: what is to be drawn over it; may be null. What it needs of the list is kept.
  void prepare(const scene::DrawList* list);
  // `picture`: packed 8-bit pixels of picture.size, `output` of picture.output. On all processors.
  void draw(const PresentedPicture& picture, std::span<const std::uint32_t> pixels, std::span<std::uint32_t> output);

 private:
  struct Quad {
    vec2 min, max, uv_min, uv_max;
    std::array<std::uint32_t, 4> color;  // of 255, in the output's order
    bool textured;
  };
  void draw_quads(const PresentedPicture& picture, std::span<std::uint32_t> output, std::uint32_t first,
                  std::uint32_t end) const;

  std::vector<scene::DrawQuad> list_;
  std::vector<Quad> quads_;
  std::vector<std::uint32_t> atlas_;  // of atlas_revision_
  std::uint64_t atlas_revision_ = 0;
  std::uint32_t atlas_width_ = 1;
  std::vector<std::uint32_t> source_;  // tinted, distorted, in the output's order
};

// Weights of the four texels about a point `f` of the way from the second to the third; their sum is 1.
std::array<float, 4> cubic_weights(float f, float sharpness);

}  // namespace fb::render
