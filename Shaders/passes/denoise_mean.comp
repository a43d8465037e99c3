// While nothing changes: the denoised picture gives way to the accumulated mean, so that it converges to what is right.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/denoise.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, to = section(kSectionPicture) * 4u + 2u * at;
  uvec2 texel = picture_texel(at);
  vec4 mean = mean_radiance.at[at];
  float frames = max(mean.w - 1.0, 0.0);
  vec3 color = clamp(mix(picture_color(texel), mean.rgb, frames / (frames + frame.svgf_mean_frames)), vec3(-kMaxHalf),
                     vec3(kMaxHalf));
  history_words.at[to] = packHalf2x16(color.rg);
  history_words.at[to + 1u] = packHalf2x16(vec2(color.b, 0.0)) | (texel.y & 0xffff0000u);
}
