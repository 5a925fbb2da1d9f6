#include "wire/sweep/series_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "wire/scenario/channels.h"

namespace contact {
namespace {

using Pick = SeriesMetric::Pick;

constexpr std::array<std::pair<std::string_view, Pick>, 6> kSeriesPicks{
    {{"first", Pick::kFirst},
     {"last", Pick::kLast},
     {"max", Pick::kMax},
     {"min", Pick::kMin},
     {"time_of_max", Pick::kTimeOfMax},
     {"time_of_min", Pick::kTimeOfMin}}};

constexpr char kHow[] =
    "such as series[B1.velocity].max; .min, .first, .last, .time_of_max and .time_of_min, too";

std::string HintFor(const std::string& word) {
  std::vector<std::string_view> words;
  for (const auto& [name, pick] : kSeriesPicks) words.push_back(name);
  return DidYouMean(word, words, kHow);
}

bool IsPlain(const PathStep& step) { return !step.index && step.key.empty(); }

}  // namespace

std::optional<SeriesMetric> FindSeriesMetric(std::span<const PathStep> steps,
                                             const std::string& text, const Rules& rules) {
  if (steps.front().key.empty() || steps.size() < 2) {
    rules.Break("", Quoted(text) + " names no number of a channel", kHow);
    return std::nullopt;
  }
  for (const auto& [word, pick] : kSeriesPicks) {
    if (steps.size() == 2 && IsPlain(steps[1]) && steps[1].name == word) {
      return SeriesMetric{steps.front().key, pick};
    }
  }
  rules.Break("", fmt::format("{}: unknown word {}", Quoted(text), Quoted(steps[1].name)),
              HintFor(steps[1].name));
  return std::nullopt;
}

void CheckChannel(const SeriesMetric& metric, const Scenario& scenario, const Rules& rules) {
  if (scenario.sample_interval == 0) {
    return rules.Break("", "goes not with base.output.ledger_only, which makes no samples");
  }
  const auto channels = Channels(scenario);
  if (std::ranges::find(channels, metric.channel, &v1::FrameChunk::Column::name) !=
      channels.end()) {
    return;
  }
  std::vector<std::string_view> names;
  for (const auto& channel : channels) names.push_back(channel.name());
  rules.Break("", fmt::format("the base has no channel {}", Quoted(metric.channel)),
              DidYouMean(metric.channel, names));
}

SeriesTally::SeriesTally(const std::vector<SeriesMetric>& metrics, const Scenario& scenario) {
  if (metrics.empty()) return;
  const auto channels = Channels(scenario);
  for (const SeriesMetric& metric : metrics) {
    const auto column = std::ranges::find(channels, metric.channel, &v1::FrameChunk::Column::name);
    seen_.push_back({metric.pick, static_cast<std::size_t>(column - channels.begin())});
  }
}

void SeriesTally::See(const Samples& samples) {
  const auto width = static_cast<std::size_t>(samples.columns);
  for (std::size_t row = 0; row < samples.values.size(); row += width) {
    for (Seen& seen : seen_) {
      if (seen.column < width) See(samples.values[row], samples.values[row + seen.column], &seen);
    }
  }
}

void SeriesTally::See(double time, double value, Seen* seen) {
  if (seen->pick == Pick::kFirst) {
    if (std::isnan(seen->chosen)) seen->chosen = value;
    return;
  }
  if (seen->pick == Pick::kLast) {
    seen->chosen = value;
    return;
  }
  const bool largest = seen->pick == Pick::kMax || seen->pick == Pick::kTimeOfMax;
  const bool exceeds = largest ? value > seen->extreme : value < seen->extreme;
  if (!exceeds && !std::isnan(seen->extreme)) return;
  seen->extreme = value;
  const bool is_time = seen->pick == Pick::kTimeOfMax || seen->pick == Pick::kTimeOfMin;
  seen->chosen = is_time ? time : value;
}

}  // namespace contact
