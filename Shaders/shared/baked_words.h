// The baked light of a map as words, for the view of it: kBakedFaceWords words of each face, then the luxels, a word
// each (red, green, blue from the lowest byte on), of a face's first style, then of its second, and so on.
#ifndef FB_SHARED_BAKED_WORDS_H
#define FB_SHARED_BAKED_WORDS_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kBakedFaceWords = 12u;
FB_CONST uint kBakedAxes = 0u;          // eight floats: luxel = dot(axis.xyz, point) + axis.w
FB_CONST uint kBakedSize = 8u;          // width | height << 16; 0: none
FB_CONST uint kBakedFirst = 9u;         // its first luxel's word
FB_CONST uint kBakedStyles = 10u;       // four bytes, 255: none
FB_CONST uint kBakedKind = 11u;         // kBakedWhole
FB_CONST uint kBakedWhole = 1u;         // it shows its texture whole, in no light: a liquid
FB_CONST float kPaintedLuxel = 128.0f;  // the value that shows a texture as it was painted

FB_NAMESPACE_END
#endif
