#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact::campaign {

/// How a run of a campaign is made and looked at.
struct Options {
  RestitutionScope scope = RestitutionScope::kAuto;
  std::int64_t max_steps = 0;  ///< 0: as the kind has it.
  bool certify = false;        ///< Integrate it again by an independent method.
  bool metamorphic = false;    ///< Run it again in other words.
};

/// What a second look at a run found.
struct Check {
  enum class Verdict { kNone, kAgrees, kDisagrees, kNotChecked };
  Verdict verdict = Verdict::kNone;
  double worst = 0;  ///< Largest relative difference.
  std::string what;  ///< Where it is, or why it was not checked.
};

/// A line of a campaign: how the run of a kind and a seed ended.
struct Result {
  enum class Status { kFull, kPartial, kBudget, kFailed };
  using Count = std::pair<std::string, int>;

  std::string kind;
  unsigned seed = 0;
  Status status = Status::kFailed;
  std::string end;                                    ///< Of Outcome::end.
  std::string message;                                ///< Of a run that did not finish.
  double end_time = 0, time = 0;                      ///< [s].
  int bodies = 0, groups = 0, longest = 0;            ///< longest: cycles of the longest group.
  std::vector<std::pair<std::string, int>> cycles;    ///< Status and how many, of those there are.
  int jumps = 0, released = 0, limited = 0, cut = 0;  ///< Groups, of released and cut ones rows.
  std::int64_t passes = 0, iterations = 0, growths = 0, steps = 0, evaluations = 0;
  double ms = 0;                                                   ///< Of the processor.
  double restitution = 0, identity = 0, momentum = 0, energy = 0;  ///< Worst, as recorded.
  std::vector<std::string> broken;  ///< Promises, in a few words each.
  Check certificate, metamorphic;
};

/// Rolls the scenario, as options have it.
Scenario ScenarioOf(int kind, unsigned seed, const Options& options);

Result RunOne(int kind, unsigned seed, const Options& options);

/// A line of JSON and back. FromJson throws what nlohmann's parser throws. result_json.cpp
std::string ToJson(const Result& result);
Result FromJson(const std::string& line);

/// FULL, PARTIAL, BUDGET or FAILED.
const char* NameOf(Result::Status status);

}  // namespace contact::campaign
