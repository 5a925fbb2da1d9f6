#include "translate/stepping.h"

#include <algorithm>
#include <cmath>

namespace contact::translate {
namespace {

// The mean over 32 touches is that over 1,000 within 1e-4 where a contact takes ten steps.
constexpr int kTouches = 32;
// A contact of 20,000 steps, the most that are looked at, has not ended after ten times as many
// only where it never ends.
constexpr int kMostSteps = 200'000;
// Slower than this, in units of the approach, in two steps one after the other, a body rests: where
// it turns it gains more in a step, 1.5e-4 with 20,000 steps.
constexpr double kRest = 1e-9;

struct Motion {
  double deformation, velocity;
  double acceleration = 0;
};

class Stepper {
 public:
  Stepper(const ForceLaw& law, const Collision& collision, double step)
      : law_(law), collision_(collision), step_(step) {}

  void Euler(Motion* at) const {
    at->velocity += step_ * Acceleration(at->deformation, at->velocity);
    at->deformation += step_ * at->velocity;
  }

  void Verlet(Motion* at) const {
    const double half = at->velocity + step_ / 2 * at->acceleration;
    at->deformation += step_ * half;
    at->acceleration = Acceleration(at->deformation, half);
    at->velocity = half + step_ / 2 * at->acceleration;
  }

  // The impulse λ ≥ 0 of the constraint v⁺ = −ERP/h δ + CFM λ/h, with h k + c = 1/CFM.
  void Implicit(Motion* at) const {
    at->velocity += step_ * collision_.load / collision_.mass;
    if (at->deformation > 0) Brake(law_.stiffness * at->deformation, at);
    at->deformation += step_ * at->velocity;
  }

  // Before the touch ERP is 1: the constraint lets the bodies come just to the touch.
  void Speculative(Motion* at) const {
    at->velocity += step_ * collision_.load / collision_.mass;
    Brake(at->deformation * (at->deformation > 0 ? law_.stiffness : Firmness() / step_), at);
    at->deformation += step_ * at->velocity;
  }

 private:
  double Firmness() const { return step_ * law_.stiffness + law_.damping; }

  void Brake(double force, Motion* at) const {
    const double impulse =
        step_ * (force + Firmness() * at->velocity) / (1 + step_ * Firmness() / collision_.mass);
    at->velocity -= std::max(0.0, impulse) / collision_.mass;
  }

  double Acceleration(double deformation, double velocity) const {
    const double force = deformation > 0 ? law_.Force(deformation, velocity, collision_.load) : 0;
    return (collision_.load - force) / collision_.mass;
  }

  const ForceLaw& law_;
  const Collision& collision_;
  const double step_;
};

// e_N of one collision that begins `before` [m] from the touch.
template <class Advance>
double RatioOf(Advance advance, const Collision& collision, double before) {
  Motion motion{-before, collision.velocity};
  bool touched = false, slow = false;
  for (int i = 0; i < kMostSteps; ++i) {
    advance(&motion);
    const bool slower = std::abs(motion.velocity) < kRest * collision.velocity;
    if (slow && slower) break;
    slow = slower;
    touched = touched || motion.deformation > 0;
    if (touched && motion.deformation <= 0 && motion.velocity < 0)
      return -motion.velocity / collision.velocity;
  }
  return 0;
}

template <class Advance>
SteppedRebound Over(Advance advance, const Collision& collision, double step) {
  SteppedRebound all{1e300, 0, -1e300};
  for (int i = 0; i < kTouches; ++i) {
    const double before = (i + 0.5) / kTouches * step * collision.velocity;
    const double ratio = RatioOf(advance, collision, before);
    all.least = std::min(all.least, ratio);
    all.most = std::max(all.most, ratio);
    all.mean += ratio / kTouches;
  }
  return all;
}

}  // namespace

SteppedRebound Step(const ForceLaw& law, const Collision& collision, Stepping stepping,
                    double step) {
  const Stepper stepper(law, collision, step);
  switch (stepping) {
    case Stepping::kSymplecticEuler:
      return Over([&](Motion* at) { stepper.Euler(at); }, collision, step);
    case Stepping::kVerlet:
      return Over([&](Motion* at) { stepper.Verlet(at); }, collision, step);
    case Stepping::kImplicitEuler:
      return Over([&](Motion* at) { stepper.Implicit(at); }, collision, step);
    case Stepping::kSpeculative:
      return Over([&](Motion* at) { stepper.Speculative(at); }, collision, step);
    case Stepping::kAccurate:
      break;
  }
  return {};
}

}  // namespace contact::translate
