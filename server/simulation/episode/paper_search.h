#pragma once

#include <map>

#include "simulation/episode/iteration_log.h"
#include "simulation/episode/problem.h"

namespace contact {

/// The paper's own process, its Fig. 7: every cycle is corrected on its own, and those that have
/// converged keep their μ; (P1) to (P5) of README.md.
class PaperSearch {
 public:
  PaperSearch(Problem& problem, IterationLog& log) : problem_(problem), log_(log) {}

  /// Solves the stretch from the problem's start to the first instant without a cycle.
  void Solve(int most_cycles, int most_corrections);

 private:
  struct Bracket {
    double low = 0, high = 0;  // μ known to give too much, too little restitution; 0: none.
  };
  bool Converged(const GroupSight& group) const;
  void Correct(Sight& sight, int corrections);
  Iteration::Update Move(const GroupSight& group, Bracket& bracket);

  Problem& problem_;
  IterationLog& log_;
  std::map<GroupId, Bracket> brackets_;
};

}  // namespace contact
