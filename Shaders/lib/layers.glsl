// What the denoiser keeps apart from the light on pixels' own surfaces, at blocks of pixels, each a texel
// (shared/denoise.h, LayerTexel): what a medium scatters, and the light on second surfaces (lib/second_surface.glsl).
#ifndef FB_LIB_LAYERS
#define FB_LIB_LAYERS
#include "lib/denoise.glsl"
#include "lib/second_surface.glsl"
#include "shared/medium.h"

struct Layer {
  uint block;  // pixels a side of a block
  ivec2 size;  // blocks
  uint first;  // texel of its first slot
};
Layer layer_of(uint block, uint width, uint first) {
  return Layer(block, ivec2(width, (frame.height + block - 1u) / block), first);
}
Layer medium_layer() { return layer_of(frame.medium_block, frame.medium_width, frame.medium_layer); }
Layer second_layer() { return layer_of(frame.light_block, frame.light_width, frame.second_layer); }
uint layer_slot(Layer layer, uint slot) { return layer.first + slot * uint(layer.size.x * layer.size.y); }

struct LayerLight {
  vec3 light;               // over the pixel's factor
  float frames;             // 0: none
  uint place;               // pack_surface of where it comes from
  float mean, mean_square;  // of luminance
};
LayerLight unpack_layer(uvec4 t) {
  vec2 moments = unpackHalf2x16(t.w);
  return LayerLight(vec3(unpackHalf2x16(t.x), unpackHalf2x16(t.y & 0xffffu).x), float(t.y >> 16u), t.z, moments.x,
                    moments.y * moments.y);
}
uvec4 pack_layer(LayerLight m) {
  return uvec4(packHalf2x16(m.light.rg), (packHalf2x16(vec2(m.light.b, 0.0)) & 0xffffu) | (uint(m.frames + 0.5) << 16u),
               m.place, packHalf2x16(vec2(m.mean, sqrt(max(m.mean_square, 0.0)))));
}

// How alike two places are, as a factor of weight: the fourth power of the ratio of their depths, less where they are
// turned.
float layer_alike(uint a, uint b) {
  vec3 turned = unpack_surface_normal(a) - unpack_surface_normal(b);
  float x = unpack_surface_inverse_depth(a), y = unpack_surface_inverse_depth(b);
  float t = min(x, y) / max(x, y) * max(1.0 - dot(turned, turned), 0.0), t2 = t * t;
  return t2 * t2;
}

// What a layer has at a pixel.
struct LayerThere {
  vec3 factor;  // on its light; zero: it has none here
  float depth;  // of the place it comes from, along the view
  vec3 normal;  // there
};
uint place_of(LayerThere there) { return pack_surface(1.0 / max(there.depth, 1e-6), there.normal); }

// What scatters on a pixel's way, fog and a liquid together: its light is what would be scattered if the medium took
// all light; its place, where light scatters in the mean. `ray`: to the pixel, 1 along the view.
LayerThere medium_there(uint at, vec3 ray) {
  float depth = uintBitsToFloat(gbuffer_quad(at, 4u).z), reach = depth > 0.0 ? depth * length(ray) : 1e6;
  vec3 factor = frame.medium.rgb * haze_opacity(camera_haze(), reach);
  float distance = haze_mean(camera_haze(), reach);
  if (frame.turbid != 0u) {
    uvec4 words = gbuffer_quad(at, kLiquidPlane);
    vec2 rest = unpackHalf2x16(words.y);
    vec3 liquid = vec3(unpackHalf2x16(words.x), rest.x);
    float of_fog = luminance_of(factor), of_liquid = luminance_of(liquid);
    distance = of_liquid > 0.0 ? mix(distance, rest.y, of_liquid / (of_fog + of_liquid)) : distance;
    factor += liquid;
  }
  return LayerThere(factor, distance / length(ray), vec3(0.0, 0.0, 1.0));
}

LayerThere second_there(uint at, vec3 ray) {
  SecondTexel s = second_at(at);
  bool none = s.albedo == vec3(0.0);  // then nothing else is stored of it
  return LayerThere(second_factor(at, ray), none ? 1.0 : s.depth, none ? vec3(0.0, 0.0, 1.0) : second_normal(at));
}

// A layer's light at a pixel, from slot 3: of the four blocks about it, those of its place. `guess`: where none has
// any. Where no pixel of the frame has the layer the slot was not written.
vec3 layer_color(Layer layer, LayerThere there, uvec2 pixel, vec3 guess) {
  if (there.factor == vec3(0.0)) return vec3(0.0);
  uint place = place_of(there);
  vec2 point = (vec2(pixel) + 0.5) / float(layer.block) - 0.5, corner = floor(point), f = point - corner;
  uint from = layer_slot(layer, 3u);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (uint i = 0u; i < 4u; ++i) {
    vec2 offset = vec2(i & 1u, i >> 1u);
    ivec2 b = clamp(ivec2(corner + offset), ivec2(0), layer.size - 1);
    LayerLight m = unpack_layer(history_quad(from + uint(b.y * layer.size.x + b.x)));
    vec2 along = mix(1.0 - f, f, offset);
    float weight = m.frames > 0.0 ? max(along.x * along.y, 1e-4) * (layer_alike(place, m.place) + 1e-6) : 0.0;
    sum += weight * m.light;
    weights += weight;
  }
  return there.factor * (weights > 0.0 ? sum / weights : guess);
}
#endif
