// progs.dat put together by hand, a statement at a time: for what no compiler emits, and where there is none. For
// tests.
//
//   ProgramBuilder builder;
//   const auto a = builder.global(2.0f), b = builder.global(3.0f), c = builder.global(0.0f);
//   builder.function("main", {{Op::kAddF, a, b, c}, {Op::kDone}});
//   auto program = load_program(builder.build(), "made.dat");
#pragma once

#include <bit>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>
#include <algorithm>

#include "base/bytes.h"
#include "progs/program.h"
#include "progs/system_defs.h"

namespace fb::progs::testing {

class ProgramBuilder {
 public:
  ProgramBuilder() : ProgramBuilder(true) {}
  explicit ProgramBuilder(bool as_compilers_do) {
    strings_.push_back(0);
    globals_.resize(kSystemGlobals);
    field_words_ = kSystemFields;
    if (as_compilers_do) statements_.push_back({Op::kDone});  // belongs to no function
    functions_.push_back({});
    global_definitions_.push_back({});
    field_definitions_.push_back({});
    for (const auto& row : system_globals()) define_global(row.name, row.type, row.offset);
    for (const auto& row : system_fields()) define_field(row.name, row.type, row.offset);
  }

  std::uint16_t crc = kProgsCrc;

  std::uint32_t string(std::string_view text) {
    const auto at = static_cast<std::uint32_t>(strings_.size());
    strings_.insert(strings_.end(), text.begin(), text.end());
    strings_.push_back(0);
    return at;
  }
  std::uint16_t word(Word value) {
    globals_.push_back(value);
    return static_cast<std::uint16_t>(globals_.size() - 1);
  }
  std::uint16_t global(float value) { return word(as_word(value)); }
  std::uint16_t vector(float x, float y, float z) {
    const std::uint16_t at = global(x);
    global(y);
    global(z);
    return at;
  }
  void define_global(std::string_view name, Type type, std::uint32_t offset, bool saved = false) {
    define(global_definitions_, name, static_cast<std::uint16_t>(static_cast<unsigned>(type) | (saved ? 0x8000u : 0u)),
           offset);
  }
  void define_field(std::string_view name, Type type, std::uint32_t offset) {
    define(field_definitions_, name, static_cast<std::uint16_t>(type), offset);
  }
  // A new field behind those that there are; its offset.
  std::uint32_t field(std::string_view name, Type type) {
    const std::uint32_t at = field_words_;
    define_field(name, type, at);
    field_words_ += words_of(type);
    return at;
  }
  std::uint32_t function(std::string_view name, std::initializer_list<Statement> body, std::uint32_t first_local = 0,
                         std::uint32_t local_count = 0, std::initializer_list<std::uint8_t> parm_sizes = {}) {
    FileFunction function{static_cast<std::int32_t>(statements_.size()), first_local, local_count, string(name),
                          static_cast<std::int32_t>(parm_sizes.size()),  {}};
    std::copy(parm_sizes.begin(), parm_sizes.end(), function.parm_sizes);
    statements_.insert(statements_.end(), body);
    functions_.push_back(function);
    return static_cast<std::uint32_t>(functions_.size() - 1);
  }
  std::uint32_t builtin(std::string_view name, std::int32_t number) {
    functions_.push_back({-number, 0, 0, string(name), 0, {}});
    return static_cast<std::uint32_t>(functions_.size() - 1);
  }

  Bytes build() const {
    Bytes lumps;
    std::vector<std::uint32_t> header = {6, crc};
    const auto add = [&](std::size_t count, auto write) {
      header.push_back(static_cast<std::uint32_t>(60 + lumps.size()));
      header.push_back(static_cast<std::uint32_t>(count));
      for (std::size_t i = 0; i < count; ++i) write(i);
    };
    const auto put = [&](auto value) {
      for (std::size_t i = 0; i < sizeof(value); ++i) lumps.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    };
    add(statements_.size(), [&](std::size_t i) {
      const Statement& s = statements_[i];
      for (const std::uint16_t part : {static_cast<std::uint16_t>(s.op), s.a, s.b, s.c}) put(part);
    });
    for (const auto* definitions : {&global_definitions_, &field_definitions_}) {
      add(definitions->size(), [&](std::size_t i) {
        put((*definitions)[i].type);
        put((*definitions)[i].offset);
        put((*definitions)[i].name);
      });
    }
    add(functions_.size(), [&](std::size_t i) {
      const FileFunction& f = functions_[i];
      put(static_cast<std::uint32_t>(f.first_statement));
      for (const std::uint32_t part : {f.first_local, f.local_count, 0u, f.name, 0u}) put(part);
      put(static_cast<std::uint32_t>(f.parm_count));
      for (const std::uint8_t size : f.parm_sizes) put(size);
    });
    add(strings_.size(), [&](std::size_t i) { put(static_cast<std::uint8_t>(strings_[i])); });
    add(globals_.size(), [&](std::size_t i) { put(globals_[i]); });
    header.push_back(field_words_);
    Bytes head;
    std::swap(head, lumps);
    for (const std::uint32_t value : header) put(value);
    lumps.insert(lumps.end(), head.begin(), head.end());
    return lumps;
  }

 private:
  struct FileDefinition {
    std::uint16_t type = 0, offset = 0;
    std::uint32_t name = 0;
  };
  struct FileFunction {
    std::int32_t first_statement = 0;
    std::uint32_t first_local = 0, local_count = 0, name = 0;
    std::int32_t parm_count = 0;
    std::uint8_t parm_sizes[8] = {};
  };
  void define(std::vector<FileDefinition>& into, std::string_view name, std::uint16_t type, std::uint32_t offset) {
    into.push_back({type, static_cast<std::uint16_t>(offset), string(name)});
  }

  std::vector<Statement> statements_;
  std::vector<FileDefinition> global_definitions_, field_definitions_;
  std::vector<FileFunction> functions_;
  std::vector<char> strings_;
  std::vector<Word> globals_;
  std::uint32_t field_words_ = 0;
};

}  // namespace fb::progs::testing
