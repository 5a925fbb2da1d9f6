// The paper's 6.2: the ball on a spring that is pushed against a wall.
#include <fmt/format.h>

#include <utility>

#include "cli/figures/run/presets.h"
#include "cli/paper/cases.h"
#include "cli/paper/items.h"

namespace contact::cli {
namespace {

constexpr char kContact[] = "ball-wall";
constexpr double kStiffness = 1.8e7;  // [N/m^1.5]
constexpr double kTolerance = 0.005;  // ξ of the paper.

// Table 4: corrections for the first eleven cycles, by (29) and by (31) before there is a bracket.
constexpr int kByNewton[] = {0, 0, 1, 1, 5, 1, 1, 1, 1, 1, 0};
constexpr int kByRatio[] = {0, 0, 7, 14, 22, 13, 18, 15, 10, 7, 4};
// Fig. 15: μ/k of the first ten, printed as α [s/m].
constexpr double kFactors[] = {0.0123, 0.0176, 0.0235, 0.0326, 0.0460,
                               0.0581, 0.0739, 0.0894, 0.0990, 0.1044};

PaperItem Table4(const std::vector<Solved>& runs) {
  PaperItem item{"table4", "Corrections of μ for each of the first eleven cycles", {}, {}};
  const auto add = [&](const char* rule, const int(&published)[11], const Solved& run, double limit,
                       const char* why) {
    const std::vector<v1::Cycle> cycles = run.Cycles(kContact);
    const std::vector<v1::Cycle> exact = runs[2].Cycles(kContact);
    for (std::size_t i = 0; i < std::size(published); ++i) {
      item.numbers.push_back({.what = fmt::format("{}, cycle {}", rule, i + 1),
                              .published = static_cast<double>(published[i]),
                              .process = static_cast<double>(cycles.at(i).iterations()),
                              .converged = static_cast<double>(exact.at(i).iterations()),
                              .limit = limit,
                              .why = published[i] == cycles.at(i).iterations() ? "" : why});
    }
  };
  add("(27) or (29)", kByNewton, runs[0], 0, "");
  add("(27) or (31)", kByRatio, runs[1], 3,
      "published count not reached; (31) creeps, so that little changes its count");
  return item;
}

std::vector<Comparison> Factors(const std::vector<Solved>& runs) {
  std::vector<Comparison> numbers;
  for (std::size_t i = 0; i < std::size(kFactors); ++i) {
    numbers.push_back({.what = fmt::format("μ/k of cycle {} [s/m]", i + 1),
                       .published = kFactors[i],
                       .process = runs[0].Cycles(kContact).at(i).mu() / kStiffness,
                       .converged = runs[2].Cycles(kContact).at(i).mu() / kStiffness,
                       .limit = 0.05 * kFactors[i],
                       .why = "any μ within ξ = 0.5 % of ε counts as found; printed as α"});
  }
  return numbers;
}

// Where cycles start and end: the marks o and × of the paper.
Data Marks(const std::string& name, const Solved& run) {
  Data data{name,
            {"start_time [s]", "end_time [s]", "deformation_start [m]", "deformation_end [m]",
             "mu_over_k [s/m]"},
            {}};
  for (const v1::Cycle& cycle : run.Cycles(kContact)) {
    data.rows.push_back({cycle.start_time_s(), cycle.end_time_s(), cycle.delta_start_m(),
                         cycle.delta_end_m(), cycle.mu_over_k_s_per_m()});
  }
  return data;
}

// Names the curves in the key as the paper does. Each mark is named once.
void NameCurves(Figure* figure) {
  bool starts = false;
  bool ends = false;
  for (Figure::Curve& curve : figure->panels.front().curves) {
    if (curve.mark == Figure::Mark::kStart && !std::exchange(starts, true)) {
      curve.label = "start of a cycle", curve.keyed = true;
    } else if (curve.mark == Figure::Mark::kEnd && !std::exchange(ends, true)) {
      curve.label = "end of a cycle", curve.keyed = true;
    } else if (curve.mark == Figure::Mark::kDashed) {
      curve.label = "equivalent external force";
    } else if (curve.label == kContact) {
      curve.label = "contact force";
    }
  }
}

PaperItem MakeItem(const std::string& id, const std::string& preset, const std::string& title,
                   const Solved& run, const std::vector<std::string>& columns,
                   const std::vector<std::string>& headers) {
  Figure figure = PresetFigure(preset, run);
  figure.title = title;
  NameCurves(&figure);
  return {id,
          title,
          {},
          {SampleData(id, columns, headers, {&run, 1}), Marks(id + "_cycles", run)},
          std::move(figure)};
}

}  // namespace

std::vector<PaperItem> MakeSpringItems(Lab& lab) {
  v1::Scenario newton = SpringWall();
  SolveAsPaper(&newton, v1::Solver::PAPER_NEWTON, kTolerance);
  v1::Scenario ratio = SpringWall();
  SolveAsPaper(&ratio, v1::Solver::PAPER_RATIO, kTolerance);
  const std::vector<Solved> runs = lab.Solve({newton, ratio, SpringWall()});
  const Solved& run = runs[0];
  std::vector<PaperItem> items;
  items.push_back(MakeItem("fig14", "position", "Position of the ball", run, {"ball.position"},
                           {"position [m]"}));
  items.push_back(MakeItem("fig15", "force", "Contact force and equivalent external force", run,
                           {"ball-wall.contact_force", "ball-wall.external_force"},
                           {"contact_force [N]", "external_force [N]"}));
  items.back().numbers = Factors(runs);
  items.push_back(MakeItem("fig16", "velocity", "Velocity of the ball", run, {"ball.velocity"},
                           {"velocity [m/s]"}));
  items.push_back(MakeItem("fig17", "hysteresis", "Hysteresis loops: force against deformation",
                           run, {"ball-wall.deformation", "ball-wall.contact_force"},
                           {"deformation [m]", "contact_force [N]"}));
  items.push_back(Table4(runs));
  return items;
}

}  // namespace contact::cli
