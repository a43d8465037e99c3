// The techniques there are: a row registers one. Its host code stands in this folder (TechniqueInfo kNAME), its shader,
// Shaders/estimators/FOLDER/NAME.comp, chooses the steps of the path loop (Shaders/lib/path.glsl).
#include <algorithm>

#include "render/techniques/technique.h"

#define FB_TECHNIQUES(X) \
  X(kPt)                 \
  X(kNee)                \
  X(kMcpg)               \
  X(kMcpgNee)            \
  X(kMcpgTail)           \
  X(kMcpgNeeTail)        \
  X(kMcpgCv)             \
  X(kRestirDi)           \
  X(kRestirGi)           \
  X(kRestirGuided)       \
  X(kSsmm)               \
  X(kSsmmNee)            \
  X(kPstfCv)             \
  X(kPstfCvNee)          \
  X(kPstfIs)             \
  X(kPstfIsNee)          \
  X(kPstfIsCv)           \
  X(kPstfIsCvNee)        \
  X(kPstfB)              \
  X(kPstfBNee)           \
  X(kMir)                \
  X(kMirNee)             \
  X(kDdgi)               \
  X(kDdgiPlus)           \
  X(kDdgiRestir)

namespace fb::render {

#define FB_DECLARE(row) extern const TechniqueInfo row;
FB_TECHNIQUES(FB_DECLARE)
#undef FB_DECLARE

const std::vector<TechniqueInfo>& techniques() {
#define FB_ROW(row) row,
  static const std::vector<TechniqueInfo> list{FB_TECHNIQUES(FB_ROW)};
#undef FB_ROW
  return list;
}

const TechniqueInfo* find_technique(std::string_view name) {
  const auto& list = techniques();
  const auto found = std::find_if(list.begin(), list.end(), [&](const TechniqueInfo& t) { return t.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace fb::render
