// Every number that the host and the shaders agree on to find each other's data: descriptor sets, bindings and
// specialisation constants. Nothing else numbers them.
//
// Shaders see three sets: the scene, the frame, and what a technique keeps of its own; in the place of the third two
// passes see arrays that no other pass reads. Storage bindings of a set count from 0; three together stay within the 32
// storage buffers a stage that every desktop driver and lavapipe offer.
#ifndef FB_SHARED_BINDINGS_H
#define FB_SHARED_BINDINGS_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kSetScene = 0u;
FB_CONST uint kSetFrame = 1u;
FB_CONST uint kSetTechnique = 2u;
FB_CONST uint kSetPlaces = 3u;  // that a shader sees
// In the third place, of one pass each:
FB_CONST uint kSetPose = 3u;  // passes/pose.comp
FB_CONST uint kSetDraw = 4u;  // passes/present.comp
FB_CONST uint kSetCount = 5u;

// Set kSetScene: the scene (shared/scene_gpu.h).
FB_CONST uint kBindNodes = 0u;       // BvhNode[]: see shared/bvh.h
FB_CONST uint kBindTriangles = 1u;   // GpuTriangle[]: positions in leaf order, of meshes and of copies
FB_CONST uint kBindAttributes = 2u;  // GpuAttribute[]: one a mesh triangle, in the same leaf order
FB_CONST uint kBindPoses = 3u;       // uvec2[]: PoseVertex of all posed meshes
FB_CONST uint kBindNormals = 4u;     // uint[]: octahedral 2x16 snorm vertex normals of smooth rigid meshes
FB_CONST uint kBindInstances = 5u;   // GpuInstance[]
FB_CONST uint kBindMaterials = 6u;   // GpuMaterial[]: this frame's (animated textures are resolved)
FB_CONST uint kBindImages = 7u;      // GpuImage[]
FB_CONST uint kBindTexels = 8u;      // uint[]: all texels
FB_CONST uint kBindPalette = 9u;     // vec4[256]: linear Rec.709 colour
FB_CONST uint kBindLights = 10u;     // uvec4[]: the list of lights, for techniques that sample it
FB_CONST uint kSceneArrays = 11u;

FB_CONST uint kBindFrameConstants = 16u;  // FrameConstants, a uniform buffer
FB_CONST uint kBindTlas = 17u;            // the top-level acceleration structure, where the device has ray query
// A technique's constants, a uniform buffer. Not in its own set: lavapipe compiles a shader for the values of its
// uniforms where a set with uniforms is bound before its dispatch, and sets of the third place change within a frame.
FB_CONST uint kBindTechniqueConstants = 49u;
FB_CONST uint kBindAddresses = 48u;  // uvec4[kAddresses], a uniform buffer: xy is an array's device address

// Uniform texel buffers of four words a texel (usamplerBuffer): how arrays of records are read
// (lib/scene_records.glsl).
FB_CONST uint kBindTexelBuffers = 18u;
FB_CONST uint kTexelsNodes = 0u;
FB_CONST uint kTexelsTriangles = 1u;
FB_CONST uint kTexelsHistory = 2u;
FB_CONST uint kTexelsGBuffer = 3u;
FB_CONST uint kTexelsInstances = 4u;
FB_CONST uint kTexelsAttributes = 5u;
FB_CONST uint kTexelsMaterials = 6u;
FB_CONST uint kTexelsImages = 7u;
FB_CONST uint kTexelsPalette = 8u;
FB_CONST uint kTexelsLights = 9u;
FB_CONST uint kTexelsTechnique = 10u;  // a technique's arrays
FB_CONST uint kTexelBuffers = kTexelsTechnique + 10u;

// Set kSetFrame: the picture and what passes keep from frame to frame.
FB_CONST uint kBindGBuffer =
    0u;  // uvec4[5][pixels], a GBufferTexel's; with water [kWaterPlanes][pixels] more (lib/water_texel.glsl)
FB_CONST uint kBindRadiance = 1u;  // vec4[pixels]: this frame's mean of samples; w: samples that were not finite.
                                   // Then, where there is a medium, the light that it scatters, and twice what is
                                   // known of distances in it (lib/medium_distances.glsl); then, with water,
                                   // vec4[pixels] of second surfaces (lib/second_surface.glsl)
FB_CONST uint kBindMean = 2u;      // vec4[pixels]: mean over the accumulated frames (rgb), w their number
FB_CONST uint kBindM2 = 3u;        // vec4[pixels]: sum of squared deviations from that mean (Welford)
FB_CONST uint kBindLdr = 4u;     // uint[pixels]: tone-mapped, sRGB, r lowest. Before that, while the G-buffer is made:
                                 // uint[2][tiles of 8x8 pixels], lib/water_tiles.glsl
FB_CONST uint kBindSmooth = 5u;  // uint[pixels]: after anti-aliasing
FB_CONST uint kBindOutput = 6u;  // uint[output pixels]: what is shown
FB_CONST uint kBindExposure = 7u;          // ExposureBuffer[1]
FB_CONST uint kBindCounters = 8u;          // uint[kCounterCount]
FB_CONST uint kBindHistory = 9u;           // uvec4[]: the denoiser's past frames (shared/denoise.h)
FB_CONST uint kBindPreviousGBuffer = 10u;  // kBindGBuffer of the former frame, for techniques that want it
FB_CONST uint kFrameArrays = 11u;

// The same set in passes/trace_rays.comp (shared/ray_list.h).
FB_CONST uint kBindRays = 0u;  // ListRay[]
FB_CONST uint kBindHits = 1u;  // ListHit[]

// Set kSetTechnique: a technique's own storage buffers, numbered from 0 by its header (estimators/NAME/NAME.h), those
// that techniques share from the last one down; all are texel buffers as well (kTexelsTechnique).
FB_CONST uint kTechniqueArrays = 10u;
#define FB_ARRAY_CONSTANT(constant, binding, per, bytes, former, name) FB_CONST uint constant = binding;
FB_CONST uint kBindSeen = kTechniqueArrays - 1u;  // shared/seen_grid.h

// Set kSetPose.
FB_CONST uint kBindLevels = 0u;    // uint[]: nodes of each mesh's tree, by depth (for refitting)
FB_CONST uint kBindCopyJobs = 1u;  // GpuCopyJob[]: copies that this frame makes
FB_CONST uint kBindVertices = 2u;  // float[]: corners of triangles in leaf order, for ray query builds
FB_CONST uint kPoseArrays = 3u;

// Set kSetDraw.
FB_CONST uint kBindQuads = 0u;  // GpuQuad[]
FB_CONST uint kBindTiles = 1u;  // uint[]: a tile's first and last+1 index, then the lists of quads
FB_CONST uint kBindAtlas = 2u;  // uint[]: texels of 2D drawing
FB_CONST uint kDrawArrays = 3u;

// That a shader sees at once, at most.
FB_CONST uint kArraysInPlace = kSceneArrays + kFrameArrays + kTechniqueArrays;

// Where an array's address stands in the block kBindAddresses.
FB_CONST uint kFirstSceneAddress = 0u;
FB_CONST uint kFirstFrameAddress = kSceneArrays;
FB_CONST uint kFirstTechniqueAddress = kFirstFrameAddress + kFrameArrays;
FB_CONST uint kFirstPoseAddress = kFirstTechniqueAddress + kTechniqueArrays;
FB_CONST uint kFirstDrawAddress = kFirstPoseAddress + kPoseArrays;
FB_CONST uint kAddresses = kFirstDrawAddress + kDrawArrays;

// Specialisation constants. What the scene needs:
FB_CONST uint kSpecCandidates = 0u;  // alpha tests or translucency
FB_CONST uint kSpecSpecular = 1u;    // some material is not plain Lambert
FB_CONST uint kSpecFeatures = 3u;    // what surfaces and sky have: kFeature* (shared/kinds.h)
// What a technique is set to (kSpecTechnique and up are its own to number), and whether it draws its debug view:
FB_CONST uint kSpecShowView = 2u;
FB_CONST uint kSpecTechnique = 4u;
FB_CONST uint kTechniqueSpecs = 4u;
// Whether there is a medium between the surfaces:
FB_CONST uint kSpecMedium = 8u;
// Whether paths have one reflection at most (scattering in a medium counts as one):
FB_CONST uint kSpecOneBounce = 10u;
// Whether less code counts more than speed: a shader that stands in while another is compiled.
FB_CONST uint kSpecSmall = 11u;
// Whether some surface is a dielectric interface, of water or glass (kMaterialDielectric):
FB_CONST uint kSpecWater = 9u;
// Whether lanes are a GPU's: branches and memory of a lane's own are cheap there, registers and code are not. A
// processor's, lavapipe's, want the opposite.
FB_CONST uint kSpecGpuLanes = 12u;
// Of passes/pose.comp:
FB_CONST uint kSpecForQuery = 0u;

FB_NAMESPACE_END
#endif
