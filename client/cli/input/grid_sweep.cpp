#include "cli/input/grid_sweep.h"

#include <fmt/format.h>

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/scalar.h"
#include "cli/input/scenario_file.h"
#include "cli/input/sweep_rules.h"
#include "wire/rules/field_path.h"

namespace contact::cli {
namespace {

[[noreturn]] void FailAxis(const std::string& axis, bool drawn) {
  throw Failure(
      ExitCode::kUsage,
      fmt::format("--grid {}: expected FIELD={} or FIELD=A,B,C", axis,
                  drawn ? "LOW:HIGH, which --random and --lhs draw from," : "FIRST:LAST:COUNT"));
}

std::vector<std::string> Split(const std::string& text, char separator) {
  const std::string packed = boost::erase_all_copy(text, " ");
  std::vector<std::string> parts;
  boost::split(parts, packed, [separator](char c) { return c == separator; });
  return parts;
}

// Rounded to 15 digits: 0.9 instead of 0.8999999999999999.
double Rounded(double value) { return ParseNumber(fmt::format("{:.15g}", value)).value_or(value); }

// Adds `count` values in equal steps, which may also fall.
void AddSteps(double first, double last, int count, v1::Sweep::Axis* axis) {
  for (int i = 0; i < count; ++i) {
    axis->add_values(Rounded(std::lerp(first, last, count == 1 ? 0.0 : 1.0 * i / (count - 1))));
  }
}

// Gives an axis over a variable the fields of the variable.
void SetFields(const std::string& text, const VariableFields& variables, v1::Sweep::Axis* axis) {
  const std::optional<VariableAxis> found = FindVariableAxis(axis->field(), variables);
  if (!found) return;
  if (found->fields.empty()) {
    throw Failure(ExitCode::kUsage,
                  WithHint(fmt::format("--grid {}: {}", text, found->problem), found->hint));
  }
  axis->set_label(axis->field());
  axis->set_field(found->fields.front());
  axis->mutable_also()->Assign(found->fields.begin() + 1, found->fields.end());
}

v1::Sweep::Axis ReadAxis(const std::string& text, bool drawn, const VariableFields& variables) {
  constexpr double kMostSteps = 10'000;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) FailAxis(text, drawn);
  v1::Sweep::Axis axis;
  axis.set_field(text.substr(0, equals));
  SetFields(text, variables, &axis);
  const bool range = text.find(':', equals) != std::string::npos;
  std::vector<double> numbers;
  for (const std::string& part : Split(text.substr(equals + 1), range ? ':' : ',')) {
    const std::optional<double> number = range ? ParseNumber(part) : AxisValue(axis.field(), part);
    if (!number) FailAxis(text, drawn);
    numbers.push_back(*number);
  }
  if (!range) {
    axis.mutable_values()->Assign(numbers.begin(), numbers.end());
  } else if (drawn && numbers.size() == 2) {
    axis.mutable_linear()->set_low(numbers[0]);
    axis.mutable_linear()->set_high(numbers[1]);
  } else if (!drawn && numbers.size() == 3 && numbers[2] >= 1 && numbers[2] <= kMostSteps) {
    AddSteps(numbers[0], numbers[1], static_cast<int>(numbers[2]), &axis);
  } else {
    FailAxis(text, drawn);
  }
  return axis;
}

// A broken rule at the axis that its field belongs to, if it belongs to one.
Diagnostic Place(const Violation& violation, const std::vector<std::string>& axes) {
  std::string source = "--grid";
  const std::vector<PathStep> path = ParsePath(violation.field);
  if (!path.empty() && path.front().name == "axes" && path.front().index) {
    source += " " + axes.at(static_cast<std::size_t>(*path.front().index));
  }
  return {.source = std::move(source),
          .field = violation.field,
          .what = violation.description,
          .hint = violation.hint};
}

}  // namespace

v1::Sweep MakeGrid(const ScenarioFile& base, const std::vector<std::string>& axes,
                   const std::vector<std::string>& metrics, const DrawnCells& drawn) {
  v1::Sweep sweep;
  for (const std::string& axis : axes) {
    *sweep.add_axes() = ReadAxis(axis, drawn.count > 0, base.variables());
  }
  for (const std::string& metric : metrics) sweep.add_metrics(metric);
  if (metrics.empty()) sweep.add_metrics("iterations");
  if (drawn.count > 0) {
    sweep.set_combination(drawn.latin_hypercube ? v1::Sweep::LATIN_HYPERCUBE : v1::Sweep::RANDOM);
    sweep.set_count(drawn.count);
    sweep.set_seed(drawn.seed);
  }
  RequireNone(base.diagnostics());
  *sweep.mutable_base() = base.scenario();
  RequireNone(CheckSweep(sweep, &base,
                         [&axes](const Violation& violation) { return Place(violation, axes); }));
  TellAdvice(base);
  return sweep;
}

}  // namespace contact::cli
