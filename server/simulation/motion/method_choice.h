#pragma once

namespace contact {

/// Which of the two methods takes the next step: the explicit one, or the implicit one where strong
/// damping keeps explicit steps short. λ h is the damping in a step: the largest λ = μ δᵖ/m_e of a
/// contact times the length of the step.
class MethodChoice {
 public:
  /// Begins anew, with the explicit method.
  void Begin() { *this = {}; }
  /// Whether the implicit method takes the next step.
  bool implicit() const { return implicit_; }
  /// The explicit method has taken a step of `damping` λ h.
  void AfterExplicit(double damping);
  /// The implicit method goes on with a step of λ h; it has taken the last, or must try again.
  void AfterImplicit(double damping);

 private:
  /// Explicit steps that damping must keep short, one after the other, before the implicit method
  /// is tried.
  static constexpr int kPatience = 10;

  bool implicit_ = false;
  int patience_ = kPatience;
  // Such steps so far.
  int short_steps_ = 0;
  // Steps of the implicit method since it is in use.
  int implicit_steps_ = 0;
};

}  // namespace contact
