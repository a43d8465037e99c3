#include "render/settings.h"

namespace fb::render {
