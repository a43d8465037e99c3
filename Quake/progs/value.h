// QuakeC's values. Everything that QuakeC sees (globals, entities' fields) is a 32-bit word; what a word means is the
// business of whoever reads it. Words are kept as integers so that a float that is no number survives being copied.
#pragma once

#include <bit>
#include <cstdint>

#include "base/maths.h"

namespace fb::progs {

using Word = std::uint32_t;

// A place in the progs' block of strings (>= 0) or a string of the engine (< 0): progs/strings.h.
enum class StringId : std::int32_t { kNull = 0 };
// Index of Program::functions.
enum class FunctionId : std::uint32_t { kNull = 0 };
// Number of an edict. This is what QuakeC's entity values hold as well (QuakeSpasm has byte offsets there): both grow
// in equal steps from 0, the world, so that mods which calculate with entities get what they expect.
enum class EdictId : std::uint32_t { kWorld = 0 };
// Offset of a field, in words: what QuakeC's values of type .float, .vector, ... hold.
enum class FieldId : std::uint32_t {};

constexpr std::uint32_t index(FunctionId id) { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(EdictId id) { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(FieldId id) { return static_cast<std::uint32_t>(id); }
constexpr EdictId next(EdictId id) { return EdictId{index(id) + 1}; }

inline float as_float(Word word) { return std::bit_cast<float>(word); }
inline Word as_word(float value) { return std::bit_cast<Word>(value); }
// C's cast as x86 has it, which is what mods know: what an int cannot hold becomes the least int.
constexpr std::int32_t to_int(float value) {
  return value >= -2147483648.0f && value < 2147483648.0f ? static_cast<std::int32_t>(value) : INT32_MIN;
}
constexpr std::int32_t to_int(double value) {
  return value > -2147483649.0 && value < 2147483648.0 ? static_cast<std::int32_t>(value) : INT32_MIN;
}

// QuakeC's types as definitions of progs.dat have them.
enum class Type : std::uint16_t { kVoid, kString, kFloat, kVector, kEntity, kField, kFunction, kPointer };
constexpr std::uint32_t words_of(Type type) { return type == Type::kVector ? 3 : 1; }
const char* type_name(Type type);  // "float"

// How a C++ type lies in words.
template <typename T>
struct ValueTraits;
template <>
struct ValueTraits<float> {
  static constexpr Type kType = Type::kFloat;
  static float load(const Word* from) { return as_float(*from); }
  static void store(Word* to, float value) { *to = as_word(value); }
};
template <>
struct ValueTraits<vec3> {
  static constexpr Type kType = Type::kVector;
  static vec3 load(const Word* from) { return {as_float(from[0]), as_float(from[1]), as_float(from[2])}; }
  static void store(Word* to, const vec3& value) {
    for (int i = 0; i < 3; ++i) to[i] = as_word(value[i]);
  }
};
template <typename Id, Type type>
struct IdTraits {
  static constexpr Type kType = type;
  static Id load(const Word* from) { return static_cast<Id>(*from); }
  static void store(Word* to, Id value) { *to = static_cast<Word>(value); }
};
template <>
struct ValueTraits<StringId> : IdTraits<StringId, Type::kString> {};
template <>
struct ValueTraits<EdictId> : IdTraits<EdictId, Type::kEntity> {};
template <>
struct ValueTraits<FunctionId> : IdTraits<FunctionId, Type::kFunction> {};
template <>
struct ValueTraits<FieldId> : IdTraits<FieldId, Type::kField> {};

constexpr std::uint32_t kAbsent = 0xffffffffu;
// Where a field of an edict, or a global, is and what it holds: a constant of system_defs.h, or found by name once a
// level (Program::field, Program::global), then absent where the mod has none.
template <typename T>
struct Field {
  std::uint32_t offset = kAbsent;  // words
  constexpr explicit operator bool() const { return offset != kAbsent; }
};
template <typename T>
struct Global {
  std::uint32_t offset = kAbsent;  // words
  constexpr explicit operator bool() const { return offset != kAbsent; }
};

}  // namespace fb::progs
