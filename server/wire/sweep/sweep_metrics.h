#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"
#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

/// The numbers that a sweep keeps of the result of each cell. Safe to read from any thread.
class SweepMetrics {
 public:
  /// No metrics.
  SweepMetrics() = default;

  /// Reads the paths of the metrics. Notes those that are not the path of a number in a Job.
  SweepMetrics(const v1::Sweep& sweep, std::vector<Violation>* violations);

  /// Notes the metrics that name a body or contact that is not in the scenario.
  void CheckNames(const Scenario& scenario, std::vector<Violation>* violations) const;

  /// The metrics of a result in their order; NaN where the result has no such number.
  std::vector<double> Of(const v1::Job& result) const;

 private:
  // One step of a path: a field, and the entry of a list.
  struct Step {
    const google::protobuf::FieldDescriptor* field;
    std::optional<int> index;  // Index of the entry.
    std::string key;           // Name of the entry if it has no index; else empty.
  };
  using Path = std::vector<Step>;

  // The number at the end of the path from `message`; NaN if an entry is missing.
  static double Value(const Path& path, const google::protobuf::Message& message);

  std::vector<Path> paths_;
};

}  // namespace contact
