// Storage arrays, declared alike whether shaders reach them through descriptors or by device address; `name.at[i]` is
// an element. ARRAYS_BY_ADDRESS 1 is faster to run and several times faster to compile on lavapipe since Mesa 24, where
// a load through a descriptor becomes a branch a lane; 0 is faster before, and for devices without addresses.
//
//   FB_ARRAY(set, first address of the set, binding, alignment, readonly or empty, Block, element, name)
#ifndef FB_LIB_ARRAYS
#define FB_LIB_ARRAYS
#include "shared/bindings.h"

#if ARRAYS_BY_ADDRESS
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
layout(set = kSetScene, binding = kBindAddresses, std140) uniform AddressBlock { uvec4 array_addresses[kAddresses]; };
#define FB_ARRAY(set_, first_, binding_, align_, access_, Block, element_, name_)                            \
  layout(buffer_reference, std430, buffer_reference_align = align_) access_ buffer Block { element_ at[]; }; \
  Block name_ = Block(array_addresses[first_ + binding_].xy);
#else
#define FB_ARRAY(set_, first_, binding_, align_, access_, Block, element_, name_)        \
  layout(set = set_, binding = binding_, std430) access_ buffer Block { element_ at[]; } \
  name_;
#endif

#define FB_SCENE_ARRAY(binding_, align_, access_, Block, element_, name_) \
  FB_ARRAY(kSetScene, kFirstSceneAddress, binding_, align_, access_, Block, element_, name_)
#define FB_FRAME_ARRAY(binding_, align_, access_, Block, element_, name_) \
  FB_ARRAY(kSetFrame, kFirstFrameAddress, binding_, align_, access_, Block, element_, name_)
#define FB_TECHNIQUE_ARRAY(binding_, align_, access_, Block, element_, name_) \
  FB_ARRAY(kSetTechnique, kFirstTechniqueAddress, binding_, align_, access_, Block, element_, name_)
// Arrays of one pass, in the technique's place.
#define FB_POSE_ARRAY(binding_, align_, access_, Block, element_, name_) \
  FB_ARRAY(kSetTechnique, kFirstPoseAddress, binding_, align_, access_, Block, element_, name_)
#define FB_DRAW_ARRAY(binding_, align_, access_, Block, element_, name_) \
  FB_ARRAY(kSetTechnique, kFirstDrawAddress, binding_, align_, access_, Block, element_, name_)
#endif
