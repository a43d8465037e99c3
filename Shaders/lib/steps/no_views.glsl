// Step `views` of a technique without debug views of its own. Of others draw_view writes a pixel of the picture (ldr)
// and, where its view is of light, the pixel's radiance; `lit`: the pixel shows a surface that reflects, `v`.
#include "lib/pixel_start.glsl"

const bool kHasViews = false;

void draw_view(PathPixel p, bool lit, Vertex v) {}
