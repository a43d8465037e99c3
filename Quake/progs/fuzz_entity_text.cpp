// Fuzz target: text. Entities' text is refused, or what is written of it reads back the same; builtins that take text
// apart stand any text.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/log.h"
#include "progs/builtins/builtins.h"
#include "progs/entity_text.h"
#include "progs/test_program.h"

namespace {

using namespace fb;
using namespace fb::progs;

std::shared_ptr<const Program> make_program() {
  testing::ProgramBuilder builder;
  for (const int number : {627, 441, 117, 224, 226, 227, 479, 81, 116, 484}) builder.builtin("b", number);
  builder.field("where", Type::kField);
  auto program = load_program(builder.build(), "made.dat");
  FB_CHECK(program.ok());
  return std::make_shared<Program>(std::move(program).value());
}

// As it would be saved; "" where it is refused.
std::string read_and_write(Vm& vm, std::string_view text) {
  const auto id = vm.edicts().revive(EdictId{2});
  FB_CHECK(id.ok());
  return parse_edict(vm, *id, text).ok() ? write_edict(vm, *id) : std::string();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  set_log_level(LogLevel::kError);
  static const std::shared_ptr<const Program> program = make_program();
  VmOptions options;
  options.max_edicts = 4;
  auto vm = Vm::create(program, standard_builtins({}), options);
  FB_CHECK(vm.ok());
  (*vm)->edicts().start_level(1);
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string first = read_and_write(**vm, text);
  if (!first.empty()) {
    const std::string second = read_and_write(**vm, first.substr(2));  // numbers have six decimals now
    FB_CHECK(!second.empty());
    FB_CHECK_EQ(read_and_write(**vm, second.substr(2)), second);
  }
  const std::string_view half = std::string_view(text).substr(text.size() / 2);
  for (std::uint32_t i = 1; i < program->functions.size(); ++i) {
    for (int parm = 0; parm < 8; ++parm) {
      (*vm)->set_parm(parm, (*vm)->strings().temporary(parm % 2 == 0 ? std::string_view(text) : half));
    }
    (void)(*vm)->execute(FunctionId{i});
  }
  return 0;
}
