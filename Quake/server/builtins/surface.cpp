// DP_QC_GETSURFACE: the faces of brush models. As everything that collides, they stand where the entity's origin is,
// and its angles do not turn them.
#include <cfloat>
#include <cmath>

#include "server/builtins/game_builtins.h"
#include "server/simulation/link.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::Vm;
namespace fields = progs::fields;

struct Surface {
  const formats::Bsp* bsp = nullptr;
  const formats::BspModel* model = nullptr;
  vec3 origin{0.0f};
  const formats::BspFace* face = nullptr;  // what the second parameter says; null where there is none

  vec3 point(std::uint32_t i) const { return bsp->face_vertex(*face, i) + origin; }
  vec3 normal() const {
    const vec3 n = bsp->planes[face->plane].normal;
    return face->back_side ? -n : n;
  }
};

// The model of entity parameter 0; `model` is null where it is no brush model.
Surface model_parm(Vm& vm, const GameContext& context) {
  Surface surface;
  const Edict edict = vm.parm_edict(0);
  if (vm.failed()) return surface;
  const BrushModel* const brush = brush_model_of(*context.level, edict);
  if (!brush) return surface;
  surface.bsp = brush->bsp.get();
  surface.model = &surface.bsp->models.at(brush->index);
  surface.origin = edict.get(fields::origin);
  return surface;
}

Surface surface_parm(Vm& vm, const GameContext& context) {
  Surface surface = model_parm(vm, context);
  const std::int32_t number = vm.parm_int(1);
  if (surface.model && number >= 0 && static_cast<std::uint32_t>(number) < surface.model->face_count)
    surface.face = &surface.bsp->faces[surface.model->first_face + static_cast<std::uint32_t>(number)];
  return surface;
}

// The nearest point of the face to p: p moved into its plane, then behind each edge that it lies before.
vec3 clip_to_face(const Surface& surface, const vec3& p) {
  const std::uint32_t count = surface.face->surfedge_count;
  if (count < 3) return count == 0 ? p : surface.point(0);
  const vec3 normal = surface.normal();
  const vec3 on_plane = p - normal * dot(p - surface.point(0), normal);
  bool inside = true;
  vec3 best = on_plane;
  float best_distance = FLT_MAX;
  for (std::uint32_t i = 0; i < count; ++i) {
    const vec3 a = surface.point(i), edge = surface.point((i + 1) % count) - a;
    const float length_squared = dot(edge, edge);
    // Quake's faces go round clockwise, seen from in front.
    if (dot(cross(edge, on_plane - a), normal) > 0.0f) inside = false;
    const float t = length_squared > 0.0f ? glm::clamp(dot(on_plane - a, edge) / length_squared, 0.0f, 1.0f) : 0.0f;
    const vec3 nearest = a + edge * t;
    const float distance = dot(nearest - on_plane, nearest - on_plane);
    if (distance < best_distance) {
      best_distance = distance;
      best = nearest;
    }
  }
  return inside ? on_plane : best;
}

void getsurfacenearpoint(Vm& vm, const GameContext& context) {
  vm.return_float(-1.0f);
  Surface surface = model_parm(vm, context);
  if (!surface.model) return;
  const vec3 p = vm.parm_vector(1);
  float best = FLT_MAX;
  for (std::uint32_t i = 0; i < surface.model->face_count; ++i) {
    surface.face = &surface.bsp->faces[surface.model->first_face + i];
    // No point of a face is nearer than its plane.
    if (surface.face->surfedge_count < 3 || std::fabs(dot(p - surface.point(0), surface.normal())) >= best) continue;
    const float distance = length(clip_to_face(surface, p) - p);
    if (!(distance < best)) continue;
    best = distance;
    vm.return_float(static_cast<float>(i));
  }
}

std::string_view texture_name(const Surface& surface) {
  if (!surface.face) return {};
  const std::uint32_t texture = surface.bsp->texinfos[surface.face->texinfo].texture;
  return texture == formats::kNoTexture ? std::string_view() : std::string_view(surface.bsp->textures[texture].name);
}

std::uint32_t triangle_count(const Surface& surface) {
  return surface.face && surface.face->surfedge_count > 2 ? surface.face->surfedge_count - 2 : 0;
}

// What a point of a face has: 0 its place, 1 and 2 the directions in which its texture grows, 3 the normal, 4 where in
// the texture it is (1: as wide as it), 5 where in the lightmap (not known here), 6 its colour.
void getsurfacepointattribute(Vm& vm, const GameContext& context) {
  const Surface surface = surface_parm(vm, context);
  const std::int32_t i = vm.parm_int(2), attribute = vm.parm_int(3);
  vm.return_vector(vec3(0.0f));
  if (!surface.face || i < 0 || static_cast<std::uint32_t>(i) >= surface.face->surfedge_count) return;
  const vec3 point = surface.bsp->face_vertex(*surface.face, static_cast<std::uint32_t>(i));
  const formats::BspTexInfo& info = surface.bsp->texinfos[surface.face->texinfo];
  const auto direction = [&](std::size_t axis) {
    const float size = length(vec3(info.axes[axis]));
    return size > 0.0f ? vec3(info.axes[axis]) / size : vec3(0.0f);
  };
  if (attribute == 0) vm.return_vector(point + surface.origin);
  if (attribute == 1 || attribute == 2) vm.return_vector(direction(static_cast<std::size_t>(attribute) - 1));
  if (attribute == 3) vm.return_vector(surface.normal());
  if (attribute == 4 && info.texture != formats::kNoTexture) {
    const formats::BspTexture& texture = surface.bsp->textures[info.texture];
    const auto along = [&](std::size_t axis) { return dot(vec3(info.axes[axis]), point) + info.axes[axis].w; };
    vm.return_vector(
        {along(0) / static_cast<float>(texture.width), along(1) / static_cast<float>(texture.height), 0.0f});
  }
  if (attribute == 6) vm.return_vector(vec3(1.0f));
}

}  // namespace

void add_surface_builtins(BuiltinTable& table, GameContext& context) {
  table.set(434, "getsurfacenumpoints", [&context](Vm& vm) {
    const Surface surface = surface_parm(vm, context);
    vm.return_float(surface.face ? static_cast<float>(surface.face->surfedge_count) : 0.0f);
  });
  table.set(435, "getsurfacepoint", [&context](Vm& vm) {
    const Surface surface = surface_parm(vm, context);
    const std::int32_t i = vm.parm_int(2);
    const bool there = surface.face && i >= 0 && static_cast<std::uint32_t>(i) < surface.face->surfedge_count;
    vm.return_vector(there ? surface.point(static_cast<std::uint32_t>(i)) : vec3(0.0f));
  });
  table.set(436, "getsurfacenormal", [&context](Vm& vm) {
    const Surface surface = surface_parm(vm, context);
    vm.return_vector(surface.face ? surface.normal() : vec3(0.0f));
  });
  table.set(437, "getsurfacetexture",
            [&context](Vm& vm) { vm.return_string(texture_name(surface_parm(vm, context))); });
  table.set(438, "getsurfacenearpoint", [&context](Vm& vm) { getsurfacenearpoint(vm, context); });
  table.set(439, "getsurfaceclippedpoint", [&context](Vm& vm) {
    const Surface surface = surface_parm(vm, context);
    const vec3 p = vm.parm_vector(2);
    vm.return_vector(surface.face ? clip_to_face(surface, p) : p);
  });
  table.add_extension("DP_QC_GETSURFACE");
  // Faces are convex: their triangles share the first point.
  table.set(628, "getsurfacenumtriangles",
            [&context](Vm& vm) { vm.return_float(static_cast<float>(triangle_count(surface_parm(vm, context)))); });
  table.set(629, "getsurfacetriangle", [&context](Vm& vm) {
    const std::uint32_t count = triangle_count(surface_parm(vm, context));
    const std::int32_t i = vm.parm_int(2);
    const bool there = i >= 0 && static_cast<std::uint32_t>(i) < count;
    vm.return_vector(there ? vec3(0.0f, i + 1, i + 2) : vec3(0.0f));
  });
  table.add_extension("DP_QC_GETSURFACETRIANGLE");
  table.set(486, "getsurfacepointattribute", [&context](Vm& vm) { getsurfacepointattribute(vm, context); });
  table.add_extension("DP_QC_GETSURFACEPOINTATTRIBUTE");
}

}  // namespace fb::sv
