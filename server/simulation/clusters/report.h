#pragma once

#include <string>
#include <variant>
#include <vector>

#include "simulation/model/observer.h"

namespace contact {

/// What a part of a run has to tell, to be told in the order of time.
struct Report {
  struct Warning {
    std::string text;
  };
  using News = std::variant<Warning, Cycle, Group>;
  struct Item {
    double time = 0;  ///< Its place in the order [s]: the end of a cycle, else the begin of all.
    News news;
  };
  std::vector<Item> items;
};

/// Writes the report of a part of a run, in which contacts and episodes have other numbers.
class Reporter final : public Observer {
 public:
  /// `contacts`: the indices in the whole scenario; `observer` hears of steps and of the search at
  /// once, though the part may be undone. All outlive this.
  Reporter(const std::vector<int>& contacts, double begin, Observer& observer, Report* report)
      : contacts_(contacts), begin_(begin), observer_(observer), report_(*report) {}

  /// What is reported from now on belongs to this episode.
  void SetEpisode(int episode) { episode_ = episode; }

  void OnIteration(const Iteration& iteration) override;
  void OnCycle(const Cycle& cycle) override;
  void OnGrowth(const Group& group) override;
  void OnGroup(const Group& group) override;
  void OnWarning(const std::string& text) override;
  void OnStep() override { observer_.OnStep(); }

 private:
  int Whole(int contact) const { return contacts_[static_cast<std::size_t>(contact)]; }

  const std::vector<int>& contacts_;
  const double begin_;
  Observer& observer_;
  Report& report_;
  int episode_ = 0;
};

}  // namespace contact
