#include "wire/estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "simulation/forecast/encounter.h"

namespace contact {
namespace {

// Steps of a cycle with error control, in a pass at 1e-11 and in one at the 1e-6 that corrections
// begin with: of an isolated collision and of the scenarios that are shipped.
constexpr double kExactSteps = 45;
constexpr double kCoarseSteps = 25;
// Passes through a cycle: the recording one, and those that look for μ.
constexpr double kImpactPasses = 3;
constexpr double kPressedPasses = 4;

// Of a worker in a release build on a core of an AMD EPYC: simulation_benchmark's Row (a ball costs
// 0.11 µs in a step with error control), Solve and PaperProcess (1.1 and 0.38 µs for a step of
// three balls); and bouncing-ball.yaml, with its 60 000 samples of seven values, without, and by
// RK4.
constexpr double kStepSeconds = 0.5e-6;
constexpr double kBodySeconds = 0.2e-6;   // A body with a contact, in a step.
constexpr double kFixedStepShare = 0.45;  // Four evaluations instead of twelve.
constexpr double kValueSeconds = 0.1e-6;  // Of a sample: interpolated, encoded and stored.

constexpr double kChunkRows = 256;     // Of samples in an event,
constexpr double kColumnBytes = 60;    // with name, quantity and unit of each column.
constexpr double kCycleBytes = 300;    // A row of the ledger as an event.
constexpr double kUnknownBytes = 110;  // A cycle in a row of the iteration.
constexpr double kLogBytes = 600;      // Of any job: states, attempt, progress.
constexpr double kMostUnknowns = 96;   // In the window that is solved together.
constexpr double kStages = 13;         // Slopes that a step of the integrator holds.

// Cycles until one has but this fraction of the first one's work, of which each leaves ε².
double CyclesToRest(double restitution, double fraction) {
  if (restitution >= 1 || fraction <= 0) return std::numeric_limits<double>::infinity();
  return 1 + std::log(fraction) / (2 * std::log(restitution));
}

// The number n of impacts that begin by `time` after the first, whose flights fall off as ε^m:
//   n T + f (1 − ε^n)/(1 − ε) = time.
double Bounces(double time, double duration, double flight, double restitution) {
  double low = 0;
  double high = time / duration;
  for (int i = 0; i < 60; ++i) {
    const double n = (low + high) / 2;
    const double flights =
        restitution >= 1 ? n * flight : flight * (1 - std::pow(restitution, n)) / (1 - restitution);
    (n * duration + flights > time ? high : low) = n;
  }
  return low;
}

// Cycles of one contact, and the time that they take in all.
struct Cycles {
  double count = 0;
  double time = 0;
  double passes = 1;
};

bool Iterated(const Contact& contact) {
  return contact.damping == DampingLaw::kEnergyRestitution && contact.restitution < 1;
}

Cycles CyclesOf(const Scenario& scenario, const Contact& contact, const Encounter& encounter) {
  const double rest =
      encounter.driven ? std::numeric_limits<double>::infinity()
                       : CyclesToRest(contact.restitution,
                                      encounter.speed > 0 ? scenario.solver.settled_fraction
                                                          : scenario.solver.settled_nirv_fraction);
  Cycles cycles;
  if (encounter.speed == 0) {
    cycles.count = encounter.pressed / encounter.duration;
  } else if (encounter.push > 0) {
    double flight = 2 * contact.restitution * encounter.speed / encounter.push;
    if (encounter.swing > 0) flight = std::min(flight, encounter.swing);
    const double left = scenario.end_time - encounter.start;
    cycles.count = 1 + Bounces(left, encounter.duration, flight, contact.restitution);
  } else {
    cycles.count = 1;
  }
  cycles.count = std::max(1.0, std::min(cycles.count, rest));
  cycles.time = std::min(cycles.count * encounter.duration, scenario.end_time);
  if (Iterated(contact)) cycles.passes = encounter.speed > 0 ? kImpactPasses : kPressedPasses;
  return cycles;
}

// Of all contacts. Those of which nothing is known, such as the inner ones of a row, are taken to
// be like the others on average; where nothing is known of any there is only free flight.
std::vector<Cycles> Expect(const Scenario& scenario) {
  std::vector<Cycles> all;
  const auto encounters = Foresee(scenario);
  double count = 0;
  double time = 0;
  for (std::size_t i = 0; i < encounters.size(); ++i) {
    if (!encounters[i]) continue;
    all.push_back(CyclesOf(scenario, scenario.contacts[i], *encounters[i]));
    count += all.back().count;
    time += all.back().time;
  }
  if (all.empty()) return all;
  const auto known = static_cast<double>(all.size());
  for (std::size_t i = 0; i < encounters.size(); ++i) {
    if (encounters[i]) continue;
    all.push_back({.count = count / known,
                   .time = time / known,
                   .passes = Iterated(scenario.contacts[i]) ? kImpactPasses : 1});
  }
  return all;
}

// The fastest load or support, of which no step takes more than half a radian [1/s].
double Rate(const Scenario& scenario) {
  double rate = 0;
  for (const Load& load : scenario.loads) {
    if (load.amplitude != 0) rate = std::max(rate, load.angular_frequency);
  }
  for (const Support& support : scenario.supports) {
    double inverse = 1 / scenario.bodies[static_cast<std::size_t>(support.body)].mass;
    if (support.other != kNone) {
      inverse += 1 / scenario.bodies[static_cast<std::size_t>(support.other)].mass;
    }
    rate = std::max({rate, std::sqrt(support.stiffness * inverse), support.damping * inverse});
  }
  return rate;
}

//   fixed step      end/step, and for each pass that looks for μ the time in cycles once more;
//   error control   the steps of each cycle's passes, and those of the time beside.
double Steps(const Scenario& scenario, const std::vector<Cycles>& cycles) {
  const double step = scenario.solver.fixed_step;
  double steps = step > 0 ? scenario.end_time / step : 1 + 2 * scenario.end_time * Rate(scenario);
  if (step > 0) {
    double again = 0;  // They overlap in time, and are solved together then.
    double passes = 1;
    for (const Cycles& c : cycles) {
      again += c.time;
      passes = std::max(passes, c.passes);
    }
    return steps + (passes - 1) * std::min(again, scenario.end_time) / step;
  }
  for (const Cycles& c : cycles) steps += c.count * (kExactSteps + (c.passes - 1) * kCoarseSteps);
  return steps;
}

double Columns(const Scenario& scenario) {
  return 1 + 2 * static_cast<double>(scenario.bodies.size()) +
         4 * static_cast<double>(scenario.contacts.size());
}

double Samples(const Scenario& scenario) {
  if (scenario.sample_interval == 0) return 0;
  return 1 + std::floor(scenario.end_time / scenario.sample_interval * (1 + 1e-12));
}

// What they take as events, headers of chunks included.
double SampleBytes(const Scenario& scenario) {
  const double samples = Samples(scenario);
  return Columns(scenario) *
         (samples * sizeof(double) + std::ceil(samples / kChunkRows) * kColumnBytes);
}

double LedgerBytes(const std::vector<Cycles>& cycles) {
  double bytes = kLogBytes;
  for (const Cycles& c : cycles) bytes += c.count * (kCycleBytes + c.passes * kUnknownBytes);
  return bytes;
}

// The slopes of a step with their sensitivities to each unknown μ, a chunk of samples, the ledger.
double Memory(const Scenario& scenario, const std::vector<Cycles>& cycles) {
  double unknowns = 0;
  double ledger = 0;
  for (const Cycles& c : cycles) {
    if (c.passes > 1) unknowns += c.count;
    ledger += c.count * kCycleBytes;
  }
  const double state = 2 * static_cast<double>(scenario.bodies.size()) +
                       5 * static_cast<double>(scenario.contacts.size());
  return sizeof(double) * (kStages * state * (1 + std::min(unknowns, kMostUnknowns)) +
                           2 * kChunkRows * Columns(scenario)) +
         ledger;
}

double Seconds(const Scenario& scenario, double steps) {
  const auto parts = static_cast<double>(scenario.bodies.size() + scenario.contacts.size());
  const double share = scenario.solver.fixed_step > 0 ? kFixedStepShare : 1;
  return share * steps * (kStepSeconds + kBodySeconds * parts / 2) +
         kValueSeconds * Samples(scenario) * Columns(scenario);
}

std::int64_t Whole(double value) {
  constexpr double kMost = 9e18;
  return static_cast<std::int64_t>(std::clamp(value, 0.0, kMost));
}

void SetSeconds(double seconds, google::protobuf::Duration* duration) {
  constexpr double kMost = 3e11;  // Of the type, in s.
  const double whole = std::floor(std::min(seconds, kMost));
  duration->set_seconds(static_cast<std::int64_t>(whole));
  if (seconds < kMost) duration->set_nanos(static_cast<std::int32_t>((seconds - whole) * 1e9));
}

}  // namespace

v1::Estimate EstimateRun(const Scenario& scenario) {
  const std::vector<Cycles> cycles = Expect(scenario);
  const double steps = Steps(scenario, cycles);
  v1::Estimate estimate;
  estimate.set_steps(Whole(steps));
  estimate.set_samples(Whole(Samples(scenario)));
  estimate.set_output_bytes(Whole(SampleBytes(scenario) + LedgerBytes(cycles)));
  estimate.set_memory_bytes(Whole(Memory(scenario, cycles)));
  SetSeconds(Seconds(scenario, steps), estimate.mutable_wall_time());
  return estimate;
}

v1::Estimate EstimateSweep(const v1::Sweep& sweep, const DecodedSweep& plan) {
  constexpr double kCellBytes = 60;   // Of its event, and
  constexpr double kNumberBytes = 8;  // for each value and metric.
  const double cells = plan.axes.cells();
  const double kept = sweep.keep_trajectories_size();
  Scenario cell = plan.first;
  const double samples = kept > 0 ? Samples(cell) : 0;
  const double sample_bytes = kept > 0 ? SampleBytes(cell) : 0;
  cell.sample_interval = 0;
  const v1::Estimate one = EstimateRun(cell);

  v1::Estimate estimate;
  estimate.set_steps(Whole(cells * static_cast<double>(one.steps())));
  estimate.set_samples(Whole(kept * samples));
  estimate.set_output_bytes(
      Whole(kLogBytes + kept * sample_bytes +
            cells * (kCellBytes + kNumberBytes * (sweep.axes_size() + sweep.metrics_size()))));
  estimate.set_memory_bytes(one.memory_bytes());
  const double seconds = cells * Seconds(cell, static_cast<double>(one.steps()));
  SetSeconds(seconds + kValueSeconds * kept * samples * Columns(cell),
             estimate.mutable_wall_time());
  return estimate;
}

}  // namespace contact
