#include "cli/export/series_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/link/jobs.h"
#include "wire/column_bytes.h"

namespace contact::cli {
namespace {

[[noreturn]] void FailUnknown(const std::string& name, const std::vector<SampleColumn>& columns) {
  std::vector<std::string_view> names;
  for (const SampleColumn& column : columns) names.push_back(column.name);
  throw Failure(
      ExitCode::kUsage,
      WithHint(fmt::format("{} is no channel of this job", Quoted(name)), DidYouMean(name, names)));
}

std::vector<SampleColumn> Chosen(const std::vector<std::string>& channels,
                                 std::vector<SampleColumn>&& columns) {
  std::vector<SampleColumn> chosen;
  chosen.push_back(columns.front());  // time
  for (const std::string& name : channels) {
    const auto found = std::ranges::find(columns, name, &SampleColumn::name);
    if (found == columns.end()) FailUnknown(name, columns);
    if (std::ranges::find(chosen, name, &SampleColumn::name) == chosen.end()) {
      chosen.push_back(*found);
    }
  }
  return chosen;
}

}  // namespace

bool SeriesSelection::empty() const {
  return channels.empty() && !from && !to && every == 1 && max_points == 0;
}

void Narrow(const SeriesSelection& selection, std::vector<SampleColumn>* columns) {
  if (columns->empty()) return;
  if (!selection.channels.empty()) *columns = Chosen(selection.channels, std::move(*columns));
  const std::vector<double>& time = columns->front().values;
  const double low = selection.from.value_or(-std::numeric_limits<double>::infinity());
  const double high = selection.to.value_or(std::numeric_limits<double>::infinity());
  const auto begin = static_cast<std::size_t>(std::ranges::lower_bound(time, low) - time.begin());
  const auto end = static_cast<std::size_t>(std::ranges::upper_bound(time, high) - time.begin());
  for (SampleColumn& column : *columns) {
    std::vector<double> kept;
    for (std::size_t i = begin; i < end; i += static_cast<std::size_t>(selection.every)) {
      kept.push_back(column.values[i]);
    }
    column.values = std::move(kept);
  }
}

std::vector<SampleColumn> ThinnedSeries(Client& client, const std::string& job,
                                        const SeriesSelection& selection) {
  v1::GetSeriesRequest request;
  request.set_name(JobName(job));
  for (const std::string& channel : selection.channels) request.add_channels(channel);
  if (selection.from) request.set_start_time_s(*selection.from);
  if (selection.to) request.set_end_time_s(*selection.to);
  request.set_max_points(selection.max_points);
  const v1::Series series = client.CallTellingAll(&Client::Stub::GetSeries, request);
  std::vector<SampleColumn> columns;
  for (const v1::FrameChunk::Column& column : series.columns()) {
    columns.push_back({column.name(), column.quantity(), column.unit(), Doubles(column.values())});
  }
  return columns;
}

}  // namespace contact::cli
