#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/job/figure_file.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/plot_options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct PlotArguments {
  std::string job;
  std::string preset;
  std::string file;
  const CLI::App* command = nullptr;
};

void RequireOneSubject(const PlotArguments& arguments) {
  const bool channels = arguments.command->get_option("--channels")->count() > 0;
  if (arguments.preset.empty() == channels) return;
  throw Failure(
      ExitCode::kUsage,
      arguments.preset.empty()
          ? fmt::format("say what to draw: {}, or --channels", fmt::join(PresetNames(), ", "))
          : "PRESET and --channels do not go together: either says what to draw");
}

ExitCode Plot(const PlotArguments& arguments, const Settings& settings) {
  RequireOneSubject(arguments);
  const std::string& preset = arguments.preset;
  std::vector<std::string> words = {"plot"};
  const auto add = [&words](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(FigureWords(arguments.file, preset.empty() ? "channels" : preset, settings));
  add(GivenFlags(*arguments.command, {"--channels", "--keep"}));
  add(GivenPlotOptions(*arguments.command));
  Client client = Connect(settings);
  add({"--", FindJob(client, arguments.job)});
  if (!preset.empty()) words.push_back(preset);
  BecomeContactsim(words, settings);
}

}  // namespace

void AddPlot(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<PlotArguments>();
  arguments->command = &command;
  AddJob(line, command, &arguments->job);
  AddOption(line, command, "PRESET", &arguments->preset, PresetNames(), "What to draw")
      ->type_name("");
  AddFigureFile(line, command, &arguments->file, "Where to. Default: PRESET.svg; txt is printed");
  CLI::Option* channels = command.add_option("--channels")
                              ->description(
                                  "Instead of PRESET: these channels over time, such as "
                                  "B1.velocity, a panel for each quantity")
                              ->delimiter(',');
  Repeatable(line.SetKind(channels, ValueKind::kChannel));
  AddPlotOptions(line, command);
  line.SetKind(command.add_option("--keep")->description(
                   "Keep the data as CSV in this folder, and a script that draws them"),
               ValueKind::kDirectory);
  line.SetAction(command, arguments, Plot);
}

}  // namespace contact::cli
