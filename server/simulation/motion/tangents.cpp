#include "simulation/motion/tangents.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/motion/rows.h"

namespace contact {
namespace {

// Damping and swing of a link in a part of a step, by its own masses: the classical method is
// stable up to 2.7, and in a row a mode decays twice as fast as a link. With a swing of 0.5 it errs
// by 3e-4.
constexpr double kDecay = 1, kSwing = 0.5;

std::size_t At(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace

Tangents::Tangents(const Scenario& scenario, const Equations& equations)
    : scenario_(scenario), equations_(equations), place_(scenario.bodies.size(), kNone) {
  Clear();
}

void Tangents::Clear() {
  u_.resize(0, equations_.bodies());
  v_.resize(0, equations_.bodies());
  work_.resize(0, equations_.contacts());
}

void Tangents::Add() {
  for (Eigen::ArrayXXd* all : {&u_, &v_, &work_}) {
    all->conservativeResize(all->rows() + 1, Eigen::NoChange);
    all->bottomRows(1).setZero();
  }
}

std::ptrdiff_t Tangents::PlaceOf(std::ptrdiff_t body) {
  if (place_[At(body)] == kNone) {
    place_[At(body)] = std::ssize(moved_);
    moved_.push_back(body);
  }
  return place_[At(body)];
}

void Tangents::Connect(const Sides& sides, int column) {
  Link& link = links_.emplace_back(Link{sides, column});
  link.left = PlaceOf(sides.left);
  link.right = PlaceOf(sides.right);
}

void Tangents::Prepare() {
  links_.clear();
  moved_.clear();
  std::ranges::fill(place_, kNone);
  for (const ActiveContact& contact : equations_.active) Connect(contact, contact.column);
  for (const Support& support : scenario_.supports) {
    Connect(equations_.SidesOf(support.body, support.other), kNone);
  }
}

void Tangents::Gather() {
  const auto bodies = std::ssize(moved_);
  x_.resize(count(), 2 * bodies + std::ssize(equations_.active));
  for (std::ptrdiff_t i = 0; i < bodies; ++i) {
    x_.col(i) = u_.col(moved_[At(i)]);
    x_.col(bodies + i) = v_.col(moved_[At(i)]);
  }
  std::ptrdiff_t place = 2 * bodies;
  for (const ActiveContact& c : equations_.active) x_.col(place++) = work_.col(c.contact);
  for (Eigen::ArrayXXd* like : {&slope_, &sum_, &stage_}) like->resize(x_.rows(), x_.cols());
}

void Tangents::Scatter() {
  const auto bodies = std::ssize(moved_);
  for (std::ptrdiff_t i = 0; i < bodies; ++i) {
    u_.col(moved_[At(i)]) = x_.col(i);
    v_.col(moved_[At(i)]) = x_.col(bodies + i);
  }
  std::ptrdiff_t place = 2 * bodies;
  for (const ActiveContact& c : equations_.active) work_.col(c.contact) = x_.col(place++);
}

void Tangents::Evaluate(const StepTime& step, const std::vector<DeformationPath>& paths,
                        double theta, std::vector<Law>* laws) const {
  const double pace = step.h * step.Rate(theta);
  laws->clear();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const double rate = pace > 0 ? paths[i].Slope(theta) / pace : 0;
    const ActiveContact::Force f = equations_.active[i].At(paths[i].Value(theta), rate);
    laws->push_back(
        {pace * f.force, pace * f.by_deformation, pace * f.by_rate, pace * f.damping, rate});
  }
  for (const Support& s : scenario_.supports) {  // (M4)
    laws->push_back({.by_deformation = pace * s.stiffness, .by_rate = pace * s.damping});
  }
}

double Tangents::Parts(const std::vector<Law>& laws, double pace, double length) const {
  double parts = 1;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double inverse = links_[i].left_inverse + links_[i].right_inverse;
    const double decay = laws[i].by_rate * inverse * length;
    const double swing = std::sqrt(std::max(0.0, laws[i].by_deformation * inverse * pace)) * length;
    parts = std::max({parts, decay / kDecay, swing / kSwing});
  }
  return std::ceil(parts);
}

// (S1) and (S2): y' = f(y, μ) differentiated by each μ.
template <class Count>
void Tangents::Slopes(Count count, const std::vector<Law>& laws, double pace, const double* x,
                      double* dx) const {
  const std::ptrdiff_t half = count * std::ssize(moved_);
  for (std::ptrdiff_t i = 0; i < half; ++i) dx[i] = pace * x[half + i];
  std::fill_n(dx + half, half, 0.0);
  const std::size_t contacts = equations_.active.size();
  double* work = dx + 2 * half;
  for (std::size_t j = 0; j < laws.size(); ++j) {
    const Link link = links_[j];  // Copies, which no store to dx can change.
    const Law law = laws[j];
    const double* left = x + count * link.left;
    const double* right = x + count * link.right;
    double* a_left = dx + half + count * link.left;
    double* a_right = dx + half + count * link.right;
    InRows(count, [&](auto rows, std::ptrdiff_t i) {
      using Array = typename decltype(rows)::Array;
      const Array deformation =
          link.left_counts * rows(left + i) - link.right_counts * rows(right + i);
      const Array rate =
          link.left_counts * rows(left + half + i) - link.right_counts * rows(right + half + i);
      const Array force = law.by_deformation * deformation + law.by_rate * rate;
      rows(a_left + i) -= link.left_inverse * force;
      rows(a_right + i) += link.right_inverse * force;
      if (j < contacts) rows(work + i) = law.rate * force + law.force * rate;
    });
    if (j >= contacts) continue;
    if (link.column != kNone) {
      a_left[link.column] -= link.left_inverse * law.damping;
      a_right[link.column] += link.right_inverse * law.damping;
      work[link.column] += law.rate * law.damping;
    }
    work += count;
  }
}

template <class Count>
void Tangents::Step(Count count, const double (&pace)[3], double length) {
  const std::ptrdiff_t coupled = count * 2 * std::ssize(moved_), all = x_.size();
  double* x = x_.data();
  double* slope = slope_.data();
  double* sum = sum_.data();
  double* stage = stage_.data();
  const auto next = [&](double part) {
    for (std::ptrdiff_t i = 0; i < coupled; ++i) stage[i] = x[i] + part * slope[i];
  };
  const auto add = [&](double weight) {
    for (std::ptrdiff_t i = 0; i < all; ++i) sum[i] += weight * slope[i];
  };
  Slopes(count, laws_[0], pace[0], x, slope);
  std::copy_n(slope, all, sum);
  next(length / 2);
  Slopes(count, laws_[1], pace[1], stage, slope);
  add(2);
  next(length / 2);
  Slopes(count, laws_[1], pace[1], stage, slope);
  add(2);
  next(length);
  Slopes(count, laws_[2], pace[2], stage, slope);
  for (std::ptrdiff_t i = 0; i < all; ++i) x[i] += length / 6 * (sum[i] + slope[i]);
}

void Tangents::Follow(const StepTime& step, const std::vector<DeformationPath>& paths, double from,
                      double to) {
  if (count() == 0 || !(to > from)) return;
  const auto pace = [&](double theta) { return step.h * step.Rate(theta); };
  for (int i = 0; i < 3; ++i) Evaluate(step, paths, from + (to - from) * i / 2, &laws_[i]);
  double parts = 1;
  for (int i = 0; i < 3; ++i) {
    parts = std::max(parts, Parts(laws_[i], pace(from + (to - from) * i / 2), to - from));
  }
  Gather();
  const double length = (to - from) / parts;
  for (double part = 0; part < parts; ++part) {
    const double begin = from + part * length, end = begin + length;
    if (part > 0) std::swap(laws_[0], laws_[2]);
    if (parts > 1) {
      Evaluate(step, paths, begin + length / 2, &laws_[1]);
      Evaluate(step, paths, end, &laws_[2]);
    }
    const double paces[3] = {pace(begin), pace(begin + length / 2), pace(end)};
    WithCount<1, 2, 3, 4>(count(), [&](auto n) { Step(n, paces, length); });
  }
  const double time = step.Offset(to) - step.Offset(from);
  for (std::size_t body = 0; body < place_.size(); ++body) {  // Free flight.
    const auto i = static_cast<Eigen::Index>(body);
    if (place_[body] == kNone) u_.col(i) += time * v_.col(i);
  }
  Scatter();
}

// A change of the instant, −δ_μ/δ̇, changes the velocities after it.
void Tangents::Jump(const Sides& sides, double growth) {
  const Eigen::ArrayXd late =
      sides.right_counts * u_.col(sides.right) - sides.left_counts * u_.col(sides.left);
  v_.col(sides.left) += growth * sides.left_inverse * late;
  v_.col(sides.right) -= growth * sides.right_inverse * late;
}

}  // namespace contact
