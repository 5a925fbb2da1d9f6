#include "simulation/laws/damping_law.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>

namespace contact {
namespace {

constexpr double kOwn = -1;  // p = n.
constexpr double kAny = 0;   // Any n.

// ξ = −ln ε/√(π² + ln² ε): the damping ratio that leaves ε of the speed after half a period, (L7).
double DampingRatio(double e) { return -std::log(e) / std::hypot(std::numbers::pi, std::log(e)); }

// The code of each α(ε) stands beside its formula.
using enum DampingLaw;
using enum DampingScale;
// clang-format off
constexpr DampingLawRow kRows[] = {
    {kEnergyRestitution, kVelocity, "ENERGY_RESTITUTION", ExactCoefficient, kAny, kOwn,
     "μ iterated until −W_r/W_c = ε²", "the paper's problem, solved by Newton's method (N1 to N4)",
     "ε in (0, 1]; every cycle, coupled and loaded ones too"},
    {kExact, kVelocity, "EXACT", ExactCoefficient, kAny, kOwn,
     "α (1+ε) = ln((1+α)/(1−αε))", "closed form of an isolated collision (L1)",
     "ε in (0, 1]; exact without other forces"},
    {kPaperEq23, kVelocity, "PAPER_EQ23",
     [](double e) { return 1.5 * (1 - e * e) / (e * e + std::pow(e, 0.87)); }, kAny, kOwn,
     "α = 3(1−ε²)/(2(ε²+ε^0.87))", "the paper, (23)",
     "ε in (0, 1]; fitted for the whole range"},
    {kHuntCrossley, kVelocity, "HUNT_CROSSLEY",
     [](double e) { return 1.5 * (1 - e); }, kAny, kOwn,
     "α = 3(1−ε)/2", "Hunt and Crossley 1975",
     "ε in (0, 1]; made for ε near 1"},
    {kLankaraniNikravesh, kVelocity, "LANKARANI_NIKRAVESH",
     [](double e) { return 0.75 * (1 - e * e); }, kAny, kOwn,
     "α = 3(1−ε²)/4", "Lankarani and Nikravesh 1990",
     "ε in (0, 1]; made for ε near 1"},
    {kFlores, kVelocity, "FLORES",
     [](double e) { return 1.6 * (1 - e) / e; }, kAny, kOwn,
     "α = 8(1−ε)/(5ε)", "Flores et al. 2011",
     "ε in (0, 1]; made for the whole range"},
    {kHuGuo, kVelocity, "HU_GUO",
     [](double e) { return 1.5 * (1 - e) / e; }, kAny, kOwn,
     "α = 3(1−ε)/(2ε)", "Hu and Guo 2015",
     "ε in (0, 1]; made for the whole range"},
    {kLeeWang, kVelocity, "LEE_WANG",
     [](double e) { return 0.75 * (1 - e); }, kAny, kOwn,
     "α = 3(1−ε)/4", "Lee and Wang 1983",
     "ε in (0, 1]; made for ε near 1"},
    {kHerbertMcWhannell, kVelocity, "HERBERT_MCWHANNELL",
     [](double e) { return 6 * (1 - e) / ((2 * e - 1) * (2 * e - 1) + 3); }, kAny, kOwn,
     "α = 6(1−ε)/((2ε−1)²+3)", "Herbert and McWhannell 1977",
     "ε in (0, 1]; made for ε near 1"},
    {kZhiyingQishao, kVelocity, "ZHIYING_QISHAO",
     [](double e) { return 0.75 * (1 - e * e) * std::exp(2 * (1 - e)); }, kAny, kOwn,
     "α = 3(1−ε²)exp(2(1−ε))/4", "Zhiying and Qishao 2006",
     "ε in (0, 1]; made for ε above about 0.3"},
    {kGonthier, kVelocity, "GONTHIER",
     [](double e) { return (1 - e * e) / e; }, kAny, kOwn,
     "α = (1−ε²)/ε", "Gonthier et al. 2004, approximate form",
     "ε in (0, 1]; made for the whole range"},
    {kCarvalhoMartins, kVelocity, "CARVALHO_MARTINS",
     [](double e) { return 1.5 * (1 - e) * (11 - e) / (1 + 9 * e); }, kAny, kOwn,
     "α = 3(1−ε)(11−ε)/(2(1+9ε))", "Carvalho and Martins 2019",
     "ε in (0, 1]; made for the whole range"},
    {kGharibHurmuzlu, kVelocity, "GHARIB_HURMUZLU",
     [](double e) { return 1 / e; }, kAny, kOwn,
     "α = 1/ε", "Gharib and Hurmuzlu 2012",
     "ε in (0, 1]; made for ε near 0"},
    {kKelvinVoigt, kMass, "KELVIN_VOIGT",
     [](double e) { return 2 * DampingRatio(e); }, 1, 0,
     "c = 2ξ√(k m_e), ξ = −ln ε/√(π²+ln²ε)", "linear spring and damper (L7)",
     "ε in (0, 1]; exponent 1; pulls before the bodies part"},
    {kHertzQuarterPower, kMass, "HERTZ_QUARTER_POWER",
     [](double e) { return std::sqrt(5.0) * DampingRatio(e); }, 1.5, 0.25,
     "μ = √5 ξ √(k m_e) with δ^¼, ξ = −ln ε/√(π²+ln²ε)", "Antypov and Elliott 2011 (L8)",
     "ε in (0, 1]; exponent 1.5; pulls before the bodies part"},
    {kGiven, DampingScale::kNone, "MU", nullptr, kAny, kOwn,
     "μ as given", "the scenario", "every cycle"},
    {kDashpot, DampingScale::kNone, "DASHPOT", nullptr, 1, 0,
     "c as given", "linear spring and damper of the scenario",
     "every cycle; exponent 1; pulls before the bodies part"},
    {kForceTable, DampingScale::kNone, "FORCE_TABLE", nullptr, kAny, kOwn,
     "F(δ) as given", "points of the scenario, with a way back of their own (F1)",
     "every cycle; ε follows from the way back"},
};
// clang-format on

// Rows are found by the number of their law.
constexpr bool InOrder() {
  int number = 0;
  return std::ranges::all_of(
      kRows, [&](const DampingLawRow& row) { return static_cast<int>(row.law) == ++number; });
}
static_assert(InOrder() && std::size(kRows) == kDampingLaws);

}  // namespace

std::span<const DampingLawRow> DampingLaws() { return kRows; }

const DampingLawRow& RowOf(DampingLaw law) {
  const int index = static_cast<int>(law) - 1;
  assert(index >= 0 && index < kDampingLaws);
  return kRows[index];
}

bool IsGiven(DampingLaw law) { return RowOf(law).scale == DampingScale::kNone; }

bool NeedsNoVelocity(DampingLaw law) { return RowOf(law).scale == DampingScale::kMass; }

double DampingExponent(DampingLaw law, double exponent) {
  const double own = RowOf(law).damping_exponent;
  return own < 0 ? exponent : own;
}

double DampingFactor(DampingLaw law, double restitution, double stiffness, double effective_mass) {
  assert(NeedsNoVelocity(law));
  return RowOf(law).alpha(restitution) * std::sqrt(stiffness * effective_mass);
}

double DampingCoefficient(DampingLaw law, double restitution) {
  assert(restitution > 0 && restitution <= 1);
  assert(RowOf(law).scale == DampingScale::kVelocity);
  return RowOf(law).alpha(restitution);
}

}  // namespace contact
