#include "cli/verbs/plot_options.h"

#include "cli/verbs/job/options.h"

namespace contact::cli {
namespace {

// A flag whose values go to contactsim as they are typed.
CLI::Option* Add(CLI::App& command, const std::string& name, const std::string& about) {
  return command.add_option(name)->description(about);
}

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

void AddLook(CommandLine& line, CLI::App& command) {
  CLI::Option* style = Add(command, "--style",
                           "colour, or paper for print: black lines told apart by dashes, a "
                           "column of 3.4 in, no title and no line below");
  line.SetWords(style, {"colour", "paper"})->type_name("STYLE")->default_str("colour");
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

const std::vector<std::string>& PresetNames() {
  static const std::vector<std::string> names = {
      "position",     "displacement",    "velocity",
      "acceleration", "force",           "deformation-velocity",
      "hysteresis",   "restitution",     "iterations",
      "energy",       "supports",        "force-map",
      "velocity-map", "force-waterfall", "velocity-waterfall"};
  return names;
}

void AddPlotOptions(CommandLine& line, CLI::App& command) {
  AddPart(line, command);
  AddLook(line, command);
}

std::vector<std::string> GivenPlotOptions(const CLI::App& command) {
  return GivenFlags(command, {"--contacts", "--from", "--to", "--style", "--size", "--font",
                              "--unit", "--log", "--no-title", "--no-provenance"});
}

}  // namespace contact::cli
