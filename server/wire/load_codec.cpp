#include "wire/load_codec.h"

#include <fmt/format.h>

#include <numbers>
#include <utility>

namespace contact {
namespace {

constexpr Range kForce{-1e15, 1e15, "[-1e15, 1e15]"};
constexpr Range kAngularFrequency{0, 1e9, "[0, 1e9]"};
constexpr Range kPhase{-1e3, 1e3, "[-1e3, 1e3]"};
constexpr Range kAcceleration{-1e9, 1e9, "[-1e9, 1e9]"};
constexpr Range kTime{0, 1e6, "[0, 1e6]"};
constexpr Range kDuration{1e-12, 1e6, "[1e-12, 1e6]"};

constexpr double kStandardGravity = 9.80665;  // m/s²
constexpr int kMostPoints = 10'000;

double DecodeAcceleration(const v1::Load::Gravity& gravity, const Rules& rules) {
  const double acceleration =
      gravity.has_acceleration_m_per_s2() ? gravity.acceleration_m_per_s2() : -kStandardGravity;
  rules.Require("gravity.acceleration_m_per_s2", acceleration, kAcceleration);
  return acceleration;
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
  LoadDecoder(const std::vector<Body>& bodies, const BodyNames& names, const Rules& rules,
              std::vector<Load>* loads)
      : bodies_(bodies), names_(names), rules_(rules), loads_(loads) {}

  void Decode(const v1::Load& load) {
    body_ = names_.Find(load.body(), "body", rules_);
    RequireMovable(bodies_, body_, rules_);
    switch (load.kind_case()) {
      case v1::Load::kConstant:
        rules_.Require("constant.force_n", load.constant().force_n(), kForce);
        return Add({.body = body_, .constant = load.constant().force_n()});
      case v1::Load::kSine:
        return Add(Read(load.sine()));
      case v1::Load::kGravity: {
        const double acceleration = DecodeAcceleration(load.gravity(), rules_);
        const double mass = body_ == kNone ? 0 : bodies_[static_cast<std::size_t>(body_)].mass;
        return Add({.body = body_, .constant = mass * acceleration});
      }
      case v1::Load::kStep:
        return Add(Read(load.step()));
      case v1::Load::kRectangularPulse:
        return Add(Read(load.rectangular_pulse()));
      case v1::Load::kHalfSinePulse:
        return Add(Read(load.half_sine_pulse()));
      case v1::Load::kTable:
        return AddTable(load.table());
      case v1::Load::KIND_NOT_SET:
        rules_.Break("", "has no kind",
                     "give one of constant, sine, gravity, step, rectangular_pulse, "
                     "half_sine_pulse and table");
    }
  }

 private:
  void Add(const Load& load) { loads_->push_back(load); }

  Load Read(const v1::Load::Sine& sine) const {
    rules_.Require("sine.amplitude_n", sine.amplitude_n(), kForce);
    rules_.Require("sine.angular_frequency_rad_per_s", sine.angular_frequency_rad_per_s(),
                   kAngularFrequency);
    rules_.Require("sine.phase_rad", sine.phase_rad(), kPhase);
    return {.body = body_,
            .amplitude = sine.amplitude_n(),
            .angular_frequency = sine.angular_frequency_rad_per_s(),
            .phase = sine.phase_rad()};
  }

  Load Read(const v1::Load::Step& step) const {
    rules_.Require("step.force_n", step.force_n(), kForce);
    rules_.Require("step.start_time_s", step.start_time_s(), kTime);
    return {.body = body_, .begin = step.start_time_s(), .constant = step.force_n()};
  }

  Load Read(const v1::Load::RectangularPulse& pulse) const {
    rules_.Require("rectangular_pulse.force_n", pulse.force_n(), kForce);
    rules_.Require("rectangular_pulse.start_time_s", pulse.start_time_s(), kTime);
    RequireDuration("rectangular_pulse.duration_s", pulse.duration_s());
    return {.body = body_,
            .begin = pulse.start_time_s(),
            .end = pulse.start_time_s() + pulse.duration_s(),
            .constant = pulse.force_n()};
  }

  Load Read(const v1::Load::HalfSinePulse& pulse) const {
    rules_.Require("half_sine_pulse.amplitude_n", pulse.amplitude_n(), kForce);
    rules_.Require("half_sine_pulse.start_time_s", pulse.start_time_s(), kTime);
    RequireDuration("half_sine_pulse.duration_s", pulse.duration_s());
    return {.body = body_,
            .begin = pulse.start_time_s(),
            .end = pulse.start_time_s() + pulse.duration_s(),
            .amplitude = pulse.amplitude_n(),
            .angular_frequency = std::numbers::pi / pulse.duration_s()};
  }

  void RequireDuration(std::string_view field, double duration) const {
    if (duration == 0) {
      rules_.Break(field, fmt::format("is missing; must be in {}", kDuration.text));
    } else {
      rules_.Require(field, duration, kDuration);
    }
  }

  void AddTable(const v1::Load::Table& table) {
    if (table.points_size() < 2 || table.points_size() > kMostPoints) {
      rules_.Break("table.points",
                   fmt::format("holds {}; must hold 2 to {}", table.points_size(), kMostPoints));
      return;
    }
    for (int i = 0; i < table.points_size() && !rules_.full(); ++i) {
      const auto& point = table.points(i);
      rules_.Require(fmt::format("table.points[{}].time_s", i), point.time_s(), kTime);
      rules_.Require(fmt::format("table.points[{}].force_n", i), point.force_n(), kForce);
      if (i > 0) AddPiece(table.points(i - 1), point, i);
    }
  }

  void AddPiece(const v1::Load::Table::Point& from, const v1::Load::Table::Point& to, int index) {
    if (to.time_s() <= from.time_s()) {
      rules_.Break(
          fmt::format("table.points[{}].time_s", index),
          fmt::format("is {}, which is not after the {} before", to.time_s(), from.time_s()),
          "points follow one another in time");
      return;
    }
    Add({.body = body_,
         .begin = from.time_s(),
         .end = to.time_s(),
         .constant = from.force_n(),
         .slope = (to.force_n() - from.force_n()) / (to.time_s() - from.time_s())});
  }

  const std::vector<Body>& bodies_;
  const BodyNames& names_;
  const Rules& rules_;
  std::vector<Load>* loads_;
  int body_ = kNone;
};

}  // namespace

void RequireMovable(const std::vector<Body>& bodies, int body, const Rules& rules) {
  if (body == kNone || !bodies[static_cast<std::size_t>(body)].fixed) return;
  rules.Break("body", "is fixed; forces do not move it");
}

std::vector<Load> DecodeLoads(const v1::Scenario& message, const std::vector<Body>& bodies,
                              const BodyNames& names, std::vector<Violation>* violations) {
  std::vector<Load> loads;
  bool gravity_of_all = false;
  for (int i = 0; i < message.loads_size(); ++i) {
    const Rules rules(violations, "loads", i);
    const v1::Load& load = message.loads(i);
    if (!load.has_gravity() || !load.body().empty()) {
      LoadDecoder(bodies, names, rules, &loads).Decode(load);
      continue;
    }
    const double acceleration = DecodeAcceleration(load.gravity(), rules);
    if (std::exchange(gravity_of_all, true)) {
      rules.Break("gravity", "repeats the gravity of every body", "give it once");
    } else {
      AddGravityOfAll(bodies, acceleration, &loads);
    }
  }
  return loads;
}

}  // namespace contact
