#pragma once

#include <optional>
#include <string>

#include "cli/link/client.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// A job of the server, by ID or jobs/ID. Throws CallFailure.
v1::Job GetJob(Client& client, const std::string& job);

/// A sweep of the server, by ID or jobs/ID. Throws CallFailure, and Failure (kUsage) if the job is
/// no sweep.
v1::Job GetSweep(Client& client, const std::string& job);

/// Finds jobs on the server, or in files that hold what `describe -o json` printed.
class JobSource {
 public:
  /// Connects when a job of the server is first asked for. `settings` must outlive this object.
  explicit JobSource(const Settings& settings) : settings_(settings) {}

  /// `name` is a file if there is one of that name, else what FindJob takes. Throws Failure:
  /// kInvalidScenario if the file holds no job, or what FindJob and the server answer.
  v1::Job Get(const std::string& name);

 private:
  const Settings& settings_;
  /// None until a job of the server is asked for.
  std::optional<Client> client_;
};

}  // namespace contact::cli
