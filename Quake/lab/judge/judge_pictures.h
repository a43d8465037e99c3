// Pictures of a judged view, to be looked at side by side.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "lab/picture.h"

namespace fb::lab {

struct Beside {
  Picture shown;            // sRGB values, 0 to 1
  std::vector<float> flip;  // per pixel
};
// FOLDER/NAME.png: above, the reference and the columns; below, the reference's silhouettes in white and each column's
// FLIP from black over violet and orange to white. All of one size.
Status write_side_by_side(const std::string& folder, const std::string& name, const Picture& reference,
                          const std::vector<bool>& silhouettes, const std::vector<Beside>& columns);

}  // namespace fb::lab
