#pragma once

#include "wire/scenario_builder.h"

namespace contact {

/// A scenario that has every message, so that every path can be set.
inline v1::Scenario Everything() {
  return FromText(R"(
      bodies { name: "B1" mass_kg: 0.5 radius_m: 0.05 }
      bodies { name: "B2" density_kg_per_m3: 1000 radius_m: 0.05 position_m: 1 }
      bodies { name: "B3" mass_kg: 1 position_m: 2 }
      contacts { between: "B1" between: "B2" stiffness: 1e8 restitution: 0.8 }
      contacts { between: "B3" wall { position_m: 3 side: RIGHT } stiffness: 1e8 damping: MU mu: 1 }
      supports { body: "B1" }
      loads { body: "B1" constant {} }
      loads { body: "B1" sine {} }
      loads { gravity {} }
      solver {}
      output {}
      end_time_s: 1)");
}

/// Make the first load a pulse of 1 s, or a table of three points.
inline v1::Load::RectangularPulse& Rectangular(v1::Scenario& s) {
  auto& pulse = *s.mutable_loads(0)->mutable_rectangular_pulse();
  pulse.set_duration_s(1);
  return pulse;
}

inline v1::Load::HalfSinePulse& HalfSine(v1::Scenario& s) {
  auto& pulse = *s.mutable_loads(0)->mutable_half_sine_pulse();
  pulse.set_duration_s(1);
  return pulse;
}

inline v1::Load::Table& Table(v1::Scenario& s) {
  auto& table = *s.mutable_loads(0)->mutable_table();
  for (int i = 0; i < 3; ++i) table.add_points()->set_time_s(i);
  return table;
}

/// Makes a material glass.
inline v1::Material* Glass(v1::Material* material) {
  material->set_youngs_modulus_pa(48e9);
  material->set_poisson_ratio(0.2);
  return material;
}

/// Makes the contact of B1 and B2 one of glass balls.
inline void HertzPair(v1::Scenario& s) {
  for (int i = 0; i < 2; ++i) Glass(s.mutable_bodies(i)->mutable_material());
  s.mutable_contacts(0)->clear_stiffness();
}

/// Makes the contact of B3 and its wall one of glass.
inline void HertzWall(v1::Scenario& s) {
  s.mutable_bodies(2)->set_radius_m(0.05);
  Glass(s.mutable_bodies(2)->mutable_material());
  Glass(s.mutable_contacts(1)->mutable_wall()->mutable_material());
  s.mutable_contacts(1)->clear_stiffness();
}

}  // namespace contact
