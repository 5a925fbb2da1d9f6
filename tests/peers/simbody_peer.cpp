// A ball that falls on a half-space in Simbody. Arguments: stiffness dissipation mass radius
// velocity gravity accuracy. Prints the velocity after over the velocity before.
#include <Simbody.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

int main(int /*argc*/, char** argv) {
  using namespace SimTK;
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const double radius = number(4), velocity = number(5);
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  GeneralContactSubsystem contacts(system);
  // The slider moves along x, towards the half-space where x > 0.
  Force::UniformGravity(forces, matter, Vec3(number(6), 0, 0));
  MobilizedBody::Slider ball(matter.Ground(), Transform(),
                             Body::Rigid(MassProperties(number(3), Vec3(0), UnitInertia(1e-3))),
                             Transform());
  const ContactSetIndex set = contacts.createContactSet();
  contacts.addBody(set, ball, ContactGeometry::Sphere(radius), Transform());
  contacts.addBody(set, matter.updGround(), ContactGeometry::HalfSpace(), Transform());
  HuntCrossleyForce force(forces, contacts, set);
  for (int surface : {0, 1}) {
    force.setBodyParameters(ContactSurfaceIndex(surface), number(1), number(2), 0, 0, 0);
  }
  State state = system.realizeTopology();
  ball.setLength(state, -radius);
  ball.setRate(state, velocity);
  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(number(7));
  integrator.initialize(state);
  bool touched = false;
  double depth = 0;
  for (int i = 1; i < 1'000'000; ++i) {
    const double target = i * 1e-5;
    while (integrator.getTime() < target) integrator.stepTo(target);
    depth = radius + ball.getLength(integrator.getState());
    if (touched && depth < 0) break;
    touched = touched || depth > 0;
  }
  // The velocity at δ = 0, up to 10 µs ago.
  const double rate = ball.getRate(integrator.getState());
  std::printf("%.12g\n", std::sqrt(rate * rate - 2 * number(6) * depth) / velocity);
}
