// The paper's section 3: isolated collisions under the damping laws of its Table 1 and its own.
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cmath>
#include <utility>

#include "cli/paper/cases.h"
#include "cli/paper/figures.h"
#include "cli/paper/items.h"

namespace contact::cli {
namespace {

constexpr v1::Contact::Damping kLaws[] = {v1::Contact::HUNT_CROSSLEY,
                                          v1::Contact::LANKARANI_NIKRAVESH, v1::Contact::FLORES,
                                          v1::Contact::HU_GUO, v1::Contact::PAPER_EQ23};

// ε from 0.05 to 0.95.
std::vector<double> Grid() {
  std::vector<double> grid;
  for (int i = 1; i <= 19; ++i) grid.push_back(i * 0.05);
  return grid;
}

v1::Cycle CycleOf(const Solved& solved, std::size_t contact) {
  return solved.Cycles(fmt::format("{}", contact)).at(0);
}

// Largest relative miss over a part of the grid.
double LargestMiss(const Solved& solved, const std::vector<double>& grid, double from, double to) {
  double largest = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid[i] < from - 1e-9 || grid[i] > to + 1e-9) continue;
    largest = std::max(largest, std::abs(CycleOf(solved, i).restitution_out() / grid[i] - 1));
  }
  return largest;
}

PaperItem DeformationVelocity(Lab& lab) {
  const std::vector<double> restitutions{0.9, 0.7, 0.5, 0.3, 0.1};
  v1::Scenario scenario = Collisions(restitutions, v1::Contact::EXACT);
  scenario.set_end_time_s(1e-3);
  scenario.mutable_output()->Clear();
  scenario.mutable_output()->set_sample_interval_s(1e-6);
  const Solved solved = lab.SolveOne(scenario);
  Data data{"fig3", {"restitution", "deformation [m]", "deformation_velocity [m/s]"}, {}};
  for (std::size_t c = 0; c < restitutions.size(); ++c) {
    const auto& deformation = solved[fmt::format("{}.deformation", c)];
    const auto& rate = solved[fmt::format("{}.deformation_velocity", c)];
    for (std::size_t i = 0; i < deformation.size(); ++i) {
      if (deformation[i] >= 0) data.rows.push_back({restitutions[c], deformation[i], rate[i]});
    }
  }
  return {"fig3",
          "Deformation velocity against deformation at several restitutions",
          {},
          {data},
          DeformationVelocityFigure(data)};
}

// α = 3(1−ε²)/(2(ε²+ε^a)), paper (21), for one a; the exponent is sought from 1.00 down.
v1::Scenario WithExponent(const std::vector<double>& grid, double a) {
  v1::Scenario scenario = Collisions(grid, v1::Contact::MU);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double e = grid[i];
    const double alpha = 1.5 * (1 - e * e) / (e * e + std::pow(e, a));
    v1::Contact* contact = scenario.mutable_contacts(static_cast<int>(i));
    contact->clear_restitution();
    contact->set_mu(alpha * kStudyStiffness / kStudyVelocity);
  }
  return scenario;
}

PaperItem Exponent(const std::vector<double>& grid, Lab& lab) {
  std::vector<v1::Scenario> scenarios;
  std::vector<double> exponents;
  for (int i = 100; i >= 80; --i) {
    exponents.push_back(i * 0.01);
    scenarios.push_back(WithExponent(grid, exponents.back()));
  }
  const std::vector<Solved> solved = lab.Solve(scenarios);
  Data data{"exponent", {"exponent_a", "largest_relative_miss"}, {}};
  std::size_t best = 0;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    data.rows.push_back({exponents[i], LargestMiss(solved[i], grid, 0, 1)});
    if (data.rows[i][1] < data.rows[best][1]) best = i;
  }
  return {"exponent",
          "The exponent a of (21) whose largest miss of the restitution is least",
          {{.what = "a", .published = 0.87, .process = exponents[best], .limit = 1e-9}},
          {data}};
}

Figure DrawPostRestitution(const Data& data) {
  Figure figure = ColumnsFigure(data, "post-restitution coefficient",
                                {"Hunt and Crossley", "Lankarani and Nikravesh", "Flores et al.",
                                 "Hu and Guo", "paper, (23)"});
  figure.title = "Restitution that each law delivers; ideal dotted";
  figure.panels.front().curves.back().mark = Figure::Mark::kDashed;  // As printed.
  AddIdeal(&figure);
  return figure;
}

PaperItem PostRestitution(const std::vector<double>& grid, const std::vector<Solved>& laws) {
  Data data{"fig4", {"restitution_in"}, {}};
  for (const v1::Contact::Damping law : kLaws) {
    data.columns.push_back("restitution_out_" +
                           boost::to_lower_copy(v1::Contact::Damping_Name(law)));
  }
  for (std::size_t i = 0; i < grid.size(); ++i) {
    data.rows.push_back({grid[i]});
    for (const Solved& law : laws) {
      data.rows.back().push_back(CycleOf(law, i).restitution_out());
    }
  }
  const Solved& own = laws.back();
  return {"fig4",
          "Post-restitution against pre-restitution under five laws",
          {{.what = "(23), largest miss at ε 0.05 to 0.30",
            .published = 0.029,
            .process = LargestMiss(own, grid, 0.05, 0.30),
            .limit = 1.5e-3},
           {.what = "(23), largest miss above",
            .published = 0.008,
            .process = LargestMiss(own, grid, 0.35, 0.95),
            .limit = 2e-4,
            .why = "0.0081; the paper says less than 0.008"}},
          {data},
          DrawPostRestitution(data)};
}

PaperItem Coefficients(const std::vector<double>& grid, const std::vector<Solved>& laws) {
  Data data{"fig5", {"restitution_in", "alpha_hu_guo", "alpha_paper_eq23"}, {}};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    data.rows.push_back({grid[i], CycleOf(laws[3], i).alpha(), CycleOf(laws[4], i).alpha()});
  }
  Figure figure =
      ColumnsFigure(data, "hysteresis damping factor coefficient α", {"Hu and Guo", "paper, (23)"});
  figure.title = "Coefficient α of the damping factor";
  for (Figure::Curve& curve : figure.panels.front().curves) {
    curve.mark = Figure::Mark::kLinePoints;
  }
  return {
      "fig5", "Coefficient α against restitution: Hu–Guo and (23)", {}, {data}, std::move(figure)};
}

}  // namespace

std::vector<PaperItem> MakeDampingStudy(Lab& lab) {
  const std::vector<double> grid = Grid();
  std::vector<v1::Scenario> scenarios;
  for (const v1::Contact::Damping law : kLaws) scenarios.push_back(Collisions(grid, law));
  const std::vector<Solved> laws = lab.Solve(scenarios);
  return {DeformationVelocity(lab), PostRestitution(grid, laws), Coefficients(grid, laws),
          Exponent(grid, lab)};
}

}  // namespace contact::cli
