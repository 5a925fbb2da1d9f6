#include "wire/law_catalogue.h"

namespace contact {
namespace {

using C = v1::Contact;

constexpr LawEntry kLaws[] = {
    {C::ENERGY_RESTITUTION, DampingLaw::kEnergyRestitution, "μ iterated until −W_r/W_c = ε²",
     "the paper's problem, solved by Newton's method (N1 to N4)",
     "ε in (0, 1]; every cycle, coupled and loaded ones too"},
    {C::EXACT, DampingLaw::kExact, "α (1+ε) = ln((1+α)/(1−αε))",
     "closed form of an isolated collision (L1)", "ε in (0, 1]; exact without other forces"},
    {C::PAPER_EQ23, DampingLaw::kPaperEq23, "α = 3(1−ε²)/(2(ε²+ε^0.87))", "the paper, (23)",
     "ε in (0, 1]; fitted for the whole range"},
    {C::HUNT_CROSSLEY, DampingLaw::kHuntCrossley, "α = 3(1−ε)/2", "Hunt and Crossley 1975",
     "ε in (0, 1]; made for ε near 1"},
    {C::LANKARANI_NIKRAVESH, DampingLaw::kLankaraniNikravesh, "α = 3(1−ε²)/4",
     "Lankarani and Nikravesh 1990", "ε in (0, 1]; made for ε near 1"},
    {C::FLORES, DampingLaw::kFlores, "α = 8(1−ε)/(5ε)", "Flores et al. 2011",
     "ε in (0, 1]; made for the whole range"},
    {C::HU_GUO, DampingLaw::kHuGuo, "α = 3(1−ε)/(2ε)", "Hu and Guo 2015",
     "ε in (0, 1]; made for the whole range"},
    {C::LEE_WANG, DampingLaw::kLeeWang, "α = 3(1−ε)/4", "Lee and Wang 1983",
     "ε in (0, 1]; made for ε near 1"},
    {C::HERBERT_MCWHANNELL, DampingLaw::kHerbertMcWhannell, "α = 6(1−ε)/((2ε−1)²+3)",
     "Herbert and McWhannell 1977", "ε in (0, 1]; made for ε near 1"},
    {C::ZHIYING_QISHAO, DampingLaw::kZhiyingQishao, "α = 3(1−ε²)exp(2(1−ε))/4",
     "Zhiying and Qishao 2006", "ε in (0, 1]; made for ε above about 0.3"},
    {C::GONTHIER, DampingLaw::kGonthier, "α = (1−ε²)/ε", "Gonthier et al. 2004, approximate form",
     "ε in (0, 1]; made for the whole range"},
    {C::CARVALHO_MARTINS, DampingLaw::kCarvalhoMartins, "α = 3(1−ε)(11−ε)/(2(1+9ε))",
     "Carvalho and Martins 2019", "ε in (0, 1]; made for the whole range"},
    {C::GHARIB_HURMUZLU, DampingLaw::kGharibHurmuzlu, "α = 1/ε", "Gharib and Hurmuzlu 2012",
     "ε in (0, 1]; made for ε near 0"},
    {C::KELVIN_VOIGT, DampingLaw::kKelvinVoigt, "c = 2ξ√(k m_e), ξ = −ln ε/√(π²+ln²ε)",
     "linear spring and damper (L7)", "ε in (0, 1]; exponent 1; pulls before the bodies part"},
    {C::HERTZ_QUARTER_POWER, DampingLaw::kHertzQuarterPower,
     "μ = √5 ξ √(k m_e) with δ^¼, ξ = −ln ε/√(π²+ln²ε)", "Antypov and Elliott 2011 (L8)",
     "ε in (0, 1]; exponent 1.5; pulls before the bodies part"},
};

}  // namespace

std::string_view LawEntry::name() const { return C::Damping_Name(damping); }

bool LawEntry::closed_form() const {
  return law != DampingLaw::kEnergyRestitution && !NeedsNoVelocity(law);
}

double LawEntry::Coefficient(double restitution) const {
  return DampingCoefficient(law, restitution);
}

double LawEntry::Delivered(double restitution) const {
  return DeliveredRestitution(Coefficient(restitution));
}

std::span<const LawEntry> LawCatalogue() { return kLaws; }

}  // namespace contact
