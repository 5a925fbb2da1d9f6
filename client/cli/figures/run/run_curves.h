#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/link/recording.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// The part of a run that a figure shows; by default all of it.
struct FigurePart {
  /// Names of contacts, and so of the bodies that they join; empty: all.
  std::vector<std::string> contacts = {};
  /// Ends of the time window [s], included.
  std::optional<double> from = {};
  std::optional<double> to = {};
};

/// Makes curves, marks and bands of one recorded run, or of a part of it. Bodies and contacts have
/// the colour of their place in the scenario. Columns of which there is no recording throw Failure
/// (kUsage).
class RunCurves {
 public:
  /// A number that the ledger tells of a cycle.
  using OfCycle = std::function<double(const v1::Cycle&)>;

  /// `recording` must outlive this object. Throws Failure (kUsage) for a contact that the scenario
  /// does not have, and for a window without duration.
  explicit RunCurves(const Recording& recording, FigurePart part = {});

  /// What the run recorded.
  const Recording& recording() const { return recording_; }
  /// The scenario of the run with its defaults filled in.
  const Scenario& scenario() const { return scenario_; }
  /// True if the figure shows the contact.
  bool Shows(const std::string& contact) const;
  /// True if the figure shows the body with this index in the scenario: one of a contact shown.
  bool Shows(int body) const;

  /// The samples of a column, such as `B1.velocity`, in its unit, whatever the window.
  const std::vector<double>& Column(const std::string& name) const;
  /// The value of a column at a time [s], which may lie between two samples.
  double At(const std::string& column, double time) const;
  /// True if a time [s] is in the window.
  bool InWindow(double time) const { return time >= from_ && time <= to_; }

  /// Calls act(name, colour) for each contact shown, in the order of the scenario. Its colour is
  /// its index in the scenario.
  template <class Act>
  void EachContact(Act act) const {
    for (std::size_t i = 0; i < scenario_.contacts.size(); ++i) {
      const auto& contact = scenario_.contacts[i];
      if (Shows(contact.name)) act(contact.name, static_cast<int>(i));
    }
  }

  /// Calls act(cycle, place) for each cycle of a contact that overlaps the window, with its place
  /// in the ledger, from 1.
  template <class Act>
  void EachCycle(const std::string& contact, Act act) const {
    int place = 0;
    for (const v1::Cycle& cycle : recording_.job.cycles()) {
      ++place;
      const bool overlaps = cycle.end_time_s() >= from_ && cycle.start_time_s() <= to_;
      if (overlaps && cycle.contact() == contact) act(cycle, place);
    }
  }

  /// A panel over time [s] without curves, with a band wherever a contact shown has a cycle or is
  /// within a group. `label` is that of the y axis.
  Figure::Panel OverTime(const std::string& label) const;

  /// Adds the part of a curve over time that is in the window; `values` has one for each sample.
  void AddCurve(const std::vector<double>& values, const std::string& label, int colour,
                Figure::Mark mark, Figure::Panel* panel) const;

  /// The same for a column.
  void AddColumn(const std::string& name, const std::string& label, int colour, Figure::Mark mark,
                 Figure::Panel* panel) const;

  /// Adds marks where the cycles of a contact start and end, at these heights. `name` is that of
  /// the curve in CSV.
  void AddMarks(const std::string& contact, const std::string& name, int colour,
                const OfCycle& at_start, const OfCycle& at_end, Figure::Panel* panel) const;

 private:
  const Recording& recording_;
  const Scenario scenario_;
  const FigurePart part_;
  /// Ends of the window [s]; infinite where there is none.
  const double from_, to_;
};

}  // namespace contact::cli
