#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "contact/v1/scenario.pb.h"
#include "simulation/model/scenario.h"
#include "wire/rules/field_path.h"
#include "wire/rules/rules.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/sweep/series_metrics.h"

namespace contact {

/// The numbers that a sweep keeps of the result of each cell. Safe to read from any thread.
class SweepMetrics {
 public:
  /// No metrics.
  SweepMetrics() = default;

  /// Reads the paths of the metrics. Notes those that are not the path of a number in a Job.
  SweepMetrics(const v1::Sweep& sweep, std::vector<Violation>* violations);

  /// Notes the metrics that name a body, contact or channel that is not in the scenario.
  void CheckNames(const Scenario& scenario, std::vector<Violation>* violations) const;

  /// A metric of a result: its number, NaN where the result has none, and where it comes from.
  struct Metric {
    double value = kNaN;
    v1::SweepCell::Source source = v1::SweepCell::RESULT;
  };
  /// The metrics of a result and the samples of its run in their order.
  std::vector<Metric> Of(const v1::Job& result, const SeriesTally& series = {}) const;
  /// Whether some are of samples.
  bool need_samples() const { return !series_.empty(); }
  /// What those are of a run of this scenario.
  SeriesTally Tally(const Scenario& scenario) const { return {series_, scenario}; }

 private:
  using Message = google::protobuf::Message;
  // What a step through a list takes of the entries that it means.
  enum class Pick { kFirst, kLast, kMax, kMin, kCount };
  // One step of a path: a field, and of a list the entries that it means.
  struct Step {
    const google::protobuf::FieldDescriptor* field;
    // Index of the only entry.
    std::optional<int> index;
    // Name of the entries; empty: all.
    std::string key;
    Pick pick = Pick::kFirst;
  };
  using Path = std::vector<Step>;

  // The path that `text` names from a Job. Notes if there is none, or if no number is at its end;
  // the path is then incomplete.
  static Path Find(const std::string& text, const Rules& rules);
  // Notes a metric that names a body or contact that is not in the scenario.
  static void CheckName(const Step& root, const Scenario& scenario, const Rules& rules);
  // Find for the steps of a path.
  static Path Follow(std::span<const PathStep> steps, const std::string& text, const Rules& rules);
  // What the first of these steps picks; nothing if it is the name of a field, or none.
  static std::optional<Pick> PickOf(std::span<const PathStep> steps);
  // The number at the end of the path from `message`; NaN if an entry is missing.
  static Metric Value(std::span<const Step> path, const Message& message);
  // Value for a path that begins with a list of `message`.
  static Metric ValueOfList(std::span<const Step> path, const Message& message);
  // Value of a list of numbers of `message`.
  static Metric ValueOfReals(const Step& step, const Message& message);
  // Whether the number of the next entry takes the place of the one chosen before.
  static bool IsChosen(Pick pick, double next, double before);

  // One path for each metric; empty for one of samples.
  std::vector<Path> paths_;
  // Those of samples, in their order.
  std::vector<SeriesMetric> series_;
};

}  // namespace contact
