// fullbright-lab compare: pictures held to a reference.
#include <fmt/format.h>

#include "host/lab_numbers.h"
#include "host/lab_stage.h"
#include "lab/compare_job.h"

namespace fb::host {
namespace {

struct CompareOptions {
  lab::CompareJob job;
  std::string json, csv;
  bool no_flip = false;
};

int run_compare(CompareOptions& options) {
  options.job.flip = !options.no_flip;
  const auto comparison = lab::compare(options.job);
  if (!comparison) return fail(comparison.error());
  if (options.json != "-" && options.csv != "-") fmt::print("{}", lab::comparison_table(*comparison));
  if (!options.json.empty()) {
    if (auto status = write_text(options.json, lab::comparison_json(*comparison)); !status) return fail(status.error());
  }
  if (!options.csv.empty()) {
    if (auto status = write_text(options.csv, lab::comparison_csv(*comparison)); !status) return fail(status.error());
  }
  return 0;
}

}  // namespace

LabCommand add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  lab::CompareJob& job = options->job;
  CLI::App* compare = app.add_subcommand(
      "compare",
      "errors of pictures against a reference: EXR files in linear radiance, PNG files as stored. Several TESTs are "
      "runs of the same thing: mean and 95% intervals");
  compare->add_option("REFERENCE", job.reference, "EXR or PNG; an EXR of `reference` says its own variance")
      ->required();
  compare->add_option("TEST", job.tests, "pictures of the same kind and size")->required();
  add_number(*compare, "--epsilon", job.metrics.epsilon, 1e-30, 1e30, "added to r^2 in relMSE and to |r| in MAPE");
  add_number(*compare, "--ppd", job.pixels_per_degree, 1.0, 1000.0, "pixels a degree of the FLIP observer");
  add_number(*compare, "--exposure", job.exposure, -100.0, 100.0,
             "stops at which LDR-FLIP looks at EXR files (HDR-FLIP chooses its own)");
  compare->add_option("--flip-map", job.flip_map, "PNG of FLIP per pixel, black 0 to white 1 (of one TEST)");
  compare->add_flag("--no-flip", options->no_flip, "leave FLIP out: it takes most of the time");
  compare->add_option("--json", options->json, "write JSON to this file; - is standard output, without the table");
  compare->add_option("--csv", options->csv, "write CSV, a line a file, to this file; - is standard output");
  return {compare, [options] { return run_compare(*options); }};
}

}  // namespace fb::host
