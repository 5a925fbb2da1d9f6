#include <fmt/format.h>

#include <memory>
#include <utility>

#include "cli/base/message.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/text/print_job.h"
#include "cli/text/render_json.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/job/follow.h"
#include "cli/verbs/sweep/cell_watcher.h"
#include "cli/verbs/sweep/heat_map_options.h"
#include "cli/verbs/sweep/sweep_cell.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct CellArguments {
  std::string job;
  std::string cell;
  bool run = false;
};

struct HeatMapArguments {
  std::string job;
  std::string file;
  HeatMapOptions map;
};

// Runs the scenario of a cell as a job of its own.
ExitCode RunCell(Client& client, const v1::Job& sweep, const v1::SweepCell& cell,
                 const Settings& settings) {
  v1::CreateJobRequest request;
  v1::Job& job = *request.mutable_job();
  *job.mutable_scenario() = ScenarioOf(sweep.sweep(), cell);
  (*job.mutable_labels())["sweep"] = ShortName(sweep.name());
  (*job.mutable_labels())["cell"] = fmt::to_string(cell.index());
  request.set_request_id(RandomRequestId());
  const std::string name = client.CallTellingAll(&Client::Stub::CreateJob, request).name();
  const WatchEnd end =
      FollowRun(client, name, settings.Deadline(), IterationRows::kFirst, settings);
  return end == WatchEnd::kFinished ? PrintResult(client, name, settings) : Detach(end, name);
}

ExitCode Cell(const CellArguments& arguments, const Settings& settings) {
  std::vector<OutputFormat> formats = {OutputFormat::kTable, OutputFormat::kJson};
  if (arguments.run) formats.push_back(OutputFormat::kName);
  settings.RequireOutput(formats);
  Client client = Connect(settings);
  const v1::Job job = GetSweep(client, FindJob(client, arguments.job));
  const SweepCells cells = ReadCells(client, job, settings);
  const v1::SweepCell& cell = FindCell(job.sweep(), cells, arguments.cell);
  if (arguments.run) return RunCell(client, job, cell, settings);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(ToJson(cell), settings);
    return ExitCode::kOk;
  }
  fmt::print("{}", RenderCell(job, cell, settings.OutputStyle()));
  Tell("Next:  contactctl sweep cell {} {} --run\n", ShortName(job.name()), cell.index());
  return ExitCode::kOk;
}

// The line of a sweep over one axis, in characters.
[[noreturn]] void PrintLine(const HeatMapOptions& map, const v1::Job& job, Settings settings) {
  settings.SetOutput(NameOf(OutputFormat::kText));
  std::vector<std::string> words = map.Words(job.name());
  for (std::string& word : FigureWords("", "line", settings)) words.push_back(std::move(word));
  BecomeContactsim(words, settings);
}

ExitCode DrawMap(const HeatMapArguments& arguments, const Settings& settings) {
  Client client = Connect(settings);
  const v1::Job job = GetSweep(client, FindJob(client, arguments.job));
  arguments.map.MetricOf(job.sweep());
  if (!arguments.file.empty()) arguments.map.RequireDrawable(job.sweep(), arguments.file);
  if (!arguments.file.empty()) {
    arguments.map.Draw(job, arguments.file, settings);
    return ExitCode::kOk;
  }
  if (job.sweep().axes_size() == 1) PrintLine(arguments.map, job, settings);
  const SweepCells cells = ReadCells(client, job, settings);
  const std::string text = arguments.map.Text(job.sweep(), cells, settings.OutputStyle());
  if (text.empty()) {
    throw Failure(ExitCode::kUsage,
                  "a heat map is of a grid of two axes that fits into the terminal; -f draws a "
                  "larger one, and of one axis a line");
  }
  fmt::print("{}", text.substr(1));  // Without the empty line that separates it from a table.
  return ExitCode::kOk;
}

}  // namespace

void AddSweepCell(CommandLine& line, CLI::App& sweep) {
  CLI::App* map = sweep.add_subcommand(
      "heatmap", "Show a metric over two axes as a map, over one as a line; also called plot");
  map->alias("plot");
  auto drawn = std::make_shared<HeatMapArguments>();
  AddJob(line, *map, &drawn->job);
  AddDestination(
      line, *map, "-f,--file", &drawn->file,
      "Draw it to this file: .svg, .png, .pdf, .eps or .pgf, a line as .txt or .csv too. Default: "
      "print it");
  drawn->map.AddTo(line, *map);
  line.SetAction(*map, drawn, DrawMap);

  CLI::App* cell = sweep.add_subcommand(
      "cell", "Show one cell whole: its values, its metrics, why it failed; or run it alone");
  auto arguments = std::make_shared<CellArguments>();
  AddJob(line, *cell, &arguments->job);
  cell->add_option("CELL", arguments->cell,
                   "Its number, or its values, such as contacts[*].restitution=0.7,bodies[0]"
                   ".velocity_m_per_s=0.2; the last part of a field is enough")
      ->required();
  cell->add_flag("--run", arguments->run,
                 "Run its scenario as a job of its own, which can be plotted");
  line.SetAction(*cell, arguments, Cell);
}

}  // namespace contact::cli
