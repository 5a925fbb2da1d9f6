#include "wire/scenario/motion_codec.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "simulation/model/derived.h"
#include "wire/scenario/frequency.h"
#include "wire/scenario/time_table.h"

namespace contact {
namespace {

using v1::Motion;
using Positions = Motion::PositionTable;
using Velocities = Motion::VelocityTable;
using Accelerations = Motion::AccelerationTable;

constexpr TableFields<Positions> kPositions{
    &Positions::Point::position_m, Positions::Point::kPositionMFieldNumber, &Positions::positions_m,
    Positions::kPositionsMFieldNumber};
constexpr TableFields<Velocities> kVelocities{
    &Velocities::Point::velocity_m_per_s, Velocities::Point::kVelocityMPerSFieldNumber,
    &Velocities::velocities_m_per_s, Velocities::kVelocitiesMPerSFieldNumber};
constexpr TableFields<Accelerations> kAccelerations{
    &Accelerations::Point::acceleration_m_per_s2,
    Accelerations::Point::kAccelerationMPerS2FieldNumber, &Accelerations::accelerations_m_per_s2,
    Accelerations::kAccelerationsMPerS2FieldNumber};

// The slopes at three or more points of parabolas through each and its neighbours; of two, the
// slope of their line.
std::vector<double> Slopes(const TimeTable& s) {
  const std::size_t n = s.times.size();
  const auto chord = [&](std::size_t i) {
    return (s.values[i + 1] - s.values[i]) / (s.times[i + 1] - s.times[i]);
  };
  if (n == 2) return {chord(0), chord(0)};
  // The slope at t of the parabola through the points i − 1, i and i + 1.
  const auto parabola = [&](std::size_t i, double t) {
    const double bend = (chord(i) - chord(i - 1)) / (s.times[i + 1] - s.times[i - 1]);
    return chord(i - 1) + bend * (2 * t - s.times[i - 1] - s.times[i]);
  };
  std::vector<double> slopes;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t middle = i == 0 ? 1 : i == n - 1 ? n - 2 : i;
    slopes.push_back(parabola(middle, s.times[i]));
  }
  return slopes;
}

// The pieces of a motion one after the other, each from where the last one leads.
class Pieces {
 public:
  Pieces(double position, double velocity) : position_(position), velocity_(velocity) {}

  // Adds a piece until `end`, after which the next begins.
  void Add(double end, double acceleration, double jerk) {
    if (end <= begin_) return;
    const Drive piece{.begin = begin_,
                      .end = end,
                      .position = position_,
                      .velocity = velocity_,
                      .acceleration = acceleration,
                      .jerk = jerk};
    const DrivenMotion last = MotionAt(piece, end);
    begin_ = end, position_ = last.position, velocity_ = last.velocity;
    all_.push_back(piece);
  }
  // Adds the last piece, without acceleration, and returns all.
  std::vector<Drive> Finish() {
    all_.push_back({.begin = begin_, .position = position_, .velocity = velocity_});
    return std::move(all_);
  }

 private:
  std::vector<Drive> all_;
  double begin_ = 0, position_, velocity_;
};

// Hermite's cubic between one point and the next; each begins at its point, whatever sums left.
std::vector<Drive> OfPositions(const TimeTable& s, double origin) {
  const std::vector<double> slopes = Slopes(s);
  std::vector<Drive> pieces;
  if (s.times[0] > 0) {
    pieces.push_back({.end = s.times[0],
                      .position = origin + s.values[0] - slopes[0] * s.times[0],
                      .velocity = slopes[0]});
  }
  for (std::size_t i = 0; i + 1 < s.times.size(); ++i) {
    const double h = s.times[i + 1] - s.times[i];
    const double chord = (s.values[i + 1] - s.values[i]) / h;
    pieces.push_back({.begin = s.times[i],
                      .end = s.times[i + 1],
                      .position = origin + s.values[i],
                      .velocity = slopes[i],
                      .acceleration = (6 * chord - 4 * slopes[i] - 2 * slopes[i + 1]) / h,
                      .jerk = 6 * (slopes[i] + slopes[i + 1] - 2 * chord) / (h * h)});
  }
  pieces.push_back(
      {.begin = s.times.back(), .position = origin + s.values.back(), .velocity = slopes.back()});
  return pieces;
}

std::vector<Drive> OfVelocities(const TimeTable& s, double origin) {
  Pieces pieces(origin, s.values[0]);
  pieces.Add(s.times[0], 0, 0);
  for (std::size_t i = 0; i + 1 < s.times.size(); ++i) {
    pieces.Add(s.times[i + 1], (s.values[i + 1] - s.values[i]) / (s.times[i + 1] - s.times[i]), 0);
  }
  return pieces.Finish();
}

std::vector<Drive> OfAccelerations(const TimeTable& s, double origin, double velocity) {
  Pieces pieces(origin, velocity);
  pieces.Add(s.times[0], 0, 0);
  for (std::size_t i = 0; i + 1 < s.times.size(); ++i) {
    pieces.Add(s.times[i + 1], s.values[i],
               (s.values[i + 1] - s.values[i]) / (s.times[i + 1] - s.times[i]));
  }
  return pieces.Finish();
}

Drive OfSine(const Motion::Sine& sine, double origin, const Rules& rules) {
  const Drive swing{.position = origin,
                    .amplitude = rules.Read(sine, Motion::Sine::kAmplitudeMFieldNumber),
                    .angular_frequency = DecodeAngularFrequency(sine, rules),
                    .phase = rules.Read(sine, Motion::Sine::kPhaseRadFieldNumber)};
  const double speed = std::abs(swing.amplitude) * swing.angular_frequency;
  const Range& speeds = NumberOf<Motion::Uniform>(Motion::Uniform::kVelocityMPerSFieldNumber).range;
  if (std::isfinite(speed) && !speeds.Contains(speed)) {
    rules.Break("amplitude_m",
                fmt::format("makes a speed of {} m/s; must be {}", speed, speeds.text));
  }
  return swing;
}

}  // namespace

std::vector<Drive> DecodeMotion(const Motion& motion, double origin, const Rules& rules) {
  switch (motion.kind_case()) {
    case Motion::kUniform: {
      const double velocity =
          rules.In("uniform").Read(motion.uniform(), Motion::Uniform::kVelocityMPerSFieldNumber);
      return {{.position = origin, .velocity = velocity}};
    }
    case Motion::kSine:
      return {OfSine(motion.sine(), origin, rules.In("sine"))};
    case Motion::kPositionTable: {
      const TimeTable table =
          ReadTimeTable(motion.position_table(), kPositions, rules.In("position_table"));
      return table.empty() ? std::vector<Drive>() : OfPositions(table, origin);
    }
    case Motion::kVelocityTable: {
      const TimeTable table =
          ReadTimeTable(motion.velocity_table(), kVelocities, rules.In("velocity_table"));
      return table.empty() ? std::vector<Drive>() : OfVelocities(table, origin);
    }
    case Motion::kAccelerationTable: {
      const Rules here = rules.In("acceleration_table");
      const double velocity = here.Read(motion.acceleration_table(),
                                        Motion::AccelerationTable::kVelocityMPerSFieldNumber);
      const TimeTable table = ReadTimeTable(motion.acceleration_table(), kAccelerations, here);
      return table.empty() ? std::vector<Drive>() : OfAccelerations(table, origin, velocity);
    }
    case Motion::KIND_NOT_SET:
      break;
  }
  rules.Break("", "has no kind",
              "give one of uniform, sine, position_table, velocity_table and acceleration_table");
  return {};
}

void AddMotion(std::vector<Drive> pieces, int index, Body* body, std::vector<Drive>* drives) {
  if (pieces.empty()) return;
  const DrivenMotion start = MotionAt(pieces[0], 0);
  body->position = start.position;
  body->velocity = start.velocity;
  for (Drive& piece : pieces) {
    piece.body = index;
    drives->push_back(piece);
  }
}

}  // namespace contact
