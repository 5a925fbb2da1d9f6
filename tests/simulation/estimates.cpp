// Estimates seeded random scenarios, runs them, and prints how far each estimate was off: what
// README.md and Estimate in job.proto say of estimates is judged by this.
//   simulation_estimates [SCENARIOS]   of each kind, 10 if it is not given
// A factor is estimate / run; scenarios without estimate do not count. The last lines have the
// quantiles of each kind and of all. python/estimate measures the wall time, on a server.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "simulation/forecast/run_estimate.h"
#include "simulation/kinds.h"
#include "simulation/run.h"

namespace contact {
namespace {

constexpr double kSamples = 1000;  // Intervals of a recorded trajectory.
constexpr double kGood = 3;        // The factor that the documentation promises for examples.

struct SampleCounter final : Observer {
  double rows = 0;
  void OnSamples(const Samples& samples) override { rows += samples.rows(); }
};

// The factors of one quantity.
struct Factors {
  const char* what;
  std::vector<double> values = {};

  void Tell(const char* of) {
    if (values.empty()) return;
    std::ranges::sort(values);
    const auto quantile = [this](double part) {
      return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
    };
    const auto good = std::ranges::count_if(
        values, [](double value) { return value <= kGood && value >= 1 / kGood; });
    std::printf(
        "%-9s %-8s lowest %.3g, 10 %% %.3g, median %.3g, 90 %% %.3g, highest %.3g; %.0f %% "
        "within a factor of %g, of %zu\n",
        of, what, values.front(), quantile(0.1), quantile(0.5), quantile(0.9), values.back(),
        100 * static_cast<double>(good) / static_cast<double>(values.size()), kGood, values.size());
  }
};

struct Tally {
  Factors steps{"steps"}, samples{"samples"};

  void Tell(const char* of) {
    for (Factors* factors : {&steps, &samples}) factors->Tell(of);
  }
};

void Compare(unsigned seed, int kind, Tally& own, Tally& all) {
  Scenario scenario = testing::Dice(seed, static_cast<testing::Kind>(kind)).Roll();
  scenario.sample_interval = scenario.end_time / kSamples;
  const RunEstimate estimate = EstimateRunOf(scenario);
  if (!estimate.steps) return;  // It has no estimate.
  SampleCounter counter;
  const Outcome outcome = Run(scenario, counter);
  const double steps =
      *estimate.steps / static_cast<double>(std::max<std::int64_t>(outcome.steps, 1));
  const double samples = estimate.samples / std::max(counter.rows, 1.0);
  std::printf("%-9s %3u steps %.0f of %lld, factor %.3g%s\n", testing::kKindNames[kind], seed,
              *estimate.steps, static_cast<long long>(outcome.steps), steps,
              outcome.end == Outcome::End::kFinished ? "" : " (not finished)");
  std::fflush(stdout);
  for (Tally* tally : {&own, &all}) {
    tally->steps.values.push_back(steps);
    tally->samples.values.push_back(samples);
  }
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  const int scenarios = argc > 1 ? std::stoi(argv[1]) : 10;
  std::vector<contact::Tally> tallies(contact::testing::kKinds);
  contact::Tally all;
  for (int kind = 0; kind < contact::testing::kKinds; ++kind) {
    for (int seed = 0; seed < scenarios; ++seed) {
      contact::Compare(static_cast<unsigned>(seed), kind, tallies[static_cast<std::size_t>(kind)],
                       all);
    }
  }
  std::puts("");
  for (int kind = 0; kind < contact::testing::kKinds; ++kind) {
    tallies[static_cast<std::size_t>(kind)].Tell(contact::testing::kKindNames[kind]);
  }
  all.Tell("all");
}
