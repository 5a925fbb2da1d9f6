// Runs seeded random scenarios and tells of each, in a line, how it ended.
//   simulation_campaign [FROM TO [KIND KIND]]: seeds and kinds, both without the last.
// A line that begins with BAD breaks a promise; the exit code is 1 then.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include "simulation/kinds.h"
#include "testing/cases.h"

namespace contact {
namespace {

struct Tally {
  int runs = 0, full = 0, bad = 0, cycles = 0, not_converged = 0, infeasible = 0;
  std::vector<double> seconds;
};

double Seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bool IsBalanced(const Cycle& c) {
  if (c.status != Cycle::Status::kConverged || c.end == Cycle::End::kRunEnd) return true;
  return std::abs(c.restitution_out / c.restitution_in - 1) < 2e-8;
}

bool IsSound(const testing::Record& record) {
  return record.outcome.end == Outcome::End::kFinished && record.outcome.energy_residual < 1e-7 &&
         std::ranges::all_of(record.cycles, IsBalanced);
}

void RunOne(unsigned seed, int kind, Tally& tally) {
  const double start = Seconds();
  const testing::Record record =
      testing::RunAndRecord(testing::Dice(seed, static_cast<testing::Kind>(kind)).Roll());
  const Outcome& outcome = record.outcome;
  const auto count = [&](Cycle::Status status) {
    return static_cast<int>(std::ranges::count(record.cycles, status, &Cycle::status));
  };
  const bool bad = !IsSound(record);
  ++tally.runs;
  tally.full += outcome.all_converged;
  tally.bad += bad;
  tally.cycles += static_cast<int>(record.cycles.size());
  tally.not_converged += count(Cycle::Status::kNotConverged);
  tally.infeasible += count(Cycle::Status::kInfeasible);
  tally.seconds.push_back(Seconds() - start);
  std::cout << (bad ? "BAD " : "") << testing::kKindNames[kind] << ' ' << seed << " full "
            << outcome.all_converged << " cycles " << record.cycles.size() << " corrections "
            << outcome.iterations << " steps " << outcome.steps << " seconds "
            << tally.seconds.back() << std::endl;
}

void Tell(int kind, Tally& tally) {
  std::ranges::sort(tally.seconds);
  std::cout << testing::kKindNames[kind] << ": " << tally.full << " of " << tally.runs
            << " full; of " << tally.cycles << " cycles " << tally.infeasible << " infeasible and "
            << tally.not_converged << " not converged; median "
            << tally.seconds[tally.seconds.size() / 2] << " s, longest " << tally.seconds.back()
            << " s\n";
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto number = [&](std::size_t i, int otherwise) {
    return i < arguments.size() ? std::stoi(arguments[i]) : otherwise;
  };
  int bad = 0;
  for (int kind = number(2, 0); kind < number(3, contact::testing::kSmallKinds); ++kind) {
    contact::Tally tally;
    for (int seed = number(0, 0); seed < number(1, 500); ++seed) {
      contact::RunOne(static_cast<unsigned>(seed), kind, tally);
    }
    if (tally.runs > 0) contact::Tell(kind, tally);
    bad += tally.bad;
  }
  return bad == 0 ? 0 : 1;
}
