#include <cmath>

#include "translate/tool.h"

namespace contact::translate {
namespace {

using Values = std::vector<double>;

// Two surfaces of modulus E each have the effective modulus E/2^1.5 (HuntCrossleyForce adds up
// compliances of the power 2/3), and k = 4/3 √R* E/2^1.5.
double ModulusOf(double stiffness, double radius) {
  return std::pow(2, 1.5) * 3 * stiffness / (4 * std::sqrt(radius));
}

double StiffnessOf(double modulus, double radius) {
  return 4 * std::sqrt(radius) * modulus / (3 * std::pow(2, 1.5));
}

// F = k δ^1.5 (1 + 1.5 c δ̇).
Values WriteHuntCrossley(const ForceLaw& law, const Setup& setup) {
  return {ModulusOf(law.stiffness, setup.radius), law.damping / law.stiffness / 1.5};
}

ForceLaw ReadHuntCrossley(ForceLaw law, const Values& values, const Setup& setup) {
  law.stiffness = StiffnessOf(values[0], setup.radius);
  law.damping = 1.5 * values[1] * law.stiffness;
  return law;
}

Values WriteLinear(const ForceLaw& law, const Setup& /*setup*/) {
  return {law.stiffness, law.damping};
}

ForceLaw ReadLinear(ForceLaw law, const Values& values, const Setup& /*setup*/) {
  law.stiffness = values[0];
  law.damping = values[1];
  return law;
}

constexpr std::string_view kHuntCrossleyNote =
    "both surfaces have these values, with a plane for the other body too; ε falls with the speed";

Tool Simbody() {
  return {.name = "simbody",
          .title = "Simbody, HuntCrossleyForce",
          .source = "Simbody 3.7, HuntCrossleyForce.h and .cpp; run",
          .law = {.exponent = 1.5, .damping_exponent = 1.5, .pull = Pull::kClamped},
          .needs_radius = true,
          .parameters = {{"stiffness", "Pa"}, {"dissipation", "s/m"}},
          .write = WriteHuntCrossley,
          .read = ReadHuntCrossley,
          .line = "force.setBodyParameters(surface, {stiffness}, {dissipation}, 0, 0, 0);",
          .note = kHuntCrossleyNote};
}

Tool OpenSim() {
  Tool tool = Simbody();
  tool.name = "opensim";
  tool.title = "OpenSim, HuntCrossleyForce";
  tool.source = "opensim-core, HuntCrossleyForce.cpp, which hands the numbers to Simbody; read";
  tool.line = "<stiffness>{stiffness}</stiffness> <dissipation>{dissipation}</dissipation>";
  return tool;
}

Tool Drake() {
  return {.name = "drake",
          .title = "Drake, point contact",
          .source = "Drake, multibody_plant.cc: fn = k x (1 + d vn); read",
          .law = {.damping_exponent = 1, .pull = Pull::kClamped},
          .parameters = {{"point_contact_stiffness", "N/m"}, {"hunt_crossley_dissipation", "s/m"}},
          .write = [](const ForceLaw& law, const Setup& /*setup*/) -> Values {
            return {law.stiffness, law.damping / law.stiffness};
          },
          .read =
              [](ForceLaw law, const Values& values, const Setup& /*setup*/) {
                law.stiffness = values[0];
                law.damping = values[1] * values[0];
                return law;
              },
          .line =
              "AddContactMaterial(dissipation={hunt_crossley_dissipation}, "
              "point_stiffness={point_contact_stiffness}, properties=properties)",
          .note =
              "values of the pair: two equal geometries have twice the stiffness and the same "
              "dissipation; the approximation SAP has a linear damper instead, which these "
              "numbers are not for; ε falls with the speed"};
}

Tool Simscape(Pull pull) {
  const bool damped = pull == Pull::kAllowed;
  return {.name = damped ? "simscape-damped" : "simscape-undamped",
          .title = damped ? "Simscape, Translational Hard Stop, damped rebound"
                          : "Simscape, Translational Hard Stop, undamped rebound",
          .source =
              "mathworks.com/help/simscape/ref/translationalhardstop.html, and models of others "
              "that follow it; read",
          .law = {.pull = pull},
          .parameters = {{"stiffness", "N/m"}, {"damping", "N*s/m"}},
          .write = WriteLinear,
          .read = ReadLinear,
          .line = "Contact stiffness {stiffness} N/m, Contact damping {damping} N*s/m",
          .note = {}};
}

Tool ElastoGap() {
  return {.name = "elastogap",
          .title = "Modelica, Mechanics.Translational.Components.ElastoGap",
          .source = "Modelica Standard Library, ElastoGap.mo; read",
          .law = {.pull = Pull::kLimitedDamper},
          .parameters = {{"c", "N/m"}, {"d", "N*s/m"}},
          .write = WriteLinear,
          .read = ReadLinear,
          .line = "Modelica.Mechanics.Translational.Components.ElastoGap stop(c={c}, d={d}, n=1);",
          .note = {}};
}

// The depth of full damping: a tenth of the largest deformation of an undamped contact, 1.093 L.
constexpr double kImpactDepth = 0.1093;

Tool Adams() {
  return {.name = "adams",
          .title = "Adams, IMPACT (also of MotionSolve and SolidWorks Motion)",
          .source = "IMPACT in the help of MotionSolve 2021 and SolidWorks 2024; read",
          .law = {.exponent = 1.5, .pull = Pull::kClamped, .full_depth = kImpactDepth},
          .parameters = {{"k", "N/m^1.5"}, {"cmax", "N*s/m"}, {"d", "m"}},
          .write = [](const ForceLaw& law, const Setup& /*setup*/) -> Values {
            return {law.stiffness, law.damping, law.full_depth};
          },
          .read =
              [](ForceLaw law, const Values& values, const Setup& /*setup*/) {
                law.stiffness = values[0];
                law.damping = values[1];
                law.full_depth = values[2];
                return law;
              },
          .line = "IMPACT(DZ(i,j,j), VZ(i,j,j), x1, {k}, 1.5, {cmax}, {d})",
          .note = "d is a tenth of the largest deformation; ε depends on the speed"};
}

}  // namespace

std::vector<Tool> MultibodyTools() {
  return {Adams(),
          Drake(),
          ElastoGap(),
          OpenSim(),
          Simscape(Pull::kAllowed),
          Simscape(Pull::kUndampedReturn),
          Simbody()};
}

}  // namespace contact::translate
