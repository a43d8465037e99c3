// QuakeC instructions a second, on the kinds of code that mods are made of. Without fteqcc there is nothing to run.
#include <benchmark/benchmark.h>

#include "progs/builtins/builtins.h"
#include "progs/test_compile.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

constexpr const char* kSource = R"(
entity() spawn = #14;
float(vector v) vlen = #12;
.entity next_one;
.float count;
.string kind;
entity first;

void() setup = {
  local float i;
  local entity e;
  for (i = 0; i < 500; i = i + 1) {
    e = spawn();
    e.next_one = first;
    e.kind = "monster";
    e.velocity = '1 2 3';
    first = e;
  }
};
void() arithmetic = {
  local float i, sum;
  for (i = 0; i < 100000; i = i + 1) sum = sum + i * 0.5 - (i & 3);
  self.count = sum;
};
float(float n) fib = { if (n < 2) return n; return fib(n - 1) + fib(n - 2); };
void() calls = { fib(20); };
void() entities = {
  local entity e;
  local float rounds;
  for (rounds = 0; rounds < 40; rounds = rounds + 1) {
    for (e = first; e != world; e = e.next_one) {
      e.origin = e.origin + e.velocity * 0.1;
      if (e.origin_z > 100) e.count = e.count + 1;
    }
  }
};
void() strings = {
  local entity e;
  local float rounds, n;
  for (rounds = 0; rounds < 40; rounds = rounds + 1) {
    for (e = first; e != world; e = e.next_one) {
      if (e.kind == "player") n = n + 1;
      else if (e.kind == "monster") n = n + 2;
    }
  }
  self.count = n;
};
void() vectors = {
  local vector v, w;
  local float i;
  for (i = 0; i < 30000; i = i + 1) {
    w = v * 0.5 + '0 1 1';
    v = w - v * (v * w) * 0.01 + '1 0 0';
  }
  self.origin = v;
};
void() builtins = {
  local float i, n;
  for (i = 0; i < 30000; i = i + 1) n = n + vlen('3 4 0');
  self.count = n;
};
)";

std::unique_ptr<Vm> make_vm() {
  const testing::Compiled compiled = testing::compile(kSource, "-O2");
  if (compiled.progs.empty()) return nullptr;
  auto program = load_program(compiled.progs, "progs.dat");
  if (!program) return nullptr;
  VmOptions options;
  options.max_edicts = 1024;
  auto vm = Vm::create(std::make_shared<Program>(std::move(program).value()), standard_builtins({}), options);
  if (!vm) return nullptr;
  (*vm)->edicts().start_level(1);
  (*vm)->set(globals::self, EdictId{1});
  return std::move(vm).value();
}

void run(benchmark::State& state, const char* function) {
  const std::unique_ptr<Vm> vm = make_vm();
  if (!vm) {
    state.SkipWithError("no fteqcc (Linux/install-deps.sh test)");
    return;
  }
  (void)vm->execute(vm->program().find_function("setup"));
  const FunctionId id = vm->program().find_function(function);
  const std::int64_t before = vm->statements_executed();
  for (auto _ : state) {
    if (const Status status = vm->execute(id); !status) {
      state.SkipWithError(status.error().message.c_str());
      return;
    }
  }
  state.SetItemsProcessed(vm->statements_executed() - before);
}

BENCHMARK_CAPTURE(run, arithmetic, "arithmetic");
BENCHMARK_CAPTURE(run, calls, "calls");
BENCHMARK_CAPTURE(run, entities, "entities");
BENCHMARK_CAPTURE(run, strings, "strings");
BENCHMARK_CAPTURE(run, vectors, "vectors");
BENCHMARK_CAPTURE(run, builtins, "builtins");

}  // namespace
}  // namespace fb::progs
