// fullbright-lab report: a suite's results as a page, by the Python package beside the program.
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "host/lab/lab_stage.h"
#include "lab/judge/program.h"
#include "platform/program_directory.h"

namespace fb::host {
namespace {

// Beside the program in a build, in share/ of an installation.
Result<std::string> package_folder() {
  const std::filesystem::path here = platform::program_directory();
  std::error_code ignored;
  for (const auto& folder : {here / "python", here / ".." / "share" / "fullbright" / "python"})
    if (std::filesystem::is_directory(folder / "fullbright_lab", ignored)) return folder.string();
  return Error{fmt::format("report: the Python package fullbright_lab is not beside the program ({})", here.string())};
}

// A Python that has what figures are drawn with.
Result<std::string> python() {
  for (const char* program : {"python3", "/usr/bin/python3"}) {
    const auto tried = lab::run_program({program, "-c", "import numpy, matplotlib"});
    if (tried && tried->status == 0) return std::string(program);
  }
  return Error{
      "report: Python with numpy and matplotlib is wanted; on Debian: apt-get install python3-numpy "
      "python3-matplotlib"};
}

int run_report(const std::string& folder, const std::string& out) {
  const auto package = package_folder();
  if (!package) return fail(package.error());
  const auto interpreter = python();
  if (!interpreter) return fail(interpreter.error());
  std::vector<std::string> command{"env", "PYTHONPATH=" + *package, *interpreter,
                                   "-m",  "fullbright_lab.report",  folder};
  command.insert(command.end(), {"--lab", (platform::program_directory() / "fullbright-lab").string()});
  if (!out.empty()) command.insert(command.end(), {"--out", out});
  const auto end = lab::run_program(command);
  if (!end) return fail(end.error());
  fmt::print(end->status == 0 ? stdout : stderr, "{}", end->output);
  return end->status;
}

}  // namespace

LabCommand add_report_command(CLI::App& app) {
  auto folder = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "report", "writes a suite's results as one HTML page that needs nothing else: figures, tables, pictures");
  command->add_option("DIR", *folder, "the folder that `suite` wrote")->required();
  command->add_option("--out", *out, "the page; default: report.html in DIR");
  return {command, [folder, out] { return run_report(*folder, *out); }};
}

}  // namespace fb::host
