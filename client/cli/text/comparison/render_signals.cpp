#include "cli/text/comparison/render_signals.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "cli/base/csv.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "wire/column_name.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;
using Row = SignalComparison::Row;

std::string Points(const Row& row) {
  if (row.outside == 0) return fmt::to_string(row.points);
  return fmt::format("{} of {}", row.points, row.points + row.outside);
}

std::string ShiftLine(const SignalComparison& comparison) {
  if (comparison.fitted) {
    return fmt::format(
        "simulated time = measured time {:+.6g} s, the best shift in [{:g}, {:g}] s\n",
        comparison.shift, comparison.fitted->low, comparison.fitted->high);
  }
  if (comparison.shift == 0) return "";
  return fmt::format("simulated time = measured time {:+.6g} s\n", comparison.shift);
}

}  // namespace

std::string RenderSignals(const SignalComparison& comparison, const Style& style) {
  constexpr int kDigits = 4;
  Table table({{"SIGNAL"},
               {"POINTS", true, 4},
               {"RMS", true},
               {"LARGEST", true},
               {"AT [s]", true, 3},
               {"MEASURED PEAK", true, 2},
               {"SIMULATED PEAK", true, 1},
               {"ALLOWED", true},
               {""}});
  for (const Row& row : comparison.rows) {
    table.Add({ColumnHeader(row.channel, row.unit), Points(row), Digits(row.rms, kDigits),
               Digits(row.largest, kDigits), Digits(row.largest_time, kDigits),
               Digits(row.measured_peak, kDigits), Digits(row.simulated_peak, kDigits),
               Digits(row.allowed, kDigits),
               row.Holds() ? Table::Cell("ok", Tone::kGood) : Table::Cell("DIFFERS", Tone::kBad)});
  }
  const bool holds = comparison.Holds();
  const std::string verdict = Paint(holds ? "within tolerance" : "DIFFERENT: not within tolerance",
                                    holds ? Tone::kGood : Tone::kBad, style);
  return fmt::format("{}\n{}{} and {}: {}\n", table.Text(style), ShiftLine(comparison),
                     comparison.job, comparison.file, verdict);
}

std::string SignalsJson(const SignalComparison& comparison) {
  Json json{{"job", comparison.job}, {"file", comparison.file}, {"shift_s", comparison.shift}};
  if (const auto& range = comparison.fitted) json["fitted_between_s"] = {range->low, range->high};
  json["holds"] = comparison.Holds();
  json["signals"] = Json::array();
  for (const Row& row : comparison.rows) {
    json["signals"].push_back({{"name", row.channel},
                               {"unit", row.unit},
                               {"points", row.points},
                               {"outside", row.outside},
                               {"rms", row.rms},
                               {"largest", row.largest},
                               {"largest_time_s", row.largest_time},
                               {"measured_peak", row.measured_peak},
                               {"simulated_peak", row.simulated_peak},
                               {"allowed", row.allowed},
                               {"holds", row.Holds()}});
  }
  return json.dump(2) + "\n";
}

std::string SignalsCsv(const SignalComparison& comparison) {
  std::string text;
  CsvWriter csv(&text);
  csv.Row({"signal", "unit", "points", "outside", "rms", "largest", "largest_time [s]",
           "measured_peak", "simulated_peak", "allowed", "shift [s]", "verdict"});
  for (const Row& row : comparison.rows) {
    csv.Add(row.channel).Add(row.unit);
    csv.Add(static_cast<double>(row.points)).Add(static_cast<double>(row.outside));
    csv.Add(row.rms).Add(row.largest).Add(row.largest_time).Add(row.measured_peak);
    csv.Add(row.simulated_peak).Add(row.allowed).Add(comparison.shift);
    csv.Add(row.Holds() ? "ok" : "DIFFERS").EndRow();
  }
  return text;
}

}  // namespace contact::cli
