// What the loader demands of functions, statements and the layout before anything may run.
#include <fmt/format.h>

#include <array>
#include <numeric>

#include "progs/program_detail.h"
#include "progs/system_defs.h"

namespace fb::progs::detail {
namespace {

std::optional<std::string> fault_of_operand(const Program& program, std::size_t statement, Operand kind,
                                            std::uint16_t value) {
  if (kind == Operand::kGlobal && value >= program.global_count) {
    return fmt::format("operand {} is none of {} globals", value, program.global_count);
  }
  if (kind == Operand::kJump) {
    const std::int64_t target = static_cast<std::int64_t>(statement) + jump_of(value);
    // The statement that ends the program (Op::kEnd) may be jumped to: running into it is an error of its own.
    if (target < 0 || target >= static_cast<std::int64_t>(program.statements.size())) {
      return fmt::format("jump to statement {}, of {}", target, program.statements.size() - 1);
    }
  }
  return std::nullopt;
}

std::string_view engine_of_crc(std::uint16_t crc) {
  switch (crc) {
    case 54730:
      return " (QuakeWorld's)";
    case 22390:
      return " (that of mods which draw all of the picture)";
    case 32401:
      return " (Tenebrae's)";
    default:
      return "";
  }
}

// The first that is missing or elsewhere.
template <typename Find>
std::optional<std::string> misplaced(std::span<const SystemDefinition> expected, const Find& find) {
  for (const SystemDefinition& row : expected) {
    const Definition* found = find(row.name);
    if (!found) return fmt::format("{} is missing", row.name);
    if (found->offset != row.offset || found->type != row.type) {
      return fmt::format("{} is a {} at {}, where Quake has a {} at {}", row.name, type_name(found->type),
                         found->offset, type_name(row.type), row.offset);
    }
  }
  return std::nullopt;
}

const Definition* find_name(const std::vector<Definition>& definitions, std::string_view name) {
  for (const Definition& definition : definitions) {
    if (definition.name == name) return &definition;
  }
  return nullptr;
}

}  // namespace

std::optional<Error> check_statements(const Program& program, const Lump& lump, const ByteReader& reader) {
  for (std::size_t i = 0; i < lump.count; ++i) {
    const Statement& statement = program.statements[i];
    const auto op = static_cast<std::uint16_t>(statement.op);
    const std::size_t at = lump.entry(i, kStatementSize);
    if (op >= kOpCount) {
      return reader.error_at(at, fmt::format("statement {} has opcode {}, which version 6 does not have", i, op));
    }
    const OpInfo& info = op_info(statement.op);
    const std::array<std::pair<Operand, std::uint16_t>, 3> operands = {
        {{info.a, statement.a}, {info.b, statement.b}, {info.c, statement.c}}};
    for (const auto& [kind, value] : operands) {
      if (const auto fault = fault_of_operand(program, i, kind, value)) {
        return reader.error_at(at, fmt::format("statement {} ({}): {}", i, info.name, *fault));
      }
    }
  }
  return std::nullopt;
}

std::optional<Error> check_functions(const Program& program, const Lump& lump, const ByteReader& reader) {
  for (std::size_t i = 1; i < program.functions.size(); ++i) {
    const Function& function = program.functions[i];
    if (function.is_builtin()) continue;
    const auto fault = [&](const std::string& cause) {
      return reader.error_at(lump.entry(i, kFunctionSize), fmt::format("function {} ({}) {}", i, function.name, cause));
    };
    if (static_cast<std::size_t>(function.first_statement) >= program.statements.size()) {
      return fault(
          fmt::format("begins at statement {}, of {}", function.first_statement, program.statements.size() - 1));
    }
    if (function.first_local > program.global_count ||
        function.local_count > program.global_count - function.first_local) {
      return fault(fmt::format("has {} local words at {}, of {} globals", function.local_count, function.first_local,
                               program.global_count));
    }
    std::uint32_t parm_words = 0;
    for (std::uint32_t parm = 0; parm < function.parm_count; ++parm) {
      if (function.parm_sizes[parm] > 3) {
        return fault(fmt::format("has a parameter of {} words", function.parm_sizes[parm]));
      }
      parm_words += function.parm_sizes[parm];
    }
    if (parm_words > program.global_count - function.first_local) {
      return fault(fmt::format("has {} words of parameters at {}, of {} globals", parm_words, function.first_local,
                               program.global_count));
    }
  }
  return std::nullopt;
}

std::optional<Error> check_layout(Program& program, const ByteReader& reader) {
  if (program.crc == kProgsCrc) return std::nullopt;
  const auto of = [](const std::vector<Definition>& definitions) {
    return [&](std::string_view name) { return find_name(definitions, name); };
  };
  auto fault = misplaced(system_globals(), of(program.global_definitions));
  if (!fault) fault = misplaced(system_fields(), of(program.field_definitions));
  const std::string crc =
      fmt::format("CRC {}{} instead of Quake's {}", program.crc, engine_of_crc(program.crc), kProgsCrc);
  if (fault) return reader.error_at(4, fmt::format("progs for another engine: {}, and {}", crc, *fault));
  program.warnings.push_back(
      reader.error_at(4, crc + "; taken, as all of Quake's globals and fields are in their places").message);
  return std::nullopt;
}

}  // namespace fb::progs::detail
