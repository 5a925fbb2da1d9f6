#include "simulation/motion/moving_system.h"

#include <cstddef>

namespace contact {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

MovingSystem::MovingSystem(const Scenario& of)
    : scenario(of),
      equations(of),
      rk(fixed_step() > 0 ? RungeKutta::Method::kClassical : RungeKutta::Method::kDormandPrince),
      tangents(of, equations),
      scales(of.contacts.size()),
      tolerance(of.solver.relative_tolerance) {}

void MovingSystem::Begin(const State& state, bool is_recording, double own_tolerance) {
  const int n = equations.bodies();
  tolerance = own_tolerance > 0 ? own_tolerance : scenario.solver.relative_tolerance;
  time = state.time;
  next_step = state.step;
  contacts = state.contacts;
  contact_loss = state.contact_loss;
  touch_time = kNaN;

  equations.base = state.positions;
  equations.recording = is_recording;
  tangents.Clear();
  SelectLoads();
  rk.Resize(equations.size(), equations.coupled());
  rk.y0.setZero();
  for (int i = 0; i < n; ++i) rk.y0[n + i] = state.velocities[At(i)];
  for (int c = 0; c < equations.contacts(); ++c) {
    const ContactState& contact = contacts[At(c)];
    rk.y0[equations.work(c)] = contact.work;
    if (is_recording) rk.y0[equations.external_work(c)] = contact.external_work;
  }
  RefreshActive();
}

double MovingSystem::ExternalWork(int contact, const Eigen::ArrayXd& y) const {
  return equations.recording ? y[equations.external_work(contact)] : 0;
}

double MovingSystem::Deformation(int contact, const double* y) const {
  return equations.Relative(contact, y) - contacts[At(contact)].gap;
}

void MovingSystem::PrepareInterpolation() {
  rk.PrepareInterpolation(equations, step);
  if (fixed_step() == 0) evaluations += 3;
}

void MovingSystem::SelectLoads() {
  breakpoint = equations.SelectLoads(time);
  forcing_time = equations.ForcingTime();
}

void MovingSystem::RefreshActive() {
  equations.active.clear();
  resting = false;
  for (int c = 0; c < equations.contacts(); ++c) {
    const ContactState& contact = contacts[At(c)];
    if (!InTouch(contact.phase)) continue;
    resting |= contact.phase == Phase::kResting;
    equations.active.push_back(
        equations.Activate(c, contact.gap, contact.cycle.mu, contact.column));
  }
  equations.Prepare();
  if (tangents.count() > 0) tangents.Prepare();
  equations(time, rk.y0.data(), rk.slope0.data());
  ++evaluations;
}

std::pair<DeformationPath::End, DeformationPath::End> MovingSystem::PathEnds(int contact) const {
  const int n = equations.bodies();
  const Sides& sides = equations.sides(contact);
  const double gap = contacts[At(contact)].gap;
  const double bend = 2 * step.h * (1 - step.warp);  // d²t/dθ²
  const auto end = [&](const auto& y, const auto& slope, double theta) {
    const double rate = sides.Relative(y.data() + n);
    const double acceleration = sides.Relative(slope.data() + n);
    const double dt = step.h * step.Rate(theta);
    return DeformationPath::End{sides.Relative(y.data()) - gap, dt * rate,
                                dt * dt * acceleration + bend * rate};
  };
  return {end(rk.y0, rk.slope0, 0), end(rk.y1, rk.slope1, 1)};
}

}  // namespace contact
