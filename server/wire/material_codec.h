#pragma once

#include "contact/v1/scenario.pb.h"
#include "wire/rules.h"

namespace contact {

/// Checks a material. `rules` are those of the message that holds it, as the field `path`.
void CheckMaterial(const v1::Material& material, std::string_view path, const Rules& rules);

/// (1 − ν²)/E of one side of a contact [1/Pa].
double Compliance(const v1::Material& material);

/// Stiffness of a contact of spheres, or of a sphere and a plane (H1) [N/m^1.5]: 4/3 E* √R* with
/// `compliance` = 1/E* and `curvature` = 1/R*, each the sum over both sides.
double HertzStiffness(double compliance, double curvature);

}  // namespace contact
