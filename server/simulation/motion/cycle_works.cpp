#include "simulation/motion/cycle_works.h"

#include <algorithm>

#include "simulation/model/contact_spring.h"

namespace contact {

void SetCompression(const Contact& contact, double deformation, double work, double external_work,
                    ContactState* state) {
  Cycle* cycle = &state->cycle;
  cycle->work_compression = work;
  cycle->external_compression = external_work;
  cycle->dissipated_compression =
      work - ElasticEnergy(contact, deformation, state->yield) + state->stored;
}

void SetRestitution(const Contact& contact, double deformation, double work, double external_work,
                    ContactState* state) {
  Cycle* cycle = &state->cycle;
  cycle->work_restitution = work - cycle->work_compression;
  cycle->external_restitution = external_work - cycle->external_compression;
  cycle->dissipated_restitution = cycle->work_restitution -
                                  ElasticEnergy(contact, cycle->end_deformation, state->yield) +
                                  ElasticEnergy(contact, deformation, state->yield);
}

void SetRest(const Contact& contact, double time, double deformation, double work,
             double external_work, ContactState* state) {
  Cycle* cycle = &state->cycle;
  cycle->turn_time = cycle->end_time = time;
  cycle->end_deformation = deformation;
  cycle->max_deformation = std::max(cycle->start_deformation, deformation);
  const double dissipated =
      work - ElasticEnergy(contact, deformation, state->yield) + state->stored;
  const bool pressed = work > 0;
  cycle->work_compression = pressed ? work : 0;
  cycle->work_restitution = pressed ? 0 : work;
  cycle->external_compression = pressed ? external_work : 0;
  cycle->external_restitution = pressed ? 0 : external_work;
  cycle->dissipated_compression = pressed ? dissipated : 0;
  cycle->dissipated_restitution = pressed ? 0 : dissipated;
}

}  // namespace contact
