#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/base/message.h"
#include "cli/input/measured.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"
#include "cli/text/comparison/render_comparison.h"
#include "cli/text/print_job.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/measured_comparison.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> jobs;
  Tolerance tolerance;
  std::string format;
  std::string plot;  // File to draw the runs to.
  std::vector<std::string> channels;
  MeasuredComparison measured;
  const CLI::Option* absolute = nullptr;  // --abs
  const CLI::Option* relative = nullptr;  // --rel
};

// The settings with the format of --format, an older flag that wins over -o.
Settings WithFormat(const CompareArguments& arguments, Settings settings) {
  if (!arguments.format.empty()) settings.SetOutput(arguments.format);
  settings.RequireOutput(
      {OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv, OutputFormat::kLatex});
  return settings;
}

void DrawRuns(const CompareArguments& arguments, const Settings& settings) {
  std::vector<std::string> words = {"overlay", "--file=" + arguments.plot};
  for (const std::string& channel : arguments.channels) words.push_back("--channels=" + channel);
  words.emplace_back("--");
  Client client = Connect(settings);
  for (const std::string& job : arguments.jobs) {
    if (std::filesystem::is_regular_file(job)) {
      throw Failure(ExitCode::kUsage, fmt::format("--plot: {} is a file without trajectory", job));
    }
    words.push_back(FindJob(client, job));
  }
  RunContactsim(words, settings);
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

// What --abs and --rel allow of measured data, whose digits are fewer.
SignalTolerance ToleranceOfSignals(const CompareArguments& arguments) {
  SignalTolerance tolerance;
  if (arguments.absolute->count() > 0) tolerance.absolute = arguments.tolerance.absolute;
  if (arguments.relative->count() > 0) tolerance.relative = arguments.tolerance.relative;
  return tolerance;
}

ExitCode CompareMeasured(const CompareArguments& arguments, const Settings& settings) {
  const bool swapped = IsTable(arguments.jobs.front());
  const std::string& file = swapped ? arguments.jobs.front() : arguments.jobs.back();
  const std::string& job = swapped ? arguments.jobs.back() : arguments.jobs.front();
  if (arguments.jobs.size() != 2 || IsTable(job)) {
    throw Failure(ExitCode::kUsage, "a file of measured data is compared with one job");
  }
  if (!arguments.channels.empty()) {
    throw Failure(ExitCode::kUsage, "--channels: measured data has its channels in its headers");
  }
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv});
  return arguments.measured.Run(job, file, ToleranceOfSignals(arguments), arguments.plot, settings);
}

ExitCode CompareJobs(const CompareArguments& arguments, const Settings& global) {
  const Settings settings = WithFormat(arguments, global);
  if (arguments.jobs.size() < 2) {
    throw Failure(
        ExitCode::kUsage,
        "give two jobs or more, the baseline first, or a job and a table of measured data");
  }
  if (!arguments.plot.empty()) FormatOfFigure(arguments.plot);  // Refused before anything is read.
  if (std::ranges::any_of(arguments.jobs, IsTable)) return CompareMeasured(arguments, settings);
  if (const std::string flag = arguments.measured.GivenFlag(); !flag.empty()) {
    throw Failure(ExitCode::kUsage, fmt::format("{} goes with a file of measured data", flag));
  }
  const std::vector<v1::Job> runs = ReadRuns(arguments.jobs, settings);
  if (!arguments.plot.empty()) DrawRuns(arguments, settings);
  const JobComparison comparison = Compare(runs, arguments.tolerance);
  Print(comparison, settings);
  return comparison.Holds() ? ExitCode::kOk : ExitCode::kDiffers;
}

void AddTolerance(CLI::App& command, CompareArguments* arguments) {
  const auto add = [&command](const char* name, double* value, const char* about) {
    return command.add_option(name, *value, about)->check(AtLeast(0))->capture_default_str();
  };
  arguments->absolute =
      add("--abs", &arguments->tolerance.absolute,
          "Deviation that does not matter; with measured data 0 if it is not given");
  arguments->relative = add("--rel", &arguments->tolerance.relative,
                            "The same relative to the baseline, with measured data to the peak, "
                            "then 0.05 if it is not given; the larger one counts");
}

}  // namespace

void AddCompare(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<CompareArguments>();
  AddOption(line, command, "JOB", &arguments->jobs, ValueKind::kJob,
            "Two or more: IDs, or files with what describe -o json printed; the first is the "
            "baseline. Or one ID and a table of measured data, such as measured.csv")
      ->required()
      ->expected(1, 1000);
  AddTolerance(command, arguments.get());
  arguments->measured.AddTo(command);
  AddOption(line, command, "--format", &arguments->format,
            {"table", "json", "yaml", "csv", "latex"}, "The same as -o")
      ->type_name("FORMAT");
  AddOption(line, command, "--plot", &arguments->plot, ValueKind::kFile,
            "Draw the runs over each other to this file too: .svg, .png, .pdf, .eps, .pgf, .txt or "
            ".csv");
  AddListOption(line, command, "--channels", &arguments->channels, ValueKind::kChannel,
                "What --plot draws, such as B1.velocity. Default: the contact forces");
  line.SetAction(command, arguments, CompareJobs);
}

}  // namespace contact::cli
