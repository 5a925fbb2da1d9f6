#include <cmath>

#include "translate/damping.h"
#include "translate/tool.h"

namespace contact::translate {
namespace {

using Values = std::vector<double>;

Tool MuJoCo() {
  return {.name = "mujoco",
          .title = "MuJoCo, solref in the direct format",
          .source = "MuJoCo 2.2.2, modeling.rst, Solver parameters; run",
          .law = {.pull = Pull::kClamped, .carries_load = true},
          .stepping = Stepping::kSymplecticEuler,
          .parameters = {{"stiffness", "1/s^2"}, {"damping", "1/s"}},
          .write = [](const ForceLaw& law, const Setup& setup) -> Values {
            return {law.stiffness / setup.collision.mass, law.damping / setup.collision.mass};
          },
          .read =
              [](ForceLaw law, const Values& values, const Setup& setup) {
                law.stiffness = values[0] * setup.collision.mass;
                law.damping = values[1] * setup.collision.mass;
                return law;
              },
          .line =
              "<geom condim=\"1\" solref=\"-{stiffness} -{damping}\" "
              "solimp=\"0.9999 0.9999 0.001\"/>",
          .note =
              "both geoms have this solref and solimp; where solimp varies with the depth, as by "
              "default, ε differs by some thousandths; the same for all masses; under gravity the "
              "solver carries the weight, not the spring"};
}

Tool Chrono(std::string_view name, std::string_view title) {
  return {.name = name,
          .title = title,
          .source = "Project Chrono, ChContactSMC.h; read",
          .law = {.pull = Pull::kClamped},
          .parameters = {},
          .write = nullptr,
          .read = nullptr,
          .line = {},
          .note = "a fixed body counts with its mass: give it one that is large"};
}

Tool ChronoHooke() {
  Tool tool = Chrono("chrono-hooke", "Chrono SMC, Hooke, material coefficients");
  tool.parameters = {{"kn", "N/m"}, {"gn", "1/s"}};
  tool.write = [](const ForceLaw& law, const Setup& setup) -> Values {
    return {law.stiffness, law.damping / setup.collision.mass};
  };
  tool.read = [](ForceLaw law, const Values& values, const Setup& setup) {
    law.stiffness = values[0];
    law.damping = values[1] * setup.collision.mass;
    return law;
  };
  tool.line = "system.UseMaterialProperties(False); material.SetKn({kn}); material.SetGn({gn})";
  return tool;
}

// F = R* √δ (kn δ + m_e gn δ̇).
Tool ChronoHertz() {
  Tool tool = Chrono("chrono-hertz", "Chrono SMC, Hertz, material coefficients");
  tool.law.exponent = 1.5;
  tool.law.damping_exponent = 0.5;
  tool.needs_radius = true;
  tool.parameters = {{"kn", "N/m^2.5"}, {"gn", "1/(s*m^1.5)"}};
  tool.write = [](const ForceLaw& law, const Setup& setup) -> Values {
    return {law.stiffness / setup.radius, law.damping / setup.radius / setup.collision.mass};
  };
  tool.read = [](ForceLaw law, const Values& values, const Setup& setup) {
    law.stiffness = values[0] * setup.radius;
    law.damping = values[1] * setup.radius * setup.collision.mass;
    return law;
  };
  tool.line = "system.UseMaterialProperties(False); material.SetKn({kn}); material.SetGn({gn})";
  return tool;
}

// F = 4/3 E* √(R* δ) δ + √5 ξ(cr) √(k m_e) δ^¼ δ̇; E* = E/2 of two equal materials with ν = 0.
Tool ChronoMaterial() {
  Tool tool = Chrono("chrono-material", "Chrono SMC, Hertz, material properties");
  tool.law.exponent = 1.5;
  tool.law.damping_exponent = 0.25;
  tool.needs_radius = true;
  tool.parameters = {{"young_modulus", "Pa"}, {"restitution", "1"}};
  tool.restitution = 1;
  tool.write = [](const ForceLaw& law, const Setup& setup) -> Values {
    return {2 * 3 * law.stiffness / (4 * std::sqrt(setup.radius)),
            QuarterPowerRestitution(law.stiffness, setup.collision.mass, law.damping)};
  };
  tool.read = [](ForceLaw law, const Values& values, const Setup& setup) {
    law.stiffness = 4.0 / 3 * values[0] / 2 * std::sqrt(setup.radius);
    law.damping = QuarterPowerDamping(law.stiffness, setup.collision.mass, values[1]);
    return law;
  };
  tool.line =
      "material.SetYoungModulus({young_modulus}); material.SetPoissonRatio(0); "
      "material.SetRestitution({restitution})";
  return tool;
}

// An implicit step of the spring and damper: ERP = h k/(h k + c), CFM = 1/(h k + c).
Tool Ode() {
  return {.name = "ode",
          .title = "Open Dynamics Engine, soft contact",
          .source = "ODE 0.16.2, joints/contact.cpp; run",
          .law = {.pull = Pull::kClamped},
          .stepping = Stepping::kImplicitEuler,
          .needs_step = true,
          .parameters = {{"soft_erp", "1"}, {"soft_cfm", "m/(N*s)"}},
          .write = [](const ForceLaw& law, const Setup& setup) -> Values {
            const double firmness = setup.step * law.stiffness + law.damping;
            return {setup.step * law.stiffness / firmness, 1 / firmness};
          },
          .read =
              [](ForceLaw law, const Values& values, const Setup& setup) {
                law.stiffness = values[0] / (setup.step * values[1]);
                law.damping = (1 - values[0]) / values[1];
                return law;
              },
          .line =
              "contact.surface.mode = dContactSoftERP | dContactSoftCFM; "
              "contact.surface.soft_erp = {soft_erp}; contact.surface.soft_cfm = {soft_cfm};",
          .note = "for this step only: with another one the same numbers are another spring"};
}

Tool Bullet() {
  return {.name = "bullet",
          .title = "Bullet, contact stiffness and damping",
          .source = "Bullet 3.24, btSequentialImpulseConstraintSolver.cpp; run",
          .law = {.pull = Pull::kClamped},
          .stepping = Stepping::kSpeculative,
          .parameters = {{"contactStiffness", "N/m"}, {"contactDamping", "N*s/m"}},
          .write = [](const ForceLaw& law, const Setup& /*setup*/) -> Values {
            return {2 * law.stiffness, law.damping / 2};
          },
          .read =
              [](ForceLaw law, const Values& values, const Setup& /*setup*/) {
                law.stiffness = values[0] / 2;
                law.damping = 2 * values[1];
                return law;
              },
          .line =
              "pybullet.changeDynamics(body, -1, contactStiffness={contactStiffness}, "
              "contactDamping={contactDamping})",
          .note =
              "both bodies have these values, for dampers of the two are added and 0.1 N*s/m is "
              "the default; where contacts are deeper than 0.04 m, splitImpulse is off"};
}

}  // namespace

std::vector<Tool> EngineTools() {
  return {Bullet(), ChronoHertz(), ChronoHooke(), ChronoMaterial(), MuJoCo(), Ode()};
}

}  // namespace contact::translate
