// The light that a map's author baked, as Quake's ports show it: samples ("luxels") over each face, a value of 128
// shows the texture as it was painted. Taken from, the first that fits the map: a .lit file beside it (coloured, QLIT
// version 1), the BSPX lump RGBLIGHTING, the lump of light. BSPX DECOUPLED_LM says where luxels lie, else they are 16
// units of the texture's axes apart.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "formats/bsp.h"

namespace fb::scene {

class Lightmaps {
 public:
  static constexpr std::uint8_t kNoStyle = 255;

  // The map must outlive this. `lit`: a .lit file, if there is one. One that does not fit the map, to the byte, is not
  // used (`lit_error` says why).
  explicit Lightmaps(const formats::Bsp& bsp, const std::optional<FileData>& lit = std::nullopt);

  bool empty() const { return samples_.empty(); }
  bool colored() const { return channels_ == 3; }
  ByteView samples() const { return samples_; }
  const std::string& lit_error() const { return lit_error_; }
  const std::vector<std::string>& errors() const { return errors_; }  // sentences on what of the map's is not used

  // Whether a face has light baked for the k-th of its styles (k < 4), and which style that is.
  bool has(std::uint32_t face, std::size_t k) const;
  std::uint8_t style(std::uint32_t face, std::size_t k) const { return faces_[face].styles[k]; }
  // Baked value / 128 at a point of the face, between luxels as a texture filter has it; displayed, not linear, values.
  vec3 value(std::uint32_t face, std::size_t k, const vec3& point) const;

  struct Face {
    std::array<vec4, 2> axes;  // luxel = dot(axes.xyz, point) + axes.w
    int width = 0, height = 0;
    std::uint64_t first = 0;  // sample
    std::array<std::uint8_t, 4> styles{kNoStyle, kNoStyle, kNoStyle, kNoStyle};
  };
  const std::vector<Face>& faces() const { return faces_; }  // of the map; none where it is empty
  // A luxel of the k-th of a face's styles, which it has, as bytes.
  std::array<std::uint8_t, 3> luxel(const Face& face, std::size_t k, int x, int y) const;
  // Of all luxels of its faces' first styles, 0 to 1; 1 where there is none.
  double black_share() const;

 private:
  void choose_samples(const formats::Bsp& bsp);
  // Whether it is of the map.
  bool take_lit(const formats::Bsp& bsp, const FileData& lit);
  Face usual_face(const formats::Bsp& bsp, const formats::BspFace& face) const;

  std::vector<Face> faces_;
  FileData lit_;
  ByteView samples_;  // the map's own, or the .lit file's
  int channels_ = 1;
  std::string lit_error_;
  std::vector<std::string> errors_;
};

// The light that a displayed factor on a surface of this reflectance stands for: Quake multiplies what displays decode.
// About a power of 2.2; less where both are dark, since the decoding (sRGB) is linear there; no more than white.
vec3 light_of_display(const vec3& displayed, const vec3& reflectance);
// The same where no surface is known.
float light_of_display(float displayed);

}  // namespace fb::scene
