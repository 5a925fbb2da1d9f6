#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contact/v1/job_service.pb.h"

namespace contact::cli {

/// The flags of a command that submits a job: --label, --request-id, and those for priority, budget
/// and time to live.
class Submission {
 public:
  /// Adds the flags. `what` is submitted, `scenario` or `sweep`, for the help. This object must
  /// outlive the parsing.
  void AddTo(CLI::App& command, std::string_view what);

  /// A request with the values of the flags, still without a scenario or sweep. Its request ID is
  /// random unless the user gave one. Throws Failure (kUsage) for a label, time or number that
  /// cannot be read.
  v1::CreateJobRequest Request() const;

 private:
  std::vector<std::string> labels_;  // KEY=VALUE
  std::string request_id_;           // Empty: not given.
  std::int32_t priority_ = 0;        // From -100 to 100; the server checks it.
  std::string wall_time_;            // Such as `10s`; empty: no budget.
  std::string steps_;                // Such as `1e6`; empty: no budget.
  std::uint64_t output_bytes_ = 0;   // 0: no budget.
  std::string time_to_live_;         // Empty: the default of the server.
};

}  // namespace contact::cli
