#include "simulation/motion/method_choice.h"

#include <algorithm>

namespace contact {
namespace {

// The explicit method is stable up to λ h near 6; from 1 on it loses its order.
constexpr double kDamped = 1;
// Up to this λ h explicit steps can be as long, and cost a fraction of an implicit one.
constexpr double kWorth = 5;
// After so many steps in a row the implicit method has been worth its trial.
constexpr int kProven = 3;
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
  implicit_ = damping >= kWorth;
  if (implicit_) {
    ++implicit_steps_;
  } else {
    patience_ = implicit_steps_ > kProven ? kPatience : std::min(2 * patience_, kMostPatience);
    short_steps_ = 0;
  }
}

}  // namespace contact
