#include "simulation/proof/plain_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/model/derived.h"
#include "simulation/proof/rosenbrock.h"

namespace contact::testing {
namespace {

// An error so large that a step is a tenth next: of a trial beyond all numbers.
constexpr double kTooFar = 1e300;
// Extrapolation is stable up to λ h of about 5; where so many steps in a row are near that, a
// contact creeps, and is integrated implicitly.
constexpr double kStiff = 2;
constexpr int kPatience = 10;

}  // namespace

PlainMotion::PlainMotion(const Scenario& scenario, double speed, double tolerance)
    : s_(scenario),
      bodies_(scenario.bodies.size()),
      speed_(speed),
      tolerance_(tolerance),
      mu_(scenario.contacts.size(), kNone_),
      scales_(scenario.contacts.size()),
      overlaps_(scenario.contacts.size()),
      yields_(scenario.contacts.size()),
      state_(2 * bodies_ + scenario.contacts.size(), 0.0) {
  for (std::size_t i = 0; i < bodies_; ++i) state_[bodies_ + i] = s_.bodies[i].velocity;
  for (const Contact& c : s_.contacts) {
    gaps_.push_back(InitialGap(s_, c));
    exponents_.push_back(DampingExponent(c.damping, c.exponent));
  }
  for (const Support& p : s_.supports) {
    const double from = p.other == kNone ? 0 : s_.bodies[At(p.other)].position;
    stretches_.push_back(s_.bodies[At(p.body)].position - from - p.rest_position);
  }
}

void PlainMotion::Engage(int contact, double mu, const Scale& scale) {
  mu_[At(contact)] = mu;
  scales_[At(contact)] = scale;
  state_[2 * bodies_ + At(contact)] = 0;
}

void PlainMotion::Disengage(int contact) { mu_[At(contact)] = kNone_; }

double PlainMotion::Difference(int left, int right, const Vector& y, std::size_t from) const {
  return (left == kNone ? 0 : y[from + At(left)]) - (right == kNone ? 0 : y[from + At(right)]);
}

double PlainMotion::Rate(int contact) const {
  const Contact& c = s_.contacts[At(contact)];
  return Difference(c.left, c.right, state_, bodies_);
}

double PlainMotion::InverseMass(int body) const {
  return body == kNone || s_.bodies[At(body)].fixed ? 0 : 1 / s_.bodies[At(body)].mass;
}

PlainMotion::Force PlainMotion::ContactForce(std::size_t contact, const Vector& y) const {
  const Contact& c = s_.contacts[contact];
  const double depth = std::max(0.0, Difference(c.left, c.right, y, 0) - gaps_[contact]);
  const double rate = Difference(c.left, c.right, y, bodies_);
  if (!c.table.empty()) {
    const Power at = c.table.At(depth, yields_[contact]);
    return {at.value, at.slope, 0};
  }
  const double n = c.exponent, p = exponents_[contact], mu = mu_[contact];
  const double spring = c.stiffness * std::pow(depth, n);
  const double damping = p == n ? mu * (spring / c.stiffness) : mu * std::pow(depth, p);
  if (s_.solver.clip_tension && spring + damping * rate < 0) return {0, 0, 0};
  const double slope = depth == 0 ? 0 : (n * spring + p * damping * rate) / depth;
  return {spring + damping * rate, slope, damping};
}

double PlainMotion::LoadForce(const Load& l, double t) const {
  const double since = t - l.begin;
  return l.constant + l.slope * since +
         l.amplitude * std::sin(l.angular_frequency * since + l.phase);
}

double PlainMotion::LoadSlope(const Load& l, double t) const {
  return l.slope + l.amplitude * l.angular_frequency *
                       std::cos(l.angular_frequency * (t - l.begin) + l.phase);
}

void PlainMotion::Slopes(const Vector& y, Vector& dy, double t) const {
  std::fill(dy.begin(), dy.end(), 0.0);
  const auto push = [&](int body, double force) {
    if (body != kNone) dy[bodies_ + At(body)] += force * InverseMass(body);
  };
  for (std::size_t i = 0; i < bodies_; ++i) dy[i] = y[bodies_ + i];
  for (const Load& l : s_.loads) {
    if (Acts(l)) push(l.body, LoadForce(l, t));
  }
  for (const Drive& d : s_.drives) {
    if (Acts(d)) dy[bodies_ + At(d.body)] += MotionAt(d, t).acceleration;
  }
  for (std::size_t i = 0; i < s_.supports.size(); ++i) {
    const Support& p = s_.supports[i];
    const double d = stretches_[i] + Difference(p.body, p.other, y, 0);
    double force = p.stiffness * d + p.damping * Difference(p.body, p.other, y, bodies_);
    for (std::size_t j = 0; j < p.higher.size(); ++j) {
      force += p.higher[j] * std::pow(d, static_cast<int>(j) + 2);
    }
    push(p.body, -force);
    push(p.other, force);
  }
  for (std::size_t i = 0; i < mu_.size(); ++i) {
    if (std::isnan(mu_[i])) continue;
    const Contact& c = s_.contacts[i];
    const double force = ContactForce(i, y).value;
    push(c.left, -force);
    push(c.right, force);
    dy[2 * bodies_ + i] = force * Difference(c.left, c.right, y, bodies_);
  }
}

void PlainMotion::Couple(int left, int right, const Force& force, Eigen::MatrixXd& j) const {
  const auto n = static_cast<Eigen::Index>(bodies_);
  for (const int row : {left, right}) {
    const double w = (row == left ? -1 : 1) * InverseMass(row);
    for (const int column : {left, right}) {
      if (row == kNone || column == kNone) continue;
      const double side = column == left ? w : -w;
      j(n + row, column) += side * force.by_deformation;
      j(n + row, n + column) += side * force.by_rate;
    }
  }
}

void PlainMotion::Jacobian(Eigen::MatrixXd& j, Eigen::VectorXd& by_time) const {
  const auto n = static_cast<Eigen::Index>(bodies_);
  for (Eigen::Index i = 0; i < n; ++i) j(i, n + i) = 1;
  for (const Load& l : s_.loads) {
    if (Acts(l)) by_time[n + l.body] += LoadSlope(l, time_) * InverseMass(l.body);
  }
  for (const Drive& d : s_.drives) {
    if (!Acts(d)) continue;
    const double w = d.angular_frequency, phase = w * (time_ - d.begin) + d.phase;
    by_time[n + d.body] += d.jerk - d.amplitude * w * w * w * std::cos(phase);
  }
  for (std::size_t i = 0; i < s_.supports.size(); ++i) {
    const Support& p = s_.supports[i];
    const double d = stretches_[i] + Difference(p.body, p.other, state_, 0);
    double slope = p.stiffness;
    for (std::size_t k = 0; k < p.higher.size(); ++k) {
      slope += static_cast<double>(k + 2) * p.higher[k] * std::pow(d, static_cast<int>(k) + 1);
    }
    Couple(p.body, p.other, {0, slope, p.damping}, j);
  }
  for (std::size_t i = 0; i < mu_.size(); ++i) {
    if (std::isnan(mu_[i])) continue;
    const Contact& c = s_.contacts[i];
    const Force force = ContactForce(i, state_);
    const double rate = Difference(c.left, c.right, state_, bodies_);
    Couple(c.left, c.right, force, j);
    const auto row = 2 * n + static_cast<Eigen::Index>(i);
    for (const int body : {c.left, c.right}) {
      if (body == kNone) continue;
      const double side = body == c.left ? 1 : -1;
      j(row, body) = side * force.by_deformation * rate;
      j(row, n + body) = side * (force.by_rate * rate + force.value);
    }
  }
}

void PlainMotion::Creep(double step, Vector& reached, Vector& error) const {
  const auto size = static_cast<Eigen::Index>(state_.size());
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd by_time = Eigen::VectorXd::Zero(size);
  Jacobian(j, by_time);
  Vector at(state_.size()), slopes(state_.size());
  const auto f = [&](const Eigen::VectorXd& y, double t) {
    std::ranges::copy(y, at.begin());
    Slopes(at, slopes, t);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(slopes.data(), size));
  };
  RosenbrockStep taken;
  taken.Take(f, Eigen::Map<const Eigen::VectorXd>(state_.data(), size), time_, step, j, by_time);
  reached.assign(taken.reached.begin(), taken.reached.end());
  error.assign(taken.error.begin(), taken.error.end());
}

// No step straddles an instant at which a load or drive begins or ends.
double PlainMotion::NextEdge(double end) const {
  double edge = end;
  const auto see = [&](const auto& pieces) {
    for (const auto& piece : pieces) {
      for (const double t : {piece.begin, piece.end}) {
        if (t > time_) edge = std::min(edge, t);
      }
    }
  };
  see(s_.loads);
  see(s_.drives);
  return edge;
}

// The rate at which damping ends a motion of the contacts [1/s].
double PlainMotion::Stiffest() const {
  double rate = 0;
  for (std::size_t i = 0; i < mu_.size(); ++i) {
    if (std::isnan(mu_[i])) continue;
    const Contact& c = s_.contacts[i];
    const double w = InverseMass(c.left) + InverseMass(c.right);
    rate = std::max(rate, mu_[i] * std::pow(std::max(0.0, -gaps_[i]), exponents_[i]) * w);
  }
  return rate;
}

// Relative to what is allowed: the tolerance, and what round-off makes in a step.
double PlainMotion::Error(const Vector& e, double step) const {
  constexpr double kRound = 64 * std::numeric_limits<double>::epsilon();
  double worst = 0;
  const auto take = [&](double error, double allowed) {
    worst = std::max(worst, std::isfinite(error) ? std::abs(error) / allowed : kTooFar);
  };
  for (std::size_t i = 0; i < bodies_; ++i) {
    const double v = tolerance_ * speed_ + kRound * std::abs(state_[bodies_ + i]);
    take(e[bodies_ + i], v);
    take(e[i], v * step);
  }
  for (std::size_t i = 0; i < mu_.size(); ++i) {
    if (std::isnan(mu_[i])) continue;
    const Contact& c = s_.contacts[i];
    double fast = 0;
    for (const int body : {c.left, c.right}) {
      if (body != kNone) fast = std::max(fast, std::abs(state_[bodies_ + At(body)]));
    }
    // Also the forces in equilibrium have digits to lose.
    const double pull = step * c.stiffness * std::pow(std::max(0.0, -gaps_[i]), c.exponent) *
                        (InverseMass(c.left) + InverseMass(c.right));
    const double v = tolerance_ * scales_[i].speed + kRound * (fast + pull);
    take(Difference(c.left, c.right, e, bodies_), v);
    take(Difference(c.left, c.right, e, 0),
         tolerance_ * scales_[i].deformation + kRound * (fast * step + std::abs(gaps_[i])));
    take(e[2 * bodies_ + i], tolerance_ * scales_[i].work);
  }
  return worst;
}

void PlainMotion::Accept(const Vector& reached, double time) {
  state_ = reached;
  time_ = time;
  for (std::size_t i = 0; i < bodies_; ++i) {
    fastest_ = std::max(fastest_, std::abs(state_[bodies_ + i]));
  }
  for (std::size_t i = 0; i < gaps_.size(); ++i) {
    gaps_[i] -= Difference(s_.contacts[i].left, s_.contacts[i].right, state_, 0);
    if (std::isnan(mu_[i])) {
      overlaps_[i] = std::max(overlaps_[i], -gaps_[i]);
      if (gaps_[i] > 0) yields_[i] = 0;
    } else {  // What it turns at is the most there was: a step ends there.
      yields_[i] = std::max(yields_[i], -gaps_[i]);
    }
  }
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    stretches_[i] += Difference(s_.supports[i].body, s_.supports[i].other, state_, 0);
  }
  std::fill_n(state_.begin(), bodies_, 0.0);
}

bool PlainMotion::Advance(double end, int most_steps) {
  const auto slopes = [this](const Vector& y, Vector& dy, double t) { Slopes(y, dy, t); };
  while (time_ < end) {
    const double edge = NextEdge(end);
    const bool last = step_ >= edge - time_;
    const double step = last ? edge - time_ : step_;
    if (++steps_ > most_steps || !(step > 1e-15 * time_)) return false;
    stiff_ = step * Stiffest() > kStiff ? stiff_ + 1 : 0;
    const bool creeps = stiff_ > kPatience;
    if (creeps) {
      Creep(step, taken_.reached, taken_.error);
    } else {
      taken_.Take(slopes, state_, time_, step);
    }
    const double miss = Error(taken_.error, step);
    const double factor = 0.8 * std::pow(std::max(miss, 1e-10), creeps ? -1.0 / 4 : -1.0 / 11);
    const double next = step * std::clamp(factor, 0.1, 4.0);
    if (!last || miss > 1 || next > step_) step_ = next;
    if (miss <= 1) Accept(taken_.reached, last ? edge : time_ + step);
  }
  return true;
}

}  // namespace contact::testing
