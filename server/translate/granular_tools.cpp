#include <cmath>
#include <limits>

#include "translate/damping.h"
#include "translate/tool.h"

namespace contact::translate {
namespace {

using Values = std::vector<double>;

constexpr std::string_view kLammps = "LAMMPS 29 Sep 2021, pair_granular.cpp and .rst; run";

double EffectiveModulus(double stiffness, double radius) {
  return 3 * stiffness / (4 * std::sqrt(radius));
}

Values WriteHooke(const ForceLaw& law, const Setup& /*setup*/) {
  return {law.stiffness, law.damping};
}

ForceLaw ReadHooke(ForceLaw law, const Values& values, const Setup& /*setup*/) {
  law.stiffness = values[0];
  law.damping = values[1];
  return law;
}

// F = kn √R* δ^1.5 + η m_e √(R* δ) δ̇.
Values WriteViscoelastic(const ForceLaw& law, const Setup& setup) {
  const double root = std::sqrt(setup.radius);
  return {law.stiffness / root, law.damping / (root * setup.collision.mass)};
}

ForceLaw ReadViscoelastic(ForceLaw law, const Values& values, const Setup& setup) {
  const double root = std::sqrt(setup.radius);
  law.stiffness = values[0] * root;
  law.damping = values[1] * root * setup.collision.mass;
  return law;
}

// α(e) of Tsuji 1992 as LAMMPS has it; c = α √(k m_e) δ^¼. It falls from 1.2728 at 0 to 3e-4 at 1.
double Tsuji(double e) {
  return 1.2728 +
         e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

double InverseTsuji(double alpha) {
  if (alpha > Tsuji(0)) return std::numeric_limits<double>::quiet_NaN();
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (Tsuji(middle) > alpha ? low : high) = middle;
  }
  return high;
}

Values WriteTsuji(const ForceLaw& law, const Setup& setup) {
  return {law.stiffness / std::sqrt(setup.radius),
          InverseTsuji(law.damping / std::sqrt(law.stiffness * setup.collision.mass))};
}

ForceLaw ReadTsuji(ForceLaw law, const Values& values, const Setup& setup) {
  law.stiffness = values[0] * std::sqrt(setup.radius);
  law.damping = Tsuji(values[1]) * std::sqrt(law.stiffness * setup.collision.mass);
  return law;
}

Values WriteRestitution(const ForceLaw& law, const Setup& setup) {
  return {law.stiffness / std::sqrt(setup.radius),
          QuarterPowerRestitution(law.stiffness, setup.collision.mass, law.damping)};
}

ForceLaw ReadRestitution(ForceLaw law, const Values& values, const Setup& setup) {
  law.stiffness = values[0] * std::sqrt(setup.radius);
  law.damping = QuarterPowerDamping(law.stiffness, setup.collision.mass, values[1]);
  return law;
}

// kn = 16/15 √R* Y* (15 m_e V²/(16 √R* Y*))^(1/5), V the characteristic velocity, here that of the
// collision. Two equal materials with ν = 0 have Y = 2 Y*.
Values WriteLiggghtsHooke(const ForceLaw& law, const Setup& setup) {
  const Collision& c = setup.collision;
  const double effective =
      std::pow(law.stiffness / std::pow(c.mass * c.velocity * c.velocity, 0.2), 1.25) * 15 /
      (16 * std::sqrt(setup.radius));
  const double ratio = law.damping / (2 * std::sqrt(law.stiffness * c.mass));
  return {2 * effective, RestitutionOfRatio(ratio), c.velocity};
}

ForceLaw ReadLiggghtsHooke(ForceLaw law, const Values& values, const Setup& setup) {
  const double base = 16 * std::sqrt(setup.radius) * values[0] / 2 / 15;
  law.stiffness = base * std::pow(setup.collision.mass * values[2] * values[2] / base, 0.2);
  law.damping = 2 * DampingRatio(values[1]) * std::sqrt(law.stiffness * setup.collision.mass);
  return law;
}

Values WriteLiggghtsHertz(const ForceLaw& law, const Setup& setup) {
  return {2 * EffectiveModulus(law.stiffness, setup.radius),
          QuarterPowerRestitution(law.stiffness, setup.collision.mass, law.damping)};
}

ForceLaw ReadLiggghtsHertz(ForceLaw law, const Values& values, const Setup& setup) {
  return ReadRestitution(law, {4.0 / 3 * values[0] / 2, values[1]}, setup);
}

Tool LammpsHooke() {
  return {
      .name = "lammps-hooke",
      .title = "LAMMPS granular, hooke, damping velocity",
      .source = kLammps,
      .law = {},
      .stepping = Stepping::kVerlet,
      .parameters = {{"kn", "N/m"}, {"eta", "N*s/m"}},
      .write = WriteHooke,
      .read = ReadHooke,
      .line = "pair_coeff * * hooke {kn} {eta} damping velocity tangential linear_nohistory 0 0",
      .note = {}};
}

Tool LammpsHertz() {
  return {.name = "lammps-hertz",
          .title = "LAMMPS granular, hertz, damping viscoelastic",
          .source = kLammps,
          .law = {.exponent = 1.5, .damping_exponent = 0.5},
          .stepping = Stepping::kVerlet,
          .needs_radius = true,
          .parameters = {{"kn", "Pa"}, {"eta", "1/(s*m)"}},
          .write = WriteViscoelastic,
          .read = ReadViscoelastic,
          .line =
              "pair_coeff * * hertz {kn} {eta} damping viscoelastic tangential "
              "linear_nohistory 0 0",
          .note = "ε falls with the speed"};
}

Tool LammpsTsuji() {
  return {.name = "lammps-tsuji",
          .title = "LAMMPS granular, hertz, damping tsuji",
          .source = kLammps,
          .law = {.exponent = 1.5, .damping_exponent = 0.25},
          .stepping = Stepping::kVerlet,
          .needs_radius = true,
          .parameters = {{"kn", "Pa"}, {"e", "1"}},
          .restitution = 1,
          .write = WriteTsuji,
          .read = ReadTsuji,
          .line = "pair_coeff * * hertz {kn} {e} damping tsuji tangential linear_nohistory 0 0",
          .note = "e is not the restitution: the polynomial of LAMMPS makes less damping of e"};
}

Tool LammpsRestitution() {
  Tool tool = LammpsTsuji();
  tool.name = "lammps-restitution";
  tool.title = "LAMMPS granular, hertz, damping coeff_restitution";
  tool.source = "LAMMPS develop, gran_sub_mod_damping.cpp; read";
  tool.note = {};
  tool.write = WriteRestitution;
  tool.read = ReadRestitution;
  tool.line =
      "pair_coeff * * hertz {kn} {e} damping coeff_restitution tangential linear_nohistory 0 0";
  return tool;
}

Tool LiggghtsHooke() {
  return {.name = "liggghts-hooke",
          .title = "LIGGGHTS, model hooke",
          .source = "LIGGGHTS 3.8.0, normal_model_hooke.h; run",
          .law = {},
          .stepping = Stepping::kVerlet,
          .needs_radius = true,
          .parameters = {{"youngsModulus", "Pa"},
                         {"coefficientRestitution", "1"},
                         {"characteristicVelocity", "m/s"}},
          .restitution = 1,
          .write = WriteLiggghtsHooke,
          .read = ReadLiggghtsHooke,
          .line =
              "pair_style gran model hooke tangential off  # youngsModulus {youngsModulus}, "
              "poissonsRatio 0, coefficientRestitution {coefficientRestitution}, "
              "characteristicVelocity {characteristicVelocity}",
          .note = {}};
}

Tool LiggghtsHertz() {
  return {.name = "liggghts-hertz",
          .title = "LIGGGHTS, model hertz",
          .source = "LIGGGHTS 3.8.0, normal_model_hertz.h; run",
          .law = {.exponent = 1.5, .damping_exponent = 0.25},
          .stepping = Stepping::kVerlet,
          .needs_radius = true,
          .parameters = {{"youngsModulus", "Pa"}, {"coefficientRestitution", "1"}},
          .restitution = 1,
          .write = WriteLiggghtsHertz,
          .read = ReadLiggghtsHertz,
          .line =
              "pair_style gran model hertz tangential off  # youngsModulus {youngsModulus}, "
              "poissonsRatio 0, coefficientRestitution {coefficientRestitution}",
          .note = {}};
}

Tool Yade() {
  return {.name = "yade",
          .title = "Yade, ViscElMat with Law2_ScGeom_ViscElPhys_Basic",
          .source = "Yade 2023.02a, ViscoelasticPM.cpp; run",
          .law = {.pull = Pull::kClamped},
          .stepping = Stepping::kSymplecticEuler,
          .parameters = {{"kn", "N/m"}, {"cn", "N*s/m"}},
          .write = [](const ForceLaw& law, const Setup& /*setup*/) -> Values {
            return {2 * law.stiffness, 2 * law.damping};
          },
          .read =
              [](ForceLaw law, const Values& values, const Setup& /*setup*/) {
                law.stiffness = values[0] / 2;
                law.damping = values[1] / 2;
                return law;
              },
          .line = "ViscElMat(kn={kn}, cn={cn}, ks=0, cs=0, frictionAngle=0)",
          .note =
              "both bodies have this material; its en and tc are those of a force that pulls, "
              "which this law does not have"};
}

// The same model whose force does not pull.
Tool Limited(Tool tool, std::string_view name, std::string_view title, std::string_view line) {
  tool.name = name;
  tool.title = title;
  tool.law.pull = Pull::kClamped;
  tool.line = line;
  return tool;
}

}  // namespace

std::vector<Tool> GranularTools() {
  return {
      LammpsHertz(),
      LammpsHooke(),
      LammpsRestitution(),
      LammpsTsuji(),
      LiggghtsHertz(),
      LiggghtsHooke(),
      Yade(),
      Limited(
          LammpsHertz(), "lammps-hertz-limited",
          "LAMMPS granular, hertz, damping viscoelastic, limit_damping",
          "pair_coeff * * hertz {kn} {eta} damping viscoelastic tangential linear_nohistory 0 0 "
          "limit_damping"),
      Limited(LammpsHooke(), "lammps-hooke-limited",
              "LAMMPS granular, hooke, damping velocity, limit_damping",
              "pair_coeff * * hooke {kn} {eta} damping velocity tangential linear_nohistory 0 0 "
              "limit_damping"),
      Limited(LammpsTsuji(), "lammps-tsuji-limited",
              "LAMMPS granular, hertz, damping tsuji, limit_damping",
              "pair_coeff * * hertz {kn} {e} damping tsuji tangential linear_nohistory 0 0 "
              "limit_damping"),
      Limited(LammpsRestitution(), "lammps-restitution-limited",
              "LAMMPS granular, hertz, damping coeff_restitution, limit_damping",
              "pair_coeff * * hertz {kn} {e} damping coeff_restitution tangential "
              "linear_nohistory 0 0 limit_damping"),
      Limited(LiggghtsHertz(), "liggghts-hertz-limited", "LIGGGHTS, model hertz, limitForce on",
              "pair_style gran model hertz tangential off limitForce on  # youngsModulus "
              "{youngsModulus}, poissonsRatio 0, coefficientRestitution {coefficientRestitution}"),
      Limited(LiggghtsHooke(), "liggghts-hooke-limited", "LIGGGHTS, model hooke, limitForce on",
              "pair_style gran model hooke tangential off limitForce on  # youngsModulus "
              "{youngsModulus}, poissonsRatio 0, coefficientRestitution {coefficientRestitution}, "
              "characteristicVelocity {characteristicVelocity}"),
  };
}

}  // namespace contact::translate
