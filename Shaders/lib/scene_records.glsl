// Records of the scene's tables, through texel buffers: lavapipe loads each word of a storage buffer by itself (before
// Mesa 24 lane by lane), four words of a texel buffer at once. Words that nobody reads are not fetched.
#ifndef FB_LIB_SCENE_RECORDS
#define FB_LIB_SCENE_RECORDS
#include "lib/scene_bindings.glsl"

layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsTriangles) uniform usamplerBuffer triangle_texels;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsInstances) uniform usamplerBuffer instance_texels;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsAttributes) uniform usamplerBuffer attribute_texels;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsMaterials) uniform usamplerBuffer material_texels;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsImages) uniform usamplerBuffer image_texels;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsPalette) uniform usamplerBuffer palette_texels;

uvec4 triangle_quad(uint at) { return texelFetch(triangle_texels, int(at)); }

GpuTriangle triangle_at(uint index) {
  return GpuTriangle(uintBitsToFloat(triangle_quad(index * 3u)), uintBitsToFloat(triangle_quad(index * 3u + 1u)),
                     uintBitsToFloat(triangle_quad(index * 3u + 2u)));
}

vec4 instance_row(int at) { return uintBitsToFloat(texelFetch(instance_texels, at)); }

GpuInstance instance_at(uint index) {
  int at = int(index) * 17;
  uvec4 places = texelFetch(instance_texels, at + 9), poses_of = texelFetch(instance_texels, at + 10);
  uvec4 more = texelFetch(instance_texels, at + 11), last = texelFetch(instance_texels, at + 12);
  return GpuInstance(vec4[](instance_row(at), instance_row(at + 1), instance_row(at + 2)),
                     vec4[](instance_row(at + 3), instance_row(at + 4), instance_row(at + 5)),
                     vec4[](instance_row(at + 6), instance_row(at + 7), instance_row(at + 8)), places.x, places.y,
                     places.z, places.w, poses_of.x, poses_of.y, poses_of.z, poses_of.w, uintBitsToFloat(more.x),
                     uintBitsToFloat(more.y), more.z, more.w, last.x, uintBitsToFloat(last.y), uintBitsToFloat(last.z),
                     last.w, instance_row(at + 13), instance_row(at + 14), instance_row(at + 15),
                     instance_row(at + 16));
}

GpuAttribute attribute_at(uint index) {
  int at = int(index) * 3;
  uvec4 first = texelFetch(attribute_texels, at);
  vec4 uv = uintBitsToFloat(texelFetch(attribute_texels, at + 1));
  uvec4 last = texelFetch(attribute_texels, at + 2);
  return GpuAttribute(first.x, first.y, first.z, first.w, uv.xy, uv.zw, uintBitsToFloat(last.xy), last.z, last.w);
}

GpuMaterial material_at(uint index) {
  int at = int(index) * 6;
  uvec4 images_of = texelFetch(material_texels, at), shape = texelFetch(material_texels, at + 3);
  uvec4 last = texelFetch(material_texels, at + 4), inside = texelFetch(material_texels, at + 5);
  return GpuMaterial(
      images_of.x, images_of.y, images_of.z, images_of.w, uintBitsToFloat(texelFetch(material_texels, at + 1)),
      uintBitsToFloat(texelFetch(material_texels, at + 2)), uintBitsToFloat(shape.x), uintBitsToFloat(shape.y),
      uintBitsToFloat(shape.z), shape.w, last.x, uintBitsToFloat(last.y), uintBitsToFloat(last.z),
      uintBitsToFloat(last.w), uintBitsToFloat(inside.x), uintBitsToFloat(inside.y), inside.z, inside.w);
}

vec3 seen_emission(GpuMaterial m) { return vec3(unpackHalf2x16(m.seen_rg), unpackHalf2x16(m.seen_b).x); }

GpuImage image_at(uint index) {
  uvec4 image = texelFetch(image_texels, int(index));
  return GpuImage(image.x, image.y, image.z, image.w);
}

// Linear colour of a channel each: the palette's 256 colours, then kPaletteSrgb + byte, what a byte of sRGB means.
vec3 palette_at(uvec3 index) {
  return uintBitsToFloat(uvec3(texelFetch(palette_texels, int(index.x)).x, texelFetch(palette_texels, int(index.y)).y,
                               texelFetch(palette_texels, int(index.z)).z));
}
#endif
