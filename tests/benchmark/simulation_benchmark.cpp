// The triple chain of the paper's 6.1: one pass with known μ, and the whole solve for μ, beside
// one pass of Boost.odeint's dopri5 (no events, no works) and beside the paper's own process.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "simulation/motion/motion.h"
#include "testing/cases.h"

namespace contact {
namespace {

constexpr std::array<double, 2> kFactors = {2.259378079e8, 4.563828953e8};
constexpr double kLastEnd = 2.576052458e-3;  // The second contact's separation.
constexpr double kFinal[] = {-0.003731206344, 0.048726255138, 0.155004951207};

using Chain = std::array<double, 6>;

struct ChainEquations {
  void operator()(const Chain& y, Chain& dy, double) const {
    std::array<double, 2> force;
    for (std::size_t c = 0; c < 2; ++c) {
      const double deformation = std::max(0.0, y[c] - y[c + 1]);
      const double rate = y[3 + c] - y[4 + c];
      force[c] = deformation * std::sqrt(deformation) * (1e8 + kFactors[c] * rate);
    }
    for (std::size_t i = 0; i < 3; ++i) dy[i] = y[3 + i];
    dy[3] = -force[0] / 0.5;
    dy[4] = (force[0] - force[1]) / 0.5;
    dy[5] = force[1] / 0.5;
  }
};

double Error(const double* velocities) {
  double error = 0;
  for (int i = 0; i < 3; ++i) error = std::max(error, std::abs(velocities[i] - kFinal[i]) / 0.2);
  return error;
}

void OdeintPass(benchmark::State& state) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  Chain y;
  while (state.KeepRunning()) {
    y = {0, 0, 0, 0.2, 0, 0};
    const auto stepper = boost::numeric::odeint::make_controlled(
        tolerance * 1e-4, tolerance, boost::numeric::odeint::runge_kutta_dopri5<Chain>());
    boost::numeric::odeint::integrate_adaptive(stepper, ChainEquations(), y, 0.0, kLastEnd, 1e-6);
    benchmark::DoNotOptimize(y);
  }
  state.counters["error"] = Error(&y[3]);
}
BENCHMARK(OdeintPass)->DenseRange(8, 12, 2)->Unit(benchmark::kMicrosecond);

class FixedFactors final : public CycleHost {
 public:
  Factor OnStart(ContactState& s, double, double) override {
    // Length and speed are what a solve knows after its first pass.
    return {.mu = kFactors[static_cast<std::size_t>(s.cycle.contact)],
            .column = kNone,
            .length = 8e-5,
            .speed = 0.15};
  }
  void OnEnd(ContactState&, const Eigen::ArrayXd&, const Eigen::ArrayXd&, double, double) override {
  }
};

// With events located and works integrated.
void Pass(benchmark::State& state) {
  Scenario scenario = testing::TripleChain();
  scenario.solver.relative_tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const State start = InitialState(scenario);
  Motion motion(scenario);
  FixedFactors host;
  while (state.KeepRunning()) {
    motion.Begin(start, false);
    benchmark::DoNotOptimize(motion.Advance(1, host, nullptr, {}, 1'000'000'000));
  }
  state.counters["error"] = Error(motion.integrator().y0.data() + 3);
}
BENCHMARK(Pass)->DenseRange(8, 12, 2)->Unit(benchmark::kMicrosecond);

// Everything: events, works, sensitivities, every iteration, the ledger and its balances. To
// ξ = 10^−first with steps of a tolerance 10^−second; 11 is the default.
void Solve(benchmark::State& state) {
  Scenario scenario = testing::TripleChain();
  scenario.solver.restitution_tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  scenario.solver.relative_tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
  testing::Record record;
  while (state.KeepRunning()) {
    record = {};
    record.outcome = Run(scenario, record);
  }
  state.counters["iterations"] = static_cast<double>(record.outcome.iterations);
  state.counters["error"] = Error(record.outcome.velocities.data());
}
BENCHMARK(Solve)
    ->ArgsProduct({{2, 8}, {9, 11}})
    ->Args({10, 11})
    ->ArgNames({"xi", "tolerance"})
    ->Unit(benchmark::kMicrosecond);

// The paper's own: RK4 with 1 µs, update (31), ξ = 1 %, phases split at the largest force.
void PaperProcess(benchmark::State& state) {
  Scenario scenario = testing::TripleChain();
  scenario.end_time = 2.6e-3;
  scenario.solver.fixed_step = 1e-6;
  scenario.solver.update = UpdateRule::kPaperRatio;
  scenario.solver.phase_split = PhaseSplit::kPeakForce;
  scenario.solver.restitution_tolerance = 0.01;
  for (Contact& c : scenario.contacts) c.reference_velocity = 0.2;
  testing::Record record;
  while (state.KeepRunning()) {
    record = {};
    record.outcome = Run(scenario, record);
  }
  state.counters["iterations"] = static_cast<double>(record.outcome.iterations);
  state.counters["error"] = Error(record.outcome.velocities.data());
}
BENCHMARK(PaperProcess)->Unit(benchmark::kMicrosecond);

Scenario UndampedRow(std::size_t balls) {
  Scenario scenario =
      testing::Chain(std::vector<double>(balls, 0.5), std::vector<double>(balls - 1, 1e8),
                     std::vector<double>(balls - 1, 1), 0.2, 2e-3);
  for (Contact& c : scenario.contacts) c.damping = DampingLaw::kGiven;
  return scenario;
}

// An undamped row through which a wave runs: what a ball costs in a step.
void Row(benchmark::State& state) {
  const auto balls = static_cast<std::size_t>(state.range(0));
  const Scenario scenario = UndampedRow(balls);
  testing::Record record;
  while (state.KeepRunning()) {
    record = {};
    record.outcome = RunWhole(scenario, record);
  }
  state.counters["ball_steps"] =
      benchmark::Counter(static_cast<double>(record.outcome.steps) * static_cast<double>(balls),
                         benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Row)->Arg(100)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// The same, of which only what the wave has reached is solved.
void Pulse(benchmark::State& state) {
  const Scenario scenario = UndampedRow(static_cast<std::size_t>(state.range(0)));
  while (state.KeepRunning()) testing::RunAndRecord(scenario);
}
BENCHMARK(Pulse)->Arg(100)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// A gas whose balls collide two by two: what a collision costs, however many balls there are.
void Gas(benchmark::State& state) {
  const Scenario s = testing::Gas(static_cast<int>(state.range(0)), 1e6, 2);
  std::size_t cycles = 0;
  while (state.KeepRunning()) cycles = testing::RunAndRecord(s).cycles.size();
  state.counters["a_collision"] = benchmark::Counter(
      static_cast<double>(cycles),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(Gas)->Arg(100)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// The same with all balls moved together, as they would be without clusters.
void GasTogether(benchmark::State& state) {
  const Scenario s = testing::Gas(static_cast<int>(state.range(0)), 1e6, 2);
  testing::Record record;
  while (state.KeepRunning()) RunWhole(s, record);
}
BENCHMARK(GasTogether)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact

BENCHMARK_MAIN();
