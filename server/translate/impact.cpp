#include "translate/impact.h"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>

namespace contact::translate {
namespace {

// δ, δ̇ and the work of the force, in units in which k, m_e and v are 1.
using State = std::array<double, 3>;

// Tolerance and longest step: of the laws with closed forms the restitution comes out within 1e-9
// (tests/translate). A step of 0.05 is a sixtieth of an undamped contact, so no step passes
// over two events.
constexpr double kTolerance = 1e-12, kLongestStep = 0.05;
// An undamped contact lasts 3.2. What has not ended after 200 creeps back without end: no rebound.
constexpr double kLongest = 200;
// 200 takes 60,000 steps with as much damping as is looked at, and less than 20,000 without. More
// are taken where the load is enormous, and nothing comes back.
constexpr int kMostCourseSteps = 500'000;

double Cubic(double x) { return x >= 1 ? 1 : x * x * (3 - 2 * x); }

// The law and the load in the units of the collision.
ForceLaw Scaled(ForceLaw law, const Collision& collision) {
  law.damping /= DampingUnit(law, collision);
  law.full_depth /= LengthUnit(law, collision);
  law.stiffness = 1;
  return law;
}

// The course of one collision, in units.
class Course {
 public:
  Course(const ForceLaw& law, double load) : law_(law), load_(load) {
    stepper_.initialize(State{0, 1, 0}, 0, 1e-6);
  }

  Rebound Run() {
    for (int i = 0; !over_ && i < kMostCourseSteps && stepper_.current_time() < kLongest; ++i) {
      stepper_.do_step([this](const State& x, State& slope, double /*t*/) { slope = SlopeAt(x); });
      Note(stepper_.current_state());
    }
    if (rebound_.velocity_ratio == 0) {
      rebound_.restitution = std::numeric_limits<double>::quiet_NaN();
    }
    return rebound_;
  }

 private:
  double ForceAt(const State& x) const { return x[0] > 0 ? law_.Force(x[0], x[1], load_) : 0; }

  State SlopeAt(const State& x) const {
    const double force = ForceAt(x);
    return {x[1], load_ - force, force * x[1]};
  }

  // The instant in the last step at which `value` of the state falls to 0.
  template <class Value>
  double InstantOf(Value value) const {
    double low = stepper_.previous_time(), high = stepper_.current_time();
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (value(StateAt(middle)) > 0 ? low : high) = middle;
    }
    return high;
  }

  State StateAt(double time) const {
    State x;
    stepper_.calc_state(time, x);
    return x;
  }

  void Note(const State& x) {
    const double force = ForceAt(x);
    rebound_.peak_force = std::max(rebound_.peak_force, force);
    rebound_.pull = std::max(rebound_.pull, -force);
    if (!returns_ && x[1] <= 0) Turn();
    if (!returns_) return;
    if (rebound_.duration == 0 && law_.pull != Pull::kAllowed && force <= 0) {
      rebound_.duration = InstantOf([this](const State& at) { return ForceAt(at); });
    }
    if (x[0] <= 0) Part();
    if (x[1] > 0) over_ = true;  // Under a load the bodies stop before they part.
  }

  void Turn() {
    const State turn = StateAt(InstantOf([](const State& at) { return at[1]; }));
    rebound_.deformation = turn[0];
    compression_ = turn[2];
    returns_ = true;
  }

  void Part() {
    const double time = InstantOf([](const State& at) { return at[0]; });
    const State end = StateAt(time);
    if (rebound_.duration == 0) rebound_.duration = time;
    rebound_.velocity_ratio = std::max(0.0, -end[1]);
    rebound_.restitution = std::sqrt(std::max(0.0, compression_ - end[2]) / compression_);
    over_ = true;
  }

  const ForceLaw law_;
  const double load_;
  boost::numeric::odeint::result_of::make_dense_output<
      boost::numeric::odeint::runge_kutta_dopri5<State>>::type stepper_ =
      boost::numeric::odeint::make_dense_output(
          kTolerance, kTolerance, kLongestStep,
          boost::numeric::odeint::runge_kutta_dopri5<State>());
  Rebound rebound_;
  // Work of the compression.
  double compression_ = 0;
  bool returns_ = false;
  bool over_ = false;
};

}  // namespace

double ForceLaw::Force(double deformation, double velocity, double load) const {
  const double spring = stiffness * std::pow(deformation, exponent);
  double damper = damping * velocity;
  if (damping_exponent > 0) damper *= std::pow(deformation, damping_exponent);
  if (full_depth > 0) damper *= Cubic(deformation / full_depth);
  const double carried = carries_load ? load : 0;
  switch (pull) {
    case Pull::kAllowed:
      return spring + damper + carried;
    case Pull::kClamped:
      return std::max(0.0, spring + damper + carried);
    case Pull::kUndampedReturn:
      return spring + std::max(0.0, damper);
    case Pull::kLimitedDamper:
      return spring + std::clamp(damper, -spring, spring);
  }
  return 0;
}

double LengthUnit(const ForceLaw& law, const Collision& collision) {
  return std::pow(collision.mass * collision.velocity * collision.velocity / law.stiffness,
                  1 / (law.exponent + 1));
}

double DampingUnit(const ForceLaw& law, const Collision& collision) {
  return collision.mass * collision.velocity /
         std::pow(LengthUnit(law, collision), law.damping_exponent + 1);
}

Rebound Collide(const ForceLaw& law, const Collision& collision) {
  const double length = LengthUnit(law, collision);
  const double force = collision.mass * collision.velocity * collision.velocity / length;
  Rebound rebound = Course(Scaled(law, collision), collision.load / force).Run();
  rebound.duration *= length / collision.velocity;
  rebound.deformation *= length;
  rebound.peak_force *= force;
  rebound.pull *= force;
  return rebound;
}

}  // namespace contact::translate
