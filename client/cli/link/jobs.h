#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/link/client.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// `jobs/ID` for `jobs/ID` or `ID`.
std::string JobName(const std::string& job);

/// `ID` for `jobs/ID`.
std::string ShortName(const std::string& name);

/// A random UUID, to be the request_id of one CreateJob call and its retries.
std::string RandomRequestId();

/// Reads KEY=VALUE texts of --label; the last value of a key counts. Throws Failure (kUsage) for a
/// text of another form.
std::map<std::string, std::string> ParseLabels(const std::vector<std::string>& texts);

/// The name `jobs/ID` of the job that `text` means: an ID or `jobs/ID`; the beginning of an ID that
/// only one job of the server has; `last`, the newest job; or `last~N`, the Nth before it. Asks the
/// server unless the ID is whole. A text with which no ID begins is taken for an ID, so that the
/// server says that there is no such job. Throws Failure: kUsage with the candidates if several IDs
/// begin so, or for a bad N; kNotFound if the server has fewer jobs. Throws CallFailure.
std::string FindJob(Client& client, const std::string& text);

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

  /// `name` is a file if there is one of that name, or if it has a dot, else what FindJob takes.
  /// Throws Failure: kLocal if there is no such file, kInvalidScenario if it holds no job, or what
  /// FindJob and the server answer.
  v1::Job Get(const std::string& name);

 private:
  const Settings& settings_;
  /// None until a job of the server is asked for.
  std::optional<Client> client_;
};

}  // namespace contact::cli
