#include "cli/export/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/base/message.h"
#include "cli/link/jobs.h"
#include "cli/link/watch.h"
#include "wire/column_bytes.h"

namespace contact::cli {
namespace {

constexpr int kFewSamples = 10;  // For a shape that is seen, as in contactsim's figures/words.json.

// Adds the times of all samples in a range, in as many calls as it takes: an answer has a limit.
void AddTimes(Client& client, const std::string& job, double from, double to,
              std::vector<double>* times) {
  v1::GetSeriesRequest request;
  request.set_name(job);
  request.add_channels("time");
  request.set_start_time_s(from);
  request.set_end_time_s(to);
  request.set_decimation(v1::GetSeriesRequest::RAW);
  try {
    const v1::Series series = client.Call(&Client::Stub::GetSeries, request);
    AppendDoubles(series.columns(0).values(), times);
  } catch (const CallFailure& failure) {
    const double middle = (from + to) / 2;
    if (failure.status() != grpc::StatusCode::OUT_OF_RANGE || middle <= from) throw;
    AddTimes(client, job, from, middle, times);
    AddTimes(client, job, std::nextafter(middle, to), to, times);
  }
}

bool IsCoarse(const v1::Cycle& cycle, const std::vector<double>& time) {
  const auto samples = std::ranges::upper_bound(time, cycle.end_time_s()) -
                       std::ranges::lower_bound(time, cycle.start_time_s());
  return cycle.end() != v1::Cycle::RUN_END && samples < kFewSamples;
}

}  // namespace

std::string SamplingNote(const v1::Job& job, const std::vector<double>& time,
                         const SeriesSelection& part) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  std::int64_t all = 0;
  std::int64_t coarse = 0;
  for (const v1::Cycle& cycle : job.cycles()) {
    if (cycle.end_time_s() < part.from.value_or(-kEver)) continue;
    if (cycle.start_time_s() > part.to.value_or(kEver)) continue;
    ++all;
    if (IsCoarse(cycle, time)) ++coarse;
  }
  if (coarse == 0 || time.empty()) return "";
  return fmt::format("{} of {} fewer than {} samples", coarse,
                     Count(all, "contact has", "contacts have"), kFewSamples);
}

std::string SamplingNote(Client& client, const std::string& job, const SeriesSelection& part,
                         const Settings& settings) {
  const v1::Job now = GetJob(client, job);
  if (!IsFinal(now.state()) || now.cycles().empty()) return "";
  std::vector<double> times;
  AddTimes(client, job, 0, now.scenario().end_time_s(), &times);
  return SamplingNote(ReadRecording(client, job, settings, false).job, times, part);
}

Provenance WithSampling(Provenance source, const std::string& note) {
  if (!note.empty()) source.emplace_back("sampling", note);
  return source;
}

void TellSampling(const std::string& note, const std::string& job) {
  if (note.empty()) return;
  Tell(
      "{}, too few to show. For more:\n"
      "  contactctl run --like {} --set output.samples_per_contact=100\n",
      note, job);
}

}  // namespace contact::cli
