#include "cli/verbs/verbs.h"

#include <algorithm>
#include <string>

namespace contact::cli {

const std::vector<Verb>& Verbs() {
  constexpr bool kNoSettings = false;
  static const std::vector<Verb> kVerbs = {
      {"run", "Submit a scenario, watch it, show its result", AddRun},
      {"submit", "Submit a scenario and leave", AddSubmit},
      {"watch", "Show all events of a job, from its start to its end", AddWatch},
      {"wait", "Wait for the end of a job", AddWait},
      {"list", "List jobs, newest first", AddList},
      {"describe", "Show a job with its ledger (also: result)", AddDescribe},
      {"cancel", "Ask a job to stop; what it recorded is kept", AddCancel},
      {"delete", "Remove an ended job and its events", AddDelete},
      {"artifact", "List and fetch the files that an ended job leaves", AddArtifact},
      {"export",
       "Write what a job recorded, once it has ended: -o csv, jsonl, netcdf, mat or protobuf",
       AddExport},
      {"plot", "Draw a job that has ended, through gnuplot: -o svg, png, pdf, txt, tikz, gp or csv",
       AddPlot},
      {"compare", "Show where runs differ: parameters, then results; exit code 8 if these do",
       AddCompare},
      {"report", "Write one page about ended runs: ledgers, figures, balances, how to repeat them",
       AddReport},
      {"validate", "Check a scenario or sweep file, without a server", AddValidate},
      {"init", "Write an example scenario or sweep to start from", AddInit},
      {"schema", "Print the JSON Schema of a scenario file, for editors", AddSchema, kNoSettings},
      {"series", "Print the recorded motion of a job", AddSeries},
      {"sweep", "Solve a scenario for many values of its fields", AddSweep},
      {"version", "Show the version of contactctl", AddVersion, kNoSettings},
      {"server", "Show the state of the server, back up its data", AddServer},
      {"paper", "Make the paper's figures and tables again, each number beside the published one",
       AddPaper},
      {"model", "Show and compare damping laws", AddModel},
      {"config", "Show and change the settings of contactctl", AddConfig, kNoSettings},
      {"completion", "Print the completion script of a shell", AddCompletion, kNoSettings},
      {"dev", "Start a private server to try things; dev -- CMD… runs one command with it", AddDev},
      {"doctor", "Check the installation and say how to repair what is wrong", AddDoctor,
       kNoSettings},
      {"help", "Show the help of a command, or a tutorial", AddHelp, kNoSettings}};
  return kVerbs;
}

void AddVerbs(CommandLine& line) {
  for (const Verb& verb : Verbs()) {
    verb.add(line, *line.app().add_subcommand(std::string(verb.name), std::string(verb.about)));
  }
}

bool NeedsSettings(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (chosen.empty()) return true;
  const auto verb = std::ranges::find(Verbs(), chosen.front()->get_name(), &Verb::name);
  return verb == Verbs().end() || verb->needs_settings;
}

}  // namespace contact::cli
