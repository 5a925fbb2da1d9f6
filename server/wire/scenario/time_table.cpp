#include "wire/scenario/time_table.h"

#include <fmt/format.h>

#include <cstdint>

#include "wire/rules/field_rule.h"

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;

constexpr int kFewest = 2;

// Whether all entries of a list are in the range of its field.
bool CheckEntries(std::span<const double> entries, const FieldDescriptor& field,
                  const Rules& rules) {
  const Range range = RangeOf(field);
  bool good = true;
  for (std::size_t i = 0; i < entries.size() && !rules.full(); ++i) {
    if (range.Contains(entries[i])) continue;
    rules.In(field.name(), static_cast<int>(i)).Require("", entries[i], range);
    good = false;
  }
  return good;
}

}  // namespace

TimeTable ReadLists(std::span<const double> times, const FieldDescriptor& of_times,
                    std::span<const double> values, const FieldDescriptor& of_values,
                    const Rules& rules) {
  const auto count = static_cast<std::int64_t>(times.size());
  const int most = RuleOf(of_times).max_entries();
  if (count < kFewest || count > most) {
    rules.Break(of_times.name(), fmt::format("holds {}; must hold {} to {}", count, kFewest, most));
    return {};
  }
  if (values.size() != times.size()) {
    rules.Break(of_values.name(), fmt::format("holds {}; must hold {}, one for each of {}",
                                              values.size(), count, of_times.name()));
    return {};
  }
  bool good = CheckEntries(times, of_times, rules);
  for (std::size_t i = 1; i < times.size() && !rules.full(); ++i) {
    if (times[i] > times[i - 1]) continue;
    BreakOrder("", times[i], times[i - 1], rules.In(of_times.name(), static_cast<int>(i)));
    good = false;
  }
  good &= CheckEntries(values, of_values, rules);
  if (!good || rules.full()) return {};
  return {{times.begin(), times.end()}, {values.begin(), values.end()}};
}

void BreakBothGiven(const FieldDescriptor& of_values, const Rules& rules) {
  rules.Break("points", fmt::format("is given beside times_s and {}", of_values.name()),
              "give the points or the two lists");
}

void BreakCountOfPoints(int count, const FieldDescriptor& points, const FieldDescriptor& of_values,
                        const Rules& rules) {
  const v1::FieldRule& rule = RuleOf(points);
  std::string hint;
  if (count == 0 || count > rule.max_entries()) {
    hint = fmt::format("times_s and {} are lists for tables that are long", of_values.name());
  }
  rules.Break(
      "points",
      fmt::format("holds {}; must hold {} to {}", count, rule.min_entries(), rule.max_entries()),
      hint);
}

void BreakOrder(std::string_view field, double time, double before, const Rules& rules) {
  rules.Break(field, fmt::format("is {}, which is not after the {} before", time, before),
              "points follow one another in time");
}

}  // namespace contact
