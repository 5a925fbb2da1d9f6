#include "cli/text/render_estimate.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "cli/base/number.h"
#include "cli/base/table.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

using google::protobuf::util::TimeUtil;

// A number with two significant digits, which is all that an estimate can promise.
std::string About(double value) {
  if (value >= 1e9) return fmt::format("{:.1e}", value);
  const double unit = value < 100 ? 1 : std::pow(10, std::floor(std::log10(value)) - 1);
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string Bytes(std::int64_t count) {
  constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  auto bytes = static_cast<double>(count);
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

// The lowest limit that is set (> 0); 0 if none is.
std::int64_t Least(std::initializer_list<std::int64_t> limits) {
  std::int64_t least = 0;
  for (const std::int64_t limit : limits) {
    if (limit > 0 && (least == 0 || limit < least)) least = limit;
  }
  return least;
}

std::int64_t MaxSteps(const v1::Job& job) {
  if (job.has_sweep()) return 0;  // Each cell has a limit of its own.
  const NumberField& steps = NumberOf<v1::Solver>(v1::Solver::kMaxStepsFieldNumber);
  const double most = steps.Find(job.scenario().solver()).value_or(steps.default_value);
  return static_cast<std::int64_t>(most);
}

double SecondsOf(const google::protobuf::Duration& duration) {
  return static_cast<double>(TimeUtil::DurationToMicroseconds(duration)) / 1e6;
}

}  // namespace

std::string RenderEstimate(const v1::Job& job, const v1::ServerLimits& limits, const Style& style) {
  if (!job.has_estimate()) return "";
  const v1::Estimate& estimate = job.estimate();
  const v1::Budget& most = limits.max_budget();
  const google::protobuf::Duration& most_wall =
      job.budget().has_wall_time() ? job.budget().wall_time() : most.wall_time();
  const double wall = SecondsOf(most_wall);
  const std::int64_t steps = Least({job.budget().steps(), most.steps(), MaxSteps(job)});
  const std::int64_t output = Least({job.budget().output_bytes(), most.output_bytes()});
  const auto number = [](std::int64_t value) { return value > 0 ? fmt::to_string(value) : "-"; };
  Table table({{"TAKES"}, {"ABOUT", true}, {"AT MOST", true}});
  const auto add = [&table](std::string what, std::string about, std::string limit) {
    table.Add({std::move(what), std::move(about), std::move(limit)});
  };
  const bool told = estimate.has_wall_time();  // And steps.
  add("steps", told ? About(static_cast<double>(estimate.steps())) : "-", number(steps));
  add("samples", fmt::to_string(estimate.samples()), number(limits.max_samples()));
  add("output", Bytes(estimate.output_bytes()), output > 0 ? Bytes(output) : "-");
  add("memory", Bytes(estimate.memory_bytes()), "-");
  add("wall time", told ? Seconds(SecondsOf(estimate.wall_time())) : "-",
      wall > 0 ? Seconds(wall) : "-");
  return table.Text(style);
}

}  // namespace contact::cli
