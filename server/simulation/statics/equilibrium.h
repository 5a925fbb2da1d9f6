#pragma once

#include <vector>

#include "simulation/model/scenario.h"

namespace contact {

/// Where the bodies of a scenario stand still at t = 0.
struct Equilibrium {
  /// Of each body [m]. Without a meaning where some are not held.
  std::vector<double> positions;
  /// Bodies whose forces no positions were found to balance, first the one that went farthest in
  /// search of them; none: this is an equilibrium.
  std::vector<int> unheld;
};

/// Finds the positions at which contacts and supports balance the loads of t = 0:         (Q1)
///   k_c δ_cⁿ, −k_e (x − x_other − rest) and F(0) sum to 0 on each body.
/// They are the least of the potential energy Σ k δⁿ⁺¹/(n+1) + Σ ½ k_e (…)² − Σ F x, which is
/// convex: there are none, one, or some between which bodies can be moved without a force. Of these
/// those near the given positions are taken. With springs whose force falls somewhere there may be
/// others: one that lies downhill from the given positions is taken, or these where they are one,
/// stable or not. Fixed bodies stay where they are, and so do bodies that have a velocity, whose
/// contacts press nothing.
Equilibrium FindEquilibrium(const Scenario& scenario);

/// The bodies that could stand elsewhere, too, where the scenario stands at equilibrium: no chain
/// of pressed contacts and supports joins them to what is fixed.
std::vector<int> FindLoose(const Scenario& scenario);

}  // namespace contact
