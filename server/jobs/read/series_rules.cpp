#include "jobs/read/series_rules.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "base/spelling.h"

namespace contact {
namespace {

constexpr std::size_t kMaxViolations = 100;
// Bytes of values in an answer: a client takes 4 MiB unless it says otherwise.
constexpr std::size_t kMaxSeriesBytes = 4'000'000;
constexpr std::size_t kDefaultPoints = 1000;

using Columns = std::vector<v1::FrameChunk::Column>;

std::string ChannelHint(const std::string& name, const Columns& channels) {
  std::vector<std::string_view> names;
  for (const auto& channel : channels) names.push_back(channel.name());
  return DidYouMean(name, names, fmt::format("channels are {}", fmt::join(names, ", ")));
}

// The time and the channels asked for, each once.
std::vector<int> SelectColumns(const v1::GetSeriesRequest& request, const Columns& channels,
                               std::vector<Violation>* violations) {
  std::vector<int> columns = {0};
  const auto select = [&columns](int column) {
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
  };
  std::map<std::string_view, int> places;
  for (const auto& channel : channels) {
    places.emplace(channel.name(), static_cast<int>(places.size()));
  }
  for (int i = 0; i < request.channels_size() && violations->size() < kMaxViolations; ++i) {
    const std::string& name = request.channels(i);
    if (const auto place = places.find(name); place != places.end()) {
      select(place->second);
    } else {
      violations->push_back({fmt::format("channels[{}]", i),
                             fmt::format("{} is no channel of this job", Quoted(name)),
                             ChannelHint(name, channels)});
    }
  }
  if (!request.channels().empty()) return columns;
  columns.resize(channels.size());
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

void CheckTimes(const v1::GetSeriesRequest& request, std::vector<Violation>* violations) {
  if (std::isnan(request.start_time_s())) violations->push_back({"start_time_s", "is nan", ""});
  if (std::isnan(request.end_time_s())) violations->push_back({"end_time_s", "is nan", ""});
  if (request.has_start_time_s() && request.has_end_time_s() &&
      request.start_time_s() > request.end_time_s()) {
    violations->push_back({"end_time_s",
                           fmt::format("is {}, which is before start_time_s, {}",
                                       request.end_time_s(), request.start_time_s()),
                           ""});
  }
}

}  // namespace

Error NotRecorded(const std::vector<v1::FrameChunk::Column>& channels) {
  std::vector<Violation> violations;
  for (const auto& channel : channels) {
    violations.push_back({"channels", fmt::format("{} is not recorded", Quoted(channel.name())),
                          "an older server made this job; run its scenario again"});
  }
  return Invalid(std::move(violations));
}

Result<SeriesSelection> ToSelection(const v1::GetSeriesRequest& request, const Columns& channels) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  std::vector<Violation> violations;
  SeriesSelection selection;
  selection.columns = SelectColumns(request, channels, &violations);
  selection.all = request.channels().empty();
  selection.start_time = request.has_start_time_s() ? request.start_time_s() : -kEver;
  selection.end_time = request.has_end_time_s() ? request.end_time_s() : kEver;
  CheckTimes(request, &violations);
  if (!v1::GetSeriesRequest::Decimation_IsValid(request.decimation())) {
    violations.push_back({"decimation", "is neither MINMAX nor RAW", ""});
  }
  selection.raw = request.decimation() == v1::GetSeriesRequest::RAW;
  selection.plain_numbers = request.plain_numbers();
  const std::size_t least = selection.raw ? 1 : 2 * selection.columns.size();
  const std::size_t most = kMaxSeriesBytes / sizeof(double) / selection.columns.size();
  if (request.max_points() < 0 ||
      (request.max_points() > 0 && static_cast<std::size_t>(request.max_points()) < least)) {
    violations.push_back(
        {"max_points",
         fmt::format(
             "is {}; must be at least {} for {}", request.max_points(), least,
             Count(static_cast<std::int64_t>(selection.columns.size()) - 1, "channel", "channels")),
         "ask for more points, or fewer channels"});
  }
  if (!violations.empty()) return Invalid(std::move(violations));
  if (least > most) return SeriesTooLarge(most);
  const std::size_t points = selection.raw ? most : std::max(least, kDefaultPoints);
  selection.max_rows = std::min(
      most, request.max_points() > 0 ? static_cast<std::size_t>(request.max_points()) : points);
  return selection;
}

}  // namespace contact
