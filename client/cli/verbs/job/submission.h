#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/settings/job_options.h"
#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// The flags of a command that submits a job: --label, --request-id, and those of JobOptions.
class Submission {
 public:
  /// Adds the flags. `what` is submitted, `scenario` or `sweep`, for the help. This object must
  /// outlive the parsing.
  void AddTo(CLI::App& command, std::string_view what);

  /// A request with the values of the flags, still without a scenario or sweep. Its request ID is
  /// random unless the user gave one. Throws Failure (kUsage) for a label or an option that cannot
  /// be read.
  v1::CreateJobRequest Request() const;

 private:
  std::vector<std::string> labels_;  // KEY=VALUE
  std::string request_id_;           // Empty: not given.
  JobOptions options_;
};

}  // namespace contact::cli
