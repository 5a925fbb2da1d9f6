// An independent integration of a run: Boost.odeint on the plain equations of motion, with the μ
// and the instants that the ledger tells. What the ledger says must come out again.
#pragma once

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <vector>

#include "simulation/model/derived.h"
#include "testing/cases.h"

namespace contact::testing {

/// How far the ledger of a run is from what an independent method finds, relative. Of times: the
/// rest of the speed that shall be 0 there, or of the deformation, over the largest of the cycle.
struct Disagreement {
  double velocity = 0;     ///< Of the bodies at the end, over the largest speed.
  double restitution = 0;  ///< Of the groups that have ended.
  double time = 0;         ///< Of turns and ends.
  double overlap = 0;      ///< Deformation outside cycles, over the largest of the contact.
};

class Independent {
 public:
  explicit Independent(const Scenario& scenario)
      : s_(scenario), bodies_(scenario.bodies.size()), mu_(scenario.contacts.size(), kNaN) {
    for (const Contact& c : s_.contacts) gap_.push_back(InitialGap(s_, c));
  }

  Disagreement Compare(const Record& run) {
    state_.assign(2 * bodies_ + s_.contacts.size(), 0);
    for (std::size_t i = 0; i < bodies_; ++i) state_[bodies_ + i] = s_.bodies[i].velocity;
    for (const Cycle& c : run.cycles) Note(c);
    std::ranges::stable_sort(marks_, {}, &Mark::time);
    for (const Mark& mark : marks_) {
      Advance(mark.time);
      Apply(mark);
    }
    Advance(run.outcome.time);
    CompareGroups(run);
    CompareVelocities(run);
    return worst_;
  }

  // The right side: y has displacements, velocities and the works ∫F dδ.
  void operator()(const std::vector<double>& y, std::vector<double>& dy, double t) const {
    std::ranges::fill(dy, 0.0);
    for (std::size_t i = 0; i < bodies_; ++i) dy[i] = y[bodies_ + i];
    for (const Load& l : s_.loads) {
      if (begin_ < l.begin || begin_ >= l.end) continue;
      const double since = t - l.begin;
      Push(l.body,
           l.constant + l.slope * since +
               l.amplitude * std::sin(l.angular_frequency * since + l.phase),
           dy);
    }
    for (const Support& p : s_.supports) {
      const double x = Place(p.body, y) - Place(p.other, y) - p.rest_position;
      const double v = Speed(p.body, y) - Speed(p.other, y);
      Push(p.body, -p.stiffness * x - p.damping * v, dy);
      Push(p.other, p.stiffness * x + p.damping * v, dy);
    }
    for (std::size_t c = 0; c < mu_.size(); ++c) {
      if (std::isnan(mu_[c])) continue;
      const Contact& contact = s_.contacts[c];
      const double rate = Rate(c, y);
      const double force = std::pow(std::max(Deformation(c, y), 0.0), contact.exponent) *
                           (contact.stiffness + mu_[c] * rate);
      Push(contact.left, -force, dy);
      Push(contact.right, force, dy);
      dy[2 * bodies_ + c] = force * rate;
    }
  }

 private:
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  struct Mark {
    enum class Kind { kEnd, kStart, kTurn, kBreak } kind;
    double time;
    const Cycle* cycle;
  };

  static std::size_t At(int index) { return static_cast<std::size_t>(index); }

  void Note(const Cycle& c) {
    marks_.push_back({Mark::Kind::kStart, c.start_time, &c});
    if (!std::isnan(c.turn_time)) marks_.push_back({Mark::Kind::kTurn, c.turn_time, &c});
    marks_.push_back({Mark::Kind::kEnd, c.end_time, &c});
  }

  double Place(int body, const std::vector<double>& y) const {
    return body == kNone ? 0 : s_.bodies[At(body)].position + y[At(body)];
  }
  double Speed(int body, const std::vector<double>& y) const {
    return body == kNone ? 0 : y[bodies_ + At(body)];
  }
  double Deformation(std::size_t c, const std::vector<double>& y) const {
    const Contact& contact = s_.contacts[c];
    const double left = contact.left == kNone ? 0 : y[At(contact.left)];
    return left - (contact.right == kNone ? 0 : y[At(contact.right)]) - gap_[c];
  }
  double Rate(std::size_t c, const std::vector<double>& y) const {
    return Speed(s_.contacts[c].left, y) - Speed(s_.contacts[c].right, y);
  }
  void Push(int body, double force, std::vector<double>& dy) const {
    if (body == kNone || s_.bodies[At(body)].fixed) return;
    dy[bodies_ + At(body)] += force / s_.bodies[At(body)].mass;
  }

  // No step straddles an instant at which a load begins or ends.
  void Advance(double to) {
    std::vector<double> stops = {to};
    for (const Load& l : s_.loads) {
      for (const double t : {l.begin, l.end}) {
        if (t > begin_ && t < to) stops.push_back(t);
      }
    }
    std::ranges::sort(stops);
    for (const double stop : stops) {
      if (stop <= begin_) continue;
      namespace odeint = boost::numeric::odeint;
      const auto stepper =
          odeint::make_controlled(1e-18, 1e-13, odeint::runge_kutta_dopri5<std::vector<double>>());
      odeint::integrate_adaptive(stepper, std::cref(*this), state_, begin_, stop,
                                 std::min(1e-7, (stop - begin_) / 4));
      begin_ = stop;
    }
  }

  void Apply(const Mark& mark) {
    const Cycle& cycle = *mark.cycle;
    const std::size_t c = At(cycle.contact);
    double& work = state_[2 * bodies_ + c];
    if (mark.kind == Mark::Kind::kStart) {
      worst_.overlap =
          std::max(worst_.overlap, std::abs(Deformation(c, state_) - cycle.start_deformation) /
                                       cycle.max_deformation);
      mu_[c] = cycle.mu;
      work = 0;
      return;
    }
    const double speed = std::sqrt(2 * Elastic(c, cycle));
    const double rate = std::abs(Rate(c, state_)) / std::max(speed, cycle.approach_velocity);
    if (mark.kind == Mark::Kind::kTurn) {
      compression_.push_back({&cycle, work});
      worst_.time = std::max(worst_.time, rate);
      return;
    }
    if (cycle.end == Cycle::End::kNonSeparation) worst_.time = std::max(worst_.time, rate);
    if (cycle.end == Cycle::End::kSeparation) {
      worst_.time = std::max(worst_.time, std::abs(Deformation(c, state_)) / cycle.max_deformation);
    }
    total_.push_back({&cycle, work});
    mu_[c] = kNaN;
  }

  // ∫k δⁿ dδ up to δ_m over the mass: the square of a speed of the cycle, halved.
  double Elastic(std::size_t c, const Cycle& cycle) const {
    const Contact& contact = s_.contacts[c];
    double inverse_mass = 0;
    for (const int body : {contact.left, contact.right}) {
      if (body != kNone && !s_.bodies[At(body)].fixed) inverse_mass += 1 / s_.bodies[At(body)].mass;
    }
    return contact.stiffness * std::pow(cycle.max_deformation, contact.exponent + 1) /
           (contact.exponent + 1) * inverse_mass;
  }

  struct Work {
    const Cycle* cycle;
    double value;
  };
  static double Of(const std::vector<Work>& works, const Cycle& cycle) {
    const auto found = std::ranges::find(works, &cycle, &Work::cycle);
    return found == works.end() ? kNaN : found->value;
  }

  void CompareGroups(const Record& run) {
    for (const Group& g : run.groups) {
      if (g.end == Cycle::End::kRunEnd) continue;
      double compression = 0, restitution = 0;
      for (const Cycle& c : run.cycles) {
        if (c.contact != g.contact || c.group != g.number) continue;
        compression += Of(compression_, c);
        restitution += Of(total_, c) - Of(compression_, c);
      }
      const double out = std::sqrt(-restitution / compression);
      worst_.restitution = std::max(worst_.restitution, std::abs(out / g.restitution_out - 1));
    }
  }

  void CompareVelocities(const Record& run) {
    double largest = 0, miss = 0;
    for (const Cycle& c : run.cycles) largest = std::max(largest, c.approach_velocity);
    for (std::size_t i = 0; i < bodies_; ++i) {
      for (const double v : {s_.bodies[i].velocity, run.outcome.velocities[i]}) {
        largest = std::max(largest, std::abs(v));
      }
      miss = std::max(miss, std::abs(state_[bodies_ + i] - run.outcome.velocities[i]));
    }
    worst_.velocity = miss / largest;
  }

  const Scenario& s_;
  std::size_t bodies_;
  std::vector<double> gap_;
  std::vector<double> mu_;  // Of the cycle that runs; NaN: none does.
  std::vector<double> state_;
  double begin_ = 0;
  std::vector<Mark> marks_;
  std::vector<Work> compression_, total_;  // Of each cycle: to its turn, to its end.
  Disagreement worst_;
};

}  // namespace contact::testing
