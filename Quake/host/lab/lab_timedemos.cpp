// fullbright-lab timedemos: two files of scr_timedemo_json compared.
#include <fmt/format.h>

#include "host/lab/lab_stage.h"
#include "lab/timedemo/timedemo.h"

namespace fb::host {
namespace {

struct TimedemosOptions {
  std::string a, b, json;
};

int run_timedemos(const TimedemosOptions& o) {
  const auto a = lab::read_timedemos(o.a);
  if (!a) return fail(a.error());
  const auto b = lab::read_timedemos(o.b);
  if (!b) return fail(b.error());
  const auto comparison = lab::compare_timedemos(*a, o.a, *b, o.b);
  if (!comparison) return fail(comparison.error());
  if (o.json != "-") fmt::print("{}", lab::comparison_table(*comparison));
  if (o.json.empty()) return 0;
  const Status status = write_text(o.json, lab::comparison_json(*comparison));
  return status ? 0 : fail(status.error());
}

}  // namespace

LabCommand add_timedemos_command(CLI::App& app) {
  auto options = std::make_shared<TimedemosOptions>();
  CLI::App* command =
      app.add_subcommand("timedemos",
                         "compares two files of the game's scr_timedemo_json, of two builds, devices or "
                         "settings: how many times as fast the second is, with 95% intervals");
  command->add_option("A", options->a, "a file of scr_timedemo_json")->required();
  command->add_option("B", options->b, "another, of the same demos at the same size")->required();
  command->add_option("--json", options->json, "write JSON to this file; - is standard output, and omits the table");
  return {command, [options] { return run_timedemos(*options); }};
}

}  // namespace fb::host
