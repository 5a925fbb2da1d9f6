#pragma once

#include <cstddef>

namespace contact {

/// What the march is tuned by, and what several parts of the search share. "Prototype" is a march
/// in an earlier version of this engine, of which each value was changed alone: 3,000 random
/// scenarios, steps relative to these values.
struct SearchOptions {
  /// Miss |ε_out/ε_in − 1| to which blocks are solved while the march goes ahead. Larger: groups
  /// that come later are seen with worse μ before them. Prototype: 1e-2 takes 1.2 times the steps,
  /// 1e-4 as many.
  double ahead_miss = 1e-3;
  /// The same where nothing comes later: what is left falls to its square in the first exact pass.
  double last_miss = 1e-2;
  /// Relative tolerance of the passes that go ahead. Passes as exact as the scenario asks take 1.8
  /// times the steps; prototype: 2.5 times, where all are.
  double ahead_tolerance = 1e-6;
  /// Overlapping groups so few are solved at once, also those that end after the one that misses:
  /// one block instead of one for each group. With 4 for 8 long rows 0 to 8 take 1.3 times the
  /// steps and machines 0 to 3 1.2 times; with 16 rows of 40 balls 1.4 to 1.7 times.
  /// TimelineTest.ABlock…. Where more overlap no smaller root is looked for.
  std::size_t at_once = 8;
  /// Groups of a block at most, the last to end: slopes of a pass are linear in them. A pass ends
  /// after so many where none runs, of fixed steps after `at_once`. Episode.WhatIsPressedForEver….
  /// A group has as many cycles at most.
  std::size_t block = 30;
  /// A guess that misses by more may end too early, or be there only because others are guesses:
  /// what began before it is solved first, and without it. Less: rows of 40 balls at ε = 0.9 take
  /// 2.7 times the steps at 0.02; more: those at 0.5 take 2.6 times.
  double astray = 0.3;
  /// In units of the goal: a group that has moved by less between two polishes is settled.
  /// Prototype: 100 times more or less takes as many steps.
  double influence = 0.02;
  /// Part of what a pass sees that must be final to be recorded: less records often, more lets
  /// passes become long.
  double commit = 0.3;
  /// Spans of a block that a trial may last beyond it, until what has not ended is open.
  double trial_spans = 8;
  /// Relative difference between the misses that a coarse and an exact pass see, to which they have
  /// seen the same motion. Zero: all is solved exactly that an exact pass has seen to miss.
  double alike = 0.5;
  /// A miss that may be the error of the first look at an exact guess: it sees an isolated
  /// collision miss by 1.02e-6 at ε = 0.9. Less: 89 of the 133 steps of such a collision are for
  /// nothing.
  double noise = 3e-6;
  /// Part of the tolerance that a last step without a look may leave; the recording tells. Without,
  /// a triple chain takes 1.2 times as long in the prototype.
  double unseen = 0.1;
  /// Trials of a step: less than 12 % of one, the third, is no descent worth its passes. With five
  /// long rows 0 to 8 take 1.05 times the steps.
  int trials = 3;
  /// Roots of a group alone that lead to no solution of its block, until it grows.
  int tries = 2;
  /// How often a word about a group may be taken back, each kind of word for itself: that it has no
  /// solution or does not end, that it is negligible, its guess, its root for a smaller one. Two
  /// words that take turns would go on without end. With 4 as many of 1,226 runs are FULL, long
  /// rows 0 to 5 take 1.02 times the steps, and in a row of 30 balls a group grows without need.
  int revisions = 8;
  /// Rounds in an episode: a guard against a march that goes round.
  int rounds = 3000;
};

inline constexpr SearchOptions kSearch;

}  // namespace contact
