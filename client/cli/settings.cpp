#include "cli/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/number.h"
#include "cli/render_job.h"
#include "cli/render_json.h"

namespace contact::cli {

void Settings::RequireOutput(std::initializer_list<std::string_view> formats) const {
  if (std::ranges::find(formats, output) != formats.end()) return;
  const auto origin = origins.find("output");
  const bool flag = origin == origins.end() || origin->second == "--output";
  throw Failure(ExitCode::kUsage, fmt::format("{} {}: this command prints {}",
                                              flag ? "--output" : origin->second + ": output",
                                              output, fmt::join(formats, ", ")));
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
  const bool bar = progress == "bar" || (progress == "auto" && MessageStyle().terminal);
  return bar ? ProgressForm::kBar : ProgressForm::kNone;
}

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

void PrintJob(const v1::Job& job, const Settings& settings) {
  if (settings.output == "name") {
    fmt::print("{}\n", job.name());
  } else if (settings.output == "json") {
    fmt::print("{}", ToJson(job));
  } else {
    fmt::print("{}", RenderJob(job, settings.OutputStyle()));
  }
}

ExitCode Outcome(const v1::Job& job) {
  if (job.state() == v1::Job::FAILED || job.state() == v1::Job::CANCELLED) {
    return ExitCode::kRunFailed;
  }
  return job.convergence() == v1::Job::PARTIAL ? ExitCode::kNotConverged : ExitCode::kOk;
}

}  // namespace contact::cli
