// What tests of imported scenes ask of them, and damage for the files that they come from.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "base/bytes.h"
#include "base/rng.h"
#include "lab/import/imported_scene.h"
#include "scene/shapes.h"

namespace fb::lab {

// By the material's name: area in square units, triangles, and the mean normal of the front.
struct Part {
  double area = 0;
  std::size_t triangles = 0;
  scene::Material material;
};
inline std::map<std::string, Part> parts_of(const scene::FrameSnapshot& snapshot) {
  std::map<std::string, Part> parts;
  for (const scene::Instance& instance : snapshot.instances) {
    const scene::Mesh& mesh = snapshot.assets->meshes[instance.mesh];
    for (const scene::MeshTriangle& t : mesh.triangles) {
      vec3 p[3];
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = transform_point(instance.transform, scene::vertex_position(mesh, t.vertices[i]));
      const scene::Material& material = snapshot.assets->materials[t.material + instance.material_base];
      Part& part = parts[material.name];
      part.material = material;
      part.area += 0.5 * static_cast<double>(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
      ++part.triangles;
    }
  }
  return parts;
}

// Some bytes changed, cut off or doubled; never the same for two numbers.
inline Bytes damaged(Bytes data, std::uint64_t number) {
  Rng rng(number + 1);
  const std::uint32_t changes = 1 + rng.below(4);
  for (std::uint32_t i = 0; i < changes && !data.empty(); ++i) {
    const std::size_t at = rng.below(static_cast<std::uint32_t>(data.size()));
    switch (rng.below(5)) {
      case 0:
        data[at] = static_cast<std::uint8_t>(rng.next());
        break;
      case 1:
        data[at] ^= static_cast<std::uint8_t>(1u << (rng.below(8)));
        break;
      case 2:
        data.resize(at);
        break;
      case 3:  // a digit, where text has numbers
        data[at] = static_cast<std::uint8_t>('0' + rng.below(10));
        break;
      default:
        data.erase(data.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  return data;
}

}  // namespace fb::lab
