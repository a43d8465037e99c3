// The page of `fullbright-lab authored`: pictures beside what the map's author saw, how far they are apart, and how
// strong each emitter is by the baked light.
#pragma once

#include <string>
#include <vector>

#include "lab/authored/authored_measure.h"

namespace fb::lab {

struct AuthoredRow {
  std::string camera, picture;  // file of the pair, beside the page; may be empty
  AuthoredDistance distance;
};
struct AuthoredPage {
  std::string title;
  std::vector<std::string> notes;  // sentences below it
  std::vector<AuthoredRow> rows;   // of cameras
  AuthoredDistance mean;
  struct Emitter {
    std::string name;
    vec3 factor;
    float share;  // of the light at the map's faces
  };
  std::vector<Emitter> emitters;
};

std::string authored_html(const AuthoredPage& page);

}  // namespace fb::lab
