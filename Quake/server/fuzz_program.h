// A program with some of everything that saves hold, for the fuzzer of saves and its seeds.
#pragma once

#include <memory>

#include "base/check.h"
#include "progs/test_program.h"

namespace fb::sv::testing {

inline std::shared_ptr<const progs::Program> fuzz_program() {
  progs::testing::ProgramBuilder builder;
  builder.function("thing_think", {{progs::Op::kDone}});
  builder.define_global("counter", progs::Type::kFloat, builder.global(1.5f), true);
  builder.define_global("word", progs::Type::kString, builder.word(builder.string("a word")), true);
  builder.define_global("marked", progs::Type::kEntity, builder.word(1), true);
  builder.field("state", progs::Type::kFloat);
  builder.field("pos1", progs::Type::kVector);
  builder.field("way", progs::Type::kField);
  auto program = progs::load_program(builder.build(), "fuzz.dat");
  FB_CHECK(program.ok());
  return std::make_shared<progs::Program>(std::move(*program));
}

}  // namespace fb::sv::testing
