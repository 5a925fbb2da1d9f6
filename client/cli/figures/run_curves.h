#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/link/recording.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// Makes curves, marks and bands of one recorded run. Bodies and contacts have the colour of their
/// place in the scenario. Columns of which there is no recording throw Failure (kUsage).
class RunCurves {
 public:
  /// `recording` must outlive this object.
  explicit RunCurves(const Recording& recording);

  /// What the run recorded.
  const Recording& recording() const { return recording_; }
  /// The scenario of the run with its defaults filled in.
  const Scenario& scenario() const { return scenario_; }

  /// The samples of a column, such as `B1.velocity`, in its unit.
  const std::vector<double>& Column(const std::string& name) const;

  /// Calls act(name, colour) for each contact, in the order of the scenario.
  template <class Act>
  void EachContact(Act act) const {
    int colour = 0;
    for (const auto& contact : scenario_.contacts) act(contact.name, colour++);
  }

  /// A panel over time [s] without curves, with a band for each group of cycles and for each cycle
  /// that is in none. `label` is that of the y axis.
  Figure::Panel OverTime(const std::string& label) const;

  /// Adds a column as a curve over time.
  void AddColumn(const std::string& name, const std::string& label, int colour, Figure::Mark mark,
                 Figure::Panel* panel) const;

  /// Adds marks on a column where the cycles of a contact start and end.
  void AddMarks(const std::string& contact, const std::string& column, int colour,
                Figure::Panel* panel) const;

 private:
  // Adds the point of a column at a time [s], which may lie between two samples.
  void AddPoint(double time, const std::string& column, Figure::Curve* curve) const;

  const Recording& recording_;
  const Scenario scenario_;
};

}  // namespace contact::cli
