#include "wire/scenario/contact_law_codec.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "wire/scenario/force_table_codec.h"
#include "wire/scenario/law_catalogue.h"

namespace contact {
namespace {

DampingLaw DecodeDamping(const v1::Contact& message, const Rules& rules) {
  const v1::Contact::Damping damping = message.damping();
  if (damping == v1::Contact::DAMPING_UNSPECIFIED) return DampingLaw::kEnergyRestitution;
  if (v1::Contact::Damping_IsValid(damping)) return static_cast<DampingLaw>(damping);
  rules.RequireKnown("damping", damping);
  return DampingLaw::kEnergyRestitution;
}

void DecodeRestitution(const v1::Contact& message, const Rules& rules, Contact* contact) {
  if (message.has_restitution() && message.restitution() == 0) {
    rules.Break("restitution", "is 0; must be in (0, 1]",
                "no finite μ takes all energy; 0.01 leaves 1e-4 of it");
  } else if (message.has_restitution()) {
    contact->restitution =
        rules.Check<v1::Contact>(v1::Contact::kRestitutionFieldNumber, message.restitution());
  } else if (!IsGiven(contact->damping)) {
    rules.Break("restitution", "is missing", "1 is elastic; damping MU with mu needs none");
  }
}

// A number that goes with one law only.
struct LawNumber {
  const char* field;
  int number;
  DampingLaw law;
};
constexpr LawNumber kMu = {"mu", v1::Contact::kMuFieldNumber, DampingLaw::kGiven};
constexpr LawNumber kDamper = {"damping_n_s_per_m", v1::Contact::kDampingNSPerMFieldNumber,
                               DampingLaw::kDashpot};

double DecodeNumber(const LawNumber& of, std::optional<double> value, DampingLaw damping,
                    const Rules& rules) {
  const std::string_view law = RowOf(of.law).name;
  if (damping == of.law && !value) {
    rules.Break(of.field, fmt::format("is missing; damping {} needs it", law));
  }
  if (damping != of.law && value) {
    const bool of_damper = damping == DampingLaw::kKelvinVoigt && of.law == DampingLaw::kGiven;
    rules.Break(of.field, fmt::format("is given, but goes only with damping {}", law),
                fmt::format("remove {}, or set damping: {}{}", of.field, law,
                            of_damper ? "; for a damper c of your own damping: DASHPOT with "
                                        "damping_n_s_per_m"
                                      : ""));
  }
  return rules.Check<v1::Contact>(of.number, value.value_or(0));
}

// μ or c, as far as the law has one.
double DecodeMu(const v1::Contact& message, DampingLaw damping, const Rules& rules) {
  std::optional<double> mu, damper;
  if (message.has_mu()) mu = message.mu();
  if (message.has_damping_n_s_per_m()) damper = message.damping_n_s_per_m();
  const double given = DecodeNumber(kMu, mu, damping, rules);
  const double dashpot = DecodeNumber(kDamper, damper, damping, rules);
  return damping == DampingLaw::kDashpot ? dashpot : given;
}

// Some laws are made for one exponent.
double DecodeExponent(const v1::Contact& message, DampingLaw damping, const Rules& rules) {
  const double exponent = rules.Read(message, v1::Contact::kExponentFieldNumber);
  const DampingLawRow& law = RowOf(damping);
  if (law.contact_exponent != 0 && exponent != law.contact_exponent) {
    rules.Break("exponent",
                fmt::format("is {}; damping {} needs {}", exponent, law.name, law.contact_exponent),
                fmt::format("set exponent: {}", law.contact_exponent));
  }
  return exponent;
}

// All that a table says already.
void BreakBesideTable(const v1::Contact& message, const Rules& rules) {
  const std::pair<const char*, bool> others[] = {
      {"stiffness", message.has_stiffness()},
      {"exponent", message.has_exponent()},
      {"restitution", message.has_restitution()},
      {"reference_velocity_m_per_s", message.has_reference_velocity_m_per_s()}};
  for (const auto& [field, given] : others) {
    if (given) {
      rules.Break(field, "is given beside damping FORCE_TABLE", "remove it; force_table says all");
    }
  }
}

// The contact of damping FORCE_TABLE.
void DecodeTable(const v1::Contact& message, const Rules& rules, Contact* contact) {
  BreakBesideTable(message, rules);
  if (!message.has_force_table()) {
    rules.Break("force_table", "is missing; damping FORCE_TABLE needs it");
    return;
  }
  const v1::ForceTable& table = message.force_table();
  contact->table = DecodeForceTable(table, rules.In("force_table"));
  if (contact->table.empty()) return;
  contact->exponent = 1;
  contact->stiffness = table.forces_n().rbegin()[0] / table.deformations_m().rbegin()[0];
}

}  // namespace

Contact DecodeContactLaw(const v1::Contact& message, const Rules& rules) {
  using Field = v1::Contact;
  Contact contact;
  if (message.has_stiffness()) {
    contact.stiffness = rules.Check<Field>(Field::kStiffnessFieldNumber, message.stiffness());
  }
  contact.damping = DecodeDamping(message, rules);
  if (contact.damping == DampingLaw::kForceTable) {
    DecodeMu(message, contact.damping, rules);  // There is none.
    DecodeTable(message, rules, &contact);
    return contact;
  }
  if (message.has_force_table()) {
    rules.Break("force_table", "is given, but goes only with damping FORCE_TABLE",
                "remove force_table, or set damping: FORCE_TABLE");
  }
  contact.exponent = DecodeExponent(message, contact.damping, rules);
  DecodeRestitution(message, rules, &contact);
  contact.mu = DecodeMu(message, contact.damping, rules);
  if (message.has_reference_velocity_m_per_s()) {
    contact.reference_velocity = rules.Check<Field>(Field::kReferenceVelocityMPerSFieldNumber,
                                                    message.reference_velocity_m_per_s());
  }
  return contact;
}

}  // namespace contact
