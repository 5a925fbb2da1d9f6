#pragma once

#include <memory>
#include <vector>

#include "jobs/run/sweep_run.h"

namespace contact {

/// The sweeps with which idle workers may help. Not thread-safe.
class SweepOffers {
 public:
  void Add(const std::shared_ptr<SweepRun>& sweep) { sweeps_.push_back(sweep); }

  /// The oldest sweep that has a cell to compute; null if there is none.
  std::shared_ptr<SweepRun> Find() {
    std::erase_if(sweeps_, [](const auto& sweep) {
      const auto run = sweep.lock();
      return !run || !run->HasWork();
    });
    return sweeps_.empty() ? nullptr : sweeps_.front().lock();
  }

 private:
  /// Oldest first.
  std::vector<std::weak_ptr<SweepRun>> sweeps_;
};

}  // namespace contact
