#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"
#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/scenario_codec.h"

namespace contact {

/// The numbers that a sweep keeps of the result of each cell.
class SweepMetrics {
 public:
  SweepMetrics() = default;
  /// Notes the metrics that no result has.
  SweepMetrics(const v1::Sweep& sweep, std::vector<Violation>* violations);

  /// Notes those that name a body or contact that is not in the scenario.
  void CheckNames(const Scenario& scenario, std::vector<Violation>* violations) const;

  /// Of a result: one number for each metric, NaN where there is none.
  std::vector<double> Of(const v1::Job& result) const;

 private:
  struct Step {
    const google::protobuf::FieldDescriptor* field;
    std::optional<int> index;  ///< Of an entry.
    std::string key;           ///< Name of the entry, if it has no index.
  };
  using Path = std::vector<Step>;

  static double Value(const Path& path, const google::protobuf::Message& message);

  std::vector<Path> paths_;
};

}  // namespace contact
