#include "cli/verbs/sweep/sweep_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/base/scalar.h"
#include "cli/base/table.h"
#include "cli/input/sweep_rules.h"
#include "cli/text/render_job.h"
#include "cli/text/sweep/sweep_cells.h"
#include "wire/sweep/axis_words.h"
#include "wire/sweep/sweep_fields.h"

namespace contact::cli {
namespace {

// One FIELD=VALUE of the text that names a cell.
struct Choice {
  int axis = 0;
  double value = 0;
};

// The axis of this name, or whose name ends in it after a point or colon. Throws Failure (kUsage)
// if there is none.
int AxisOf(const v1::Sweep& sweep, const std::string& text) {
  std::vector<int> found;
  std::vector<std::string_view> axes;
  std::vector<std::string_view> names;  // The axes, and the last part of each.
  for (int i = 0; i < sweep.axes_size(); ++i) {
    const std::string& name = AxisName(sweep.axes(i));
    if (name == text) return i;
    if (name.ends_with("." + text) || name.ends_with(":" + text)) found.push_back(i);
    axes.push_back(name);
    names.push_back(name);
    names.push_back(std::string_view(name).substr(name.find_last_of(".:") + 1));
  }
  if (found.size() == 1) return found.front();
  throw Failure(
      ExitCode::kUsage,
      WithHint(fmt::format("{} is no axis of this sweep", Quoted(text)),
               DidYouMean(text, names, fmt::format("axes are {}", fmt::join(axes, ", ")))));
}

// One FIELD=VALUE. The value is a number, or the word of an enum. Throws Failure (kUsage) for a
// text that is none.
Choice ReadChoice(const v1::Sweep& sweep, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) {
    const int axis = AxisOf(sweep, text.substr(0, equals));
    const auto value = AxisValue(sweep.axes(axis).field(), text.substr(equals + 1));
    if (value) return {axis, *value};
  }
  throw Failure(ExitCode::kUsage,
                fmt::format("{}: expected the number of a cell, or FIELD=VALUE,… such as {}=0.5",
                            Quoted(text), AxisName(sweep.axes(0))));
}

std::vector<Choice> ReadChoices(const v1::Sweep& sweep, const std::string& text) {
  std::vector<Choice> choices;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    choices.push_back(ReadChoice(sweep, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return choices;
}

// True if the values are equal to six digits, as tables show them.
bool Near(double a, double b) {
  return std::abs(a - b) <= 1e-5 * std::max(std::abs(a), std::abs(b));
}

bool Has(const v1::SweepCell& cell, const std::vector<Choice>& choices) {
  return std::ranges::all_of(choices, [&cell](const Choice& choice) {
    return Near(cell.values(choice.axis), choice.value);
  });
}

// Throws Failure (kUsage) with the nearest value if no cell has the value of the choice.
void RequireValue(const v1::Sweep& sweep, const SweepCells& cells, const Choice& choice) {
  const auto distance = [&choice](const SweepCells::value_type& cell) {
    return std::abs(cell.second.values(choice.axis) - choice.value);
  };
  const double nearest = std::ranges::min_element(cells, {}, distance)->second.values(choice.axis);
  if (Near(nearest, choice.value)) return;
  const v1::Sweep::Axis& axis = sweep.axes(choice.axis);
  throw Failure(ExitCode::kUsage,
                fmt::format("no cell has {}={}{}", AxisName(axis), AxisText(axis, choice.value),
                            AxisWord(axis, nearest).empty()
                                ? fmt::format("; the nearest value is {}", AxisText(axis, nearest))
                                : ""));  // No word is near another.
}

}  // namespace

const v1::SweepCell& FindCell(const v1::Sweep& sweep, const SweepCells& cells,
                              const std::string& text) {
  if (const auto index = ParseInteger<int>(text)) {
    const auto found = cells.find(*index);
    if (found != cells.end()) return found->second;
    throw Failure(
        ExitCode::kUsage,
        fmt::format("there is no cell {}; {}", *index,
                    cells.empty() ? std::string("the sweep has none")
                                  : fmt::format("the last is {}", cells.rbegin()->first)));
  }
  const std::vector<Choice> choices = ReadChoices(sweep, text);
  std::vector<const v1::SweepCell*> found;
  for (const auto& [index, cell] : cells) {
    if (Has(cell, choices)) found.push_back(&cell);
  }
  if (found.size() == 1) return *found.front();
  if (found.size() > 1) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{} cells have {}: {}, {}, …; name more fields", found.size(), text,
                              found[0]->index(), found[1]->index()));
  }
  for (const Choice& choice : choices) {
    if (!cells.empty()) RequireValue(sweep, cells, choice);
  }
  throw Failure(ExitCode::kUsage, fmt::format("no cell has {} together", text));
}

std::string RenderCell(const v1::Job& job, const v1::SweepCell& cell, const Style& style) {
  const v1::Sweep& sweep = job.sweep();
  const bool failed = cell.state() == v1::Job::FAILED;
  std::string text =
      fmt::format("{}  {}{}\n",
                  Paint(fmt::format("{} cell {}", job.name(), cell.index()), Tone::kStrong, style),
                  Paint(v1::Job::State_Name(cell.state()), ToneOf(cell.state()), style),
                  failed ? "" : fmt::format("  convergence {}", VerdictText(cell)));
  if (failed) {
    text += Wrap(fmt::format("{}: {}\n", cell.state_reason(), cell.message()), style);
  }
  Table values({{"FIELD"}, {"VALUE", true}});
  for (int i = 0; i < cell.values_size(); ++i) {
    values.Add({AxisName(sweep.axes(i)), AxisText(sweep.axes(i), cell.values(i))});
  }
  Table metrics({{"METRIC"}, {"VALUE", true}});
  for (int i = 0; i < sweep.metrics_size(); ++i) {
    metrics.Add({sweep.metrics(i), MetricText(cell, i, 10)});
  }
  return text + "\n" + values.Text(style) + "\n" + metrics.Text(style);
}

v1::Scenario ScenarioOf(const v1::Sweep& sweep, const v1::SweepCell& cell) {
  std::vector<Violation> violations;
  SweepFields fields(sweep, &violations);
  std::vector<double> values(cell.values().begin(), cell.values().end());
  return fields.Set(values);
}

}  // namespace contact::cli
