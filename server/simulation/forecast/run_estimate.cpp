#include "simulation/forecast/run_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "simulation/forecast/first_meeting.h"
#include "simulation/model/columns.h"
#include "simulation/model/derived.h"
#include "simulation/model/observer.h"

namespace contact {
namespace {

// Steps of a cycle with error control, in a pass at 1e-11 and in one at the 1e-6 that corrections
// begin with: of an isolated collision and of the scenarios that are shipped.
constexpr double kExactSteps = 45;
constexpr double kCoarseSteps = 25;
// Passes through a cycle: the recording one, and those that look for μ.
constexpr double kImpactPasses = 3;
constexpr double kPressedPasses = 4;

// Steps to the end of a run in which loads move bodies that touch nothing, each longer than the
// last; without a load it takes one.
constexpr double kFlightSteps = 10;

// Of a worker in a release build on a core of an AMD EPYC: simulation_benchmark's Row (a ball costs
// 0.11 µs in a step with error control), Solve and PaperProcess (1.1 and 0.38 µs for a step of
// three balls); bouncing-ball.yaml, with its 60 000 samples of seven values, without, and by RK4;
// and two-balls.yaml without samples.
constexpr double kJobSeconds = 60e-6;  // Of any: its states and events.
constexpr double kStepSeconds = 0.5e-6;
constexpr double kBodySeconds = 0.2e-6;    // A body with a contact, in a step.
constexpr double kFixedStepShare = 0.45;   // Four evaluations instead of twelve.
constexpr double kValueSeconds = 0.02e-6;  // Of a sample: interpolated, encoded and stored.

constexpr double kColumnBytes = 60;    // Name, quantity and unit of a column, in such an event.
constexpr double kColumnMemory = 300;  // The same in memory, of each chunk.
constexpr double kChunksAtOnce = 3;    // Being filled, waiting, and being written.
constexpr double kCycleBytes = 470;    // A row of the ledger and its group, as events.
constexpr double kUnknownBytes = 110;  // A cycle in a row of the iteration.
constexpr double kLogBytes = 600;      // States, attempt and progress of any job.
constexpr double kTangents = 5;        // Arrays of derivatives by a μ, of motion and works.
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

Cycles CyclesOf(const Scenario& scenario, const Contact& contact, const FirstMeeting& meeting) {
  const double rest = meeting.driven
                          ? std::numeric_limits<double>::infinity()
                          : CyclesToRest(contact.restitution,
                                         meeting.speed > 0 ? scenario.solver.settled_fraction
                                                           : scenario.solver.settled_nirv_fraction);
  Cycles cycles;
  if (meeting.speed == 0) {
    cycles.count = meeting.pressed / meeting.duration;
  } else if (meeting.push > 0) {
    double flight = 2 * contact.restitution * meeting.speed / meeting.push;
    if (meeting.swing > 0) flight = std::min(flight, meeting.swing);
    const double left = scenario.end_time - meeting.start;
    cycles.count = 1 + Bounces(left, meeting.duration, flight, contact.restitution);
  } else {
    cycles.count = 1;
  }
  cycles.count = std::max(1.0, std::min(cycles.count, rest));
  cycles.time = std::min(cycles.count * meeting.duration, scenario.end_time);
  if (Iterated(contact)) cycles.passes = meeting.speed > 0 ? kImpactPasses : kPressedPasses;
  return cycles;
}

// Of all contacts. Those of which nothing is known, such as the inner ones of a row, are taken to
// be like the others on average; where nothing is known of any there is only free flight.
std::vector<Cycles> Expect(const Scenario& scenario) {
  std::vector<Cycles> all;
  const auto meetings = ForecastFirstMeetings(scenario);
  double count = 0;
  double time = 0;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i]) continue;
    all.push_back(CyclesOf(scenario, scenario.contacts[i], *meetings[i]));
    count += all.back().count;
    time += all.back().time;
  }
  if (all.empty()) return all;
  const auto known = static_cast<double>(all.size());
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (meetings[i]) continue;
    all.push_back({.count = count / known,
                   .time = time / known,
                   .passes = Iterated(scenario.contacts[i]) ? kImpactPasses : 1});
  }
  return all;
}

// With a fixed step they are end/step, and for each pass that looks for μ the time in cycles once
// more. With error control they are the steps of each cycle's passes, and those of the time beside:
// no step takes more than half a radian of the fastest load or support.
double Steps(const Scenario& scenario, const std::vector<Cycles>& cycles) {
  const double step = scenario.solver.fixed_step;
  const double flight = scenario.loads.empty() && scenario.drives.empty() ? 1 : kFlightSteps;
  const double rate = ForcingRate(scenario, scenario.loads, scenario.drives);
  double steps = step > 0 ? scenario.end_time / step : flight + 2 * scenario.end_time * rate;
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

double Columns(const Scenario& scenario) { return SampleColumns(scenario); }

double Rows(const Scenario& scenario, const std::vector<Cycles>& cycles) {
  if (scenario.sample_interval == 0) return 0;
  double in_cycles = 0;
  for (const Cycles& c : cycles) {
    const double spacing = c.time / c.count / scenario.samples_per_contact;
    if (!scenario.wants_all_contact_samples && !(spacing < scenario.sample_interval)) continue;
    in_cycles += c.count * scenario.samples_per_contact;
  }
  const double regular = 1 + std::floor(scenario.end_time / scenario.sample_interval * (1 + 1e-12));
  const auto most = static_cast<double>(scenario.most_contact_samples);
  if (in_cycles <= most) return regular + std::round(in_cycles);
  // Of the cycles after these the extremes are taken.
  const double unseen = std::floor((in_cycles - most) / scenario.samples_per_contact);
  return regular + most + std::min(unseen, regular) * 2 * scenario.turning_channels;
}

// Rows of a chunk.
double ChunkRows(const Scenario& scenario) {
  return RowsPerChunk(static_cast<int>(Columns(scenario)));
}

// What they take if each column of a chunk takes so much beside its values.
double SampleBytes(const Scenario& scenario, double samples, double column_bytes) {
  return Columns(scenario) *
         (samples * sizeof(double) + std::ceil(samples / ChunkRows(scenario)) * column_bytes);
}

double LedgerMemory(const std::vector<Cycles>& cycles) {
  double bytes = 0;
  for (const Cycles& c : cycles) bytes += c.count * kCycleBytes;
  return bytes;
}

double LedgerBytes(const std::vector<Cycles>& cycles) {
  double bytes = kLogBytes;
  for (const Cycles& c : cycles) bytes += c.count * (kCycleBytes + c.passes * kUnknownBytes);
  return bytes;
}

// The slopes of a step, the derivatives by each unknown μ, and chunks of samples.
double Memory(const Scenario& scenario, const std::vector<Cycles>& cycles, double samples) {
  double unknowns = 0;
  for (const Cycles& c : cycles) unknowns += c.passes > 1 ? c.count : 0;
  const double state = 2 * static_cast<double>(scenario.bodies.size()) +
                       5 * static_cast<double>(scenario.contacts.size());
  const double columns = std::min<double>(unknowns, kMostColumns);
  const double pending = std::min(samples, kChunksAtOnce * ChunkRows(scenario));
  return sizeof(double) * state * (kStages + kTangents * columns) +
         SampleBytes(scenario, pending, kColumnMemory);
}

double SolveSeconds(const Scenario& scenario, double steps) {
  const double all = static_cast<double>(scenario.bodies.size() + scenario.contacts.size());
  const double parts = MayPart(scenario) ? std::min(all, 3.0) : all;  // Two bodies that touch.
  const double share = scenario.solver.fixed_step > 0 ? kFixedStepShare : 1;
  return kJobSeconds + share * steps * (kStepSeconds + kBodySeconds * parts / 2);
}

// Whether steps and time can be told: only of bodies that nothing holds or moves and that touch one
// other body or wall at most. Elsewhere nothing tells how many passes the search for their μ takes.
bool Foreseeable(const Scenario& scenario) {
  std::vector<int> contacts(scenario.bodies.size());
  return scenario.supports.empty() && scenario.drives.empty() &&
         std::ranges::none_of(scenario.contacts, [&](const Contact& contact) {
           return std::ranges::any_of(std::array{contact.left, contact.right}, [&](int body) {
             return body != kNone && ++contacts[static_cast<std::size_t>(body)] > 1;
           });
         });
}

}  // namespace

RunEstimate EstimateRunOf(const Scenario& scenario) {
  const std::vector<Cycles> cycles = Expect(scenario);
  RunEstimate estimate;
  estimate.samples = Rows(scenario, cycles);
  estimate.sample_bytes = SampleBytes(scenario, estimate.samples, kColumnBytes);
  estimate.sample_memory = SampleBytes(scenario, estimate.samples, kColumnMemory);
  estimate.ledger_bytes = LedgerBytes(cycles);
  estimate.fixed_memory = Memory(scenario, cycles, estimate.samples);
  estimate.memory_bytes = estimate.fixed_memory + LedgerMemory(cycles);
  estimate.sample_seconds = kValueSeconds * estimate.samples * Columns(scenario);
  if (!Foreseeable(scenario)) return estimate;
  estimate.steps = Steps(scenario, cycles);
  estimate.solve_seconds = SolveSeconds(scenario, *estimate.steps);
  return estimate;
}

}  // namespace contact
