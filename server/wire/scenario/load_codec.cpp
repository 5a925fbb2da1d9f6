#include "wire/scenario/load_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "wire/scenario/frequency.h"
#include "wire/scenario/time_table.h"

namespace contact {
namespace {

// Pieces of loads that tables which come again may make, so that a period of a nanosecond does not
// take all memory: these take 64 MB. Each is a step of the run at least.
constexpr int kMostPieces = 1'000'000;
// Part of the last time of a table by which sums of decimal times may miss the period.
constexpr double kRoundOff = 1e-14;
constexpr double kNever = std::numeric_limits<double>::infinity();

using Forces = v1::Load::Table;
constexpr TableFields<Forces> kForces{&Forces::Point::force_n, Forces::Point::kForceNFieldNumber,
                                      &Forces::forces_n, Forces::kForcesNFieldNumber};

double DecodeAcceleration(const v1::Load& load, const Rules& rules) {
  return rules.In("gravity").Read(load.gravity(),
                                  v1::Load::Gravity::kAccelerationMPerS2FieldNumber);
}

void AddGravityOfAll(const std::vector<Body>& bodies, double acceleration,
                     std::vector<Load>* loads) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].fixed) continue;
    loads->push_back({.body = static_cast<int>(i), .constant = bodies[i].mass * acceleration});
  }
}

// Reads one load that acts on one named body.
class LoadDecoder {
 public:
  LoadDecoder(const v1::Scenario& message, const std::vector<Body>& bodies, const BodyNames& names,
              const Rules& rules, std::vector<Load>* loads)
      : message_(message), bodies_(bodies), names_(names), rules_(rules), loads_(loads) {}

  void Decode(const v1::Load& load) {
    body_ = names_.Find(load.body(), "body", rules_);
    RequireMovable(message_, body_, rules_);
    switch (load.kind_case()) {
      case v1::Load::kConstant:
        return Add(Read(load.constant(), rules_.In("constant")));
      case v1::Load::kSine:
        return Add(Read(load.sine(), rules_.In("sine")));
      case v1::Load::kGravity: {
        const double acceleration = DecodeAcceleration(load, rules_);
        const double mass = body_ == kNone ? 0 : bodies_[static_cast<std::size_t>(body_)].mass;
        return Add({.body = body_, .constant = mass * acceleration});
      }
      case v1::Load::kStep:
        return Add(Read(load.step(), rules_.In("step")));
      case v1::Load::kRectangularPulse:
        return Add(Read(load.rectangular_pulse(), rules_.In("rectangular_pulse")));
      case v1::Load::kHalfSinePulse:
        return Add(Read(load.half_sine_pulse(), rules_.In("half_sine_pulse")));
      case v1::Load::kTable:
        return AddTable(load.table(), rules_.In("table"));
      case v1::Load::KIND_NOT_SET:
        rules_.Break("", "has no kind",
                     "give one of constant, sine, gravity, step, rectangular_pulse, "
                     "half_sine_pulse and table");
    }
  }

 private:
  void Add(const Load& load) { loads_->push_back(load); }

  Load Read(const v1::Load::Constant& constant, const Rules& rules) const {
    return {.body = body_,
            .constant = rules.Read(constant, v1::Load::Constant::kForceNFieldNumber)};
  }

  Load Read(const v1::Load::Sine& sine, const Rules& rules) const {
    using Field = v1::Load::Sine;
    return {.body = body_,
            .amplitude = rules.Read(sine, Field::kAmplitudeNFieldNumber),
            .angular_frequency = DecodeAngularFrequency(sine, rules),
            .phase = rules.Read(sine, Field::kPhaseRadFieldNumber)};
  }

  Load Read(const v1::Load::Step& step, const Rules& rules) const {
    Load load{.body = body_};
    load.constant = rules.Read(step, v1::Load::Step::kForceNFieldNumber);
    load.begin = rules.Read(step, v1::Load::Step::kStartTimeSFieldNumber);
    return load;
  }

  Load Read(const v1::Load::RectangularPulse& pulse, const Rules& rules) const {
    Load load{.body = body_};
    load.constant = rules.Read(pulse, v1::Load::RectangularPulse::kForceNFieldNumber);
    load.begin = rules.Read(pulse, v1::Load::RectangularPulse::kStartTimeSFieldNumber);
    load.end = load.begin + rules.Read(pulse, v1::Load::RectangularPulse::kDurationSFieldNumber);
    return load;
  }

  Load Read(const v1::Load::HalfSinePulse& pulse, const Rules& rules) const {
    Load load{.body = body_};
    load.amplitude = rules.Read(pulse, v1::Load::HalfSinePulse::kAmplitudeNFieldNumber);
    load.begin = rules.Read(pulse, v1::Load::HalfSinePulse::kStartTimeSFieldNumber);
    const double duration = rules.Read(pulse, v1::Load::HalfSinePulse::kDurationSFieldNumber);
    load.end = load.begin + duration;
    load.angular_frequency = std::numbers::pi / duration;
    return load;
  }

  void AddTable(const Forces& message, const Rules& rules) {
    const TimeTable table = ReadTimeTable(message, kForces, rules);
    if (!message.has_period_s()) return AddOnce(table, 0, kNever);
    const double period = rules.Read(message, Forces::kPeriodSFieldNumber);
    const Range& periods_allowed = NumberOf<Forces>(Forces::kPeriodSFieldNumber).range;
    if (table.empty() || !periods_allowed.Contains(period)) return;
    const double length = table.times.back() - table.times.front();
    const double touching = kRoundOff * table.times.back();
    if (period < length - touching) {
      rules.Break("period_s", fmt::format("is {}; must be at least {}, from the first point to the "
                                          "last",
                                          period, length));
      return;
    }
    const double periods = PeriodsOf(table, period);
    if (!HasRoomFor(periods * static_cast<double>(table.times.size() - 1), period, rules)) return;
    for (int i = 0; i < static_cast<int>(periods); ++i) {
      const double end = period <= length + touching ? (i + 1) * period : kNever;
      AddOnce(table, i * period, table.times.front() + end);
    }
  }

  // How often a table comes until the end of the run, at least once.
  double PeriodsOf(const TimeTable& table, double period) const {
    const Range& times = NumberOf<v1::Scenario>(v1::Scenario::kEndTimeSFieldNumber).range;
    if (!times.Contains(message_.end_time_s())) return 1;
    return std::max(std::ceil((message_.end_time_s() - table.times.front()) / period), 1.0);
  }

  bool HasRoomFor(double pieces, double period, const Rules& rules) const {
    if (static_cast<double>(loads_->size()) + pieces <= kMostPieces) return true;
    rules.Break(
        "period_s",
        fmt::format("is {}, with which all tables have {:.0f} pieces until end_time_s; must "
                    "have at most {}",
                    period, static_cast<double>(loads_->size()) + pieces, kMostPieces),
        "give fewer points, an earlier end_time_s, or a sine");
    return false;
  }

  // Adds the pieces of a table that begins `delay` later than it says. Its last piece does not go
  // on past `next`, where the table begins again; at `next`, to round-off, it ends in any case.
  void AddOnce(const TimeTable& table, double delay, double next) {
    for (std::size_t i = 1; i < table.times.size(); ++i) {
      const double begin = table.times[i - 1], end = table.times[i];
      Load piece{.body = body_,
                 .begin = begin + delay,
                 .end = end + delay,
                 .constant = table.values[i - 1],
                 .slope = (table.values[i] - table.values[i - 1]) / (end - begin)};
      if (i + 1 == table.times.size() && next != kNever) piece.end = next;
      if (piece.begin < piece.end) Add(piece);
    }
  }

  const v1::Scenario& message_;
  const std::vector<Body>& bodies_;
  const BodyNames& names_;
  const Rules& rules_;
  std::vector<Load>* loads_;
  int body_ = kNone;
};

}  // namespace

void RequireMovable(const v1::Scenario& message, int body, const Rules& rules) {
  if (body == kNone) return;
  if (message.bodies(body).has_motion()) {
    rules.Break("body", "moves as its motion says; forces do not move it");
  } else if (message.bodies(body).fixed()) {
    rules.Break("body", "is fixed; forces do not move it");
  }
}

std::vector<Load> DecodeLoads(const v1::Scenario& message, const std::vector<Body>& bodies,
                              const BodyNames& names, std::vector<Violation>* violations) {
  std::vector<Load> loads;
  bool gravity_of_all = false;
  for (int i = 0; i < message.loads_size(); ++i) {
    const Rules rules(violations, "loads", i);
    const v1::Load& load = message.loads(i);
    if (!load.has_gravity() || !load.body().empty()) {
      LoadDecoder(message, bodies, names, rules, &loads).Decode(load);
      continue;
    }
    const double acceleration = DecodeAcceleration(load, rules);
    if (std::exchange(gravity_of_all, true)) {
      rules.Break("gravity", "repeats the gravity of every body", "give it once");
    } else {
      AddGravityOfAll(bodies, acceleration, &loads);
    }
  }
  return loads;
}

}  // namespace contact
