// A ball that falls on a plane in Bullet. Arguments: contactStiffness contactDamping mass radius
// velocity gravity step. Prints the velocity after over the velocity before.
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <cstdlib>

int main(int /*argc*/, char** argv) {
  const auto number = [&](int i) { return static_cast<btScalar>(std::atof(argv[i])); };
  const btScalar mass = number(3), radius = number(4), velocity = number(5), step = number(7);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -number(6)));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btSphereShape sphere(radius);
  btVector3 inertia;
  sphere.calculateLocalInertia(mass, inertia);
  btRigidBody floor(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane));
  btRigidBody ball(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, &sphere, inertia));
  for (btRigidBody* body : {&floor, &ball}) {
    body->setContactStiffnessAndDamping(number(1), number(2));
    body->setFriction(0);
    world.addRigidBody(body);
  }
  ball.setActivationState(DISABLE_DEACTIVATION);
  btTransform start(btQuaternion::getIdentity(), btVector3(0, 0, radius + velocity * step / 2));
  ball.setWorldTransform(start);
  ball.setLinearVelocity(btVector3(0, 0, -velocity));
  bool touched = false;
  for (int i = 0; i < 10'000'000; ++i) {
    world.stepSimulation(step, 0);
    const btScalar depth = radius - ball.getWorldTransform().getOrigin().z();
    if (touched && depth < 0) break;
    touched = touched || depth > 0;
  }
  std::printf("%.12g\n", static_cast<double>(ball.getLinearVelocity().z() / velocity));
}
