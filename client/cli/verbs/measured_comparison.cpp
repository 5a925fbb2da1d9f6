#include "cli/verbs/measured_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cstdio>
#include <map>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/scalar.h"
#include "cli/base/unit.h"
#include "cli/input/measured.h"
#include "cli/link/connect.h"
#include "cli/settings/options.h"
#include "cli/text/comparison/render_signals.h"
#include "cli/text/print_job.h"
#include "cli/verbs/job/contactsim.h"

namespace contact::cli {
namespace {

[[noreturn]] void FailTolerance(const std::string& channel, const std::string& text) {
  throw Failure(ExitCode::kUsage,
                fmt::format("--tolerance {}={}: expected a number with or without a unit of the "
                            "channel, or a percentage of the peak, such as 5%",
                            channel, text));
}

SignalTolerance ReadTolerance(const std::string& channel, const std::string& text,
                              const std::string& si) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.eE+-"), text.size());
  const auto number = ParseNumber(text.substr(0, end));
  const std::string unit = boost::trim_copy(text.substr(end));
  if (!number || *number < 0) FailTolerance(channel, text);
  if (unit == "%") return {.absolute = 0, .relative = *number / 100};
  const auto factor = unit.empty() ? std::optional(1.0) : UnitFactor(unit, si);
  if (!factor) FailTolerance(channel, text);
  return {.absolute = *number * *factor, .relative = 0};
}

TimeRange ReadRange(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto low = ParseNumber(text.substr(0, colon));
  const auto high = ParseNumber(colon == std::string::npos ? "" : text.substr(colon + 1));
  if (low && high && *low < *high) return {*low, *high};
  throw Failure(ExitCode::kUsage,
                fmt::format("--fit-shift {}: expected LOW:HIGH in s, such as -1e-3:1e-3", text));
}

Recording ReadRun(const std::string& job, const Settings& settings) {
  Client client = Connect(settings);
  Recording run = ReadRecording(client, job, settings);
  if (run.job.has_sweep()) {
    throw Failure(ExitCode::kUsage, fmt::format("{} is a sweep, not a run", run.job.name()));
  }
  if (!run.columns.empty()) return run;
  throw Failure(ExitCode::kUsage, fmt::format("{} recorded no trajectory", run.job.name()));
}

void Print(const SignalComparison& comparison, const Settings& settings) {
  switch (settings.output) {
    case OutputFormat::kJson:
      return PrintJson(SignalsJson(comparison), settings);
    case OutputFormat::kCsv:
      return fmt::print("{}", SignalsCsv(comparison));
    default:
      return fmt::print("{}", RenderSignals(comparison, settings.OutputStyle()));
  }
}

}  // namespace

void MeasuredComparison::AddTo(CLI::App& command) {
  Repeatable(command.add_option("--map", map_,
                                "With measured data: the channel of a column, such as "
                                "'F=B1-B2.contact_force [kN]'; repeatable"))
      ->type_name("HEADER=CHANNEL");
  Repeatable(command.add_option("--tolerance", tolerances_,
                                "With measured data: what a signal may deviate, instead of --abs "
                                "and --rel: 'B1.velocity=3%' of its peak, or '=20 mm/s'; "
                                "repeatable"))
      ->type_name("CHANNEL=TOLERANCE");
  CLI::Option* shift = command
                           .add_option("--shift", shift_,
                                       "With measured data: simulated time minus measured time, in "
                                       "s. Default: 0")
                           ->type_name("SECONDS");
  command
      .add_option("--fit-shift", fit_,
                  "With measured data: look for the shift between two, in s, with which the "
                  "squared deviations are least")
      ->type_name("LOW:HIGH")
      ->excludes(shift);
}

std::string MeasuredComparison::GivenFlag() const {
  if (!map_.empty()) return "--map";
  if (!tolerances_.empty()) return "--tolerance";
  if (shift_) return "--shift";
  return fit_.empty() ? "" : "--fit-shift";
}

ExitCode MeasuredComparison::Run(const std::string& job, const std::string& file,
                                 const SignalTolerance& common, const std::string& plot,
                                 const Settings& settings) const {
  const MeasuredTable table = MeasuredTable::Open(file);
  const auto map = ParseAssignments(map_, "--map", "HEADER=CHANNEL");
  const std::optional<TimeRange> range =
      fit_.empty() ? std::nullopt : std::optional(ReadRange(fit_));
  const Recording run = ReadRun(job, settings);
  const MeasuredSignals found = FindSignals(table, run, map);
  if (!found.left_out.empty()) {
    fmt::print(stderr, "left out, no channels: {}\n", fmt::join(found.left_out, ", "));
  }
  const double shift = range ? FitShift(found.signals, run, *range) : shift_.value_or(0);
  SignalComparison comparison =
      Compare(found.signals, run, shift, common, ReadTolerances(tolerances_, found.signals));
  comparison.file = file;
  comparison.fitted = range;
  if (!plot.empty()) {
    std::vector<std::string> words = {"measured", fmt::format("--shift={}", shift),
                                      "--file=" + plot};
    for (const std::string& pair : map_) words.push_back("--map=" + pair);
    words.insert(words.end(), {"--", run.job.name(), file});
    RunContactsim(words, settings);
    fmt::print(stderr, "{}\n", plot);
  }
  Print(comparison, settings);
  return comparison.Holds() ? ExitCode::kOk : ExitCode::kDiffers;
}

std::map<std::string, SignalTolerance> ReadTolerances(const std::vector<std::string>& texts,
                                                      const std::vector<MeasuredSignal>& signals) {
  std::map<std::string, SignalTolerance> tolerances;
  for (const auto& [channel, text] : ParseAssignments(texts, "--tolerance", "CHANNEL=TOLERANCE")) {
    const auto signal = std::ranges::find(signals, channel, &MeasuredSignal::channel);
    if (signal == signals.end()) {
      std::vector<std::string_view> names;
      for (const MeasuredSignal& each : signals) names.push_back(each.channel);
      throw Failure(ExitCode::kUsage,
                    WithHint(fmt::format("--tolerance {}={}: no such signal", channel, text),
                             DidYouMean(channel, names,
                                        fmt::format("there are {}", fmt::join(names, ", ")))));
    }
    tolerances[channel] = ReadTolerance(channel, text, signal->unit);
  }
  return tolerances;
}

}  // namespace contact::cli
