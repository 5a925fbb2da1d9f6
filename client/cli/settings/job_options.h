#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The flags of commands that make a job which say how it is to be treated.
class JobOptions {
 public:
  void AddTo(CLI::App& command);
  /// Throws Failure (kUsage) for a text that is no time or number.
  void Apply(v1::Job* job) const;

 private:
  std::int32_t priority_ = 0;
  std::string wall_time_;
  std::string steps_;
  std::uint64_t output_bytes_ = 0;
  std::string time_to_live_;
};

}  // namespace contact::cli
