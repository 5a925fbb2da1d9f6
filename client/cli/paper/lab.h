#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/link/recording.h"
#include "cli/paper/report.h"

namespace contact::cli {

/// What the run of a scenario came to.
struct Solved : Recording {
  /// The samples of a column of the trajectory, such as `B1.velocity`. Throws Failure (kRunFailed)
  /// if there is none.
  const std::vector<double>& operator[](const std::string& column) const;

  /// The cycles of a contact, in order.
  std::vector<v1::Cycle> Cycles(const std::string& contact) const;
};

/// The samples of runs, one run after the other: the number of the run from 0, if there are
/// several, the time, then these columns below these headers. Throws as Solved::operator[] does.
Data SampleData(const std::string& name, const std::vector<std::string>& columns,
                const std::vector<std::string>& headers, std::span<const Solved> runs);

/// Runs scenarios. The items of the paper are made of nothing but what a lab returns.
class Lab {
 public:
  virtual ~Lab() = default;

  /// Runs all scenarios; the results are in the same order. Throws Failure if a run does not
  /// succeed.
  virtual std::vector<Solved> Solve(const std::vector<v1::Scenario>& scenarios) = 0;

  /// Runs one scenario. Throws as above.
  Solved SolveOne(const v1::Scenario& scenario) { return Solve({scenario}).front(); }
};

/// Runs scenarios as jobs of a server, and deletes the jobs.
class ServerLab : public Lab {
 public:
  /// `client` and `settings` must outlive this object.
  ServerLab(Client& client, const Settings& settings) : client_(client), settings_(settings) {}

  /// Runs as many at the same time as the server does. Throws Failure (kRunFailed) if a run does
  /// not succeed, and as ReadRecording does.
  std::vector<Solved> Solve(const std::vector<v1::Scenario>& scenarios) override;

 private:
  /// Creates a job; returns its name.
  std::string Submit(const v1::Scenario& scenario);
  /// Awaits the end of a job, reads its recording and deletes the job.
  Solved Collect(const std::string& name);

  Client& client_;
  const Settings& settings_;
};

}  // namespace contact::cli
