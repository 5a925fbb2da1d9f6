#include "wire/scenario/force_table_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace contact {
namespace {

using Numbers = google::protobuf::RepeatedField<double>;

// Whether each number is in its range and larger than the one before.
bool CheckGrowth(const Numbers& numbers, int field, const Rules& rules) {
  const auto& of = *v1::ForceTable::descriptor()->FindFieldByNumber(field);
  const Range range = RangeOf(of);
  double before = 0;
  for (int i = 0; i < numbers.size() && !rules.full(); ++i) {
    const double number = numbers[i];
    if (!range.Contains(number)) {
      rules.Require(fmt::format("{}[{}]", of.name(), i), number, range);
      return false;
    }
    if (!(number > before)) {
      rules.Break(fmt::format("{}[{}]", of.name(), i),
                  fmt::format("is {}; must be above {}, the one before", number, before),
                  "a plateau is a slight slope");
      return false;
    }
    before = number;
  }
  return true;
}

// As many of both as rules allow.
bool CheckCount(const v1::ForceTable& message, const Rules& rules) {
  const int points = message.deformations_m_size(), forces = message.forces_n_size();
  const int most = RuleOf<v1::ForceTable>(v1::ForceTable::kDeformationsMFieldNumber).max_entries();
  if (points == 0) {
    rules.Break("deformations_m", "is missing", "one point is a straight line");
    return false;
  }
  if (forces != points) {
    rules.Break("forces_n", fmt::format("has {} entries; deformations_m has {}", forces, points),
                "give a force for each deformation");
    return false;
  }
  return rules.RequireAtMost("deformations_m", points, most);
}

ForceTable::Unloading DecodeUnloading(const v1::ForceTable& message, double steepest,
                                      const Rules& rules) {
  using Field = v1::ForceTable;
  ForceTable::Unloading unloading;
  if (message.has_unloading_stiffness_n_per_m()) {
    unloading.stiffness = rules.Check<Field>(Field::kUnloadingStiffnessNPerMFieldNumber,
                                             message.unloading_stiffness_n_per_m());
    if (unloading.stiffness < steepest * (1 - 1e-12)) {
      rules.Break("unloading_stiffness_n_per_m",
                  fmt::format("is {}; must be at least {}, the steepest slope of the points",
                              unloading.stiffness, steepest),
                  "a way back above the way there would make energy");
    }
  }
  if (!message.has_unloading_stiffening_per_m()) return unloading;
  unloading.stiffening = rules.Check<Field>(Field::kUnloadingStiffeningPerMFieldNumber,
                                            message.unloading_stiffening_per_m());
  if (!message.has_unloading_stiffness_n_per_m()) {
    rules.Break("unloading_stiffening_per_m", "is given without unloading_stiffness_n_per_m",
                "it adds to that stiffness");
  }
  return unloading;
}

}  // namespace

ForceTable DecodeForceTable(const v1::ForceTable& message, const Rules& rules) {
  const auto &deformations = message.deformations_m(), &forces = message.forces_n();
  const bool pairs = CheckCount(message, rules);
  const bool deepens = CheckGrowth(deformations, v1::ForceTable::kDeformationsMFieldNumber, rules);
  const bool rises = CheckGrowth(forces, v1::ForceTable::kForcesNFieldNumber, rules);
  const bool right = pairs && deepens && rises;
  std::vector<ForceTable::Point> points;
  double steepest = 0;
  ForceTable::Point before{0, 0};
  for (int i = 0; right && i < forces.size(); ++i) {
    const ForceTable::Point point{deformations[i], forces[i]};
    steepest =
        std::max(steepest, (point.force - before.force) / (point.deformation - before.deformation));
    points.push_back(before = point);
  }
  const ForceTable::Unloading unloading = DecodeUnloading(message, steepest, rules);
  return right ? ForceTable(points, unloading) : ForceTable();
}

}  // namespace contact
