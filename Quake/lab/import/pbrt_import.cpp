#include "lab/import/pbrt_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "lab/import/pbrt_materials.h"
#include "lab/import/pbrt_shapes.h"
#include "lab/import/pbrt_text.h"
#include "lab/import/scene_maker.h"

namespace fb::lab {
namespace {

constexpr std::size_t kDeepest = 4096;  // of attributes in attributes
constexpr float kSunRadius = 0.25f;     // degrees: distant lights have no size, and ours the Sun's

// What holds for what follows, until an AttributeEnd.
struct State {
  mat4x3 transform{1.0f};
  std::uint32_t material = 0;  // of PbrtImporter::materials_
  vec3 emission{0.0f};
};

struct Placed {
  ImportedMesh mesh;
  mat4x3 transform;
  std::uint32_t material;
};

mat4x3 rotation(float angle, vec3 axis) {
  axis = glm::normalize(axis);
  const float c = std::cos(radians(angle)), s = std::sin(radians(angle));
  const auto turned = [&](const vec3& v) {
    return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1.0f - c));
  };
  return mat4x3(turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), vec3(0));
}

// From the camera's space, which looks along z, to the world's.
mat4x3 looks_at(const vec3& eye, const vec3& at, const vec3& up) {
  const vec3 forward = glm::normalize(at - eye), right = glm::normalize(glm::cross(glm::normalize(up), forward));
  return mat4x3(right, glm::cross(forward, right), forward, eye);
}

bool finite(const mat4x3& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

class PbrtImporter {
 public:
  explicit PbrtImporter(PbrtText text, std::string path) : text_(std::move(text)), path_(std::move(path)) {}

  Result<ImportedScene> run() {
    PbrtDirective d;
    while (true) {
      const auto more = text_.next(d);
      if (!more) return more.error();
      if (!*more) break;
      if (auto status = read(d); !status) return status.error();
    }
    if (!maker_) return Error{path_ + ": it has no WorldBegin"};
    return maker_->finish(path_, true);
  }

 private:
  Status read(const PbrtDirective& d) {
    if (auto status = transform(d); !status || *status) return status ? ok_status() : Status(status.error());
    if (d.name == "AttributeBegin" || d.name == "TransformBegin") {
      if (stack_.size() >= kDeepest) return d.error("there are too many in one another");
      stack_.push_back(state_);
      return ok_status();
    }
    if (d.name == "AttributeEnd" || d.name == "TransformEnd") {
      if (stack_.empty()) return d.error("nothing began");
      const mat4x3 former = stack_.back().transform;
      if (d.name == "AttributeEnd")
        state_ = stack_.back();
      else
        state_.transform = former;
      stack_.pop_back();
      return ok_status();
    }
    if (d.name == "WorldBegin") return begin_world(d);
    if (d.name == "Camera") return set_camera(d);
    if (d.name == "Film") {
      const float x = d.number("xresolution", 1280), y = d.number("yresolution", 720);
      if (x > 0 && y > 0) aspect_ = x / y;
      return ok_status();
    }
    if (!maker_) return ok_status();  // how it is rendered is not the scene's
    if (auto status = in_world(d); !status) return status;
    if (d.name != "MakeNamedMedium" && d.name != "Attribute")
      for (const std::string& sentence : d.unread()) maker_->leave_out(sentence);
    return ok_status();
  }

  Status in_world(const PbrtDirective& d) {
    if (d.name == "Texture") {
      materials_of_->add_texture(d);
    } else if (d.name == "Material") {
      state_.material = add_material(materials_of_->material(d, d.text(0)));
    } else if (d.name == "MakeNamedMaterial") {
      named_[d.text(0)] = add_material(materials_of_->material(d, d.word("type", "")));
    } else if (d.name == "NamedMaterial") {
      const auto found = named_.find(d.text(0));
      if (found == named_.end()) return d.error(fmt::format("there is no material {}", d.text(0)));
      state_.material = found->second;
    } else if (d.name == "AreaLightSource") {
      state_.emission = materials_of_->light(d, "L", vec3(1)) * d.number("scale", 1);
      if (d.find("filename") != nullptr || d.find("power") != nullptr)
        maker_->leave_out("images and powers of area lights are left out");
      if (d.word("twosided", "false") == "false") maker_->leave_out("area lights shine from both sides");
    } else if (d.name == "LightSource") {
      return add_light(d);
    } else if (d.name == "Shape") {
      return add_shape(d);
    } else if (d.name == "ObjectBegin") {
      if (object_) return d.error("an object within an object");
      object_ = d.text(0);
      objects_[*object_].clear();
      stack_.push_back(state_);
    } else if (d.name == "ObjectEnd") {
      if (!object_ || stack_.empty()) return d.error("no object began");
      object_.reset();
      state_ = stack_.back();
      stack_.pop_back();
    } else if (d.name == "ObjectInstance") {
      const auto found = objects_.find(d.text(0));
      if (found == objects_.end()) return d.error(fmt::format("there is no object {}", d.text(0)));
      if (object_) return d.error("an instance within an object");
      for (const Placed& part : found->second)
        if (auto status = place(d, part.mesh, after(state_.transform, part.transform), part.material); !status)
          return status;
    } else if (d.name == "MakeNamedMedium" || d.name == "MediumInterface") {
      maker_->leave_out("media are left out");
    } else if (d.name == "Attribute") {
      maker_->leave_out("parameters that Attribute sets for all are left out");
    }
    return ok_status();
  }

  // Whether it is one that changes the current transform.
  Result<bool> transform(const PbrtDirective& d) {
    const auto numbers = [&](std::size_t count) { return d.numbers.size() == count; };
    const auto at = [&](std::size_t i) { return vec3(d.numbers[i], d.numbers[i + 1], d.numbers[i + 2]); };
    std::optional<mat4x3> next;
    std::size_t wanted = 0;
    if (d.name == "Identity") {
      next = mat4x3(1.0f);
    } else if (d.name == "Translate") {
      wanted = 3;
      if (numbers(3)) next = after(state_.transform, mat4x3(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), at(0)));
    } else if (d.name == "Scale") {
      wanted = 3;
      if (numbers(3)) next = after(state_.transform, scaled(at(0)));
    } else if (d.name == "Rotate") {
      wanted = 4;
      if (numbers(4)) next = after(state_.transform, rotation(d.numbers[0], at(1)));
    } else if (d.name == "LookAt") {
      wanted = 9;
      if (numbers(9)) {
        const mat4x3 camera = looks_at(at(0), at(3), at(6));
        if (!finite(camera)) return d.error("its numbers make no transform");
        next = after(state_.transform, inverse_affine(camera));
      }
    } else if (d.name == "Transform" || d.name == "ConcatTransform") {
      wanted = 16;
      if (numbers(16)) {
        const mat4x3 given(at(0), at(4), at(8), at(12));
        next = d.name == "Transform" ? given : after(state_.transform, given);
      }
    } else if (d.name == "CoordinateSystem") {
      systems_[d.text(0)] = state_.transform;
      return true;
    } else if (d.name == "CoordSysTransform") {
      const auto found = systems_.find(d.text(0));
      if (found == systems_.end()) return d.error(fmt::format("there is no system {}", d.text(0)));
      next = found->second;
    } else if (d.name == "ActiveTransform") {
      if (maker_) maker_->leave_out("motion is left out");
      return true;
    } else {
      return false;
    }
    if (!next) return d.error(fmt::format("it has {} numbers, and {} are wanted", d.numbers.size(), wanted));
    if (!finite(*next)) return d.error("its numbers make no transform");
    state_.transform = *next;
    return true;
  }

  Status set_camera(const PbrtDirective& d) {
    camera_to_world_ = inverse_affine(state_.transform);
    systems_["camera"] = *camera_to_world_;
    camera_kind_ = d.text(0);
    fov_ = d.number("fov", 90);
    if (!(fov_ > 0.0f && fov_ < 180.0f)) return d.error(fmt::format("it sees {} degrees", fov_));
    of_camera_ = d.unread();
    return ok_status();
  }

  // pbrt's axes are left-handed, unless its camera is mirrored: ours are not.
  Status begin_world(const PbrtDirective& d) {
    if (maker_) return d.error("the world began before");
    const mat4x3 camera = camera_to_world_.value_or(mat4x3(1.0f));
    const bool mirrored = glm::dot(camera[0], glm::cross(camera[1], camera[2])) < 0;
    const float s = kUnitsPerMetre;
    maker_.emplace(mat4x3(vec3(mirrored ? -s : s, 0, 0), vec3(0, 0, s), vec3(0, s, 0), vec3(0)));
    materials_of_.emplace(*maker_, text_.folder());
    for (const std::string& sentence : of_camera_) maker_->leave_out(sentence);
    if (camera_to_world_ && camera_kind_ != "perspective")
      maker_->leave_out(fmt::format("the camera of kind {} is one of perspective", camera_kind_));
    if (camera_to_world_) {
      ImportedCamera out;
      out.position = camera[3];
      out.forward = camera[2];
      out.right = camera[0];
      out.up = camera[1];
      // The shorter side has the angle.
      const float tangent = std::tan(radians(fov_) / 2.0f) * std::max(aspect_, 1.0f);
      out.fov_x = degrees(2.0f * std::atan(tangent));
      maker_->set_camera(out);
    }
    state_ = State();
    state_.material = add_material(materials_of_->material(d, "diffuse"));
    return ok_status();
  }

  std::uint32_t add_material(PbrtMaterial material) {
    materials_.push_back(std::move(material));
    return static_cast<std::uint32_t>(materials_.size() - 1);
  }

  // The material in the scene, with what a shape of it emits.
  std::uint32_t made(std::uint32_t material, const vec3& emission) {
    const auto [known, fresh] = made_.try_emplace(std::tuple(material, emission.x, emission.y, emission.z), 0u);
    if (fresh) {
      scene::Material out = materials_[material].material;
      if (emission != vec3(0)) {
        out.emission_kind = scene::EmissionKind::kConstant;
        out.emission = emission;
      }
      known->second = maker_->add_material(std::move(out));
    }
    return known->second;
  }

  Status place(const PbrtDirective& d, const ImportedMesh& mesh, const mat4x3& transform, std::uint32_t material) {
    const auto status = maker_->add_mesh(mesh, transform, material);
    return status ? status : Status(d.error(status.error().message));
  }

  Status add_shape(const PbrtDirective& d) {
    const PbrtMaterial& material = materials_[state_.material];
    // A hole in all of it is how lights are made that nobody sees.
    if (const PbrtParameter* alpha = d.find("alpha")) {
      if (!alpha->numbers.empty() && alpha->numbers[0] <= 0.0f) {
        maker_->leave_out("shapes that are holes all over are left out");
        return ok_status();
      }
      if (!alpha->texts.empty() || alpha->numbers[0] < 1.0f) maker_->leave_out("holes of shapes are filled");
    }
    std::string left_out;
    auto mesh = pbrt_shape(d, text_.folder(), left_out);
    if (!mesh) return mesh.error();
    if (!left_out.empty()) maker_->leave_out(std::move(left_out));
    if (!*mesh || (material.is_none && state_.emission == vec3(0))) return ok_status();
    for (vec2& uv : (*mesh)->uvs) {
      uv.x = uv.x * material.uv_scale.x + material.uv_offset.x;
      uv.y = 1.0f - ((1.0f - uv.y) * material.uv_scale.y + material.uv_offset.y);
    }
    const std::uint32_t number = made(state_.material, state_.emission);
    if (!object_) return place(d, **mesh, state_.transform, number);
    if (state_.emission != vec3(0)) maker_->leave_out("lights of objects shine in each of their instances");
    objects_[*object_].push_back({std::move(**mesh), state_.transform, number});
    return ok_status();
  }

  Status add_light(const PbrtDirective& d) {
    const std::string& kind = d.text(0);
    const float scale = d.number("scale", 1);
    if (d.find("power") != nullptr || d.find("illuminance") != nullptr)
      maker_->leave_out("powers and illuminances of lights are left out: their L and I count");
    if (kind == "infinite") {
      if (d.find("filename") != nullptr) maker_->leave_out("images of infinite lights are left out: they are even");
      maker_->set_sky(materials_of_->light(d, "L", vec3(1)) * scale);
    } else if (kind == "distant") {
      const vec3 from = d.vector("from", vec3(0)), to = d.vector("to", vec3(0, 0, 1));
      const vec3 towards = transform_vector(state_.transform, from - to);
      if (!(glm::length(towards) > 0.0f)) return d.error("it shines nowhere");
      maker_->add_sun(towards, materials_of_->light(d, "L", vec3(1)) * scale, kSunRadius);
    } else if (kind == "point" || kind == "spot") {
      if (kind == "spot") maker_->leave_out("spots shine all around");
      maker_->leave_out("lights that are points are balls of 2 inches");
      const vec3 at = d.vector("from", vec3(0));
      maker_->add_point_light(transform_point(state_.transform, at), materials_of_->light(d, "I", vec3(1)) * scale);
    } else {
      maker_->leave_out(fmt::format("lights of kind {} are left out", kind));
    }
    return ok_status();
  }

  PbrtText text_;
  std::string path_;
  State state_;
  std::vector<State> stack_;
  std::map<std::string, mat4x3> systems_;
  std::optional<mat4x3> camera_to_world_;
  std::string camera_kind_;
  std::vector<std::string> of_camera_;  // what is not read of it
  float fov_ = 90.0f, aspect_ = 1280.0f / 720.0f;
  std::optional<SceneMaker> maker_;
  std::optional<PbrtMaterials> materials_of_;
  std::vector<PbrtMaterial> materials_;
  std::map<std::string, std::uint32_t> named_;
  std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> made_;
  std::map<std::string, std::vector<Placed>> objects_;
  std::optional<std::string> object_;
};

}  // namespace

Result<ImportedScene> import_pbrt(const std::string& path) {
  auto text = PbrtText::open(path);
  if (!text) return text.error();
  return PbrtImporter(std::move(*text), path).run();
}

}  // namespace fb::lab
