#include "simulation/motion/moving_system.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulation/model/index.h"

namespace contact {
namespace {

// What makes implicit steps cheapest: 4 at a tolerance of 1e-6, 7 at 1e-11.
int ImplicitOrder(double tolerance) {
  return std::clamp(static_cast<int>(std::lround(-0.6 * std::log10(tolerance))), 3, 10);
}

}  // namespace

MovingSystem::MovingSystem(const Scenario& of)
    : scenario(of),
      equations(of),
      rk(fixed_step() > 0 ? RungeKutta::Method::kClassical : RungeKutta::Method::kDormandPrince),
      euler(of, equations),
      tangents(of, equations),
      scales(of.contacts.size()),
      finest(of.solver.relative_tolerance),
      tolerance(finest) {}

void MovingSystem::Begin(const State& state, bool is_recording, double own_tolerance) {
  const int n = equations.bodies();
  tolerance = own_tolerance > 0 ? own_tolerance : finest;
  implicit_order = ImplicitOrder(tolerance);
  implicit = false;
  time = state.time;
  next_step = state.step;
  contacts = state.contacts;
  equations.slips = state.slips;
  contact_loss = state.contact_loss;
  touch_time = kNaN;
  momentum_scale = energy_scale = 0;

  equations.Rebase(state.positions);
  equations.recording = is_recording;
  tangents.Clear();
  rk.Resize(equations.size(), equations.coupled());
  rk.y0.setZero();
  SelectLoads();
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

void MovingSystem::TakeStep(bool implicitly) {
  if (implicitly && !implicit) euler.Prepare();
  implicit = implicitly;
  ++steps;
  if (implicit) {
    euler.Step(rk.y0, rk.slope0, time, step.h, implicit_order, &rk.y1);
    evaluations += ExtrapolatedEuler::Evaluations(implicit_order);
  } else {
    rk.Step(equations, step);
    evaluations += fixed_step() > 0 ? 3 : 11;
  }
}

void MovingSystem::FinishStep() {
  equations.PlaceDriven(step.start + step.h, rk.y1.data());
  rk.FinishStep(equations, step);
  ++evaluations;
}

void MovingSystem::PrepareInterpolation() {
  if (implicit) {
    euler.PrepareInterpolation(rk.y0, rk.slope0, time, step.h, implicit_order, rk.y1);
    evaluations +=
        std::int64_t{ExtrapolatedEuler::kNodes} * ExtrapolatedEuler::Evaluations(implicit_order);
  } else {
    rk.PrepareInterpolation(equations, step);
    if (fixed_step() == 0) evaluations += 3;
  }
}

void MovingSystem::Interpolate(double theta, Eigen::ArrayXd* y) const {
  implicit ? euler.Interpolate(theta, y) : rk.Interpolate(theta, y);
  equations.PlaceDriven(step.At(theta), y->data());
}

void MovingSystem::SelectLoads() {
  breakpoint = equations.SelectLoads(time, rk.y0.data());
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
        equations.Activate(c, contact.gap, contact.cycle.mu, contact.column, contact.yield));
  }
  equations.Prepare();
  if (implicit) euler.Prepare();
  if (tangents.count() > 0) tangents.Prepare();
  equations(time, rk.y0.data(), rk.slope0.data());
  ++evaluations;
}

}  // namespace contact
