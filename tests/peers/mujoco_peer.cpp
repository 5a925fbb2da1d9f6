// A ball that falls on a plane in MuJoCo. Arguments: stiffness damping mass radius velocity gravity
// step, and solimp's dmin and dmax if other than 0.9999. Prints the velocity after over that
// before.
#include <mujoco/mujoco.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

int main(int argc, char** argv) {
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const std::string text = argv[6], step_text = argv[7];
  const std::string low = argc > 9 ? argv[8] : "0.9999", high = argc > 9 ? argv[9] : "0.9999";
  const std::string geom = " condim=\"1\" solref=\"-" + std::string(argv[1]) + " -" + argv[2] +
                           "\" solimp=\"" + low + " " + high + " 0.001\"/>";
  const char* const path = "peer.xml";
  std::ofstream(path) << "<mujoco><option timestep=\"" << step_text << "\" gravity=\"0 0 -" << text
                      << "\" solver=\"Newton\" tolerance=\"0\"/><worldbody>"
                      << "<geom type=\"plane\" size=\"1 1 1\"" << geom << "<body pos=\"0 0 "
                      << number(4) << "\"><freejoint/><geom type=\"sphere\""
                      << " size=\"" << number(4) << "\" mass=\"" << number(3) << "\"" << geom
                      << "</body></worldbody></mujoco>";
  char error[1000] = "";
  mjModel* model = mj_loadXML(path, nullptr, error, sizeof error);
  if (!model) {
    std::fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData* data = mj_makeData(model);
  const double radius = number(4), velocity = number(5), step = number(7);
  data->qpos[2] = radius + velocity * step / 2;
  data->qvel[2] = -velocity;
  bool touched = false;
  for (int i = 0; i < 10'000'000; ++i) {
    mj_step(model, data);
    const double depth = radius - data->qpos[2];
    if (touched && depth < 0) break;
    touched = touched || depth > 0;
  }
  std::printf("%.12g\n", data->qvel[2] / velocity);
}
