#pragma once

#include <optional>

#include "simulation/model/scenario.h"

namespace contact {

/// What a run will probably take, from its scenario alone. Nothing is solved: cycles are counted
/// from the first meetings of contacts (first_meeting.h), steps and seconds from measured averages.
/// tests/simulation/estimates.cpp prints how far that is off for random scenarios.
struct RunEstimate {
  /// Integration steps of all passes. None where a support holds a body or a body touches two
  /// others: nothing tells in advance how many passes the search for their μ takes.
  std::optional<double> steps = {};
  /// Rows of the trajectory; exact if the run reaches its end and cycles have no samples of their
  /// own.
  double samples = 0;
  /// Size of these rows as events, with the headers of their chunks [byte].
  double sample_bytes = 0;
  /// Memory of all these rows, where they are kept until the run ends [byte].
  double sample_memory = 0;
  /// Size of cycles, iterations and states of the job as events [byte].
  double ledger_bytes = 0;
  /// Memory of the solver and its chunks of samples, however long the run is [byte].
  double fixed_memory = 0;
  /// Largest memory of the solver, its chunks of samples and the ledger [byte].
  double memory_bytes = 0;
  /// Time to interpolate, encode and store the samples [s].
  double sample_seconds = 0;
  /// Time of everything else that a job takes, in a release build on one core [s]; none as `steps`.
  std::optional<double> solve_seconds = {};
};

/// The estimate for one run of a checked scenario. Takes time in proportion to its bodies,
/// contacts, supports and loads.
RunEstimate EstimateRunOf(const Scenario& scenario);

}  // namespace contact
