#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/model/ledger.h"
#include "simulation/model/scenario.h"
#include "wire/rules/field_path.h"
#include "wire/rules/rules.h"

namespace contact {

/// A number of the samples of one channel, such as `series[B1.velocity].max`.
struct SeriesMetric {
  enum class Pick { kFirst, kLast, kMax, kMin, kTimeOfMax, kTimeOfMin };
  /// Name of a column of FrameChunk.
  std::string channel;
  Pick pick = Pick::kFirst;
};

/// The metric that the steps of a path name, of which the first is `series`. Notes if there is
/// none; `text` is the path.
std::optional<SeriesMetric> FindSeriesMetric(std::span<const PathStep> steps,
                                             const std::string& text, const Rules& rules);

/// Notes if a run of the scenario has no samples, or none of the channel.
void CheckChannel(const SeriesMetric& metric, const Scenario& scenario, const Rules& rules);

/// The numbers of a run's samples, found as they come.
class SeriesTally {
 public:
  SeriesTally() = default;
  /// For a run of this scenario, which has the channels.
  SeriesTally(const std::vector<SeriesMetric>& metrics, const Scenario& scenario);

  bool empty() const { return seen_.empty(); }
  void See(const Samples& samples);
  /// The number of the metric with this index; NaN before the first sample.
  double Of(std::size_t metric) const { return seen_.empty() ? kNaN : seen_[metric].chosen; }

 private:
  struct Seen {
    SeriesMetric::Pick pick;
    std::size_t column = 0;
    double extreme = kNaN;  // Largest or smallest value so far.
    double chosen = kNaN;   // The number so far.
  };
  static void See(double time, double value, Seen* seen);

  std::vector<Seen> seen_;
};

}  // namespace contact
