// How program.cpp and program_check.cpp share the work of loading.
#pragma once

#include <cstddef>
#include <optional>

#include "progs/program.h"

namespace fb::progs::detail {

// A table of the file: where it begins, and how many entries it has.
struct Lump {
  std::uint32_t offset = 0, count = 0;
  std::size_t entry(std::size_t i, std::size_t size) const { return offset + i * size; }
};
constexpr std::size_t kStatementSize = 8, kDefinitionSize = 8, kFunctionSize = 36;

// Both name the first thing that is out of its range.
std::optional<Error> check_statements(const Program& program, const Lump& lump, const ByteReader& reader);
std::optional<Error> check_functions(const Program& program, const Lump& lump, const ByteReader& reader);
// Whether the system's globals and fields are where the engine looks for them. A warning goes to program.warnings.
std::optional<Error> check_layout(Program& program, const ByteReader& reader);

}  // namespace fb::progs::detail
