// The scene's arrays as render/scene/gpu_scene.cpp fills them (Shaders/shared/scene_gpu.h says what is in each). Those
// that lib/scene_records.glsl reads through texel buffers alone are declared there.
#ifndef FB_LIB_SCENE_BINDINGS
#define FB_LIB_SCENE_BINDINGS
#include "lib/arrays.glsl"
#include "shared/bvh.h"
#include "shared/scene_gpu.h"

// The pass that makes copies writes what all others read.
#ifndef SCENE_ACCESS
#define SCENE_ACCESS readonly
#endif

FB_SCENE_ARRAY(kBindNodes, 16, SCENE_ACCESS, NodeArray, BvhNode, nodes)
FB_SCENE_ARRAY(kBindTriangles, 16, SCENE_ACCESS, TriangleArray, GpuTriangle, triangles)
FB_SCENE_ARRAY(kBindAttributes, 16, readonly, AttributeArray, GpuAttribute, attributes)
FB_SCENE_ARRAY(kBindPoses, 8, readonly, PoseArray, uvec2, poses)
FB_SCENE_ARRAY(kBindNormals, 4, readonly, NormalArray, uint, normals)
FB_SCENE_ARRAY(kBindTexels, 4, readonly, TexelArray, uint, texels)

#if INTERSECTOR_QUERY
layout(set = kSetScene, binding = kBindTlas) uniform accelerationStructureEXT scene_tlas;
#endif
#endif
