#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/command_line.h"
#include "cli/settings/options.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct PlotArguments {
  std::string job;
  std::vector<std::string> presets;
  std::string file;
  const CLI::App* command = nullptr;
};

// The figures that can be made of a run.
const std::vector<std::string>& PresetNames() {
  static const std::vector<std::string> names = {
      "position",     "displacement",    "velocity",
      "acceleration", "force",           "deformation-velocity",
      "hysteresis",   "restitution",     "iterations",
      "energy",       "supports",        "force-map",
      "velocity-map", "force-waterfall", "velocity-waterfall"};
  return names;
}

void RequireOneSubject(const PlotArguments& arguments) {
  const bool channels = arguments.command->get_option("--channels")->count() > 0;
  if (arguments.presets.empty() == channels) return;
  throw Failure(
      ExitCode::kUsage,
      arguments.presets.empty()
          ? fmt::format("say what to draw: {}, or --channels", fmt::join(PresetNames(), ", "))
          : "PRESET and --channels do not go together: either says what to draw");
}

ExitCode Plot(const PlotArguments& arguments, const Settings& settings) {
  RequireOneSubject(arguments);
  const std::string name = fmt::format("{}", fmt::join(arguments.presets, "-"));
  std::vector<std::string> words = {"plot"};
  const auto add = [&words](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(FigureWords(arguments.file, name.empty() ? "channels" : name, settings));
  add(GivenFlags(*arguments.command,
                 {"--channels", "--keep", "--contacts", "--from", "--to", "--style", "--size",
                  "--font", "--unit", "--log", "--no-title", "--no-provenance"}));
  Client client = Connect(settings);
  add({"--", FindJob(client, arguments.job)});
  add(arguments.presets);
  BecomeContactsim(words, settings);
}

// A flag whose values go to contactsim as they are typed.
CLI::Option* Add(CLI::App& command, const std::string& name, const std::string& about) {
  return command.add_option(name)->description(about);
}

// What part of a run a figure shows.
void AddPart(CommandLine& line, CLI::App& command) {
  CLI::Option* contacts =
      Add(command, "--contacts", "Only these contacts and their bodies")->delimiter(',');
  Repeatable(line.SetKind(contacts, ValueKind::kContact));
  Add(command, "--from",
      "Only from this simulated time on; for hysteresis, restitution and iterations the cycles "
      "that overlap the time window")
      ->check(CLI::Number)
      ->type_name("SECONDS");
  Add(command, "--to", "Only up to this simulated time")->check(CLI::Number)->type_name("SECONDS");
}

// How it looks.
void AddLook(CommandLine& line, CLI::App& command) {
  CLI::Option* style = Add(command, "--style",
                           "colour, or for print: paper, or the column and font of springer, "
                           "elsevier, ieee or aps; black lines told apart by dashes, no title and "
                           "no line below");
  line.SetWords(style, {"colour", "paper", "springer", "elsevier", "ieee", "aps"})
      ->type_name("STYLE")
      ->default_str("colour");
  Add(command, "--size",
      "Width and height, such as 85x60mm, 8.5x6cm or, in inches, 3.4x2.5. Default: 8x5in, and "
      "8x7in for two panels")
      ->type_name("WxH");
  Add(command, "--font",
      "Font and its size in points, such as Times,9; either may be left out. pgf has the font of "
      "the document")
      ->type_name("FONT");
  CLI::Option* units = Repeatable(
      Add(command, "--unit",
          "Units of the axes, such as ms,µm,kN,g; µ may be written u. Default: those that give few "
          "digits. csv has SI units without prefix")
          ->delimiter(','));
  line.SuggestWords(units,
                    {"s", "ms", "µs", "m", "mm", "µm", "N", "kN", "m/s", "mm/s", "g", "J", "mJ"})
      ->type_name("UNIT,…");
  command.add_flag("--log")->description(
      "A logarithmic y axis, on which values <= 0 have no place");
  command.add_flag("--no-title")->description("Leave out the title above the figure");
  command.add_flag("--no-provenance")
      ->description(
          "Leave out the line below that names job and server; the file holds it nevertheless, but "
          "for txt");
}

}  // namespace

void AddPlot(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<PlotArguments>();
  arguments->command = &command;
  AddJob(line, command, &arguments->job);
  line.SetWords(command.add_option("PRESET", arguments->presets,
                                   "What to draw; several are panels (a), (b), … of one figure"),
                PresetNames())
      ->type_name("");
  AddFigureFile(line, command, &arguments->file, "Where to. Default: PRESET.svg; txt is printed");
  CLI::Option* channels = Add(command, "--channels",
                              "Instead of PRESET: these channels over time, such as B1.velocity, a "
                              "panel for each quantity")
                              ->delimiter(',');
  Repeatable(line.SetKind(channels, ValueKind::kChannel));
  AddPart(line, command);
  AddLook(line, command);
  line.SetKind(
      Add(command, "--keep", "Keep the data as CSV in this folder, and a script that draws them"),
      ValueKind::kDirectory);
  line.SetAction(command, arguments, Plot);
}

}  // namespace contact::cli
