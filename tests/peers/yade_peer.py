"""A ball that falls on a fixed one in Yade, of the same radius and mass; `yade -n -x` runs this.

Prints the velocity after over the velocity before. Arguments: kn cn mass radius velocity gravity
step; `mass` and `radius` are the effective ones."""

import math
import sys

from yade import *  # noqa: F401,F403  The names that Yade gives its scripts.

kn, cn, mass, radius, velocity, gravity, step = map(float, sys.argv[1:8])
# A fixed ball counts with its own mass in the parameters en and tc only.
size = 2 * radius
density = mass / (4 / 3 * math.pi * size**3)
material = O.materials.append(ViscElMat(kn=kn, cn=cn, ks=0, cs=0, frictionAngle=0, density=density))
O.bodies.append(sphere((0, 0, 0), size, material=material, fixed=True))
ball = O.bodies[O.bodies.append(sphere((0, 0, 2 * size + velocity * step / 2), size,
                                       material=material))]
ball.state.vel = (0, 0, -velocity)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.05 * size),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                    [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -gravity)),
]
O.dt = step
touched = False
while True:
    O.run(20, True)
    depth = 2 * size - ball.state.pos[2]
    if touched and depth < 0:
        break
    touched = touched or depth > 0
# The velocity at δ = 0, some steps ago.
after = math.sqrt(ball.state.vel[2]**2 + 2 * gravity * -depth)
print("ratio", after / velocity, flush=True)
