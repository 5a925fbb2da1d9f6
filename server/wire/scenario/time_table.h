#pragma once

#include <google/protobuf/descriptor.h>

#include <span>
#include <vector>

#include "wire/rules/rules.h"

namespace contact {

/// What a table of a load or motion says, at instants that follow one another.
struct TimeTable {
  std::vector<double> times, values;

  /// True for a table that breaks rules.
  bool empty() const { return times.empty(); }
};

/// Reads a table of two lists of numbers, `times` and `values`, which are the fields named. Empty
/// if it breaks rules, which are noted.
TimeTable ReadLists(std::span<const double> times,
                    const google::protobuf::FieldDescriptor& of_times,
                    std::span<const double> values,
                    const google::protobuf::FieldDescriptor& of_values, const Rules& rules);

/// Notes that a table has points and lists, that it has too few or too many points, or that the
/// time of point `index` is not after the one before.
void BreakBothGiven(const google::protobuf::FieldDescriptor& of_values, const Rules& rules);
void BreakCountOfPoints(int count, const google::protobuf::FieldDescriptor& points,
                        const google::protobuf::FieldDescriptor& of_values, const Rules& rules);
void BreakOrder(std::string_view field, double time, double before, const Rules& rules);

/// Where a type of table has its values.
template <class Table>
struct TableFields {
  /// The value of a point, and the number of that field.
  double (Table::Point::*value)() const;
  int value_number;
  /// The list of values, and the number of that field.
  const google::protobuf::RepeatedField<double>& (Table::*values)() const;
  int values_number;
};

/// Reads the points of a table. Empty if they break rules.
template <class Table>
TimeTable ReadPoints(const Table& table, const TableFields<Table>& fields, const Rules& rules) {
  using Point = typename Table::Point;
  const auto& type = *Table::descriptor();
  const auto& list = *type.FindFieldByNumber(Table::kPointsFieldNumber);
  const int count = table.points_size();
  if (count < RuleOf(list).min_entries() || count > RuleOf(list).max_entries()) {
    BreakCountOfPoints(count, list, *type.FindFieldByNumber(fields.values_number), rules);
    return {};
  }
  TimeTable read;
  bool ordered = true;
  for (int i = 0; i < count && !rules.full(); ++i) {
    const Point& point = table.points(i);
    const Rules here = rules.In("points", i);
    here.template Check<Point>(Point::kTimeSFieldNumber, point.time_s());
    here.template Check<Point>(fields.value_number, (point.*fields.value)());
    if (i > 0 && !(point.time_s() > read.times.back())) {
      BreakOrder("time_s", point.time_s(), read.times.back(), here);
      ordered = false;
    }
    read.times.push_back(point.time_s());
    read.values.push_back((point.*fields.value)());
  }
  return ordered && std::ssize(read.times) == count ? read : TimeTable();
}

/// Reads a table, which has either points or lists. Empty if it breaks rules.
template <class Table>
TimeTable ReadTimeTable(const Table& table, const TableFields<Table>& fields, const Rules& rules) {
  const auto& type = *Table::descriptor();
  const auto& times = table.times_s();
  const auto& values = (table.*fields.values)();
  const auto& of_values = *type.FindFieldByNumber(fields.values_number);
  if (times.empty() && values.empty()) return ReadPoints(table, fields, rules);
  if (table.points_size() > 0) {
    BreakBothGiven(of_values, rules);
    return {};
  }
  return ReadLists({times.data(), static_cast<std::size_t>(times.size())},
                   *type.FindFieldByNumber(Table::kTimesSFieldNumber),
                   {values.data(), static_cast<std::size_t>(values.size())}, of_values, rules);
}

}  // namespace contact
