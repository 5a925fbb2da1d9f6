#pragma once

#include <span>
#include <string_view>

#include "simulation/laws/isolated_collision.h"

namespace contact {

/// How the damping factor μ of a cycle, in F = k δⁿ + μ δᵖ δ̇, is found. The numbers are those of
/// contact.v1.Contact.Damping and never change; checkpoints hold them. Formula and source of each
/// are in its row of DampingLaws().
enum class DampingLaw {
  kEnergyRestitution = 1,  ///< μ is iterated until ε_out = ε_in.
  kExact = 2,
  kPaperEq23 = 3,
  kHuntCrossley = 4,
  kLankaraniNikravesh = 5,
  kFlores = 6,
  kHuGuo = 7,
  kLeeWang = 8,
  kHerbertMcWhannell = 9,
  kZhiyingQishao = 10,
  kGonthier = 11,
  kCarvalhoMartins = 12,
  kGharibHurmuzlu = 13,
  kKelvinVoigt = 14,
  kHertzQuarterPower = 15,
  kGiven = 16,       ///< μ is a number of the scenario.
  kDashpot = 17,     ///< So is c, which stands for μ.
  kForceTable = 18,  ///< There is no damping but by the way back of Contact::table.
};

/// How μ follows from the dimensionless α(ε) of a law.
enum class DampingScale {
  /// μ = α k/δ̇⁻, p = n: (L1) to (L3) tell what α delivers in an isolated collision.
  kVelocity,
  /// μ = α √(k m_e): no approach velocity is needed.
  kMass,
  /// There is no α: μ is given.
  kNone,
};

/// All that is known of a damping law. A law is added by its number in the contract, its
/// enumerator, its row in damping_law.cpp, and its row in README.md of simulation/.
struct DampingLawRow {
  DampingLaw law;
  /// How μ follows from α.
  DampingScale scale;
  /// As in scenarios, such as `HUNT_CROSSLEY`.
  std::string_view name;
  /// α(ε) [-] for ε in (0, 1]; null for kNone.
  double (*alpha)(double restitution);
  /// The n that the law is made for [-]; 0: any.
  double contact_exponent;
  /// p [-]; negative: p = n.
  double damping_exponent;
  /// α(ε) or μ(ε) as text.
  std::string_view formula;
  /// Authors and year.
  std::string_view source;
  /// The ε that the law is made for, and what it needs, as text.
  std::string_view range;

  /// Whether what an isolated collision gives back is known without a simulation, by (L2).
  bool closed_form() const {
    return law != DampingLaw::kEnergyRestitution && scale == DampingScale::kVelocity;
  }

  /// The restitution [-] that an isolated collision gives back where ε in (0, 1] is asked for.
  /// Only with a closed form.
  double Delivered(double restitution) const { return DeliveredRestitution(alpha(restitution)); }
};

/// Every law, in the order of its numbers, which begin at 1. The table lives as long as the
/// program.
std::span<const DampingLawRow> DampingLaws();

/// How many laws there are; DampingLaws().size() as a constant, for wire/ to hold against the
/// contract.
inline constexpr int kDampingLaws = 18;

/// The row of a law.
const DampingLawRow& RowOf(DampingLaw law);

/// Whether μ, c or the force is given by the scenario, and no ε is asked for: DampingScale::kNone.
bool IsGiven(DampingLaw law);

/// Whether μ follows from ε, k and m_e alone: DampingScale::kMass.
bool NeedsNoVelocity(DampingLaw law);

/// p [-] of the law for the contact exponent n.
double DampingExponent(DampingLaw law, double exponent);

/// μ of a law that needs no velocity [N·s/mᵖ⁺¹], for ε in (0, 1], k [N/mⁿ] and m_e [kg]; (L7),
/// (L8).
double DampingFactor(DampingLaw law, double restitution, double stiffness, double effective_mass);

/// α(ε) of a law [-] whose μ is α k/δ̇⁻, for ε in (0, 1]. That of kEnergyRestitution is (L1), the
/// first guess of its iteration. Not for laws of another DampingScale.
double DampingCoefficient(DampingLaw law, double restitution);

}  // namespace contact
