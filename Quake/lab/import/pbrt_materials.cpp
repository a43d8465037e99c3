#include "lab/import/pbrt_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/image.h"
#include "fs/file.h"

namespace fb::lab {
namespace {

// Reflectance at normal incidence of metals that pbrt knows by name, linear sRGB (Hoffman 2010, of measured indices;
// titanium dioxide by n = 2.5 to 2.9), and indices of glasses at 589 nm (Schott's).
struct Named {
  std::string_view name;
  vec3 value;
};
constexpr std::array<Named, 6> kMetals{{{"metal-Ag", {0.972f, 0.960f, 0.915f}},
                                        {"metal-Al", {0.913f, 0.922f, 0.924f}},
                                        {"metal-Au", {1.0f, 0.782f, 0.344f}},
                                        {"metal-Cu", {0.955f, 0.638f, 0.538f}},
                                        {"metal-CuZn", {0.910f, 0.778f, 0.423f}},
                                        {"metal-TiO2", {0.18f, 0.20f, 0.26f}}}};
constexpr std::array<Named, 7> kGlasses{{{"glass-BK7", vec3(1.517f)},
                                         {"glass-BAF10", vec3(1.670f)},
                                         {"glass-FK51A", vec3(1.487f)},
                                         {"glass-LASF9", vec3(1.850f)},
                                         {"glass-F5", vec3(1.603f)},
                                         {"glass-F10", vec3(1.623f)},
                                         {"glass-F11", vec3(1.621f)}}};

// Rec. 709's luminance of linear sRGB.
float luminance(const vec3& c) { return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

// CIE 1931 by the sums of Gaussians of Wyman 2013, and Planck's law; linear sRGB of luminance 1.
vec3 black_body(float kelvin) {
  const auto bump = [](double x, double mean, double left, double right) {
    const double t = (x - mean) * (x < mean ? left : right);
    return std::exp(-0.5 * t * t);
  };
  double x = 0, y = 0, z = 0;
  for (int nm = 380; nm <= 780; nm += 5) {
    const double power = std::pow(nm * 1e-9, -5.0) / std::expm1(0.0143877688 / (nm * 1e-9 * kelvin));
    x += power * (0.362 * bump(nm, 442.0, 0.0624, 0.0374) + 1.056 * bump(nm, 599.8, 0.0264, 0.0323) -
                  0.065 * bump(nm, 501.1, 0.0490, 0.0382));
    y += power * (0.821 * bump(nm, 568.8, 0.0213, 0.0247) + 0.286 * bump(nm, 530.9, 0.0613, 0.0322));
    z += power * (1.217 * bump(nm, 437.0, 0.0845, 0.0278) + 0.681 * bump(nm, 459.0, 0.0385, 0.0725));
  }
  if (!(y > 0)) return vec3(1.0f);
  x /= y;
  z /= y;
  const vec3 rgb(static_cast<float>(3.2406 * x - 1.5372 - 0.4986 * z),
                 static_cast<float>(-0.9689 * x + 1.8758 + 0.0415 * z),
                 static_cast<float>(0.0557 * x - 0.2040 + 1.0570 * z));
  const vec3 shown = glm::max(rgb, vec3(0));
  return shown / std::max(luminance(shown), 1e-6f);
}

vec3 to_share(const vec3& v) { return glm::clamp(v, vec3(0.0f), vec3(1.0f)); }

// Fresnel's equations for a conductor at normal incidence.
vec3 metal_reflectance(const vec3& n, const vec3& k) {
  const vec3 down = (n - 1.0f) * (n - 1.0f) + k * k, up = (n + 1.0f) * (n + 1.0f) + k * k;
  return down / up;
}

}  // namespace

std::optional<vec3> PbrtMaterials::spectrum(const PbrtParameter& p, bool of_light) {
  if (p.type == "rgb" && p.numbers.size() >= 3) return vec3(p.numbers[0], p.numbers[1], p.numbers[2]);
  if (p.type == "blackbody" && !p.numbers.empty()) {
    if (p.numbers[0] < 100.0f || p.numbers[0] > 1e6f) return std::nullopt;
    return black_body(p.numbers[0]);
  }
  if (p.type == "float" && !p.numbers.empty()) return vec3(p.numbers[0]);
  if (p.type != "spectrum") return std::nullopt;
  if (p.numbers.size() >= 4) {
    maker_.leave_out("spectra are the means of three bands");
    constexpr std::array<vec2, 3> kBands{{{580, 680}, {490, 580}, {420, 490}}};
    vec3 sum(0), count(0);
    for (std::size_t i = 0; i + 1 < p.numbers.size(); i += 2)
      for (int c = 0; c < 3; ++c)
        if (p.numbers[i] >= kBands[static_cast<std::size_t>(c)].x &&
            p.numbers[i] < kBands[static_cast<std::size_t>(c)].y) {
          sum[c] += p.numbers[i + 1];
          count[c] += 1.0f;
        }
    if (count.x == 0 || count.y == 0 || count.z == 0) return vec3(p.numbers[1]);
    return sum / count;
  }
  if (!p.texts.empty()) {
    for (const Named& glass : kGlasses)
      if (p.texts[0] == glass.name) return glass.value;
    if (of_light && p.texts[0].starts_with("std")) return vec3(1.0f);
  }
  return std::nullopt;
}

vec3 PbrtMaterials::light(const PbrtDirective& directive, std::string_view name, const vec3& otherwise) {
  const PbrtParameter* p = directive.find(name);
  if (p == nullptr) return otherwise;
  const auto found = spectrum(*p, true);
  if (found) return glm::max(*found, vec3(0));
  maker_.leave_out(fmt::format("a light's colour of type {} is white", p->type));
  return vec3(1.0f);
}

PbrtMaterials::Texture PbrtMaterials::value(const PbrtDirective& directive, std::string_view name,
                                            const vec3& otherwise) {
  Texture out;
  out.color = otherwise;
  const PbrtParameter* p = directive.find(name);
  if (p == nullptr) return out;
  if (p->type == "texture") {
    const auto found = p->texts.empty() ? textures_.end() : textures_.find(p->texts[0]);
    if (found != textures_.end()) return found->second;
    maker_.leave_out(fmt::format("the texture {} is not there", p->texts.empty() ? "" : p->texts[0]));
    return out;
  }
  if (const auto color = spectrum(*p, false))
    out.color = *color;
  else
    maker_.leave_out(fmt::format("{} of type {} is as where it is not said", name, p->type));
  return out;
}

PbrtMaterials::Texture PbrtMaterials::image_map(const PbrtDirective& texture) {
  Texture out;
  const std::string name = texture.word("filename", "");
  const auto [known, fresh] = images_.try_emplace(name, std::nullopt);
  if (fresh) {
    const auto file = fs::read_whole_file(folder_ / name);
    auto image =
        file ? formats::parse_image({file->data(), file->size()}, name) : Result<formats::RgbaImage>(file.error());
    if (image) {
      for (std::size_t i = 3; i < image->rgba.size(); i += 4) image->rgba[i] = 255;
      known->second = maker_.add_image(name, std::move(*image), scene::ImageEncoding::kSrgba);
    } else {
      maker_.leave_out(
          fmt::format("an image is left out, and half of light is reflected there: {}", image.error().message));
    }
  }
  out.image = known->second;
  const float scale = texture.number("scale", 1.0f);
  out.color = vec3(out.image ? scale : 0.5f * scale);
  out.clamped = texture.word("wrap", "repeat") == "clamp";
  return out;
}

void PbrtMaterials::add_texture(const PbrtDirective& texture) {
  const std::string& kind = texture.text(2);
  Texture out;
  if (kind == "constant") {
    out = value(texture, "value", vec3(1));
  } else if (kind == "imagemap") {
    out = image_map(texture);
  } else if (kind == "scale") {
    out = value(texture, "tex", vec3(1));
    const Texture factor = value(texture, "scale", vec3(1));
    if (factor.image && !out.image) {
      const vec3 color = out.color;
      out = factor;
      out.color *= color;
    } else {
      if (factor.image) maker_.leave_out("of products of two images the first is taken");
      out.color *= factor.color;
    }
  } else if (kind == "checkerboard" || kind == "mix" || kind == "dots") {
    maker_.leave_out(fmt::format("textures of kind {} are the mean of their two", kind));
    const bool dots = kind == "dots";
    const Texture a = value(texture, dots ? "inside" : "tex1", vec3(1)),
                  b = value(texture, dots ? "outside" : "tex2", vec3(0));
    out = a.image ? a : b;
    if (!a.image && !b.image) out.color = (a.color + b.color) / 2.0f;
  } else {
    maker_.leave_out(fmt::format("textures of kind {} are grey", kind));
    out.color = vec3(0.5f);
  }
  if (kind == "imagemap") {
    out.uv_scale = {texture.number("uscale", 1), texture.number("vscale", 1)};
    out.uv_offset = {texture.number("udelta", 0), texture.number("vdelta", 0)};
  }
  textures_[texture.text(0)] = out;
}

// GGX's alpha is the square root of what is told, unless `remaproughness` is false (Trowbridge-Reitz of pbrt-v4); ours
// is the square of our roughness.
float PbrtMaterials::roughness(const PbrtDirective& directive, const char* prefix) {
  const auto one = [&](const std::string& name, float otherwise) {
    const Texture found = value(directive, name, vec3(otherwise));
    if (found.image) maker_.leave_out("images of roughness are their factor alone");
    return found.color.x;
  };
  const std::string p = prefix;
  const float both = one(p + "roughness", 0.0f);
  const float u = one(p + "uroughness", both), v = one(p + "vroughness", both);
  if (u != v) maker_.leave_out("roughness is the mean of both directions");
  const float told = std::clamp((u + v) / 2.0f, 0.0f, 1.0f);
  const float alpha = directive.word("remaproughness", "true") == "false" ? told : std::sqrt(told);
  return std::sqrt(alpha);
}

float PbrtMaterials::index(const PbrtDirective& directive, const char* name) {
  return std::clamp(value(directive, name, vec3(1.5f)).color.y, 1.0f, 4.0f);
}

PbrtMaterial PbrtMaterials::material(const PbrtDirective& directive, const std::string& kind) {
  PbrtMaterial out;
  scene::Material& m = out.material;
  m.name = directive.text(0);
  m.emission_kind = scene::EmissionKind::kNone;
  m.flags = scene::kMaterialNoFullbright;
  m.roughness = 1.0f;
  const auto set_color = [&](const Texture& texture) {
    m.base_color = to_share(texture.color);
    if (!texture.image) return;
    m.frames = {scene::TextureSet{.base = *texture.image}};
    if (texture.clamped) m.flags |= scene::kMaterialClampTexture;
    out.uv_scale = texture.uv_scale;
    out.uv_offset = texture.uv_offset;
  };
  const auto coat = [&](const char* prefix, const char* eta) {
    const float n = index(directive, eta), r = (n - 1.0f) / (n + 1.0f);
    m.specular = r * r;
    m.roughness = roughness(directive, prefix);
  };
  const auto metal = [&](const std::string& prefix) {
    m.metalness = 1.0f;
    m.roughness = roughness(directive, prefix.c_str());
    if (directive.find("reflectance") != nullptr) return set_color(value(directive, "reflectance", vec3(0.5f)));
    vec3 color = kMetals[3].value;  // copper's, as in pbrt
    if (const PbrtParameter* eta = directive.find(prefix + "eta")) {
      const auto known = std::ranges::find_if(kMetals, [&](const Named& metal) {
        return !eta->texts.empty() && eta->texts[0] == std::string(metal.name) + "-eta";
      });
      const PbrtParameter* k = directive.find(prefix + "k");
      if (known != kMetals.end())
        color = known->value;
      else if (!eta->texts.empty())
        maker_.leave_out(fmt::format("the metal {} is copper", eta->texts[0]));
      else
        color = metal_reflectance(spectrum(*eta, false).value_or(vec3(1)),
                                  k == nullptr ? vec3(0) : spectrum(*k, false).value_or(vec3(0)));
    }
    m.base_color = to_share(color);
  };

  if (kind == "diffuse" || kind.empty()) {
    set_color(value(directive, "reflectance", vec3(0.5f)));
  } else if (kind == "coateddiffuse") {
    set_color(value(directive, "reflectance", vec3(0.5f)));
    coat("", "eta");
    maker_.leave_out("between a coat and what is under it light is reflected once");
  } else if (kind == "conductor") {
    metal("");
  } else if (kind == "coatedconductor") {
    metal("conductor.");
    maker_.leave_out("coated metals have no coat");
  } else if (kind == "dielectric") {
    m.flags |= scene::kMaterialDielectric;
    m.index = index(directive, "eta");
    m.base_color = vec3(0.8f);
    if (roughness(directive, "") > 0.0f) maker_.leave_out("glass is smooth");
  } else if (kind == "thindielectric") {
    m.alpha = 0.0f;
    out.is_none = true;
    maker_.leave_out("thin glass is not seen");
  } else if (kind == "interface") {
    out.is_none = true;
  } else if (kind == "diffusetransmission") {
    set_color(value(directive, "reflectance", vec3(0.25f)));
    maker_.leave_out("what lets light through diffusely reflects alone");
  } else {
    m.base_color = vec3(0.5f);
    maker_.leave_out(fmt::format("materials of kind {} are grey", kind));
  }
  for (const char* map : {"normalmap", "displacement"})
    if (directive.find(map) != nullptr) maker_.leave_out(fmt::format("{}s of materials are left out", map));
  return out;
}

}  // namespace fb::lab
