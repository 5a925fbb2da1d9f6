#pragma once

#include <string_view>
#include <vector>

#include "simulation/model/scenario.h"

namespace contact::testing {

/// A scenario said in other words, and how what it finds is said in the first ones.
struct Restated {
  std::string_view how;
  Scenario scenario;
  std::vector<int> bodies, contacts;      ///< The index there of each of the first ones.
  double mass = 1, length = 1, time = 1;  ///< Units there, in those of here.
  double direction = 1;                   ///< −1: mirrored.
  double drift = 0;                       ///< Velocity of the frame there [m/s].
  double delay = 0;                       ///< Of all instants there [s].
  bool longer = false;                    ///< It goes on after the end of the first.

  double Velocity(double v) const { return (v * length / time - drift) * direction; }
  double Time(double t) const { return t * time - delay; }
  double Force(double force) const { return force * mass * length / (time * time); }
  /// μ in N·s/mᵖ⁺¹ of a contact with the damping exponent p.
  double Mu(double mu, double p) const;
};

/// Every way that suits the scenario: mirrored, shifted, seen from a moving frame (where there is
/// neither wall nor ground), in other units, in another order under other names, with loads in
/// halves, begun earlier in flight, with a smaller tolerance, and with an end 31 % later.
std::vector<Restated> Restate(const Scenario& scenario);

}  // namespace contact::testing
