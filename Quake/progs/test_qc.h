// QuakeC for tests: compiles a source with Debian's fteqcc, runs it, and collects what it put out. For tests.
//
//   class MyTest : public QcTest {};
//   TEST_F(MyTest, Adds) {
//     EXPECT_EQ(says("put(1 + 2);"), "3");
//   }
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "base/log.h"
#include "progs/builtins/builtins.h"
#include "progs/builtins/test_builtins.h"
#include "progs/test_compile.h"
#include "progs/vm.h"

namespace fb::progs::testing {

inline std::string no_compiler() { return "fteqcc is not installed (Linux/install-deps.sh test)"; }

// Skips where there is no compiler.
class QcTest : public ::testing::Test {
 protected:
  void SetUp() override {
    set_log_level(LogLevel::kError);
    if (!has_compiler()) GTEST_SKIP() << no_compiler();
  }
  void TearDown() override {
    vm_.reset();  // before what its builtins use goes
    set_log_level(LogLevel::kInfo);
  }

  // False where there is no compiler: skip the test. What does not compile or load is a failure of the test.
  bool start(const std::string& source, const std::string& options = "-O0") {
    const Compiled compiled = compile(source, options);
    if (!compiled.has_compiler) return false;
    EXPECT_FALSE(compiled.progs.empty()) << compiled.output;
    auto program = load_program(compiled.progs, "progs.dat");
    EXPECT_TRUE(program.ok()) << program.error().message;
    if (!program.ok()) return true;
    start(std::make_shared<Program>(std::move(program).value()));
    return true;
  }

  void start(std::shared_ptr<const Program> program) {
    BuiltinTable table = standard_builtins(services_);
    add_put(table);
    add_builtins(table);
    auto vm = Vm::create(std::move(program), std::move(table), options_);
    ASSERT_TRUE(vm.ok()) << vm.error().message;
    vm_ = std::move(vm).value();
    vm_->edicts().start_level(1);
  }

  virtual void add_builtins(BuiltinTable&) {}

  Status run(const std::string& function = "main") {
    if (!vm_) return Error{"nothing was started"};
    output_.clear();
    return vm_->execute(vm_->program().find_function(function));
  }
  // "" where QuakeC went well.
  std::string error_of(const std::string& function = "main") {
    const Status status = run(function);
    return status.ok() ? "" : status.error().message;
  }
  const std::string& output() const { return output_; }
  void clear_output() { output_.clear(); }
  // Compiles, runs main() and returns what it put out, or the error.
  std::string output_of(const std::string& body) {
    if (!start(body)) return no_compiler();
    const std::string error = error_of();
    return error.empty() ? output_ : fmt::format("error: {}", error);
  }
  // The same with the standard builtins declared: `statements` are main()'s.
  std::string says(const std::string& statements, const std::string& before = "") {
    return output_of(
        std::string(kBuiltinSource).append(before).append("void() main = {").append(statements).append("};"));
  }
  // What the latest warning of these statements says, "" for none; an error is an error.
  std::string warned(const std::string& statements, const std::string& before = "") {
    const std::string said = says(statements, before);
    return !vm_ || said.starts_with("error") ? said : vm_->warning();
  }
  bool has_compiler() const { return compile("void() main = {};").has_compiler; }

  std::unique_ptr<Vm> vm_;
  Services services_;
  VmOptions options_{.max_edicts = 64};

 private:
  void add(const std::string& text) {
    if (!output_.empty()) output_ += ' ';
    output_ += text;
  }
  void add_put(BuiltinTable& table) {
    table.set(1000, "put", [this](Vm& vm) { add(fmt::format("{}", vm.parm_float(0))); });
    table.set(1001, "puts", [this](Vm& vm) { add(fmt::format("[{}]", vm.parm_string(0))); });
    table.set(1002, "putv", [this](Vm& vm) {
      const vec3 v = vm.parm_vector(0);
      add(fmt::format("({} {} {})", v.x, v.y, v.z));
    });
    table.set(1004, "putnull", [this](Vm& vm) { add(vm.parm_string_id(0) == StringId::kNull ? "null" : "text"); });
    table.set(1003, "pute", [this](Vm& vm) { add(fmt::format("e{}", index(vm.parm_entity(0)))); });
  }
  std::string output_;
};

}  // namespace fb::progs::testing
