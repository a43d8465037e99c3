// fullbright-lab compare: error of pictures against a reference.
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/compare/compare_job.h"

namespace fb::host {
namespace {

struct CompareOptions {
  lab::CompareJob job;
  std::string json, csv;
  std::vector<std::string> former;
  bool no_flip = false;
};

// Outputs must not take the place of what is compared.
Status check_outputs(const CompareOptions& options) {
  std::vector<std::string> inputs = options.job.tests;
  inputs.push_back(options.job.reference);
  inputs.insert(inputs.end(), options.former.begin(), options.former.end());
  for (const std::string& output : {options.json, options.csv, options.job.flip_map})
    for (const std::string& input : inputs) {
      std::error_code ignored;
      if (!output.empty() && std::filesystem::equivalent(output, input, ignored))
        return Error{fmt::format("{}: it is compared, so nothing is written over it", output)};
    }
  return ok_status();
}

int run_compare(CompareOptions& options) {
  if (auto status = check_outputs(options); !status) return fail(status.error());
  options.job.flip = !options.no_flip;
  if (!options.former.empty()) {
    options.job.former_reference = options.former[0];
    options.job.former_test = options.former[1];
  }
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
  CLI::App* compare = app.add_subcommand("compare",
                                         "measures the error of pictures against a reference: EXR files in linear "
                                         "radiance, PNG files as stored. Several TESTs "
                                         "are taken as runs of the same rendering, and give means and 95% intervals");
  compare->add_option("REFERENCE", job.reference, "EXR or PNG; an EXR made by `reference` includes its own variance")
      ->required();
  compare->add_option("TEST", job.tests, "pictures of the reference's format and size")->required();
  add_number(*compare, "--epsilon", job.metrics.epsilon, 1e-30, 1e30,
             "added to the denominators: r^2 in relMSE, |r| in MAPE");
  add_number(*compare, "--ppd", job.pixels_per_degree, 1.0, 1000.0, "pixels per degree of FLIP's observer");
  add_number(*compare, "--exposure", job.exposure, -100.0, 100.0,
             "exposure of EXR files for LDR-FLIP, stops (HDR-FLIP chooses its own)");
  add_number(*compare, "--peak", job.metrics.peak, 0.0, 1e30,
             "largest value, for PSNR; 0: 1 for PNG, the reference's largest channel for EXR");
  compare
      ->add_option("--former", options->former,
                   "the frame before: its reference and its TEST (EXR); adds flicker. Both references hold motion, as "
                   "those that `picture` keeps do")
      ->expected(2);
  compare->add_option("--flip-map", job.flip_map,
                      "write FLIP per pixel to this PNG, black 0 to white 1 (one TEST only)");
  compare->add_flag("--no-flip", options->no_flip, "do not compute FLIP, which takes most of the time");
  compare->add_option("--json", options->json, "write JSON to this file; - is standard output, and omits the table");
  compare->add_option("--csv", options->csv, "write CSV, one line per picture, to this file; - is standard output");
  return {compare, [options] { return run_compare(*options); }};
}

}  // namespace fb::host
