#include "simulation/motion/method_choice.h"

#include <algorithm>

namespace contact {
namespace {

// The explicit method is stable up to λ h near 6; from 1 on it loses its order.
constexpr double kDamped = 1;
// Up to this λ h explicit steps can be as long, and cost a fraction of an implicit one.
constexpr double kWorth = 5;
// Steps of a trial. Its first steps are as short as the explicit ones, because they end what these
// have left of the damped motion. A trial of one step was always given up: a ball that a sine
// presses (λ = 3e5/s) took 31,000 steps in 0.2 s at a tolerance of 1e-11 for 160 at 1e-8. A longer
// one costs an implicit step more where it gains nothing. MethodChoice.ATrialHasTime….
constexpr int kTrial = 6;
// After so many steps in a row the implicit method has been worth its trial.
constexpr int kProven = kTrial + 3;
// At most so many steps before the next trial: a trial costs a few of them.
constexpr int kMostPatience = 160;

}  // namespace

void MethodChoice::AfterExplicit(double damping) {
  short_steps_ = damping > kDamped ? short_steps_ + 1 : 0;
  implicit_ = short_steps_ >= patience_;
  implicit_steps_ = 0;
}

// Where it gains nothing, as beside a contact that swings fast, it is tried less and less often.
void MethodChoice::AfterImplicit(double damping) {
  implicit_ = damping >= kWorth || implicit_steps_ < kTrial;
  if (implicit_) {
    ++implicit_steps_;
  } else {
    patience_ = implicit_steps_ > kProven ? kPatience : std::min(2 * patience_, kMostPatience);
    short_steps_ = 0;
  }
}

}  // namespace contact
