#include "cli/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/number.h"
#include "cli/render_job.h"
#include "cli/render_json.h"
#include "cli/render_yaml.h"

namespace contact::cli {

void Settings::RequireOutput(std::initializer_list<std::string_view> formats) const {
  if (std::ranges::find(formats, output) != formats.end()) return;
  std::vector<std::string_view> known;
  for (const std::string_view format : formats) {
    known.push_back(format);
    if (format == "json") known.emplace_back("yaml");
  }
  const auto origin = origins.find("output");
  const bool flag = origin == origins.end() || origin->second == "--output";
  throw Failure(ExitCode::kUsage, fmt::format("{} {}: this command prints {}",
                                              flag ? "--output" : origin->second + ": output",
                                              yaml ? "yaml" : output, fmt::join(known, ", ")));
}

Client Settings::Connect() const {
  constexpr std::chrono::seconds kCallTimeout{10};
  return {server, timeout.empty() ? kCallTimeout : ParseDuration(timeout)};
}

std::optional<std::chrono::steady_clock::time_point> Settings::Deadline() const {
  if (timeout.empty()) return std::nullopt;
  return std::chrono::steady_clock::now() + ParseDuration(timeout);
}

ProgressForm Settings::Progress() const {
  if (progress == "plain") return ProgressForm::kLines;
  if (progress == "json") return ProgressForm::kJson;
  const bool bar = progress == "bar" || (progress == "auto" && MessageStyle().terminal);
  return bar ? ProgressForm::kBar : ProgressForm::kNone;
}

bool Settings::TaskbarProgress() const { return taskbar_progress && MessageStyle().terminal; }

Style Settings::OutputStyle() const {
  Style style = StyleOf(STDOUT_FILENO, color);
  style.wide = wide;
  if (wide) style.width = 0;
  return style;
}

Style Settings::MessageStyle() const {
  Style style = StyleOf(STDERR_FILENO, color);
  style.wide = wide;
  return style;
}

void PrintJson(const std::string& json, const Settings& settings) {
  fmt::print("{}", settings.yaml ? YamlOfJson(json) : json);
}

void PrintJob(const v1::Job& job, const Settings& settings,
              const std::vector<std::string>& columns) {
  if (settings.output == "name") {
    fmt::print("{}\n", job.name());
  } else if (settings.output == "json") {
    PrintJson(ToJson(job), settings);
  } else {
    Style style = settings.OutputStyle();
    style.columns = columns;
    fmt::print("{}", RenderJob(job, style));
  }
}

ExitCode Outcome(const v1::Job& job) {
  if (job.state() == v1::Job::FAILED || job.state() == v1::Job::CANCELLED) {
    return ExitCode::kRunFailed;
  }
  return job.convergence() == v1::Job::PARTIAL ? ExitCode::kNotConverged : ExitCode::kOk;
}

}  // namespace contact::cli
