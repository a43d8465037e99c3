// Linear Rec.709 colour.
#ifndef FB_SHARED_COLOR_H
#define FB_SHARED_COLOR_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_FN float luminance(vec3 c) { return dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

FB_NAMESPACE_END
#endif
