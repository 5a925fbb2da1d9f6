#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/client.h"
#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// What a scenario came to.
struct Solved {
  v1::Job job;  ///< With its ledger.
  /// The trajectory by column name, such as `time` or `B1.velocity`; empty if none was recorded.
  std::map<std::string, std::vector<double>> series;

  /// A column. Throws std::out_of_range.
  const std::vector<double>& operator[](const std::string& column) const {
    return series.at(column);
  }
  /// The ledger's rows of a contact, in order.
  std::vector<v1::Cycle> Cycles(const std::string& contact) const;
};

/// Has scenarios solved by a server.
class Lab {
 public:
  explicit Lab(Client& client) : client_(client) {}

  /// Solves all of them, as far as the server can at the same time, in the order given. Their jobs
  /// are deleted. Throws Failure if one does not end well.
  std::vector<Solved> Solve(const std::vector<v1::Scenario>& scenarios);
  Solved Solve(const v1::Scenario& scenario) { return Solve(std::vector{scenario}).front(); }

 private:
  std::string Submit(const v1::Scenario& scenario);
  Solved Collect(const std::string& name);

  Client& client_;
};

}  // namespace contact::cli
