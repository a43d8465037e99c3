// Next-event estimation: the technique's uniform block.
#ifndef FB_NEE_H
#define FB_NEE_H
#include "shared/common.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

struct NeeConstants {
  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)
  uint seen_stride;  // of this many shadow rays one is remembered; a power of two
  uint seen_ways;    // the table of ways that is read, 0 or 1
};

FB_NAMESPACE_END
#endif
