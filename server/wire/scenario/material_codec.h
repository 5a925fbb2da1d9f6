#pragma once

#include "contact/v1/scenario.pb.h"
#include "wire/rules/rules.h"

namespace contact {

/// Checks the numbers of a material. `rules` are for the material itself.
void CheckMaterial(const v1::Material& material, const Rules& rules);

/// (1 − ν²)/E of one side of a contact [1/Pa]. `material` breaks no rule.
double Compliance(const v1::Material& material);

/// Stiffness of a contact of spheres, or of a sphere and a plane (H1) [N/m^1.5]: 4/3 E* √R* with
/// `compliance` = 1/E* and `curvature` = 1/R*, each the sum over both sides.
double HertzStiffness(double compliance, double curvature);

}  // namespace contact
