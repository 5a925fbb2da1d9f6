#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/base/message.h"
#include "cli/figures/draw.h"
#include "cli/figures/overlay.h"
#include "cli/link/connect.h"
#include "cli/link/find_job.h"
#include "cli/link/job_source.h"
#include "cli/text/comparison/comparison_data.h"
#include "cli/text/comparison/render_comparison.h"
#include "cli/text/print_job.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> jobs;
  Tolerance tolerance;
  std::string format;
  std::string plot;  // File to draw the runs to.
  std::vector<std::string> channels;
};

// The settings with the format of --format, an older flag that wins over -o.
Settings WithFormat(const CompareArguments& arguments, Settings settings) {
  if (!arguments.format.empty()) settings.SetOutput(arguments.format);
  settings.RequireOutput(
      {OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv, OutputFormat::kLatex});
  return settings;
}

void DrawRuns(const CompareArguments& arguments, const Settings& settings) {
  Client client = Connect(settings);
  std::vector<Recording> runs;
  for (const std::string& job : arguments.jobs) {
    if (std::filesystem::is_regular_file(job)) {
      throw Failure(ExitCode::kUsage, fmt::format("--plot: {} is a file without trajectory", job));
    }
    runs.push_back(ReadRecording(client, FindJob(client, job), settings));
  }
  Draw(OverlayFigure(runs, arguments.channels), FormatOfFigure(arguments.plot), arguments.plot);
  Tell("{}\n", arguments.plot);
}

// The runs of these jobs or files. Throws Failure (kUsage) if one is a sweep.
std::vector<v1::Job> ReadRuns(const std::vector<std::string>& names, const Settings& settings) {
  std::vector<v1::Job> runs;
  JobSource source(settings);
  for (const std::string& name : names) {
    runs.push_back(source.Get(name));
    if (runs.back().has_sweep()) {
      throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep, not a run", name));
    }
  }
  return runs;
}

void Print(const JobComparison& comparison, const Settings& settings) {
  switch (settings.output) {
    case OutputFormat::kJson:
      return PrintJson(ComparisonJson(comparison), settings);
    case OutputFormat::kCsv:
      return fmt::print("{}", ComparisonCsv(comparison));
    case OutputFormat::kLatex:
      return fmt::print("{}", ComparisonLatex(comparison));
    default:
      return fmt::print("{}", RenderComparison(comparison, settings.OutputStyle()));
  }
}

ExitCode CompareJobs(const CompareArguments& arguments, const Settings& global) {
  const Settings settings = WithFormat(arguments, global);
  if (!arguments.plot.empty()) FormatOfFigure(arguments.plot);  // Refused before anything is read.
  const std::vector<v1::Job> runs = ReadRuns(arguments.jobs, settings);
  if (!arguments.plot.empty()) DrawRuns(arguments, settings);
  const JobComparison comparison = Compare(runs, arguments.tolerance);
  Print(comparison, settings);
  return comparison.Holds() ? ExitCode::kOk : ExitCode::kDiffers;
}

void AddTolerance(CLI::App& command, Tolerance* tolerance) {
  const auto add = [&command](const char* name, double* value, const char* about) {
    command.add_option(name, *value, about)->check(AtLeast(0))->capture_default_str();
  };
  add("--abs", &tolerance->absolute, "Deviation that does not matter");
  add("--rel", &tolerance->relative, "The same relative to the baseline; the larger one counts");
}

}  // namespace

void AddCompare(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<CompareArguments>();
  AddOption(line, command, "JOB", &arguments->jobs, ValueKind::kJob,
            "Two or more: IDs, or files with what describe -o json printed; the first is the "
            "baseline")
      ->required()
      ->expected(2, 1000);
  AddTolerance(command, &arguments->tolerance);
  AddOption(line, command, "--format", &arguments->format,
            {"table", "json", "yaml", "csv", "latex"}, "The same as -o")
      ->type_name("FORMAT");
  AddOption(line, command, "--plot", &arguments->plot, ValueKind::kFile,
            "Draw the runs over each other to this file too: .svg, .png, .pdf, .txt, .tex, .gp or "
            ".csv");
  AddListOption(line, command, "--channels", &arguments->channels, ValueKind::kChannel,
                "What --plot draws, such as B1.velocity. Default: the contact forces");
  line.SetAction(command, arguments, CompareJobs);
}

}  // namespace contact::cli
