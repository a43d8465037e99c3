// The scene as the device holds it: one contract for render/scene/gpu_scene.cpp, which fills it, and Shaders/lib, which
// reads it. All structs are std430. Transforms are rows of a 3x4 matrix: row i is (m_i0, m_i1, m_i2, translation_i).
#ifndef FB_SHARED_SCENE_GPU_H
#define FB_SHARED_SCENE_GPU_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kNoIndex = 0xffffffffu;

// 48 bytes: v0, v1 - v0, v2 - v0; in the mesh's space, or, where our own trees are traced, in the world's. There v0.w
// says as bits whose the triangle is: bit 0 whether hits must ask, bits 1..2 visibility, above these the instance.
struct GpuTriangle {
  vec4 v0;
  vec4 e1;
  vec4 e2;
};

struct GpuAttribute {              // 48 bytes
  uint vertex0, vertex1, vertex2;  // of the mesh (poses, normals)
  uint material;                   // added to GpuInstance::material_base
  vec2 uv0, uv1, uv2;              // 1 is one repeat of the texture
  uint flags;                      // kTriangle*
  uint face;                       // of the map (scene::MeshTriangle::face), or kNoIndex
};
FB_CONST uint kTriangleAsks = 1u;
FB_CONST uint kTriangleVisibilityShift = 1u;
FB_CONST uint kTriangleInstanceShift = 3u;
FB_CONST uint kTriangleAlphaTest = 1u;  // candidate hits must ask the texel
FB_CONST uint kTriangleSmooth = 2u;     // has vertex normals
FB_CONST uint kTriangleDielectric =
    4u;  // its material may be kMaterialDielectric, if the instance's material base is 0
FB_CONST uint kTriangleLiquidInFront = 8u;  // kMaterialDielectric: the liquid is on the side that it faces

struct GpuInstance {  // 272 bytes
  vec4 to_world[3];
  vec4 to_object[3];  // linear part; w: the origin in the world
  vec4 prev_to_world[3];
  uint world_triangle;   // into triangles: the first of those that rays are traced against (ours, not ray query)
  uint first_triangle;   // into triangles: the mesh's, or a posed instance's own, in the mesh's space
  uint first_attribute;  // into attributes
  uint first_normal;     // into normals, or kNoIndex
  uint pose_a, pose_b;   // first vertex of the pose in poses; kNoIndex: rigid
  uint prev_pose_a, prev_pose_b;
  float pose_t, prev_pose_t;
  uint material_base;
  uint flags;  // low bits: scene::Visibility << 0 (2 bits); kInstance* below
  uint id;     // scene::Instance::id
  float alpha;
  float time_offset;
  uint triangle_count;
  vec4 color;     // kInstanceHasColor: linear reflectance; w: kInstanceIsSpot: the cosine at which its cone ends
  vec4 emission;  // kInstanceHasColor: radiance factor; w: the cosine up to which it is whole
  vec4 pose_scale, pose_origin;
};
FB_CONST uint kInstanceMaskBits = 3u;
FB_CONST uint kInstanceHasColor = 4u;
FB_CONST uint kInstanceMoves = 64u;        // its points were elsewhere in the former frame
FB_CONST uint kInstanceIsNew = 128u;       // it was not there
FB_CONST uint kInstanceIsSpot = 256u;      // it shines about its x axis alone, by a law of distance (shared/spot.h)
FB_CONST uint kInstanceFallShift = 9u;     // three bits: that law; pose_scale.x is its scale
FB_CONST uint kInstanceTranslucent = 32u;  // alpha < 1: candidate hits must ask

// A copy of a mesh for one instance and this frame; a workgroup makes it. Posed triangles in the mesh's space, for
// shading; the triangles in the world's space and the refitted tree over them, for tracing.
FB_CONST uint kCopyLevels = 44u;  // above shared/bvh.h's kMaxMeshDepth
struct GpuCopyJob {               // 320 bytes
  vec4 to_world[3];
  vec4 scale, origin;   // of pose vertices
  uint pose_a, pose_b;  // first vertices in poses; kNoIndex: rigid
  float pose_t;
  uint triangle_count;
  uint first_attribute;           // of the mesh
  uint object_triangle;           // rigid: read from there; posed: written there
  uint world_triangle;            // written there (our own trees)
  uint first_vertex;              // corners are written there (ray query)
  uint owner;                     // v0.w of the copy's triangles, but for their own kTriangleAsks
  uint mesh_node, mesh_triangle;  // what references in the mesh's tree count from
  uint first_node;                // of the copy's tree
  uint first_level_entry;         // into levels
  uint level_count;
  uint pad0, pad1;
  uint level_first[44];  // levels l's nodes are entries level_first[l] .. level_first[l + 1] - 1
};

struct GpuMaterial {               // 96 bytes
  uint base, luma, normal, gloss;  // images, or kNoIndex
  vec4 base_color;                 // w: alpha
  vec4 emission;  // factor for what it lights, the kind's cvar already in it; w: kMaterialDielectric: index of
                  // refraction
  float roughness, specular, metalness;
  uint flags;                                      // scene::MaterialFlags
  uint emission_kind;                              // scene::EmissionKind
  float extinction_r, extinction_g, extinction_b;  // kMaterialDielectric: of what is behind it, 1/unit
  float scattering;                                // likewise, the part of extinction that is scattered
  float opaque_share;  // kMaterialDielectric: of its surface, which glows and ends a ray; the rest is the interface
  uint seen_rg,
      seen_b;  // halves: factor on emission for what the camera sees itself (seen_emission); high half of seen_b: scale
               // of the linear law by which what it lights falls off (shared/spot.h), 0: by the square
};

// The list of lights, a buffer of four tables. First a uint for each instance: the number of the light that its
// triangle 0 is, kNoIndex if nothing of it glows; its other triangles follow. Then, at texel frame.light_first, the
// lights, and at frame.lamp_first the lamps, each of which is a few lights of one instance that are near each other:
// what is remembered of lights from frame to frame has a lamp's number, which stays while its instance is there. At
// frame.former_first, a uint for each instance of the former frame: its index in this one, kNoIndex where it is gone.
//
// Lights, of all and of a lamp, are drawn by alias tables (Walker 1977; Vose 1991), which are exact: a random integer
// below the range that is below `threshold` chooses the light in that place itself, else `other`.
struct GpuLight {                    // 32 bytes
  uint threshold, other;             // of the list's table, range kLightRange
  uint lamp_threshold, lamp_lights;  // of a lamp's, range kLampRange, place i in its first light + i: halves, where the
                                     // light itself and the other are, from the first one on
  uint probability;                  // among all, times kLightRange, an integer
  uint instance, triangle;
  uint lamp;  // high half: probability within its lamp, times kLampRange; low half: the lamp's number + 1, 0: of none
};
struct GpuLamp {      // 8 bytes
  uint first, count;  // its first light, and kLampIsNew; lights that it has, 0: it has gone out
};
FB_CONST uint kLampIsNew = 0x80000000u;  // it did not shine in the former frame, or with other triangles
FB_CONST uint kLightRange = 0x80000000u;
FB_CONST uint kLampRange = 0x8000u;
FB_CONST uint kMostLamps = 65534u;  // that have a number
FB_CONST uint kLampLights = 8u;     // the most of one
FB_CONST uint kLampGap = 64u;       // triangles between two lights of one, at most

struct GpuImage {  // 16 bytes
  uint first;      // first texel: in bytes for palette images, in uints for RGBA
  uint size;       // width | height << 16
  uint encoding;   // scene::ImageEncoding
  uint pad;
};

FB_NAMESPACE_END
#endif
