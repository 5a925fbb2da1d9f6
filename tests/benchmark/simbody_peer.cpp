#include "simbody_peer.h"

#include <Simbody.h>

#include <cmath>
#include <cstddef>

namespace {

// The loads and supports of a scenario on its sliders.
class OtherForces final : public SimTK::Force::Custom::Implementation {
 public:
  OtherForces(const SimbodyRow& row, const std::vector<SimTK::MobilizedBody::Slider>& bodies)
      : row_(row), bodies_(bodies) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>&,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& forces) const override {
    for (const SimbodyRow::Push& push : row_.pushes) {
      Push(state, push.ball,
           push.constant +
               push.amplitude * std::sin(push.angular_frequency * state.getTime() + push.phase),
           &forces);
    }
    for (const SimbodyRow::Spring& s : row_.springs) {
      const auto& body = bodies_[static_cast<std::size_t>(s.ball)];
      Push(state, s.ball,
           -s.stiffness * (body.getLength(state) - s.rest) - s.damping * body.getRate(state),
           &forces);
    }
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  void Push(const SimTK::State& state, int body, double force, SimTK::Vector* forces) const {
    bodies_[static_cast<std::size_t>(body)].applyOneMobilityForce(state, 0, force, *forces);
  }

  const SimbodyRow& row_;
  const std::vector<SimTK::MobilizedBody::Slider>& bodies_;
};

// Simbody's force is 4/3 K^1.5 √R δ^1.5 (1 + 1.5 c δ̇) with K of two surfaces in series; each has K
// twice as large here, given as K^1.5.
void SetSurface(SimTK::HuntCrossleyForce* force, int surface, double radius,
                const SimbodyRow::Touch& touch) {
  const double stiffness = 0.75 * touch.stiffness / std::sqrt(radius) * std::pow(2, 1.5);
  force->setBodyParameters(SimTK::ContactSurfaceIndex(surface), stiffness,
                           touch.mu / (1.5 * touch.stiffness), 0, 0, 0);
}

}  // namespace

std::vector<double> BySimbody(const SimbodyRow& row, double accuracy) {
  using namespace SimTK;
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  GeneralContactSubsystem contacts(system);

  std::vector<MobilizedBody::Slider> bodies;
  for (const SimbodyRow::Ball& body : row.balls) {
    bodies.emplace_back(matter.Ground(), Transform(),
                        Body::Rigid(MassProperties(body.mass, Vec3(0), UnitInertia(1e-3))),
                        Transform());
  }
  for (const SimbodyRow::Touch& touch : row.touches) {
    const ContactSetIndex set = contacts.createContactSet();
    const std::size_t left = static_cast<std::size_t>(touch.left);
    double radius = row.balls[left].radius;
    contacts.addBody(set, bodies[left], ContactGeometry::Sphere(radius), Transform());
    if (touch.right == -1) {
      // The half-space is where its own x > 0.
      contacts.addBody(set, matter.updGround(), ContactGeometry::HalfSpace(),
                       Transform(Vec3(touch.wall, 0, 0)));
    } else {
      const std::size_t right = static_cast<std::size_t>(touch.right);
      const double other = row.balls[right].radius;
      contacts.addBody(set, bodies[right], ContactGeometry::Sphere(other), Transform());
      radius = radius * other / (radius + other);
    }
    HuntCrossleyForce force(forces, contacts, set);
    SetSurface(&force, 0, radius, touch);
    SetSurface(&force, 1, radius, touch);
    force.setTransitionVelocity(1);
  }
  const Force::Custom others(forces, new OtherForces(row, bodies));  // Simbody takes ownership.

  State state = system.realizeTopology();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].setLength(state, row.balls[i].position);
    bodies[i].setRate(state, row.balls[i].velocity);
  }
  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  integrator.initialize(state);
  while (integrator.getTime() < row.end_time) integrator.stepTo(row.end_time);

  std::vector<double> velocities;
  for (const auto& body : bodies) velocities.push_back(body.getRate(integrator.getState()));
  return velocities;
}
