// progs.dat, version 6: a mod's compiled QuakeC. After loading, every operand, jump, offset, name and count in this
// structure is in range, so that the virtual machine needs no checks but those of values (pointers, entities, calls).
//
// What is not needed to run and makes no sense (a definition that lies outside, say) is left out, and `warnings` says
// so.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"
#include "progs/opcodes.h"
#include "progs/value.h"

namespace fb::progs {

// Operands as the file has them (OpInfo): unsigned indices of globals, signed jumps relative to this statement.
struct Statement {
  Op op = Op::kEnd;
  std::uint16_t a = 0, b = 0, c = 0;
};
constexpr std::int32_t jump_of(std::uint16_t operand) { return static_cast<std::int16_t>(operand); }

// A global or a field by name.
struct Definition {
  Type type = Type::kVoid;
  bool saved = false;        // globals: goes into saved games
  std::uint32_t offset = 0;  // words; all of its words are in range
  std::string_view name;
};

struct Function {
  std::int32_t first_statement = 0;  // negative: builtin number -first_statement
  std::uint32_t first_local = 0, local_count = 0;
  std::uint32_t parm_count = 0;                 // 0..8
  std::array<std::uint8_t, 8> parm_sizes = {};  // words, 0..3
  std::string_view name, file;
  bool by_name = false;  // "= #0:name": it has neither a body nor a number
  bool is_builtin() const { return first_statement < 0 || by_name; }
  // 0: known by its name.
  std::int64_t builtin_number() const { return -std::int64_t{first_statement}; }
};

// Move only: names are views of its strings.
struct Program {
  Program() = default;
  Program(Program&&) = default;
  Program& operator=(Program&&) = default;

  std::string file;
  std::uint16_t crc = 0;
  std::vector<Statement> statements;  // one more than the file has: the last is Op::kEnd
  std::vector<Definition> global_definitions, field_definitions;
  std::vector<Function> functions;  // [0] is no function
  std::vector<char> strings;        // ends with a zero
  std::vector<Word> globals;        // initial values; global_count and kGlobalPadding zeros
  std::uint32_t global_count = 0;
  std::uint32_t field_words = 0;  // of an edict, at least kSystemFields
  std::vector<std::string> warnings;

  // The first of that name, as in Quake; nullptr where there is none.
  const Definition* find_global(std::string_view name) const;
  const Definition* find_field(std::string_view name) const;
  FunctionId find_function(std::string_view name) const;  // kNull where there is none
  // What stands at an offset, for printing; nullptr where nothing does.
  const Definition* global_at(std::uint32_t offset) const;
  const Definition* field_at(std::uint32_t offset) const;

  // Once a level: absent where the mod has none of that name, or it is of another type.
  template <typename T>
  Field<T> field(std::string_view name) const {
    const Definition* found = find_field(name);
    return found && found->type == ValueTraits<T>::kType ? Field<T>{found->offset} : Field<T>{};
  }
  template <typename T>
  Global<T> global(std::string_view name) const {
    const Definition* found = find_global(name);
    return found && found->type == ValueTraits<T>::kType ? Global<T>{found->offset} : Global<T>{};
  }

  struct Index {
    std::unordered_map<std::string_view, std::uint32_t> globals, fields, functions;
    std::unordered_map<std::uint32_t, std::uint32_t> global_offsets, field_offsets;
  };
  Index index;
};

// A vector's opcode whose operand is the last global reaches into these.
constexpr std::uint32_t kGlobalPadding = 3;
constexpr std::uint32_t kMaxFieldWords = 65538;        // what 16-bit offsets can name
constexpr std::size_t kMostProgramBytes = 64u << 20u;  // of a progs.dat; the largest mods have two million

// `name` is what errors call the file. Memory is bounded by a small multiple of data.size().
//
// The header's CRC stands for the layout of the system globals and fields (system_defs.h). With Quake's, 5927, they are
// taken to be in their places; QuakeSpasm refuses all others. Here another CRC is taken, with a warning, where the
// names show that everything is in its place all the same, and refused with the first thing that is not.
Result<Program> load_program(ByteView data, std::string_view name);

}  // namespace fb::progs
