// What a film shows: `fullbright-lab film SPEC.json` (Misc/docs/formats.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"

namespace fb::lab {

// One of the pictures side by side: rendered here, or pictures that another program captured.
struct FilmLane {
  std::string name;
  std::vector<std::string> sets;  // "cvar=value"
  std::string pictures;           // folder of PNG files in the order of their names; empty: rendered
};
struct FilmZoom {
  vec2 corner{0.0f}, size{0.0f};       // of the part that is shown in the end, pixels of a lane's picture
  std::uint32_t begins = 0, ends = 0;  // frames of the film
};
struct FilmSpec {
  std::string scene, map, demo, camera;  // one of the first three, where a lane is rendered
  std::vector<std::string> sets;         // of all lanes
  std::uint64_t first = 0, last = 0;     // frames
  std::uint32_t warmup = 0;              // rendered before them and not shown
  double fps = 30;
  uvec2 size{640, 360};  // of a lane's picture
  bool side_by_side = false;
  double sweep = 0;  // seconds in which the lines between lanes go to and fro once; 0: they stand
  bool equal_time = false;
  bool own_exposure = false;  // each lane finds its own; else all that are rendered have that of one
  bool sound = true;
  bool exr = false;                     // of frames in a folder
  std::uint32_t reference_samples = 0;  // 0: no error is measured
  std::string reference_estimator = "nee";
  std::optional<FilmZoom> zoom;
  std::vector<FilmLane> lanes;
  bool renders() const;
  std::uint32_t frames() const { return static_cast<std::uint32_t>(last - first + 1); }
};
// Fails with "FILE: line N: ..." at what is wrong. Names of files are taken from the spec's folder on.
Result<FilmSpec> read_film(const std::string& path);

}  // namespace fb::lab
