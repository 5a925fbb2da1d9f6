#include "cli/text/comparison/measured_signals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/unit.h"

namespace contact::cli {
namespace {

// What a column is said to be, by the map or by its header.
struct Meaning {
  std::string channel;
  std::string unit;
  bool mapped = false;
};

std::vector<std::string_view> NamesOf(const Recording& run) {
  std::vector<std::string_view> names;
  for (const SampleColumn& column : run.columns) names.push_back(column.name);
  return names;
}

class Finder {
 public:
  Finder(const MeasuredTable& table, const Recording& run,
         const std::map<std::string, std::string>& map)
      : table_(table), run_(run), map_(map) {}

  MeasuredSignals Find() {
    RequireMapped();
    const std::vector<double> times = Times();
    MeasuredSignals found;
    for (std::size_t i = 0; i < table_.columns().size(); ++i) {
      const MeasuredColumn& column = table_.columns()[i];
      const Meaning meaning = MeaningOf(column);
      if (IsTimeName(meaning.channel)) continue;
      const SampleColumn* channel = ChannelOf(meaning);
      if (channel == nullptr) {
        found.left_out.push_back(column.header);
      } else {
        found.signals.push_back(Signal(i, meaning, *channel, times));
      }
    }
    RequireNone(mistakes_);
    if (found.signals.empty()) FailWithoutSignal();
    return found;
  }

 private:
  // Throws Failure unless every entry of the map has its column.
  void RequireMapped() const {
    for (const auto& [header, channel] : map_) {
      const bool found =
          std::ranges::any_of(table_.columns(), [&name = header](const auto& column) {
            return column.header == name || column.name == name;
          });
      if (found) continue;
      throw Failure(ExitCode::kUsage,
                    fmt::format("--map {}={}: {} has no column {} — it has {}", header, channel,
                                table_.source(), Quoted(header), table_.Headers()));
    }
  }

  Meaning MeaningOf(const MeasuredColumn& column) const {
    auto entry = map_.find(column.header);
    if (entry == map_.end()) entry = map_.find(column.name);
    if (entry == map_.end()) return {column.name, column.unit};
    const MeasuredColumn target = ColumnWithUnit(entry->second);
    return {target.name, target.unit.empty() ? column.unit : target.unit, true};
  }

  // The channel of a column; null if it has none. Throws Failure if it was mapped to none.
  const SampleColumn* ChannelOf(const Meaning& meaning) const {
    constexpr std::string_view kForce = ".force";
    std::string name = meaning.channel;
    if (name.ends_with(kForce)) name.replace(name.size() - kForce.size() + 1, 0, "contact_");
    const SampleColumn* channel = run_.Find(meaning.channel);
    if (channel == nullptr) channel = run_.Find(name);
    if (channel != nullptr || !meaning.mapped) return channel;
    throw Failure(
        ExitCode::kUsage,
        WithHint(fmt::format("--map: {} recorded no {}", run_.job.name(), Quoted(meaning.channel)),
                 DidYouMean(meaning.channel, NamesOf(run_), Channels())));
  }

  std::string Channels() const {
    return fmt::format("channels are {}", fmt::join(NamesOf(run_), ", "));
  }

  // The factor from the unit of a column to that of its channel. Throws Failure if there is none.
  static double FactorOf(const MeasuredColumn& column, const std::string& unit,
                         const std::string& si) {
    if (unit.empty()) {
      const std::size_t underscore = column.name.rfind('_');
      const auto factor = underscore == std::string::npos
                              ? std::nullopt
                              : UnitFactor(column.name.substr(underscore + 1), si);
      return factor.value_or(1);
    }
    if (const std::optional<double> factor = UnitFactor(unit, si)) return *factor;
    throw Failure(ExitCode::kUsage, fmt::format("column {}: {} is no unit of a quantity in {}",
                                                Quoted(column.header), Quoted(unit), si));
  }

  // The numbers of a column in SI; NaN where there is none.
  std::vector<double> Values(std::size_t column, const std::string& unit, const std::string& si) {
    const double factor = FactorOf(table_.columns()[column], unit, si);
    std::vector<double> values = table_.Numbers(column, MeasuredTable::Gap::kNaN, &mistakes_);
    for (double& value : values) value = InSi(value, factor);
    return values;
  }

  std::vector<double> Times() {
    for (std::size_t i = 0; i < table_.columns().size(); ++i) {
      const Meaning meaning = MeaningOf(table_.columns()[i]);
      if (IsTimeName(meaning.channel)) return Values(i, meaning.unit, "s");
    }
    throw Failure(ExitCode::kUsage,
                  fmt::format("{} has no column time — it has {}; --map HEADER=time names it",
                              table_.source(), table_.Headers()));
  }

  MeasuredSignal Signal(std::size_t column, const Meaning& meaning, const SampleColumn& channel,
                        const std::vector<double>& times) {
    MeasuredSignal signal{channel.name, channel.unit};
    const std::vector<double> values = Values(column, meaning.unit, channel.unit);
    if (!mistakes_.empty()) return signal;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!std::isfinite(times[i]) || !std::isfinite(values[i])) continue;
      signal.times.push_back(times[i]);
      signal.values.push_back(values[i]);
    }
    if (!signal.times.empty()) return signal;
    throw Failure(ExitCode::kUsage, fmt::format("column {} has no numbers with a time",
                                                Quoted(table_.columns()[column].header)));
  }

  [[noreturn]] void FailWithoutSignal() const {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{}: no column is a channel of {}; it has {} — {}; --map "
                              "HEADER=CHANNEL joins them",
                              table_.source(), run_.job.name(), table_.Headers(), Channels()));
  }

  const MeasuredTable& table_;
  const Recording& run_;
  const std::map<std::string, std::string>& map_;
  std::vector<Diagnostic> mistakes_;
};

}  // namespace

MeasuredSignals FindSignals(const MeasuredTable& table, const Recording& run,
                            const std::map<std::string, std::string>& map) {
  return Finder(table, run, map).Find();
}

}  // namespace contact::cli
