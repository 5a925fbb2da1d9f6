// What an accuracy costs: the error of the velocities at the end against the time of one pass with
// known μ, ours beside Boost.odeint's dopri5 and Simbody's Hunt-Crossley contacts. CSV on standard
// output.
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plain_equations.h"
#include "simbody_peer.h"
#include "simulation/laws/isolated_collision.h"
#include "testing/cases.h"

namespace contact {
namespace {

using Velocities = std::vector<double>;

/// The scenario, each contact of which has the μ of an isolated collision at this velocity.
Scenario WithGivenFactors(Scenario scenario, double velocity) {
  for (Contact& contact : scenario.contacts) {
    contact.mu = ExactCoefficient(contact.restitution) * contact.stiffness / velocity;
    contact.damping = DampingLaw::kGiven;
  }
  return scenario;
}

Velocities Ours(Scenario scenario, double tolerance) {
  scenario.solver.relative_tolerance = tolerance;
  Observer nobody;
  return Run(scenario, nobody).velocities;
}

Velocities ByDopri5(const Scenario& scenario, double tolerance) {
  const PlainEquations equations(scenario);
  auto state = equations.Start();
  const auto stepper = boost::numeric::odeint::make_controlled(
      tolerance * 1e-4, tolerance,
      boost::numeric::odeint::runge_kutta_dopri5<PlainEquations::State>());
  boost::numeric::odeint::integrate_adaptive(stepper, std::cref(equations), state, 0.0,
                                             scenario.end_time, 1e-6);
  return equations.VelocitiesOf(state);
}

#ifdef CONTACT_SIMBODY
Velocities InSimbody(const Scenario& scenario, double accuracy) {
  SimbodyRow row;
  for (const Body& b : scenario.bodies) {
    row.balls.push_back({b.mass, b.radius, b.position, b.velocity});
  }
  for (const Contact& c : scenario.contacts) {
    row.touches.push_back({c.left, c.right, c.wall_position, c.stiffness, c.mu});
  }
  for (const Support& s : scenario.supports) {
    row.springs.push_back({s.body, s.stiffness, s.damping, s.rest_position});
  }
  for (const Load& l : scenario.loads) {
    row.pushes.push_back({l.body, l.constant, l.amplitude, l.angular_frequency, l.phase});
  }
  row.end_time = scenario.end_time;
  return BySimbody(row, accuracy);
}
#endif

double Distance(const Velocities& a, const Velocities& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

// The time of a run, repeated for a millisecond at least [µs].
double MicrosecondsOf(const std::function<void()>& run) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  int count = 0;
  do {
    run();
    ++count;
  } while (Clock::now() - begin < std::chrono::milliseconds(1));
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count() / count;
}

struct Program {
  const char* name;
  std::function<Velocities(const Scenario&, double tolerance)> run;
};

const Program kPrograms[] = {
    {"contactd", Ours},
    {"Boost.odeint dopri5", ByDopri5},
#ifdef CONTACT_SIMBODY
    {"Simbody", InSimbody},
#endif
};

/// Prints all programs on a scenario, at tolerances from 1e-4 to 1e-digits: errors, and the medians
/// of nine times, taken in turns so that a slow moment of the machine is one of all. Exact is what
/// ours gives at 1e-14; returns whether dopri5 confirms it at 1e-15, and ours comes to it at 1e-12.
bool Print(const char* name, const Scenario& scenario, int digits) {
  const Velocities exact = Ours(scenario, 1e-14);
  const double doubt = Distance(ByDopri5(scenario, 1e-15), exact);
  std::printf("%s,doubt,,%.3e,\n", name, doubt);
  std::map<std::pair<std::string, int>, std::vector<double>> times;
  for (int turn = 0; turn < 9; ++turn) {
    for (const Program& program : kPrograms) {
      for (int d = 4; d <= digits; ++d) {
        times[{program.name, d}].push_back(
            MicrosecondsOf([&] { program.run(scenario, std::pow(10, -d)); }));
      }
    }
  }
  for (const Program& program : kPrograms) {
    for (int d = 4; d <= digits; ++d) {
      const double error = Distance(program.run(scenario, std::pow(10, -d)), exact);
      std::vector<double>& taken = times[{program.name, d}];
      std::ranges::nth_element(taken, taken.begin() + 4);
      std::printf("%s,%s,1e-%d,%.3e,%.4g\n", name, program.name, d, error, taken[4]);
    }
  }
  return doubt < 1e-10 && Distance(Ours(scenario, 1e-12), exact) < 1e-11;
}

int Compare(int digits) {
  std::puts("scenario,program,tolerance,error_m_per_s,time_us");
  const std::vector<double> masses(20, 0.5), stiffnesses(19, 1e8), restitutions(19, 0.9);
  const Scenario row = testing::Chain(masses, stiffnesses, restitutions, 0.2, 5e-3);
  const bool confirmed[] = {
      Print("triple chain", WithGivenFactors(testing::TripleChain(), 0.2), digits),
      Print("ball on a spring", WithGivenFactors(testing::SpringWall(), 1), digits),
      Print("row of 20", WithGivenFactors(row, 0.2), digits)};
  return std::ranges::all_of(confirmed, std::identity()) ? 0 : 1;
}

}  // namespace
}  // namespace contact

int main(int count, char** words) { return contact::Compare(count > 1 ? std::atoi(words[1]) : 12); }
