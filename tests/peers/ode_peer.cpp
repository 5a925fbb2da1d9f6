// A ball that falls on a plane in ODE. Arguments: soft_erp soft_cfm mass radius velocity gravity
// step. Prints the velocity after over the velocity before.
#include <ode/ode.h>

#include <cstdio>
#include <cstdlib>

int main(int /*argc*/, char** argv) {
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const double radius = number(4), velocity = number(5), step = number(7);
  dInitODE();
  dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -number(6));
  dJointGroupID contacts = dJointGroupCreate(0);
  dBodyID ball = dBodyCreate(world);
  dMass mass;
  dMassSetSphereTotal(&mass, number(3), radius);
  dBodySetMass(ball, &mass);
  dBodySetPosition(ball, 0, 0, radius + velocity * step / 2);
  dBodySetLinearVel(ball, 0, 0, -velocity);
  bool touched = false;
  for (int i = 0; i < 10'000'000; ++i) {
    const double depth = radius - dBodyGetPosition(ball)[2];
    if (touched && depth < 0) break;
    touched = touched || depth > 0;
    if (depth > 0) {
      dContact contact = {};
      contact.surface.mode = dContactSoftERP | dContactSoftCFM;
      contact.surface.soft_erp = number(1);
      contact.surface.soft_cfm = number(2);
      contact.geom.pos[2] = 0;
      contact.geom.normal[2] = 1;
      contact.geom.depth = depth;
      dJointAttach(dJointCreateContact(world, contacts, &contact), ball, nullptr);
    }
    dWorldStep(world, step);
    dJointGroupEmpty(contacts);
  }
  std::printf("%.12g\n", dBodyGetLinearVel(ball)[2] / velocity);
}
