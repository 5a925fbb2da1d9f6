#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"
#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/rules.h"
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
  using Message = google::protobuf::Message;
  // One step of a path: a field, and the entry of a list.
  struct Step {
    const google::protobuf::FieldDescriptor* field;
    // Index of the entry.
    std::optional<int> index;
    // Name of the entry if it has no index; else empty.
    std::string key;
  };
  using Path = std::vector<Step>;

  // The path that `text` names from a Job. Notes if there is none, or if no number is at its end;
  // the path is then incomplete.
  static Path Find(const std::string& text, const Rules& rules);
  // The number at the end of the path from `message`; NaN if an entry is missing.
  static double Value(const Path& path, const Message& message);
  // The entry of the list in `message` that the step means; null if there is none.
  static const Message* Entry(const Step& step, const Message& message);

  // One path for each metric.
  std::vector<Path> paths_;
};

}  // namespace contact
