#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/export/provenance.h"
#include "cli/input/grid_sweep.h"
#include "cli/input/sweep_file.h"
#include "cli/input/templates.h"
#include "cli/input/yaml_document.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/column_choice.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/text/sweep/render_sweep.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/job/submission.h"
#include "cli/verbs/sweep/cell_watcher.h"
#include "cli/verbs/sweep/heat_map_options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct SweepArguments {
  std::string file;
  std::string shipped;  // Name of a template, instead of a file.
  std::string job;
  std::vector<std::string> variables;  // --var
  Submission submission;
  HeatMapOptions map;
  std::string heat_map;  // File to draw it to.
  bool comments = false;
  std::vector<std::string> grid;        // Axes over a scenario, instead of a sweep file.
  int random = 0, latin_hypercube = 0;  // Cells to draw from the axes.
  std::int64_t seed = 0;
  bool cancel_on_interrupt = false;
  ColumnChoice columns;
};

// Throws Failure unless the sweep has the metric and the columns that are named, and can be drawn
// if that is asked for.
void CheckNames(const v1::Sweep& sweep, const SweepArguments& arguments, const Settings& settings) {
  arguments.map.MetricOf(sweep);
  if (!arguments.heat_map.empty()) arguments.map.RequireDrawable(sweep, arguments.heat_map);
  arguments.columns.Check(
      settings.output == OutputFormat::kCsv ? SweepCsvColumns(sweep) : SweepColumns(sweep),
      settings);
}

void Print(const v1::Job& job, const SweepCells& cells, const SweepArguments& arguments,
           const Settings& settings) {
  if (settings.output == OutputFormat::kCsv) {
    fmt::print("{}{}", arguments.comments ? CommentLines(SourceOf(job)) : "",
               SweepCsv(job.sweep(), cells, arguments.columns.names()));
  } else if (settings.output == OutputFormat::kJson) {
    PrintJson(SweepJson(job, cells), settings);
  } else if (settings.output == OutputFormat::kName) {
    fmt::print("{}\n", job.name());
  } else {
    const Style style = arguments.columns.OutputStyle(settings);
    fmt::print("{}{}", RenderSweep(job, cells, style),
               arguments.map.Text(job.sweep(), cells, style));
  }
}

// Follows a sweep to its end and prints all its cells.
ExitCode Follow(Client& client, const std::string& name, const SweepArguments& arguments,
                const Settings& settings) {
  const bool submitted = arguments.job.empty();
  v1::Job job = GetSweep(client, name);
  CheckNames(job.sweep(), arguments, settings);
  SweepCells cells;
  WatchEnd end = WatchEnd::kStopped;
  {
    const Interrupt interrupt;
    if (submitted && settings.output == OutputFormat::kTable) {
      Tell("{} submitted\n", name);
    }
    end = GatherCells(client, &job, settings, &cells);
  }
  if (end != WatchEnd::kFinished) {
    return submitted ? DetachOrCancel(client, end, name, arguments.cancel_on_interrupt, settings)
                     : Detach(end, name);
  }
  Print(job, cells, arguments, settings);
  if (!arguments.heat_map.empty()) arguments.map.Draw(job, arguments.heat_map, settings);
  return CodeOf(job);
}

// Throws Failure (kUsage) for a scenario without axes of --grid, and for a sweep with them.
void RequireAxesOnce(const std::string& text, const SweepArguments& arguments) {
  const bool grid = !arguments.grid.empty();
  if (!(grid ? IsSweep(text) : IsScenario(text))) return;
  const std::string name = arguments.shipped.empty() ? arguments.file : "-t " + arguments.shipped;
  throw Failure(
      ExitCode::kUsage,
      grid ? fmt::format("{} is a sweep, with axes of its own; --grid gives axes to a scenario",
                         name)
           : fmt::format("{0} is a scenario: `contactctl run {0}` solves it, `contactctl sweep run "
                         "{0} --grid FIELD=VALUES` many of it",
                         name));
}

// The sweep of a sweep file, or with --grid the scenario of the file with these axes.
v1::Sweep Open(const SweepArguments& arguments) {
  const VariableValues variables = ParseVariables(arguments.variables);
  const std::string& shipped = arguments.shipped;
  if (arguments.file.empty() == shipped.empty()) {
    throw Failure(ExitCode::kUsage, "give a FILE or --template NAME, one of them");
  }
  const std::string text =
      shipped.empty() ? ReadYaml(arguments.file) : std::string(FindTemplate(shipped).text);
  RequireAxesOnce(text, arguments);
  if (arguments.grid.empty()) {
    return ReadSweep(shipped + arguments.file, text, variables, !shipped.empty());
  }
  const DrawnCells drawn{.count = std::max(arguments.random, arguments.latin_hypercube),
                         .latin_hypercube = arguments.latin_hypercube > 0,
                         .seed = arguments.seed};
  const bool piped = arguments.file == "-";
  const ScenarioFile base(piped ? "<stdin>" : shipped + arguments.file, text, variables,
                          std::filesystem::path(arguments.file).parent_path().string());
  return MakeGrid(base, arguments.grid, arguments.map.metrics(), drawn);
}

ExitCode Run(const SweepArguments& arguments, const Settings& settings) {
  settings.RequireOutput(
      {OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson, OutputFormat::kName});
  const v1::Sweep sweep = Open(arguments);
  v1::CreateJobRequest request = arguments.submission.Request();
  *request.mutable_job()->mutable_sweep() = sweep;
  CheckNames(sweep, arguments, settings);
  Client client = Connect(settings);
  const std::string name = client.CallTellingAll(&Client::Stub::CreateJob, request).name();
  if (settings.output == OutputFormat::kName && arguments.heat_map.empty()) {
    fmt::print("{}\n", name);  // As submit does; sweep watch waits for the cells.
    return ExitCode::kOk;
  }
  const ExitCode code = Follow(client, name, arguments, settings);
  if (settings.output == OutputFormat::kTable) {
    Tell("Next:  contactctl sweep export {} -o csv\n", ShortName(name));
  }
  return code;
}

ExitCode Show(const SweepArguments& arguments, const Settings& settings) {
  settings.RequireOutput(
      {OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson, OutputFormat::kName});
  Client client = Connect(settings);
  return Follow(client, FindJob(client, arguments.job), arguments, settings);
}

// Succeeds once the cells are printed, even if some failed or did not converge.
ExitCode Export(const SweepArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson});
  const ExitCode code = Show(arguments, settings);
  return code == ExitCode::kNotConverged || code == ExitCode::kRunFailed ? ExitCode::kOk : code;
}

// Adds the flags of the commands that print the cells of a sweep.
void AddShowing(CommandLine& line, CLI::App& command,
                const std::shared_ptr<SweepArguments>& arguments,
                ExitCode (*act)(const SweepArguments&, const Settings&)) {
  arguments->map.AddTo(line, command);
  AddOption(line, command, "--heatmap,--plot", &arguments->heat_map, ValueKind::kFile,
            "Draw the heat map, or of one axis a line, to this file too: .svg, .png, .pdf, .eps or "
            ".pgf");
  arguments->columns.AddTo(line, command);
  command.add_flag("--comments", arguments->comments, kCommentsAbout);
  line.SetAction(command, arguments, act);
}

// A flag for the number of cells that are drawn at random from the axes of `grid`.
CLI::Option* AddDrawn(CLI::App& run, const char* name, int* cells, CLI::Option* grid,
                      const char* about) {
  return run.add_option(name, *cells, about)
      ->type_name("CELLS")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(grid);
}

// Adds the flags for axes on the command line, instead of a sweep file.
void AddAxes(CLI::App& run, SweepArguments* arguments) {
  CLI::Option* grid =
      Repeatable(
          run.add_option(
              "--grid", arguments->grid,
              "An axis; its values are combined with those of all other axes, such as "
              "contacts[*].restitution=0.5:0.9:5 or …=0.5,0.7; repeatable. FIELD may "
              "name an entry, contacts[A-B].restitution, or be a variable of the file, "
              "var:NAME. --metric is then what is computed, one or several, by default iterations"))
          ->type_name("FIELD=VALUES");
  CLI::Option* random = AddDrawn(
      run, "--random", &arguments->random, grid,
      "Number of cells with random values; each axis of --grid is FIELD=LOW:HIGH or FIELD=A,B,C");
  AddDrawn(run, "--lhs", &arguments->latin_hypercube, grid,
           "Like --random, but a Latin hypercube, which covers every axis evenly")
      ->excludes(random);
  run.add_option("--seed", arguments->seed,
                 "Seed of --random and --lhs; the same seed gives the same cells. Default: 0")
      ->needs(grid);
}

void AddSource(CommandLine& line, CLI::App& run, SweepArguments* arguments) {
  AddOption(line, run, "FILE", &arguments->file, ValueKind::kScenarioFile,
            "Sweep in YAML or JSON; - is the standard input. With --grid a scenario");
  AddOption(line, run, "-t,--template", &arguments->shipped, ValueKind::kTemplate,
            "Take what init would write, instead of a file");
  AddVariableFlag(run, &arguments->variables);
  AddAxes(run, arguments);
  run.add_flag("--cancel-on-interrupt", arguments->cancel_on_interrupt,
               "A first Ctrl-C cancels the sweep instead of leaving it to the server");
  arguments->submission.AddTo(run, "sweep");
}

}  // namespace

void AddSweep(CommandLine& line, CLI::App& sweep) {
  sweep.require_subcommand(1);
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App* run = sweep.add_subcommand(
      "run", "Submit a sweep, watch it, show its cells; with -o name only submit it");
  AddShowing(line, *run, arguments, Run);
  AddSource(line, *run, arguments.get());

  CLI::App* watch = sweep.add_subcommand("watch", "Follow a sweep to its end, show its cells");
  AddShowing(line, *watch, arguments, Show);
  AddJob(line, *watch, &arguments->job);

  CLI::App* cells =
      sweep.add_subcommand("export", "Print the cells of a sweep, with -o csv or json all of them");
  AddShowing(line, *cells, arguments, Export);
  AddJob(line, *cells, &arguments->job);

  AddSweepCell(line, sweep);
}

}  // namespace contact::cli
