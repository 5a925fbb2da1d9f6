#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cli/paper/lab.h"

namespace contact::cli {

/// A lab without a server: every contact has cycles whose restitution is told by a function, and
/// three samples of each column.
class FakeLab : public Lab {
 public:
  using Restitution = std::function<double(const v1::Scenario&, const v1::Contact&)>;

  /// By default every contact gives back what it is asked for.
  explicit FakeLab(Restitution restitution =
                       [](const v1::Scenario&, const v1::Contact& contact) {
                         return contact.restitution();
                       })
      : restitution_(std::move(restitution)) {}

  std::vector<Solved> Solve(const std::vector<v1::Scenario>& scenarios) override {
    std::vector<Solved> solved;
    for (const v1::Scenario& scenario : scenarios) solved.push_back(Run(scenario));
    asked.insert(asked.end(), scenarios.begin(), scenarios.end());
    return solved;
  }

  std::vector<v1::Scenario> asked;  ///< All scenarios so far.
  int iterations = 5;               ///< Of each cycle.
  v1::Cycle::Status status = v1::Cycle::CONVERGED;

 private:
  static constexpr int kCycles = 11;  // As many as Table 4 compares.

  Solved Run(const v1::Scenario& scenario) const {
    Solved solved;
    *solved.job.mutable_scenario() = scenario;
    solved.columns = {{"time", "time", "s", {0, 1e-3, 2e-3}}};
    for (const v1::Body& body : scenario.bodies()) {
      AddColumns(body.name(), {"position", "velocity"}, &solved);
    }
    for (const v1::Contact& contact : scenario.contacts()) {
      AddColumns(contact.name(),
                 {"deformation", "deformation_velocity", "contact_force", "external_force"},
                 &solved);
      for (int number = 1; number <= kCycles; ++number)
        AddCycle(scenario, contact, number, &solved);
    }
    return solved;
  }

  static void AddColumns(const std::string& name, const std::vector<std::string>& quantities,
                         Solved* solved) {
    for (const std::string& quantity : quantities) {
      solved->columns.push_back({fmt::format("{}.{}", name, quantity), quantity, "", {0, 1, -1}});
    }
  }

  void AddCycle(const v1::Scenario& scenario, const v1::Contact& contact, int number,
                Solved* solved) const {
    v1::Cycle& cycle = *solved->job.add_cycles();
    cycle.set_contact(contact.name());
    cycle.set_number(number);
    cycle.set_status(status);
    cycle.set_iterations(iterations);
    cycle.set_end_time_s(2e-3);
    cycle.set_restitution_in(contact.restitution());
    cycle.set_restitution_out(restitution_(scenario, contact));
    cycle.set_mu(contact.mu());
  }

  Restitution restitution_;
};

}  // namespace contact::cli
