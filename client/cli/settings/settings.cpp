#include "cli/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/base/number.h"

namespace contact::cli {

void Settings::SetOutput(std::string_view name) {
  const std::optional<OutputFormat> format = FindFormat(name);
  if (!format) return;
  wide = format == OutputFormat::kWide;
  yaml = format == OutputFormat::kYaml;
  output = wide ? OutputFormat::kTable : yaml ? OutputFormat::kJson : *format;
}

void Settings::RequireOutput(const std::vector<OutputFormat>& formats) const {
  if (std::ranges::find(formats, output) != formats.end()) return;
  std::vector<std::string> known;
  for (const OutputFormat format : formats) {
    known.emplace_back(NameOf(format));
    if (format == OutputFormat::kJson) known.emplace_back(NameOf(OutputFormat::kYaml));
  }
  RefuseOutput(known);
}

void Settings::RequireUse(FormatUse use) const {
  if ((InfoOf(output).uses & use) == 0) RefuseOutput(FormatNames(use));
}

void Settings::RefuseOutput(const std::vector<std::string>& known) const {
  const auto origin = origins.find("output");
  const bool flag = origin == origins.end() || origin->second == "--output";
  throw Failure(
      ExitCode::kUsage,
      fmt::format("{} {}: this command prints {}", flag ? "--output" : origin->second + ": output",
                  NameOf(yaml ? OutputFormat::kYaml : output), fmt::join(known, ", ")));
}

std::chrono::milliseconds Settings::CallTimeout() const {
  constexpr std::chrono::seconds kCallTimeout{10};
  return timeout.empty() ? kCallTimeout : RequireDuration(timeout);
}

std::optional<std::chrono::steady_clock::time_point> Settings::Deadline() const {
  if (timeout.empty()) return std::nullopt;
  return std::chrono::steady_clock::now() + RequireDuration(timeout);
}

ProgressForm Settings::Progress() const {
  if (progress == "plain") return ProgressForm::kLines;
  if (progress == "json") return ProgressForm::kJson;
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

}  // namespace contact::cli
