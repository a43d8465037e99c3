// Numbers and vectors. Where Quake cuts to whole degrees or rounds by way of an int, so does this.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/maths.h"
#include "progs/angles.h"
#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

double length(const vec3& v) {
  const double x = v.x, y = v.y, z = v.z;
  return std::sqrt(x * x + y * y + z * z);
}

void normalize(Vm& vm) {
  const vec3 v = vm.parm_vector(0);
  const double size = length(v);
  const double scale = size == 0.0 ? 0.0 : 1.0 / size;
  const auto scaled = [&](float x) { return static_cast<float>(x * scale); };
  vm.return_vector({scaled(v.x), scaled(v.y), scaled(v.z)});
}

void makevectors(Vm& vm) {
  const AxisVectors axes = angle_vectors(vm.parm_vector(0));
  vm.set(globals::v_forward, axes.forward);
  vm.set(globals::v_right, axes.right);
  vm.set(globals::v_up, axes.up);
}

// DP_QC_VECTORVECTORS: a direction instead of angles; without roll.
void vectorvectors(Vm& vm) {
  vec3 forward = vm.parm_vector(0);
  const float size = static_cast<float>(length(forward));
  if (size > 0.0f) forward /= size;
  vec3 right(0.0f, -1.0f, 0.0f);
  if (forward.x != 0.0f || forward.y != 0.0f) right = glm::normalize(vec3(forward.y, -forward.x, 0.0f));
  vm.set(globals::v_forward, forward);
  vm.set(globals::v_right, right);
  vm.set(globals::v_up, glm::cross(right, forward));
}

// Half away from zero, by way of an int.
void rint(Vm& vm) {
  const float value = vm.parm_float(0);
  const double half = value > 0.0f ? 0.5 : -0.5;
  vm.return_float(static_cast<float>(to_int(static_cast<double>(value) + half)));
}

// Quake's, with both ends: 32768 different numbers from 0 to 1.
float random(Rng& rng) { return static_cast<float>(rng.next() >> 17u) / 32767.0f; }

// DP_QC_RANDOMVEC: evenly inside the unit sphere.
vec3 random_vector(Rng& rng) {
  for (;;) {
    vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = 2.0f * random(rng) - 1.0f;
    if (glm::dot(v, v) <= 1.0f) return v;
  }
}

// DP_QC_MINMAXBOUND: of two or more numbers.
template <typename Better>
void best_of_parms(Vm& vm, Better better) {
  float best = vm.parm_float(0);
  for (int i = 1; i < vm.parm_count(); ++i) {
    if (better(vm.parm_float(i), best)) best = vm.parm_float(i);
  }
  vm.return_float(best);
}

void bound(Vm& vm) {
  const float low = vm.parm_float(0), value = vm.parm_float(1), high = vm.parm_float(2);
  vm.return_float(value < low ? low : value > high ? high : value);
}

// mod(a, n): what is left of a behind the greatest multiple of n towards 0; 0 of 0.
void mod(Vm& vm) {
  const float a = vm.parm_float(0), n = vm.parm_float(1);
  vm.return_float(n == 0.0f ? 0.0f : a - n * std::trunc(a / n));
}

// To [0, 360), without steps.
void anglemod(Vm& vm) {
  const float angle = std::fmod(vm.parm_float(0), 360.0f);
  vm.return_float(angle < 0.0f ? angle + 360.0f : angle);
}

// log(v, base): without a base, the natural one.
void logarithm(Vm& vm) {
  const double log = std::log(static_cast<double>(vm.parm_float(0)));
  vm.return_float(
      static_cast<float>(vm.parm_count() < 2 ? log : log / std::log(static_cast<double>(vm.parm_float(1)))));
}

// vectoangles(forward, up): with `up`, the roll that it asks for, and no steps (DP_QC_VECTOANGLES_WITH_ROLL).
void vectoangles(Vm& vm) {
  const vec3 forward = vm.parm_vector(0);
  if (vm.parm_count() < 2) return vm.return_vector(vector_to_angles(forward));
  const vec3 up = vm.parm_vector(1);
  const auto degrees = [](float y, float x) { return std::atan2(y, x) * (180.0f / 3.14159265358979f); };
  const bool vertical = forward.x == 0.0f && forward.y == 0.0f;
  vec3 angles(degrees(forward.z, std::hypot(forward.x, forward.y)), vertical ? 0.0f : degrees(forward.y, forward.x),
              0.0f);
  const AxisVectors level = angle_vectors({-angles.x, angles.y, 0.0f});
  angles.z = degrees(glm::dot(up, level.right), glm::dot(up, level.up));
  for (int i = 0; i < 2; ++i) angles[i] += angles[i] < 0.0f ? 360.0f : 0.0f;
  vm.return_vector(angles);
}

// EXT_BITSHIFT: to the left, or by a negative number to the right (keeping the sign).
void bitshift(Vm& vm) {
  const std::int32_t value = vm.parm_int(0), by = vm.parm_int(1);
  const auto bits = static_cast<std::uint32_t>(value);
  std::int32_t shifted;
  if (by >= 0) {
    shifted = by > 31 ? 0 : static_cast<std::int32_t>(bits << static_cast<unsigned>(by));
  } else {
    shifted = value >> std::min(31u, static_cast<unsigned>(-static_cast<std::int64_t>(by)));
  }
  vm.return_float(static_cast<float>(shifted));
}

// A function of C on one or two floats, in double precision as C's library has it.
Builtin unary(double (*function)(double)) {
  return [function](Vm& vm) { vm.return_float(static_cast<float>(function(vm.parm_float(0)))); };
}
Builtin binary(double (*function)(double, double)) {
  return [function](Vm& vm) { vm.return_float(static_cast<float>(function(vm.parm_float(0), vm.parm_float(1)))); };
}

void change_angle(Edict edict, int axis, float ideal, float speed) {
  edict.set(fields::angles, turned_towards(edict.get(fields::angles), axis, ideal, speed));
}

void changeyaw(Vm& vm) {
  Edict self = vm.self();
  change_angle(self, 1, self.get(fields::ideal_yaw), self.get(fields::yaw_speed));
}

void add_c_functions(BuiltinTable& table) {
  table.set(37, "floor", unary(std::floor));
  table.set(38, "ceil", unary(std::ceil));
  table.set(43, "fabs", unary(std::fabs));
  table.set(60, "sin", unary(std::sin));  // of radians
  table.set(61, "cos", unary(std::cos));
  table.set(62, "sqrt", unary(std::sqrt));
  table.set(97, "pow", binary(std::pow));
  table.add_extension("DP_QC_SINCOSSQRTPOW");
  table.set(471, "asin", unary(std::asin));
  table.set(472, "acos", unary(std::acos));
  table.set(473, "atan", unary(std::atan));
  table.set(474, "atan2", binary(std::atan2));
  table.set(475, "tan", unary(std::tan));
  table.add_extension("DP_QC_ASINACOSATANATAN2TAN");
  table.set(532, "log", logarithm);
  table.add_extension("DP_QC_LOG");
}

}  // namespace

void add_math_builtins(BuiltinTable& table, const Services& services) {
  add_c_functions(table);
  std::shared_ptr<Rng> own = services.rng ? nullptr : std::make_shared<Rng>();
  Rng* const rng = services.rng ? services.rng : own.get();
  table.set(7, "random", [own, rng](Vm& vm) { vm.return_float(random(*rng)); });
  table.set(91, "randomvec", [own, rng](Vm& vm) { vm.return_vector(random_vector(*rng)); });
  table.add_extension("DP_QC_RANDOMVEC");

  table.set(1, "makevectors", makevectors);
  table.set(9, "normalize", normalize);
  table.set(12, "vlen", [](Vm& vm) { vm.return_float(static_cast<float>(length(vm.parm_vector(0)))); });
  table.set(13, "vectoyaw", [](Vm& vm) { vm.return_float(vector_to_yaw(vm.parm_vector(0))); });
  table.set(36, "rint", rint);
  table.set(49, "changeyaw", changeyaw);
  table.set(51, "vectoangles", vectoangles);
  table.add_extension("DP_QC_VECTOANGLES_WITH_ROLL");
  table.set(102, "anglemod", anglemod);
  table.set(245, "mod", mod);
  table.set_named("crossproduct", [](Vm& vm) { vm.return_vector(glm::cross(vm.parm_vector(0), vm.parm_vector(1))); });
  table.add_extension("FTE_QC_CROSSPRODUCT");
  table.set(432, "vectorvectors", vectorvectors);
  table.add_extension("DP_QC_VECTORVECTORS");

  table.set(94, "min", [](Vm& vm) { best_of_parms(vm, std::less<float>()); });
  table.set(95, "max", [](Vm& vm) { best_of_parms(vm, std::greater<float>()); });
  table.set(96, "bound", bound);
  table.add_extension("DP_QC_MINMAXBOUND");
  table.set(218, "bitshift", bitshift);
  table.add_extension("EXT_BITSHIFT");

  table.set(63, "changepitch", [](Vm& vm) {
    Edict edict = vm.parm_edict(0);
    if (vm.failed()) return;
    const auto ideal = vm.program().field<float>("idealpitch"), speed = vm.program().field<float>("pitch_speed");
    change_angle(edict, 0, edict.get(ideal), edict.get(speed));
  });
  table.add_extension("DP_QC_CHANGEPITCH");
}

}  // namespace fb::progs
