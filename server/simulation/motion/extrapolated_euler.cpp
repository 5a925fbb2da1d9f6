#include "simulation/motion/extrapolated_euler.h"

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "simulation/methods/rows.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// The Chebyshev points of the second kind, at which a polynomial does not swing between: θ of the
// places at which a step is known for Interpolate, its ends with them.
const std::array<double, ExtrapolatedEuler::kNodes + 2> kTheta = [] {
  std::array<double, ExtrapolatedEuler::kNodes + 2> theta{};
  for (std::size_t i = 0; i < theta.size(); ++i) {
    theta[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / (theta.size() - 1));
  }
  return theta;
}();

}  // namespace

void ExtrapolatedEuler::Prepare() {
  linked_.Count();
  const std::vector<Drive>& driving = equations_.driving();
  carriers_.assign(scenario_.bodies.size(), kNone);
  for (std::size_t i = 0; i < driving.size(); ++i) {
    carriers_[At(driving[i].body)] = static_cast<int>(i);
  }
  const auto join = [&](std::ptrdiff_t from, std::ptrdiff_t to, double inverse) {
    if (inverse == 0 || carriers_[At(from)] == kNone || carriers_[At(to)] != kNone) return false;
    carriers_[At(to)] = carriers_[At(from)];
    return true;
  };
  for (bool more = !driving.empty(); more;) {
    more = false;
    for (const LinkedBodies::Link& link : linked_.links()) {
      const std::ptrdiff_t left = linked_.body(link.left), right = linked_.body(link.right);
      more |= join(left, right, link.right_inverse) || join(right, left, link.left_inverse);
    }
  }
}

void ExtrapolatedEuler::Step(const Vector& y0, const Vector& slope0, double time, double h, int k,
                             Vector* y1) {
  table_.resize(y0.size(), k);
  Linearize(y0);
  for (int parts = 1; parts <= k; ++parts) {
    Integrate(y0, slope0, time, h, parts);
    Extrapolate(parts);
  }
  error_ = (table_.col(0) - table_.col(1)) / h;
  *y1 = y0 + table_.col(0);
}

void ExtrapolatedEuler::PrepareInterpolation(const Vector& y0, const Vector& slope0, double time,
                                             double h, int k, const Vector& y1) {
  nodes_.front() = y0;
  for (std::size_t i = 1; i <= kNodes; ++i) Step(y0, slope0, time, h * kTheta[i], k, &nodes_[i]);
  nodes_.back() = y1;
}

// The barycentric formula.
void ExtrapolatedEuler::Interpolate(double theta, Vector* y) const {
  y->setZero(nodes_[0].size());
  double sum = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double distance = theta - kTheta[i];
    if (distance == 0) {
      *y = nodes_[i];
      return;
    }
    const double half = i == 0 || i == nodes_.size() - 1 ? 0.5 : 1;
    const double weight = (i % 2 == 0 ? half : -half) / distance;
    *y += weight * nodes_[i];
    sum += weight;
  }
  *y /= sum;
}

void ExtrapolatedEuler::Linearize(const Vector& y0) {
  laws_.clear();
  for (const ActiveContact& c : equations_.active) {
    const double rate = c.Relative(y0.data() + equations_.bodies());
    const ActiveContact::Force f = c.At(c.Relative(y0.data()) - c.gap, rate);
    laws_.push_back({f.by_deformation, f.by_rate});
  }
  for (std::size_t i = 0; i < scenario_.supports.size(); ++i) {  // (M4)
    const double stretch = equations_.Stretch(i, y0.data());
    laws_.push_back({equations_.SpringOf(i, stretch).slope, scenario_.supports[i].damping});
  }
}

// The motion is kept apart from y0, so that its digits are not lost beside those of y0. Quadratures
// take the slopes at the end of a part: of the forces at its start, strong damping makes of small
// errors of δ̇ large ones, which the part ends.
void ExtrapolatedEuler::Integrate(const Vector& y0, const Vector& slope0, double time, double h,
                                  int parts) {
  const std::ptrdiff_t n = equations_.bodies(), quadratures = y0.size() - 2 * n;
  const double part = h / parts;
  auto moved = table_.col(parts - 1);
  Assemble(part);
  slope_ = slope0;
  y_.resize(2 * n);
  moved.setZero();
  const double *from = y0.data(), *slope = slope_.data();
  double *y = y_.data(), *motion = moved.data();
  for (int i = 1; i <= parts; ++i) {
    // Loads are those at the end of the part, as what answers to them is.
    equations_.AddLoadChange(time + (i - 1) * part, time + i * part, slope_.data() + n);
    Accelerate(part);
    InRows(2 * n, [=](auto rows, std::ptrdiff_t j) { rows(motion + j) += part * rows(slope + j); });
    InRows(n, [=](auto rows, std::ptrdiff_t j) {  // u by v at the end of the part.
      rows(motion + j) += part * part * rows(slope + n + j);
    });
    Carry(time + (i - 1) * part, time + i * part, moved);
    InRows(2 * n,
           [=](auto rows, std::ptrdiff_t j) { rows(y + j) = rows(from + j) + rows(motion + j); });
    equations_(time + i * part, y_.data(), slope_.data());
    InRows(quadratures, [=](auto rows, std::ptrdiff_t j) {
      rows(motion + 2 * n + j) += part * rows(slope + 2 * n + j);
    });
  }
}

// With s of the drive u − s and v − ṡ obey the same equations, but for the acceleration s̈ that
// Accelerate has of the driven body: v' = v + p a' + (Δṡ − p s̈), u' = u + p v' + (Δs − p ṡ), with s̈
// and ṡ at the end of the part.
void ExtrapolatedEuler::Carry(double from, double to, Eigen::Ref<Vector> moved) const {
  const std::vector<Drive>& driving = equations_.driving();
  const double part = to - from;
  for (std::size_t i = 0; i < driving.size(); ++i) {
    const DrivenMotion start = MotionAt(driving[i], from), end = MotionAt(driving[i], to);
    const double speed = end.velocity - start.velocity - part * end.acceleration;
    const double place = Displacement(driving[i], from, to) - part * end.velocity;
    for (std::ptrdiff_t body = 0; body < std::ssize(carriers_); ++body) {
      if (carriers_[At(body)] != static_cast<int>(i)) continue;
      moved[equations_.bodies() + body] += speed;
      moved[body] += part * speed + place;
    }
  }
}

// v' = v + p a' and u' = u + p v', where the forces that make a' are those of u' and v', linear in
// them: (I + p D/m + p² K/m) a' = a − p K v/m.
void ExtrapolatedEuler::Assemble(double part) {
  system_.Resize(linked_.size(), linked_.reach());
  system_.Reset();
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const LinkedBodies::Link& link = linked_.links()[i];
    if (!link.couples) continue;
    const double growth = part * (laws_[i].by_rate + part * laws_[i].by_deformation);
    link.ForEntries([&](std::ptrdiff_t row, std::ptrdiff_t column, double factor) {
      system_.Add(row, column, growth * factor);
    });
  }
  system_.Factor();
}

void ExtrapolatedEuler::Accelerate(double part) {
  double* v = slope_.data();  // u̇ = v
  double* a = v + equations_.bodies();
  sides_.resize(linked_.size());
  for (std::ptrdiff_t i = 0; i < linked_.size(); ++i) sides_[i] = a[linked_.body(i)];
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const LinkedBodies::Link& link = linked_.links()[i];
    if (!link.couples) continue;
    const double rate = link.left_counts * v[linked_.body(link.left)] -
                        link.right_counts * v[linked_.body(link.right)];
    const double force = part * laws_[i].by_deformation * rate;
    sides_[link.left] -= link.left_inverse * force;
    sides_[link.right] += link.right_inverse * force;
  }
  system_.Solve(std::integral_constant<std::ptrdiff_t, 1>(), sides_.data());
  for (std::ptrdiff_t i = 0; i < linked_.size(); ++i) a[linked_.body(i)] = sides_[i];
}

// Neville's scheme on the polynomial in the length of a part, at 0.
void ExtrapolatedEuler::Extrapolate(int parts) {
  for (int m = 1; m < parts; ++m) {
    const auto better = table_.col(parts - m);
    auto last = table_.col(parts - m - 1);
    last = better + (better - last) * (static_cast<double>(parts - m) / m);
  }
}

}  // namespace contact
