#include "simulation/motion/cycle_works.h"

#include "simulation/motion/equations.h"

namespace contact {

void SetCompression(const Contact& contact, double deformation, double work, double external_work,
                    Cycle* cycle) {
  cycle->work_compression = work;
  cycle->external_compression = external_work;
  cycle->dissipated_compression =
      work - ElasticEnergy(contact, deformation) + ElasticEnergy(contact, cycle->start_deformation);
}

void SetRestitution(const Contact& contact, double deformation, double work, double external_work,
                    Cycle* cycle) {
  cycle->work_restitution = work - cycle->work_compression;
  cycle->external_restitution = external_work - cycle->external_compression;
  cycle->dissipated_restitution = cycle->work_restitution -
                                  ElasticEnergy(contact, cycle->end_deformation) +
                                  ElasticEnergy(contact, deformation);
}

}  // namespace contact
