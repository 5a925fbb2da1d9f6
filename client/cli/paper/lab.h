#pragma once

#include <string>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// What a scenario came to.
struct Solved : Recording {
  /// The values of a column of the trajectory, such as `B1.velocity`. Throws Failure if there is
  /// none.
  const std::vector<double>& operator[](const std::string& column) const;
  /// The ledger's rows of a contact, in order.
  std::vector<v1::Cycle> Cycles(const std::string& contact) const;
};

/// Has scenarios solved by a server.
class Lab {
 public:
  Lab(Client& client, const Settings& settings) : client_(client), settings_(settings) {}

  /// Solves all of them, as far as the server can at the same time, in the order given. Their jobs
  /// are deleted. Throws Failure if one does not end well.
  std::vector<Solved> Solve(const std::vector<v1::Scenario>& scenarios);
  Solved Solve(const v1::Scenario& scenario) { return Solve(std::vector{scenario}).front(); }

 private:
  std::string Submit(const v1::Scenario& scenario);
  Solved Collect(const std::string& name);

  Client& client_;
  const Settings& settings_;
};

}  // namespace contact::cli
