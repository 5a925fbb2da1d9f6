#include "wire/scenario/load_codec.h"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "wire/scenario/frequency.h"

namespace contact {
namespace {

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

  void AddTable(const v1::Load::Table& table, const Rules& rules) {
    const v1::FieldRule& rule = RuleOf<v1::Load::Table>(v1::Load::Table::kPointsFieldNumber);
    const int count = table.points_size();
    if (count < rule.min_entries() || count > rule.max_entries()) {
      rules.Break("points", fmt::format("holds {}; must hold {} to {}", count, rule.min_entries(),
                                        rule.max_entries()));
      return;
    }
    for (int i = 0; i < count && !rules.full(); ++i) {
      using Point = v1::Load::Table::Point;
      const Point& point = table.points(i);
      const Rules here = rules.In("points", i);
      here.Check<Point>(Point::kTimeSFieldNumber, point.time_s());
      here.Check<Point>(Point::kForceNFieldNumber, point.force_n());
      if (i > 0) AddPiece(table.points(i - 1), point, here);
    }
  }

  // `rules` are for the point `to`.
  void AddPiece(const v1::Load::Table::Point& from, const v1::Load::Table::Point& to,
                const Rules& rules) {
    if (to.time_s() <= from.time_s()) {
      rules.Break(
          "time_s",
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
