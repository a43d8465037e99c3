// Set 0: the scene's buffers as render/gpu_scene.cpp fills them (Shaders/shared/scene_gpu.h says what is in each).
#ifndef FB_LIB_SCENE_BINDINGS
#define FB_LIB_SCENE_BINDINGS
#include "shared/bvh.h"
#include "shared/scene_gpu.h"

// The pass that makes copies writes what all others read.
#ifndef SCENE_ACCESS
#define SCENE_ACCESS readonly
#endif

layout(set = 0, binding = 0, std430) SCENE_ACCESS buffer NodeBlock { BvhNode nodes[]; };
layout(set = 0, binding = 1, std430) SCENE_ACCESS buffer TriangleBlock { GpuTriangle triangles[]; };
layout(set = 0, binding = 2, std430) readonly buffer AttributeBlock { GpuAttribute attributes[]; };
layout(set = 0, binding = 3, std430) readonly buffer PoseBlock { uvec2 poses[]; };
layout(set = 0, binding = 4, std430) readonly buffer NormalBlock { uint normals[]; };
layout(set = 0, binding = 5, std430) readonly buffer InstanceBlock { GpuInstance instances[]; };
layout(set = 0, binding = 6, std430) readonly buffer LevelBlock { uint levels[]; };
layout(set = 0, binding = 7, std430) readonly buffer MaterialBlock { GpuMaterial materials[]; };
layout(set = 0, binding = 8, std430) readonly buffer ImageBlock { GpuImage images[]; };
layout(set = 0, binding = 9, std430) readonly buffer TexelBlock { uint texels[]; };
layout(set = 0, binding = 10, std430) readonly buffer PaletteBlock { vec4 palette[256]; };
layout(set = 0, binding = 11, std430) readonly buffer CopyJobBlock { GpuCopyJob copy_jobs[]; };
layout(set = 0, binding = 12, std430) SCENE_ACCESS buffer VertexBlock { float posed_vertices[]; };

#if INTERSECTOR_QUERY
layout(set = 0, binding = 17) uniform accelerationStructureEXT scene_tlas;
#endif
#endif
