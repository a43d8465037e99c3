// progs_make_seed_corpus DIRECTORY: writes the seeds of this module's fuzzers into DIRECTORY/<fuzzer>/.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "fs/file.h"
#include "progs/test_program.h"

namespace {

using namespace fb;
using namespace fb::progs;
using testing::ProgramBuilder;

bool write(const std::filesystem::path& path, ByteView bytes) {
  const Status status = fs::write_file_atomically(path, bytes);
  if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
  return status.ok();
}

// Each opcode once, on operands that make sense for most of them.
ProgramBuilder every_opcode() {
  ProgramBuilder builder;
  const auto entity = builder.word(1), field = builder.word(fields::origin.offset);
  const auto vector = builder.vector(1, 2, 3), result = builder.vector(0, 0, 0), callee = builder.word(1);
  builder.builtin("random", 7);
  for (std::uint16_t op = 0; op < kOpCount; ++op) {
    Statement statement{static_cast<Op>(op), entity, field, result};
    const OpInfo& info = op_info(statement.op);
    if (info.a == Operand::kJump) statement.a = 1;
    if (info.b == Operand::kJump) statement.b = 1;
    if (statement.op >= Op::kCall0 && statement.op <= Op::kCall8) statement.a = callee;
    builder.function(info.name, {statement, {Op::kStoreV, vector, kOfsParm0}, {Op::kReturn, result}}, vector, 3, {3});
  }
  return builder;
}

// Every standard builtin, called once with entity 1, a field and a string.
ProgramBuilder calls(std::int32_t first, std::int32_t last) {
  ProgramBuilder builder;
  const auto entity = builder.word(1), text = builder.word(builder.string("a %d \\key\\value"));
  const auto field = builder.word(fields::classname.offset);
  for (std::int32_t number = first; number <= last; ++number) {
    const auto callee = builder.word(builder.builtin("b", number));
    builder.function("f", {{Op::kStoreF, number % 2 == 0 ? entity : text, kOfsParm0},
                           {Op::kStoreF, field, kOfsParm0 + 3},
                           {Op::kStoreF, text, kOfsParm0 + 6},
                           {Op::kCall3, callee},
                           {Op::kDone}});
  }
  return builder;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: progs_make_seed_corpus DIRECTORY\n");
    return 2;
  }
  const std::filesystem::path root(argv[1]);
  bool ok = write(root / "fuzz_progs" / "opcodes", every_opcode().build());
  for (const int first : {1, 9, 17, 25, 33, 41, 94, 102, 110, 118, 218, 224, 400, 440, 448, 472, 480, 496, 512, 625}) {
    ok = ok && write(root / "fuzz_progs" / ("calls" + std::to_string(first)), calls(first, first + 7).build());
  }
  const std::string_view texts[] = {
      "\"classname\" \"monster\" \"origin\" \"1 -2.5 3\" \"angle\" \"90\" \"light\" \"300\" \"think\" \"b\" }",
      "\"enemy\" \"1\" \"where\" \"origin\" \"message\" \"a\\nb \\\\ c\" \"_x\" \"y\" \"health\" \"1e-9\" }",
      "%5d %-5.2f|%2$s %1$*2$d %v %x %c %i %%", "\\key\\value\\other\\'1 2 3'", "a \"b c\" // d\n e,f,,g"};
  int number = 0;
  for (const std::string_view text : texts) {
    ok = ok && write(root / "fuzz_entity_text" / std::to_string(number++),
                     ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  return ok ? 0 : 1;
}
