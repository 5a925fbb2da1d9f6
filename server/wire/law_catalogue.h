#pragma once

#include <span>
#include <string_view>

#include "contact/v1/scenario.pb.h"
#include "simulation/laws/damping_law.h"

namespace contact {

/// What is known of a damping law, for people to choose by.
struct LawEntry {
  v1::Contact::Damping damping;
  DampingLaw law;
  std::string_view formula;
  std::string_view source;
  std::string_view range;  ///< For what it was made, and what it needs.

  /// The name in scenarios, such as `HUNT_CROSSLEY`.
  std::string_view name() const;

  /// Whether α is a function of ε alone, so that what an isolated collision gives back is known
  /// in closed form, (L2).
  bool closed_form() const;

  /// α, for ε in (0, 1]. Only with a closed form.
  double Coefficient(double restitution) const;

  /// What an isolated collision gives back for ε in (0, 1]. Only with a closed form.
  double Delivered(double restitution) const;
};

/// Every law but MU, in the order of the contract.
std::span<const LawEntry> LawCatalogue();

}  // namespace contact
