#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The flags for priority, budget and time to live, of commands that make a job.
class JobOptions {
 public:
  /// Adds the flags. This object must outlive the parsing.
  void AddTo(CLI::App& command);

  /// Sets the fields of `job` whose flags were given. Throws Failure (kUsage) for a text that is no
  /// time or number.
  void Apply(v1::Job* job) const;

 private:
  /// From -100 to 100; the server checks it.
  std::int32_t priority_ = 0;
  /// A duration such as `10s`; empty: no budget.
  std::string wall_time_;
  /// A number such as `1e6`; empty: no budget.
  std::string steps_;
  /// In bytes; 0: no budget.
  std::uint64_t output_bytes_ = 0;
  /// A duration; empty: the default of the server.
  std::string time_to_live_;
};

}  // namespace contact::cli
