#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/figures/draw.h"
#include "cli/figures/overlay.h"
#include "cli/link/connect.h"
#include "cli/link/job_source.h"
#include "cli/text/comparison/comparison_data.h"
#include "cli/text/comparison/render_comparison.h"
#include "cli/text/render_yaml.h"
#include "cli/verbs/commands.h"

namespace contact::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> jobs;
  Tolerance tolerance;
  std::string format;
  std::string plot;  ///< File to draw the runs to.
  std::vector<std::string> channels;
};

std::string Format(const CompareArguments& arguments, const Settings& settings) {
  if (!arguments.format.empty()) return arguments.format;
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv});
  return settings.yaml ? "yaml" : std::string(NameOf(settings.output));
}

void DrawRuns(const CompareArguments& arguments, const Settings& settings) {
  Client client = Connect(settings);
  std::vector<Recording> runs;
  for (const std::string& job : arguments.jobs) {
    if (std::filesystem::is_regular_file(job)) {
      throw Failure(ExitCode::kUsage, fmt::format("--plot: {} is a file without trajectory", job));
    }
    runs.push_back(ReadRecording(client, job, settings));
  }
  Draw(OverlayFigure(runs, arguments.channels), FormatOfFigure(arguments.plot), arguments.plot);
  fmt::print(stderr, "{}\n", arguments.plot);
}

ExitCode CompareJobs(const CompareArguments& arguments, const Settings& settings) {
  const std::string format = Format(arguments, settings);
  std::vector<v1::Job> jobs;
  JobSource source(settings);
  for (const std::string& job : arguments.jobs) {
    jobs.push_back(source.Get(job));
    if (jobs.back().has_sweep()) {
      throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep, not a run", job));
    }
  }
  if (!arguments.plot.empty()) DrawRuns(arguments, settings);
  const JobComparison comparison = Compare(jobs, arguments.tolerance);
  if (format == "yaml") {
    fmt::print("{}", YamlOfJson(ComparisonJson(comparison)));
  } else if (format == "json") {
    fmt::print("{}", ComparisonJson(comparison));
  } else if (format == "csv") {
    fmt::print("{}", ComparisonCsv(comparison));
  } else if (format == "latex") {
    fmt::print("{}", ComparisonLatex(comparison));
  } else {
    fmt::print("{}", RenderComparison(comparison, settings.OutputStyle()));
  }
  return comparison.Holds() ? ExitCode::kOk : ExitCode::kDiffers;
}

}  // namespace

void AddCompareCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Show where runs differ: parameters, then results; exit code 8 if these do");
  command
      ->add_option("JOB", arguments->jobs,
                   "Two or more: IDs, or files with what describe -o json printed; the first is "
                   "the baseline")
      ->required()
      ->expected(2, 1000);
  command->add_option("--abs", arguments->tolerance.absolute, "Deviation that does not matter")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--rel", arguments->tolerance.relative,
                   "The same relative to the baseline; the larger one counts")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--format", arguments->format, "table, json, yaml, csv or latex, instead of -o")
      ->check(CLI::IsMember({"table", "json", "yaml", "csv", "latex"}))
      ->type_name("FORMAT");
  command
      ->add_option(
          "--plot", arguments->plot,
          "Draw the runs over each other to this file too: .svg, .png, .pdf, .txt, .tex, .gp "
          "or .csv")
      ->type_name("FILE");
  command
      ->add_option("--channels", arguments->channels,
                   "What --plot draws, such as B1.velocity. Default: the contact forces")
      ->delimiter(',')
      ->type_name("NAME,…");
  command->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return CompareJobs(*arguments, settings); };
  });
}

}  // namespace contact::cli
