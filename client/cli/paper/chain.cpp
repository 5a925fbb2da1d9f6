// The paper's 6.1: the triple-ball chain.
#include <fmt/format.h>

#include <utility>

#include "cli/paper/cases.h"
#include "cli/paper/figures.h"
#include "cli/paper/items.h"

namespace contact::cli {
namespace {

constexpr double kVelocity = 0.2;  // Of the first ball [m/s].
constexpr const char* kContacts[] = {"B1-B2", "B2-B3"};
constexpr char kRuns[] =
    "run 0 is Hunt and Crossley, 1 Flores et al., 2 the described method as published, "
    "3 the same converged";

// A model of Figs. 10 to 12 and Table 2. The named laws give both contacts the factor for 0.8.
struct Model {
  const char* name;
  v1::Contact::Damping damping;
};
constexpr Model kModels[] = {{"Hunt and Crossley", v1::Contact::HUNT_CROSSLEY},
                             {"Flores et al.", v1::Contact::FLORES},
                             {"Described method", v1::Contact::ENERGY_RESTITUTION}};

bool Iterated(const Model& model) { return model.damping == v1::Contact::ENERGY_RESTITUTION; }

v1::Scenario AsPublished(const Model& model) {
  v1::Scenario scenario = TripleChain(0.8, 0.7);
  if (Iterated(model)) {
    UseReferenceVelocity(&scenario, kVelocity);
  } else {
    UseLaw(&scenario, model.damping, 0.8, kVelocity);
  }
  SolveAsPaper(&scenario, v1::Solver::PAPER_RATIO, 0.01);
  SplitAtPeakForce(&scenario);
  return scenario;
}

v1::Scenario Converged(const Model& model) {
  v1::Scenario scenario = TripleChain(0.8, 0.7);
  if (!Iterated(model)) UseLaw(&scenario, model.damping, 0.8, kVelocity);
  return scenario;
}

// Restitution that the paper's Table 2 prints for each model and contact.
constexpr double kPublished[3][2] = {{0.8453, 0.8661}, {0.8020, 0.8306}, {0.8067, 0.7059}};

PaperItem Table2(const std::vector<Solved>& published, const std::vector<Solved>& converged) {
  PaperItem item{"table2", "Restitution that each model delivers", {}, {}};
  for (std::size_t m = 0; m < std::size(kModels); ++m) {
    for (std::size_t c = 0; c < std::size(kContacts); ++c) {
      item.numbers.push_back(
          {.what = fmt::format("{}, ε_out {}", kModels[m].name, kContacts[c]),
           .published = kPublished[m][c],
           .process = published[m].Cycles(kContacts[c]).at(0).restitution_out(),
           .converged = converged[m].Cycles(kContacts[c]).at(0).restitution_out(),
           .limit = 7e-4,
           .why = "published with the phases split at the largest force, not at δ̇ = 0"});
    }
  }
  item.numbers.push_back({.what = "Described method, passes",
                          .published = 6,
                          .process = 1.0 + published[2].Cycles("B1-B2").at(0).iterations(),
                          .converged = 1.0 + converged[2].Cycles("B1-B2").at(0).iterations(),
                          .limit = 0});
  return item;
}

// Passes that a run took; NaN if a cycle did not converge.
double Passes(const Solved& solved) {
  for (const v1::Cycle& cycle : solved.job.cycles()) {
    if (cycle.status() != v1::Cycle::CONVERGED) return kNoNumber;
  }
  return 1.0 + solved.job.cycles(0).iterations();
}

// A cell of Table 3: velocity of the first ball [m/s], and ε of both contacts.
struct Cell {
  double velocity;
  double restitution;
};

std::vector<Cell> Table3Cells() {
  std::vector<Cell> cells;
  for (int v = 1; v <= 5; ++v) {
    for (int e = 95; e >= 50; e -= 5) cells.push_back({v / 10.0, e / 100.0});
  }
  return cells;
}

// The scenarios of a cell: by the process of the paper, and by the default solver.
std::vector<v1::Scenario> Table3Scenarios(const Cell& cell) {
  v1::Scenario exact = TripleChain(cell.restitution, cell.restitution, cell.velocity);
  exact.set_end_time_s(1e-2);
  RecordLedgerOnly(&exact);
  v1::Scenario paper = exact;
  UseReferenceVelocity(&paper, cell.velocity);
  SolveAsPaper(&paper, v1::Solver::PAPER_RATIO, 0.01);
  SplitAtPeakForce(&paper);
  return {paper, exact};
}

constexpr char kTable3[] =
    "The cells of the printed Table 3 cannot be told apart in the text of the paper, and no map of "
    "them was published: there is nothing to compare these numbers with.";

PaperItem Table3(Lab& lab) {
  const std::vector<Cell> cells = Table3Cells();
  std::vector<v1::Scenario> scenarios;
  for (const Cell& cell : cells) {
    for (v1::Scenario& scenario : Table3Scenarios(cell)) scenarios.push_back(std::move(scenario));
  }
  const std::vector<Solved> solved = lab.Solve(scenarios);
  Data data{"table3",
            {"velocity [m/s]", "restitution", "passes_published_process", "passes_converged"},
            {}};
  PaperItem item{"table3",
                 "Passes until the chain's restitutions are met: published process to 1 %, ours "
                 "to 1e-8",
                 {},
                 {}};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto [velocity, restitution] = cells[i];
    const double paper = Passes(solved[2 * i]);
    const double ours = Passes(solved[2 * i + 1]);
    data.rows.push_back({velocity, restitution, paper, ours});
    item.numbers.push_back({.what = fmt::format("v {:.1f} m/s, ε {:.2f}", velocity, restitution),
                            .process = paper,
                            .converged = ours});
  }
  item.data.push_back(std::move(data));
  item.note = kTable3;
  return item;
}

}  // namespace

std::vector<PaperItem> MakeChainFigures(Lab& lab) {
  std::vector<v1::Scenario> scenarios;
  for (const Model& model : kModels) scenarios.push_back(AsPublished(model));
  scenarios.push_back(Converged(kModels[2]));
  const std::vector<Solved> runs = lab.Solve(scenarios);
  const auto item = [&](const std::string& id, const std::string& title, Figure drawn,
                        const std::vector<std::string>& columns,
                        const std::vector<std::string>& headers) {
    drawn.title = title;
    Data samples = SampleData(id, columns, headers, runs);
    samples.note = kRuns;
    return PaperItem{id, title, {}, {std::move(samples)}, std::move(drawn)};
  };
  const auto models = [&](const std::string& preset) {
    return ModelsFigure(preset, {&runs[0], &runs[1], &runs[2]},
                        {kModels[0].name, kModels[1].name, kModels[2].name});
  };
  return {
      item("fig9", "Velocities of the balls", VelocitiesFigure(runs[2]),
           {"B1.velocity", "B2.velocity", "B3.velocity"},
           {"velocity_b1 [m/s]", "velocity_b2 [m/s]", "velocity_b3 [m/s]"}),
      item("fig10", "Contact forces", models("force"),
           {"B1-B2.contact_force", "B2-B3.contact_force"}, {"force_b12 [N]", "force_b23 [N]"}),
      item("fig11", "Deformation velocities", models("deformation-velocity"),
           {"B1-B2.deformation_velocity", "B2-B3.deformation_velocity"},
           {"deformation_velocity_b12 [m/s]", "deformation_velocity_b23 [m/s]"}),
      item("fig12", "Hysteresis loops: force against deformation", models("hysteresis"),
           {"B1-B2.deformation", "B1-B2.contact_force", "B2-B3.deformation", "B2-B3.contact_force"},
           {"deformation_b12 [m]", "force_b12 [N]", "deformation_b23 [m]", "force_b23 [N]"})};
}

std::vector<PaperItem> MakeChainTables(Lab& lab) {
  std::vector<v1::Scenario> scenarios;
  for (const Model& model : kModels) scenarios.push_back(AsPublished(model));
  for (const Model& model : kModels) scenarios.push_back(Converged(model));
  for (v1::Scenario& scenario : scenarios) RecordLedgerOnly(&scenario);
  const std::vector<Solved> solved = lab.Solve(scenarios);
  return {Table2({solved.begin(), solved.begin() + 3}, {solved.begin() + 3, solved.end()}),
          Table3(lab)};
}

}  // namespace contact::cli
