#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/drawing.h"
#include "cli/presets.h"
#include "cli/run_report.h"
#include "cli/text_file.h"

namespace contact::cli {
namespace {

struct ReportArguments {
  std::vector<std::string> jobs;
  std::string file = "report.html";
};

// Presets that a run has nothing for are left out, and all of them without gnuplot.
std::vector<std::string> DrawAll(const Recording& recording) {
  // So many that no peak and no corner is lost, and a page stays small however long the run.
  constexpr std::size_t kPoints = 1000;
  std::vector<std::string> figures;
  for (const std::string& preset : PresetNames()) {
    Figure figure;
    try {
      figure = DrawPreset(preset, recording);
    } catch (const Failure&) {
      continue;
    }
    Thin(kPoints, &figure);
    figure.title = preset;
    figures.push_back(DrawInline(figure));
  }
  return figures;
}

ExitCode Report(const ReportArguments& arguments, const Settings& settings) {
  settings.RequireOutput({"table"});
  Client client = settings.Connect();
  std::vector<RunPart> runs;
  std::string note;
  for (const std::string& job : arguments.jobs) {
    Recording recording = ReadRecording(client, job, settings);
    if (recording.job.has_sweep()) {
      throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep; see sweep export", job));
    }
    RunPart part;
    try {
      part.figures = DrawAll(recording);
    } catch (const Failure& failure) {
      note = failure.what();
    }
    part.recording = std::move(recording);
    part.recording.columns.clear();  // The figures have what is shown of them.
    runs.push_back(std::move(part));
  }
  const std::string page = ReportPage(runs, client.server());
  WriteText(page, arguments.file);
  if (!note.empty()) fmt::print(stderr, "figures are not drawn: {}\n", note);
  fmt::print(stderr, "{}  {} kB, opens offline\n", arguments.file, (page.size() + 999) / 1000);
  return ExitCode::kOk;
}

}  // namespace

void AddReportCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Write one page about ended runs: ledgers, figures, balances, how to repeat them");
  command->add_option("JOB", arguments->jobs, "One or more IDs; the first is the baseline")
      ->required();
  command->add_option("-o,--file", arguments->file, "Where to")
      ->type_name("FILE")
      ->capture_default_str();
  command->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Report(*arguments, settings); };
  });
}

}  // namespace contact::cli
