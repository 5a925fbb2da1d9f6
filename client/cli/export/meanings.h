#pragma once

#include <string_view>

namespace contact::cli {

/// A field of a message as a column. Name and unit come from the field's name in the contract.
struct Meaning {
  std::string_view field;
  std::string_view description;
  std::string_view name = {};  ///< Another name for the column than the field has.
};

/// A row of the ledger.
inline constexpr Meaning kCycle[] = {
    {"contact", "name of the contact"},
    {"number", "place of the cycle among those of its contact"},
    {"kind", "how the cycle began"},
    {"end", "how the cycle ended"},
    {"status", "what became of the restitution asked for"},
    {"iterations", "corrections of mu made for the episode"},
    {"episode", "cycles with the same number were solved together"},
    {"start_time_s", "time at which compression began"},
    {"turn_time_s", "time at which restitution began"},
    {"end_time_s", "time at which the cycle ended"},
    {"delta_start_m", "deformation at the start"},
    {"delta_max_m", "largest deformation"},
    {"delta_end_m", "deformation at the end"},
    {"approach_velocity_m_per_s", "deformation velocity at the start"},
    {"separation_velocity_m_per_s", "deformation velocity at the end"},
    {"mu", "hysteresis damping factor"},
    {"mu_over_k_s_per_m", "hysteresis damping factor over stiffness"},
    {"alpha", "mu times approach velocity over stiffness"},
    {"work_compression_j", "work of the contact force in compression"},
    {"work_restitution_j", "work of the contact force in restitution"},
    {"dissipated_compression_j", "energy lost in compression"},
    {"dissipated_restitution_j", "energy lost in restitution"},
    {"external_work_compression_j", "work of the equivalent external force in compression"},
    {"external_work_restitution_j", "work of the equivalent external force in restitution"},
    {"restitution_in", "energy restitution coefficient asked for"},
    {"restitution_out", "energy restitution coefficient of the cycle"},
    {"peak_force_n", "largest contact force"},
    {"tension_time_s", "time for which the contact force pulled"},
    {"identity_residual", "imbalance of energy over work_compression"},
    {"group", "number of its group, 0 for none"},
    {"newton_restitution", "relative velocity after over that before"},
};

/// A group of cycles.
inline constexpr Meaning kGroup[] = {
    {"contact", "name of the contact"},
    {"number", "place of the group among those of its contact"},
    {"first_cycle", "number of its first cycle"},
    {"cycles", "how many cycles it has"},
    {"encounter", "place of its encounter among those of its contact"},
    {"start_time_s", "time at which its first cycle began"},
    {"end_time_s", "time at which its last cycle ended"},
    {"end", "how its last cycle ended"},
    {"mu", "hysteresis damping factor of all its cycles"},
    {"work_compression_j", "work of the contact force in all its compressions"},
    {"work_restitution_j", "work of the contact force in all its restitutions"},
    {"restitution_in", "energy restitution coefficient asked for"},
    {"restitution_out", "energy restitution coefficient of the group"},
    {"status", "what became of the restitution asked for"},
    {"growth", "why it took in its neighbour last"},
    {"residual", "imbalance of energy over work_compression"},
    {"too_much_mu", "nearest mu that gave too much restitution"},
    {"too_much_restitution", "restitution at too_much_mu"},
    {"too_little_mu", "nearest mu that gave too little restitution"},
    {"too_little_restitution", "restitution at too_little_mu"},
    {"beside_cut", "whether the end of the run cuts it, or one that overlaps it"},
};

/// A pass of the search for μ, and
inline constexpr Meaning kIteration[] = {
    {"episode", "cycles with the same number were solved together"},
    {"number", "corrections made so far", "pass"},
    {"start_time_s", "time at which the episode starts"},
    {"accepted", "1 for the pass whose trajectory is the accepted one"},
};

/// a group of cycles in it.
inline constexpr Meaning kUnknown[] = {
    {"contact", "name of the contact"},
    {"number", "place of its first cycle among those of its contact", "cycle"},
    {"mu", "hysteresis damping factor of this pass"},
    {"restitution_out", "energy restitution coefficient that it gave"},
    {"restitution_in", "energy restitution coefficient asked for"},
    {"residual", "W_r/W_c + restitution_in^2"},
    {"bracket_low", "largest mu known to give too much restitution"},
    {"bracket_high", "smallest mu known to give too little restitution"},
    {"update", "how the next mu is found"},
};

/// A body at the end of the run.
inline constexpr Meaning kBody[] = {
    {"name", "name of the body"},
    {"position_m", "position of the centre at the end of the run"},
    {"velocity_m_per_s", "velocity at the end of the run"},
};

}  // namespace contact::cli
