// fullbright-lab: render | render-merge | reference | reference-merge | export | compare | ztest | bench | iterate |
// still | picture | suite | suite-merge | report | film | timedemos | authored | track | estimators | settings |
// commands.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "base/stop.h"
#include "base/system.h"
#include "host/guarded_main.h"
#include "host/lab/lab_stage.h"
#include "host/options.h"

namespace {

// An option that is given more often than it may be; empty if none is. CLI11's own sentence counts requirements.
std::string given_too_often(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->count() > static_cast<std::size_t>(option->get_items_expected_max()))
      return fmt::format("{}: it is given {} times and counts once", option->get_name(), option->count());
  for (const CLI::App* command : app.get_subcommands())
    if (std::string found = given_too_often(*command); !found.empty()) return found;
  return {};
}

int run(const std::vector<std::string>& arguments) {
  using namespace fb::host;
  fb::stop_on_signals("fullbright-lab", fb::StopMode::kAtOnce);
  CLI::App app("Renders and measures without a window: frames, references, errors, speed and bias.", "fullbright-lab");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  const std::string command_line = fmt::format("{}", fmt::join(arguments, " "));
  const LabCommand commands[] = {add_render_command(app),
                                 add_render_merge_command(app),
                                 add_reference_command(app),
                                 add_reference_merge_command(app),
                                 add_export_command(app),
                                 add_compare_command(app),
                                 add_ztest_command(app),
                                 add_bench_command(app, command_line),
                                 add_iterate_command(app, command_line),
                                 add_still_command(app),
                                 add_picture_command(app, command_line),
                                 add_suite_command(app),
                                 add_suite_merge_command(app),
                                 add_report_command(app),
                                 add_film_command(app),
                                 add_timedemos_command(app),
                                 add_authored_command(app),
                                 add_track_command(app),
                                 add_estimators_command(app),
                                 add_settings_command(app),
                                 add_commands_command(app)};
  std::vector<const char*> words;
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string often = given_too_often(app);
    if (often.empty()) return app.exit(error);
    fmt::print(stderr, "fullbright-lab: {}\n", often);
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  for (const LabCommand& command : commands)
    if (*command.app) return command.run();
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  return fb::host::guarded_main("fullbright-lab", [&] { return run(fb::program_arguments(argc, argv)); });
}
