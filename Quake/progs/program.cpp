#include "progs/program.h"

#include <fmt/format.h>

#include <algorithm>

#include "progs/program_detail.h"
#include "progs/system_defs.h"

namespace fb::progs {
namespace {

using detail::Lump;

constexpr std::uint32_t kVersion = 6;
constexpr std::uint16_t kSaveGlobal = 0x8000, kShared = 0x4000;  // flags of a definition's type; the second is FTE's
constexpr std::size_t kHeaderSize = 60;

struct Header {
  Lump statements, globals, fields, functions, strings, values;
  std::uint32_t field_words = 0;
};

class Loader {
 public:
  Loader(ByteView data, std::string_view name) : reader_(data, name) { program_.file = name; }

  Result<Program> load() {
    for (const auto step : {&Loader::read_header, &Loader::read_tables, &Loader::check}) {
      if (auto error = (this->*step)()) return *error;
    }
    make_index();
    return std::move(program_);
  }

 private:
  using MaybeError = std::optional<Error>;

  MaybeError read_header() {
    const std::uint32_t version = reader_.u32();
    if (reader_.size() < kHeaderSize) return reader_.error_at(reader_.size(), "file ends inside the header of progs");
    if (version != kVersion) {
      return reader_.error_at(0, fmt::format("progs of version {}; only version 6 is Quake's", version));
    }
    if (reader_.size() > kMostProgramBytes) {
      return reader_.error_at(
          0, fmt::format("progs of {} bytes; at most {} are taken", reader_.size(), kMostProgramBytes));
    }
    const std::uint32_t crc = reader_.u32();
    if (crc > 0xffff) return reader_.error_at(4, fmt::format("CRC {} of the header has more than 16 bits", crc));
    program_.crc = static_cast<std::uint16_t>(crc);
    struct Row {
      Lump* lump;
      const char* what;
      std::size_t size;
    };
    const Row rows[] = {{&header_.statements, "statements", detail::kStatementSize},
                        {&header_.globals, "global definitions", detail::kDefinitionSize},
                        {&header_.fields, "field definitions", detail::kDefinitionSize},
                        {&header_.functions, "functions", detail::kFunctionSize},
                        {&header_.strings, "bytes of strings", 1},
                        {&header_.values, "globals", sizeof(Word)}};
    for (const Row& row : rows) {
      const std::size_t at = reader_.offset();
      row.lump->offset = reader_.u32();
      row.lump->count = reader_.u32();
      if (row.lump->offset > reader_.size() || row.lump->count > (reader_.size() - row.lump->offset) / row.size) {
        return reader_.error_at(
            at, fmt::format("{} {} at {} run past the end of the file", row.lump->count, row.what, row.lump->offset));
      }
    }
    header_.field_words = reader_.u32();
    return check_sizes();
  }

  MaybeError check_sizes() const {
    if (header_.field_words < kSystemFields || header_.field_words > kMaxFieldWords) {
      return reader_.error_at(56, fmt::format("entities of {} words; Quake's own fields take {}, and {} is the most",
                                              header_.field_words, kSystemFields, kMaxFieldWords));
    }
    if (header_.values.count < kSystemGlobals || header_.values.count > 0x10000) {
      return reader_.error_at(52, fmt::format("{} globals; Quake's own take {}, and operands reach 65536",
                                              header_.values.count, kSystemGlobals));
    }
    if (header_.functions.count == 0) return reader_.error_at(36, "progs without functions");
    if (header_.strings.count > 0x7fffffff) return reader_.error_at(44, "more strings than offsets can name");
    return std::nullopt;
  }

  MaybeError read_tables() {
    program_.field_words = header_.field_words;
    read_strings();
    read_values();
    read_statements();
    if (auto error = read_definitions(header_.globals, program_.global_count, "global", program_.global_definitions)) {
      return error;
    }
    if (auto error = read_definitions(header_.fields, program_.field_words, "field", program_.field_definitions)) {
      return error;
    }
    return read_functions();
  }

  void read_strings() {
    const ByteView bytes = reader_.data().subspan(header_.strings.offset, header_.strings.count);
    program_.strings.assign(bytes.begin(), bytes.end());
    if (program_.strings.empty() || program_.strings.back() != 0) program_.strings.push_back(0);
  }

  void read_values() {
    program_.global_count = header_.values.count;
    program_.globals.resize(program_.global_count + kGlobalPadding);
    reader_.seek(header_.values.offset);
    for (std::uint32_t i = 0; i < program_.global_count; ++i) program_.globals[i] = reader_.u32();
  }

  void read_statements() {
    program_.statements.resize(header_.statements.count + 1);
    reader_.seek(header_.statements.offset);
    for (std::uint32_t i = 0; i < header_.statements.count; ++i) {
      Statement& statement = program_.statements[i];
      statement.op = static_cast<Op>(reader_.u16());
      statement.a = reader_.u16();
      statement.b = reader_.u16();
      statement.c = reader_.u16();
    }
  }

  // nullopt where the offset lies outside of the strings.
  std::optional<std::string_view> string_at(std::uint32_t offset) const {
    if (offset >= program_.strings.size()) return std::nullopt;
    return std::string_view(program_.strings.data() + offset);
  }

  MaybeError read_definitions(const Lump& lump, std::uint32_t words, const char* what, std::vector<Definition>& into) {
    into.reserve(lump.count);
    reader_.seek(lump.offset);
    bool warned = false;
    for (std::uint32_t i = 0; i < lump.count; ++i) {
      const std::size_t at = reader_.offset();
      const std::uint16_t type = reader_.u16();
      Definition definition;
      definition.type = static_cast<Type>(type & ~(kSaveGlobal | kShared));
      definition.saved = (type & kSaveGlobal) != 0;
      definition.offset = reader_.u16();
      const std::uint32_t name_offset = reader_.u32();
      const auto name = string_at(name_offset);
      if (!name) {
        return reader_.error_at(
            at, fmt::format("{} definition {} has its name at {}, outside of the strings", what, i, name_offset));
      }
      definition.name = *name;
      if (definition.offset + words_of(definition.type) <= words) {
        into.push_back(definition);
      } else if (!warned) {
        warned = true;
        program_.warnings.push_back(
            reader_
                .error_at(at, fmt::format("{} {} lies at {}, outside of {} words, and is left out", what,
                                          definition.name, definition.offset, words))
                .message);
      }
    }
    return std::nullopt;
  }

  MaybeError read_functions() {
    program_.functions.resize(header_.functions.count);
    reader_.seek(header_.functions.offset);
    for (std::uint32_t i = 0; i < header_.functions.count; ++i) {
      const std::size_t at = reader_.offset();
      Function& function = program_.functions[i];
      function.first_statement = reader_.i32();
      function.first_local = reader_.u32();
      function.local_count = reader_.u32();
      reader_.skip(4);  // the compiler's room for a profile
      const auto name = string_at(reader_.u32()), file = string_at(reader_.u32());
      if (!name || !file) {
        return reader_.error_at(at, fmt::format("function {} has a name outside of the strings", i));
      }
      function.name = *name;
      function.file = *file;
      // Some compilers count the parameters of builtins with "..." as -1; builtins ask for what they were given.
      const std::int32_t parms = reader_.i32();
      if (parms > 8) return reader_.error_at(at, fmt::format("function {} has {} parameters", function.name, parms));
      function.parm_count = static_cast<std::uint32_t>(std::max(parms, 0));
      for (std::uint8_t& size : function.parm_sizes) size = reader_.u8();
    }
    return std::nullopt;
  }

  MaybeError check() {
    if (auto error = detail::check_functions(program_, header_.functions, reader_)) return error;
    if (auto error = detail::check_statements(program_, header_.statements, reader_)) return error;
    note_named_builtins();
    return detail::check_layout(program_, reader_);
  }

  // Compilers begin with a statement that belongs to no function: what begins there has no body.
  void note_named_builtins() {
    if (program_.statements.front().op != Op::kDone) return;
    for (Function& function : program_.functions) function.by_name = function.first_statement == 0;
  }

  void make_index() {
    const auto add = [](const std::vector<Definition>& definitions, auto& names, auto& offsets) {
      for (std::uint32_t i = 0; i < definitions.size(); ++i) {
        if (definitions[i].name.empty()) continue;
        names.emplace(definitions[i].name, i);
        offsets.emplace(definitions[i].offset, i);
      }
    };
    Program::Index& index = program_.index;
    add(program_.global_definitions, index.globals, index.global_offsets);
    add(program_.field_definitions, index.fields, index.field_offsets);
    for (std::uint32_t i = 1; i < program_.functions.size(); ++i) {
      if (!program_.functions[i].name.empty()) index.functions.emplace(program_.functions[i].name, i);
    }
  }

  ByteReader reader_;
  Header header_;
  Program program_;
};

template <typename Map, typename Key, typename Rows>
auto find_in(const Map& map, const Key& key, const Rows& rows) -> decltype(rows.data()) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &rows[found->second];
}

}  // namespace

const Definition* Program::find_global(std::string_view name) const {
  return find_in(index.globals, name, global_definitions);
}
const Definition* Program::find_field(std::string_view name) const {
  return find_in(index.fields, name, field_definitions);
}
const Definition* Program::global_at(std::uint32_t offset) const {
  return find_in(index.global_offsets, offset, global_definitions);
}
const Definition* Program::field_at(std::uint32_t offset) const {
  return find_in(index.field_offsets, offset, field_definitions);
}
FunctionId Program::find_function(std::string_view name) const {
  const auto found = index.functions.find(name);
  return found == index.functions.end() ? FunctionId::kNull : FunctionId{found->second};
}

Result<Program> load_program(ByteView data, std::string_view name) { return Loader(data, name).load(); }

}  // namespace fb::progs
