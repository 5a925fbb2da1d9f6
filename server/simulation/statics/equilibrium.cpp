#include "simulation/statics/equilibrium.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include "simulation/laws/spring.h"
#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

using Vector = Eigen::VectorXd;

// Contacts become hard in steps of this factor, so often. Without softness 6 of 3,000 random piles
// are not found, and in one step of 1e-10 35; in steps of 0.01 a row of 1,000 contacts of exponent
// 5 takes 237 of Newton's steps for 30. Equilibrium.OfRandomPiles…, OfALongRow….
constexpr double kHarder = 0.1;
constexpr int kStages = 10;
// Newton's steps in all, and halvings of one of them, at most. 3,000 random piles take 14 in the
// median and 55 at most; each takes 10 ms for 10,000 bodies.
constexpr int kMostSteps = 100, kMostHalvings = 40;
// A step helps that leaves at most this part of the slope of the potential along itself.
constexpr double kHelps = 0.5;
// What is added to all slopes, relative to the largest: a body on which nothing acts has none.
constexpr double kLeastSlope = 1e-15;
// Imbalance of a body in equilibrium, relative to the sum of its forces' sizes, and while contacts
// are soft; and digits that round-off takes of positions.
constexpr double kBalanced = 1e-12, kNearly = 1e-2,
                 kRoundOff = 16 * std::numeric_limits<double>::epsilon();

// δ of a contact, made positive: s = (δ + √(δ² + τ²))/2, and ds/dδ. With τ > 0 an open contact
// holds off what comes near it, so no slope is 0; with τ = 0 it is max(δ, 0).
struct Soft {
  double value = 0, slope = 0;

  Soft(double deformation, double width) {
    const double root = std::hypot(deformation, width);
    if (root == 0) return;
    value = deformation > 0 ? (deformation + root) / 2 : width * width / (2 * (root - deformation));
    slope = value / root;
  }
};

// The forces on the bodies that take part, as a function of their displacements u [m].
class Balance {
 public:
  explicit Balance(const Scenario& scenario) : scenario_(scenario), rows_(scenario.bodies.size()) {
    int rows = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Body& body = scenario.bodies[i];
      rows_[i] = body.fixed || body.velocity != 0 ? kNone : rows++;
      size_ = std::max(size_, std::abs(body.position) + body.radius);
    }
    loads_ = Vector::Zero(rows);
    for (const Load& load : scenario.loads) {
      const int row = rows_[At(load.body)];
      if (row != kNone && load.begin <= 0 && load.end > 0) loads_[row] += LoadForce(load, 0);
    }
    const double load = loads_.cwiseAbs().sum();
    for (const Contact& contact : scenario.contacts) {
      gaps_.push_back(InitialGap(scenario, contact));
      // As soft that the contact holds that load about where it is now.
      const double pressed = DepthUnder(contact, load);
      widths_.push_back(2 * std::sqrt((std::abs(gaps_.back()) + pressed) * pressed));
    }
  }

  Eigen::Index size() const { return loads_.size(); }
  int row(std::size_t body) const { return rows_[body]; }

  // Computes the members below for these displacements, of contacts softened by this part of what
  // they begin with.
  void Evaluate(const Vector& u, double softness) {
    force = loads_;
    parts = loads_.cwiseAbs();
    entries_.clear();
    for (std::size_t c = 0; c < gaps_.size(); ++c) {
      const Contact& contact = scenario_.contacts[c];
      if (HasVelocity(contact.left) || HasVelocity(contact.right)) continue;
      const int left = Row(contact.left), right = Row(contact.right);
      const Soft soft(Of(u, left) - Of(u, right) - gaps_[c], softness * widths_[c]);
      const Power spring = SpringForce(contact, soft.value, 0);
      Push(left, right, -spring.value, spring.slope * soft.slope);
    }
    for (const Support& support : scenario_.supports) {
      if (HasVelocity(support.body) || HasVelocity(support.other)) continue;
      const int body = Row(support.body), other = Row(support.other);
      const double stretch = Position(support.body) - Position(support.other) -
                             support.rest_position + Of(u, body) - Of(u, other);
      const Spring spring(support.stiffness, support.higher, stretch);
      Push(body, other, -spring.force, std::abs(spring.slope));
    }
    slope.resize(size(), size());
    slope.setFromTriplets(entries_.begin(), entries_.end());
  }

  // Whether the forces on a body balance to this part of their sizes, as far as numbers tell.
  bool Holds(Eigen::Index row, const Vector& u, double balanced) const {
    const double reach = size_ + std::abs(u[row]);
    const double noise = kRoundOff * reach * slope.coeff(row, row);
    return std::abs(force[row]) <= balanced * parts[row] + noise;
  }

  bool HoldsAll(const Vector& u, double balanced) const {
    for (Eigen::Index row = 0; row < size(); ++row) {
      if (!Holds(row, u, balanced)) return false;
    }
    return true;
  }

  // The bodies whose forces do not balance, first the one that has moved farthest.
  std::vector<int> Unheld(const Vector& u) const {
    std::vector<int> bodies;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const bool holds = rows_[i] == kNone || Holds(rows_[i], u, kBalanced);
      if (!holds) bodies.push_back(static_cast<int>(i));
    }
    std::ranges::sort(bodies, std::greater(),
                      [&](int body) { return std::abs(u[rows_[At(body)]]); });
    return bodies;
  }

  Vector force;  // On each body [N].
  Vector parts;  // Sum of the sizes of its parts [N].
  // −∂force/∂u [N/m]; where a spring gives way, with the size of its slope, for Newton's steps to
  // go downhill there, too.
  Eigen::SparseMatrix<double> slope;

 private:
  bool HasVelocity(int body) const {
    return body != kNone && scenario_.bodies[At(body)].velocity != 0;
  }
  int Row(int body) const { return body == kNone ? kNone : rows_[At(body)]; }
  double Position(int body) const {
    return body == kNone ? 0 : scenario_.bodies[At(body)].position;
  }
  static double Of(const Vector& u, int row) { return row == kNone ? 0 : u[row]; }

  // A force on `body`, its opposite on `other`, and how fast both fall as they move.
  void Push(int body, int other, double push, double stiffness) {
    for (const int row : {body, other}) {
      if (row == kNone) continue;
      force[row] += row == body ? push : -push;
      parts[row] += std::abs(push);
      entries_.emplace_back(row, row, stiffness);
    }
    if (body == kNone || other == kNone) return;
    entries_.emplace_back(body, other, -stiffness);
    entries_.emplace_back(other, body, -stiffness);
  }

  const Scenario& scenario_;
  std::vector<int> rows_;  // Of each body among those that take part, or kNone.
  Vector loads_;
  std::vector<double> gaps_, widths_;  // Of each contact: −δ, and τ at softness 1 [m].
  double size_ = 0;                    // Of positions [m].
  std::vector<Eigen::Triplet<double>> entries_;
};

// Newton's method on Σ F = 0 at one softness after the other.
class Newton {
 public:
  explicit Newton(Balance& balance) : balance_(balance), one_(balance.size(), balance.size()) {
    one_.setIdentity();
    factors_.analyzePattern(balance.slope + one_);
  }

  void Solve(double softness, Vector& u) {
    balance_.Evaluate(u, softness);
    const double balanced = softness > 0 ? kNearly : kBalanced;
    for (; steps_ < kMostSteps && !balance_.HoldsAll(u, balanced); ++steps_) {
      if (!Step(softness, u)) return;
    }
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  // A step helps that goes downhill in the potential. False: there is none.
  bool Step(double softness, Vector& u) {
    const double largest = balance_.slope.diagonal().maxCoeff();
    factors_.factorize(balance_.slope + (largest > 0 ? kLeastSlope * largest : 1) * one_);
    Vector step = factors_.solve(balance_.force);
    const Vector before = u;
    const double slope = balance_.force.dot(step);
    if (!(slope > 0 && std::isfinite(slope))) return false;
    double part = 1;
    for (int halvings = 0; halvings < kMostHalvings; ++halvings, part *= 0.5) {
      u = before + part * step;
      balance_.Evaluate(u, softness);
      if (-balance_.force.dot(step) <= kHelps * slope) break;
    }
    return true;
  }

  Balance& balance_;
  Matrix one_;
  // Most contacts join neighbours.
  Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factors_;
  int steps_ = 0;
};

}  // namespace

// Contacts begin soft and become hard: at once hard they leave bodies that fall without any slope.
Equilibrium FindEquilibrium(const Scenario& scenario) {
  Balance balance(scenario);
  Vector u = Vector::Zero(balance.size());
  balance.Evaluate(u, 0);
  if (!balance.HoldsAll(u, kBalanced)) {
    Newton newton(balance);
    double softness = 1;
    for (int stage = 0; stage < kStages; ++stage, softness *= kHarder) newton.Solve(softness, u);
    newton.Solve(0, u);
  }
  Equilibrium found{.positions = {}, .unheld = balance.Unheld(u)};
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const int row = balance.row(i);
    found.positions.push_back(scenario.bodies[i].position + (row == kNone ? 0 : u[row]));
  }
  return found;
}

std::vector<int> FindLoose(const Scenario& scenario) {
  const std::vector<Body>& bodies = scenario.bodies;
  const std::size_t ground = bodies.size();
  boost::disjoint_sets_with_storage<> joined(ground + 1);
  const auto place = [&](int body) {
    return body == kNone || bodies[At(body)].fixed ? ground : At(body);
  };
  for (const Support& s : scenario.supports) joined.union_set(place(s.body), place(s.other));
  for (const Contact& c : scenario.contacts) {
    if (InitialGap(scenario, c) < 0) joined.union_set(place(c.left), place(c.right));
  }
  std::vector<int> loose;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool stands = !bodies[i].fixed && bodies[i].velocity == 0;
    if (stands && joined.find_set(i) != joined.find_set(ground)) {
      loose.push_back(static_cast<int>(i));
    }
  }
  return loose;
}

}  // namespace contact
