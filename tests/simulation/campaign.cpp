// Runs seeded random scenarios and tells of each, in a line, how it ended: for campaigns of
// thousands, which take minutes. A line that begins with BAD breaks a promise.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include "simulation/kinds.h"
#include "simulation/run.h"

namespace contact {
namespace {

struct Tally {
  int runs = 0, full = 0, jumps = 0, groups = 0, longer = 0;
  std::vector<double> seconds;
};

struct GroupKeeper final : Observer {
  std::vector<Group> groups;
  void OnGroup(const Group& group) override { groups.push_back(group); }
};

double Seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bool IsBalanced(const Group& g) {
  if (g.status != Cycle::Status::kConverged || g.end == Cycle::End::kRunEnd) return true;
  const double out = std::sqrt(-g.work_restitution / g.work_compression);
  return std::abs(out / g.restitution_in - 1) < 2e-8;
}

void RunOne(unsigned seed, int kind, RestitutionScope scope, Tally& tally) {
  Scenario scenario = testing::Dice(seed, static_cast<testing::Kind>(kind)).Roll();
  scenario.solver.restitution_scope = scope;
  GroupKeeper kept;
  const double start = Seconds();
  const Outcome outcome = Run(scenario, kept);
  const double took = Seconds() - start;
  int jumps = 0, longest = 0;
  bool balanced = outcome.energy_residual < 1e-8;
  for (const Group& g : kept.groups) {
    jumps += g.status == Cycle::Status::kJump;
    longest = std::max(longest, g.cycles);
    tally.longer += g.cycles > 3;
    balanced = balanced && IsBalanced(g);
  }
  ++tally.runs;
  tally.full += outcome.all_converged;
  tally.jumps += jumps > 0;
  tally.groups += static_cast<int>(kept.groups.size());
  tally.seconds.push_back(took);
  const bool bad = !balanced || outcome.end != Outcome::End::kFinished;
  std::cout << (bad ? "BAD " : "") << testing::kKindNames[kind] << ' ' << seed << " full "
            << outcome.all_converged << " groups " << kept.groups.size() << " longest " << longest
            << " jumps " << jumps << " growths " << outcome.growths << " without_progress "
            << outcome.growths_no_progress << " corrections " << outcome.iterations << " steps "
            << outcome.steps << " seconds " << took << std::endl;
}

void Tell(int kind, Tally& tally) {
  std::ranges::sort(tally.seconds);
  std::cout << testing::kKindNames[kind] << ": " << tally.full << " of " << tally.runs << " full, "
            << tally.jumps << " with a jump, " << tally.groups << " groups, " << tally.longer
            << " of more than three cycles, median " << tally.seconds[tally.seconds.size() / 2]
            << " s, longest " << tally.seconds.back() << " s\n";
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto number = [&](std::size_t i, int otherwise) {
    return i < arguments.size() ? std::stoi(arguments[i]) : otherwise;
  };
  const auto scope = static_cast<contact::RestitutionScope>(number(4, 0));
  for (int kind = number(2, 0); kind < number(3, contact::testing::kSmallKinds); ++kind) {
    contact::Tally tally;
    for (int seed = number(0, 0); seed < number(1, 500); ++seed) {
      contact::RunOne(static_cast<unsigned>(seed), kind, scope, tally);
    }
    if (tally.runs > 0) contact::Tell(kind, tally);
  }
}
