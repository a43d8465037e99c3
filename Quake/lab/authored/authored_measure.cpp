#include "lab/authored/authored_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/check.h"
#include "scene/library/light_sources.h"
#include "shared/color.h"
#include "world/bsp_query.h"
#include "world/entity_lump.h"

namespace fb::lab {
namespace {

constexpr double kBlack = 5e-4;    // added to luminance: half of the darkest grey that a display has
constexpr double kColored = 2e-3;  // luminance below which colour is not compared
constexpr float kEyes = 22.0f;     // units over an entity's origin
constexpr float kFarthest = 1e6f;  // units that an origin may be from the map's, on an axis

struct Block {
  dvec3 own{0.0}, authors{0.0};
};

bool in_open_of(const formats::Bsp& bsp, const vec3& point, std::uint32_t model) {
  const std::int32_t contents = world::point_contents(bsp, point, model);
  return contents == formats::kContentsEmpty || contents == formats::kContentsWater;
}

bool in_open_of_all(const formats::Bsp& bsp, const std::vector<scene::Submodel>& submodels, const vec3& point) {
  return in_open_of(bsp, point, 0) && std::ranges::all_of(submodels, [&](const scene::Submodel& s) {
           return in_open_of(bsp, point - s.offset, s.index);
         });
}

double luminance_of(const dvec3& c) { return static_cast<double>(shared::luminance(vec3(c))); }

std::vector<Block> blocks_of(const Picture& own, const Picture& authors) {
  std::vector<Block> blocks(std::size_t{kBlocksAcross} * kBlocksDown);
  std::vector<double> counts(blocks.size(), 0.0);
  for (std::uint32_t y = 0; y < own.height; ++y)
    for (std::uint32_t x = 0; x < own.width; ++x) {
      const std::size_t b = std::size_t{y * kBlocksDown / own.height} * kBlocksAcross + x * kBlocksAcross / own.width;
      const std::size_t at = std::size_t{y} * own.width + x;
      blocks[b].own += dvec3(own.pixels[at]);
      blocks[b].authors += dvec3(authors.pixels[at]);
      counts[b] += 1;
    }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    // Of means, not of pixels: a cut of what is noisy would darken it.
    blocks[b].own = glm::clamp(blocks[b].own / std::max(counts[b], 1.0), dvec3(0.0), dvec3(1.0));
    blocks[b].authors = glm::clamp(blocks[b].authors / std::max(counts[b], 1.0), dvec3(0.0), dvec3(1.0));
  }
  return blocks;
}

dvec3 shares_of(const dvec3& c) { return c / std::max(c.x + c.y + c.z, 1e-9); }

}  // namespace

AuthoredDistance authored_distance(const Picture& own, const Picture& authors) {
  FB_CHECK(own.same_size(authors));
  const std::vector<Block> blocks = blocks_of(own, authors);
  AuthoredDistance d;
  std::vector<double> a, b, off;
  double colors = 0;
  for (const Block& block : blocks) {
    a.push_back(std::log2(luminance_of(block.own) + kBlack));
    b.push_back(std::log2(luminance_of(block.authors) + kBlack));
    off.push_back(a.back() - b.back());
    if (luminance_of(block.own) < kColored || luminance_of(block.authors) < kColored) continue;
    const dvec3 apart = glm::abs(shares_of(block.own) - shares_of(block.authors));
    d.color += apart.x + apart.y + apart.z;
    colors += 1;
  }
  d.color /= std::max(colors, 1.0);
  d.black = std::ranges::all_of(blocks, [](const Block& block) {
    return std::max(luminance_of(block.own), luminance_of(block.authors)) < kBlack;
  });
  std::vector<double> sorted = off;
  std::ranges::sort(sorted);
  d.median = 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
  const auto n = static_cast<double>(blocks.size());
  double mean_a = 0, mean_b = 0, squares = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / n;
    mean_b += b[i] / n;
    squares += (off[i] - d.median) * (off[i] - d.median) / n;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  d.spread = std::sqrt(squares);
  d.correlation = aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0.0;
  return d;
}

AuthoredDistance mean_distance(const std::vector<AuthoredDistance>& distances) {
  AuthoredDistance mean;
  const auto seen = std::ranges::count(distances, false, &AuthoredDistance::black);
  mean.black = seen == 0;
  const double n = std::max<double>(static_cast<double>(seen), 1);
  for (const AuthoredDistance& d : distances) {
    if (d.black) continue;
    mean.median += d.median * d.median / n;
    mean.spread += d.spread * d.spread / n;
    mean.correlation += d.correlation / n;
    mean.color += d.color / n;
  }
  mean.median = std::sqrt(mean.median);
  mean.spread = std::sqrt(mean.spread);
  return mean;
}

bool in_open(const formats::Bsp& bsp, const vec3& point) {
  const auto entities = world::parse_entity_lump(bsp.entities, "the map's entities");
  return in_open_of_all(bsp, entities ? scene::shown_submodels(*entities, bsp) : std::vector<scene::Submodel>(), point);
}

MapCameras map_cameras(const formats::Bsp& bsp, std::size_t most) {
  MapCameras all;
  const auto entities = world::parse_entity_lump(bsp.entities, "the map's entities");
  if (!entities) return all;
  const auto submodels = scene::shown_submodels(*entities, bsp);
  std::map<std::string, int, std::less<>> numbers;
  for (const world::Entity& entity : *entities) {
    const std::string_view name = entity.classname();
    const bool intermission = name == "info_intermission";
    if (!name.starts_with("info_player_") && name != "info_teleport_destination" && !intermission) continue;
    std::string own_name = fmt::format("{}_{}", name, ++numbers[std::string(name)]);
    const auto origin = entity.vector("origin");
    if (!origin || !glm::all(glm::lessThan(glm::abs(*origin), vec3(kFarthest)))) {
      all.nowhere.push_back(std::move(own_name));
      continue;
    }
    MapCamera camera{std::move(own_name), *origin, vec3(0.0f)};
    if (intermission)
      camera.angles = entity.vector("mangle").value_or(vec3(0.0f));
    else
      camera.position.z += kEyes;
    if (const float yaw = entity.number("angle", 0.0f); !intermission && yaw >= 0.0f) camera.angles.y = yaw;
    if (in_open_of_all(bsp, submodels, camera.position))
      all.open.push_back(std::move(camera));
    else
      all.closed.push_back(std::move(camera.name));  // of a door, or of lava that is to flow away
  }
  if (all.open.size() <= most) return all;
  std::vector<MapCamera> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(all.open[i * all.open.size() / most]);
  all.open = std::move(chosen);
  return all;
}

}  // namespace fb::lab
