// Which reservoirs of a square of pixels have so large a W that they would show as spots. An invocation has a square.
#ifndef FB_RESTIR_BOILING
#define FB_RESTIR_BOILING
#include "estimators/restir/steps/begin.glsl"
#include "estimators/restir/steps/fresh.glsl"

const uint kSquare = 8u;

uint word_of(uint element);  // its W, as it is stored
void empty(uint element);

void empty_what_stands_out() {
  uvec2 lit = uvec2(frame.light_width, (frame.height + frame.light_block - 1u) / frame.light_block);
  uvec2 first = invocation_pixel() * kSquare, end = min(first + kSquare, lit);
  if (any(greaterThanEqual(first, lit))) return;
  float sum = 0.0, count = 0.0;
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      float w = reservoir_number(uintBitsToFloat(word_of(y * lit.x + x)));
      sum += w;
      count += w > 0.0 ? 1.0 : 0.0;
    }
  float most = count > 0.0 ? restir.restir_boiling * (sum / count) : 0.0;
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x)
      if (reservoir_number(uintBitsToFloat(word_of(y * lit.x + x))) > most) empty(y * lit.x + x);
}
#endif
