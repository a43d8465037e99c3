// What a frame costs before it does anything: a submission and the wait for it, a dispatch, a barrier, a timestamp; and
// what a staged copy moves.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "gpu/commands.h"
#include "gpu/device.h"
#include "test_arithmetic.spv.h"

namespace fb::gpu {
namespace {

Device* device(benchmark::State& state) {
  static Result<std::unique_ptr<Device>> made = Device::create({});
  if (!made) {
    state.SkipWithError(made.error().message.c_str());
    return nullptr;
  }
  return made->get();
}

void empty_run(benchmark::State& state) {
  Device* d = device(state);
  if (!d) return;
  for (auto _ : state) d->run([](Commands&) {});
}
BENCHMARK(empty_run)->Unit(benchmark::kMicrosecond)->UseRealTime();

// Dispatches of one workgroup that ends at once (its uniform count is 0), each in its own timed scope.
void empty_dispatches(benchmark::State& state) {
  Device* d = device(state);
  if (!d) return;
  const auto dispatches = static_cast<std::uint32_t>(state.range(0));
  const bool timed = state.range(1) != 0;
  BindingTable table(*d);
  Buffer factors(*d, BufferUse::kUniform, 16, "factors");
  const std::vector<std::uint32_t> zeros(4);
  upload_now(*d, factors, std::span<const std::uint32_t>(zeros));
  table.set_uniform(shared::kSetScene, factors);
  const ComputePipeline pipeline(*d, table, test_arithmetic_spv, "arithmetic");
  PassTimer timer(*d, dispatches);
  for (auto _ : state) {
    d->run([&](Commands& commands) {
      if (timed) {
        timer.reset(commands.handle());
        commands.set_timer(&timer);
      }
      commands.bind(table);
      for (std::uint32_t i = 0; i < dispatches; ++i) {
        Commands::Scope scope(commands, "empty");
        commands.dispatch(pipeline, 1);
        commands.barrier();
      }
    });
    if (timed) benchmark::DoNotOptimize(timer.read());
  }
}
BENCHMARK(empty_dispatches)
    ->ArgNames({"dispatches", "timed"})
    ->Args({1, 0})
    ->Args({10, 0})
    ->Args({10, 1})
    ->Args({50, 0})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

void upload(benchmark::State& state) {
  Device* d = device(state);
  if (!d) return;
  const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(state.range(0)));
  Buffer target(*d, BufferUse::kStorage, bytes.size(), "target");
  for (auto _ : state) upload_now(*d, target, bytes.data(), bytes.size());
  state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(upload)->Arg(4096)->Arg(32 << 20)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
}  // namespace fb::gpu
