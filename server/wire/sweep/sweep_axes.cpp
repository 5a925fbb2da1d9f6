#include "wire/sweep/sweep_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "base/spelling.h"
#include "wire/rules/rules.h"

namespace contact {
namespace {

bool IsDrawn(const v1::Sweep& sweep) {
  return sweep.combination() == v1::Sweep::RANDOM ||
         sweep.combination() == v1::Sweep::LATIN_HYPERCUBE;
}

void CheckRange(const std::string& name, const v1::Sweep::Range& range, bool drawn,
                std::int32_t max_cells, const Rules& rules) {
  Range allowed{.text = "in the finite numbers"};
  if (name == "log") allowed = {.low = 0, .open = true, .text = "in (0, 1.8e308)"};
  rules.Require(name + ".low", range.low(), allowed);
  rules.Require(name + ".high", range.high(), allowed);
  if (range.low() > range.high()) {
    rules.Break(name + ".high",
                fmt::format("is {}, which is below low, {}", range.high(), range.low()));
  }
  if (drawn && range.count() != 0) {
    rules.Break(name + ".count", "goes only with GRID and ZIP", "give count beside the axes");
  } else if (!drawn && (range.count() < 1 || range.count() > max_cells)) {
    rules.Break(name + ".count",
                fmt::format("is {}; must be in [1, {}]", range.count(), max_cells));
  }
}

void CheckAxis(const v1::Sweep::Axis& axis, bool drawn, std::int32_t max_cells,
               const Rules& rules) {
  rules.RequireShort("label", axis.label(),
                     RuleOf<v1::Sweep::Axis>(v1::Sweep::Axis::kLabelFieldNumber).max_characters());
  const int ways = static_cast<int>(!axis.values().empty()) + static_cast<int>(axis.has_linear()) +
                   static_cast<int>(axis.has_log());
  if (ways != 1) {
    rules.Break("", ways == 0 ? "has no values" : "has values in more than one way",
                "give one of values, linear and log");
  }
  for (int i = 0; i < axis.values_size() && !rules.full(); ++i) {
    if (!std::isfinite(axis.values(i))) {
      rules.Break(fmt::format("values[{}]", i), fmt::format("is {}", axis.values(i)));
    }
  }
  if (axis.has_linear()) CheckRange("linear", axis.linear(), drawn, max_cells, rules);
  if (axis.has_log()) CheckRange("log", axis.log(), drawn, max_cells, rules);
}

void CheckDraw(const v1::Sweep& sweep, std::int32_t max_cells, const Rules& rules) {
  if (IsDrawn(sweep)) {
    if (sweep.count() >= 1 && sweep.count() <= max_cells) return;
    rules.Break("count", fmt::format("is {}; must be in [1, {}]", sweep.count(), max_cells));
    return;
  }
  constexpr char kOnly[] = "goes only with RANDOM and LATIN_HYPERCUBE";
  if (sweep.count() != 0) rules.Break("count", kOnly);
  if (sweep.seed() != 0) rules.Break("seed", kOnly);
}

// Between the ends of a range, u in [0, 1].
double Between(const v1::Sweep::Axis& axis, double u) {
  if (axis.has_linear()) return std::lerp(axis.linear().low(), axis.linear().high(), u);
  const double low = axis.log().low();
  const double high = axis.log().high();
  if (u == 0 || u == 1) return u == 0 ? low : high;
  return std::clamp(std::exp(std::lerp(std::log(low), std::log(high), u)), low, high);
}

// The values that an axis has of its own.
std::vector<double> Listed(const v1::Sweep::Axis& axis) {
  if (!axis.values().empty()) return {axis.values().begin(), axis.values().end()};
  const int count = axis.has_linear() ? axis.linear().count() : axis.log().count();
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(Between(axis, count == 1 ? 0 : i / static_cast<double>(count - 1)));
  }
  return values;
}

// In [0, 1). The distributions of the standard library differ from one to the other.
double Uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

// One value for each cell.
std::vector<double> Drawn(const v1::Sweep& sweep, const v1::Sweep::Axis& axis,
                          std::mt19937_64& random) {
  const auto count = static_cast<std::size_t>(sweep.count());
  std::vector<std::size_t> parts(count);
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  for (std::size_t i = count - 1; i > 0; --i) std::swap(parts[i], parts[random() % (i + 1)]);
  const bool random_only = sweep.combination() == v1::Sweep::RANDOM;
  std::vector<double> values;
  for (const std::size_t part : parts) {
    const double within = Uniform(random);
    const double u =
        random_only ? within : (static_cast<double>(part) + within) / static_cast<double>(count);
    const double entry = u * axis.values_size();
    values.push_back(axis.values().empty() ? Between(axis, u)
                                           : axis.values(static_cast<int>(entry)));
  }
  return values;
}

void CheckAxes(const v1::Sweep& sweep, std::int32_t max_cells, std::vector<Violation>* violations) {
  const Rules rules(violations);
  rules.RequireKnown("combination", sweep.combination());
  CheckDraw(sweep, max_cells, rules);
  if (sweep.axes().empty()) rules.Break("axes", "are missing", "name a field and its values");
  const int most = RuleOf<v1::Sweep>(v1::Sweep::kAxesFieldNumber).max_entries();
  if (!rules.RequireAtMost("axes", sweep.axes_size(), most)) return;
  for (int i = 0; i < sweep.axes_size(); ++i) {
    CheckAxis(sweep.axes(i), IsDrawn(sweep), max_cells, Rules(violations, "axes", i));
  }
}

}  // namespace

SweepAxes::SweepAxes(const v1::Sweep& sweep, std::int32_t max_cells,
                     std::vector<Violation>* violations)
    : grid_(sweep.combination() != v1::Sweep::ZIP && !IsDrawn(sweep)) {
  const std::size_t before = violations->size();
  CheckAxes(sweep, max_cells, violations);
  if (violations->size() > before) return;

  std::mt19937_64 random(static_cast<std::uint64_t>(sweep.seed()));
  double cells = 1;
  for (int i = 0; i < sweep.axes_size(); ++i) {
    const v1::Sweep::Axis& axis = sweep.axes(i);
    values_.push_back(IsDrawn(sweep) ? Drawn(sweep, axis, random) : Listed(axis));
    const std::size_t size = values_.back().size();
    cells = grid_ ? cells * static_cast<double>(size) : static_cast<double>(size);
    if (!grid_ && size != values_.front().size()) {
      Rules(violations, "axes", i)
          .Break("",
                 fmt::format("has {}, but axes[0] has {}",
                             Count(static_cast<std::int64_t>(size), "value", "values"),
                             values_.front().size()),
                 "axes of a ZIP are equally long");
    }
  }
  if (cells > max_cells) {
    Rules(violations)
        .Break("axes", fmt::format("make {} cells; must make at most {}", cells, max_cells));
  }
  if (violations->size() == before) cells_ = static_cast<std::int32_t>(cells);
}

std::vector<double> SweepAxes::Values(std::int32_t cell) const {
  std::vector<double> values(values_.size());
  auto rest = static_cast<std::size_t>(cell);
  for (std::size_t i = values_.size(); i-- > 0;) {
    const std::size_t size = values_[i].size();
    values[i] = values_[i][grid_ ? rest % size : rest];
    if (grid_) rest /= size;
  }
  return values;
}

}  // namespace contact
