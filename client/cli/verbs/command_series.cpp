#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/export/sampling.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/text/render_series.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct SeriesArguments {
  std::string job;
  std::vector<std::string> channels;
  std::optional<double> from;
  std::optional<double> to;
  int points = 0;
  bool raw = false;
  bool comments = false;
};

v1::GetSeriesRequest Request(const std::string& job, const SeriesArguments& arguments) {
  v1::GetSeriesRequest request;
  request.set_name(job);
  request.mutable_channels()->Assign(arguments.channels.begin(), arguments.channels.end());
  if (arguments.from) request.set_start_time_s(*arguments.from);
  if (arguments.to) request.set_end_time_s(*arguments.to);
  request.set_max_points(arguments.points);
  request.set_decimation(arguments.raw ? v1::GetSeriesRequest::RAW : v1::GetSeriesRequest::MINMAX);
  return request;
}

ExitCode Series(const SeriesArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kCsv, OutputFormat::kJson});
  Client client = Connect(settings);
  const std::string job = FindJob(client, arguments.job);
  const v1::Series series =
      client.CallTellingAll(&Client::Stub::GetSeries, Request(job, arguments));
  const std::string sampling =
      SamplingNote(client, job, {.from = arguments.from, .to = arguments.to}, settings);
  if (settings.output == OutputFormat::kCsv) {
    const auto source = [&] { return WithSampling(SourceOf(GetJob(client, job)), sampling); };
    fmt::print("{}{}", arguments.comments ? CommentLines(source()) : "", SeriesCsv(series));
  } else if (settings.output == OutputFormat::kJson) {
    PrintJson(SeriesJson(series, sampling), settings);
  } else {
    fmt::print("{}", RenderSeries(series, settings.OutputStyle()));
  }
  TellSampling(sampling, job);
  return ExitCode::kOk;
}

}  // namespace

void AddSeries(CommandLine& line, CLI::App& series) {
  auto arguments = std::make_shared<SeriesArguments>();
  AddJob(line, series, &arguments->job);
  Repeatable(AddOption(line, series, "--channel", &arguments->channels, ValueKind::kChannel,
                       "Such as B1.velocity or B1-B2.contact_force; repeatable. Default: all"));
  series.add_option("--from", arguments->from, "Only from this simulated time on")
      ->type_name("SECONDS");
  series.add_option("--to", arguments->to, "Only up to this simulated time")->type_name("SECONDS");
  AddCount(series, "--points", &arguments->points,
           "At most N samples; no peak is lost. Default: 1000");
  series.add_flag("--raw", arguments->raw, "Every sample");
  series.add_flag("--comments", arguments->comments, kCommentsAbout);
  line.SetAction(series, arguments, Series);
}

}  // namespace contact::cli
