#include "simulation/motion/tangents.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/methods/rows.h"

namespace contact {
namespace {

constexpr double kOffset = std::numbers::sqrt3 / 6;
// The method of Gauss, of order 4.
constexpr Tangents::Method kGauss = {
    {0.5 - kOffset, 0.5 + kOffset}, {{0.25, 0.25 - kOffset}, {0.25 + kOffset, 0.25}}, {0.5, 0.5}};
// Radau IIA, of order 3: it leaves nothing of what is damped away at once.
constexpr Tangents::Method kRadau = {
    {1.0 / 3, 1}, {{5.0 / 12, -1.0 / 12}, {0.75, 0.25}}, {0.75, 0.25}};
// Damping of a link in a step, by its own masses, from which on Radau takes the place of Gauss,
// which leaves a quarter of what decays to e⁻⁸; and the most that a link swings in a part, after
// which Gauss is late by 1e-3.
constexpr double kDecay = 8, kSwing = 1;

}  // namespace

Tangents::Tangents(const Scenario& scenario, const Equations& equations)
    : scenario_(scenario), equations_(equations), linked_(scenario, equations) {
  Clear();
}

void Tangents::Clear() {
  y_.resize(0, equations_.work(2 * equations_.contacts()) + std::ssize(scenario_.supports));
  remembers_ = false;
}

void Tangents::Add() {
  y_.conservativeResize(count() + 1, Eigen::NoChange);
  y_.bottomRows(1).setZero();
}

void Tangents::Evaluate(const StepTime& step, const std::vector<DeformationPath>& paths,
                        double from, double to) {
  laws_.resize(linked_.links().size());
  for (std::size_t j = 0; j < 2; ++j) {
    const double theta = from + method_->node[j] * (to - from), slow = step.h * step.Rate(theta);
    const double pace = pace_[j] = slow * (to - from);
    const std::size_t contacts = equations_.active.size();
    for (std::size_t i = 0; i < contacts; ++i) {
      const double rate = paths[i].Slope(theta) / slow;
      const ActiveContact& c = equations_.active[i];
      const double deformation = paths[i].Value(theta);
      const ActiveContact::Force f = c.At(deformation, rate);
      Law& law = laws_[i][j];
      law = {pace * f.force, pace * f.by_deformation, pace * f.by_rate, pace * f.damping, rate};
      if (c.table != nullptr) law.by_memory = pace * c.table->ByYield(deformation, c.yield);
    }
    auto stretch = paths.begin() + static_cast<std::ptrdiff_t>(contacts);
    for (std::size_t i = 0; i < scenario_.supports.size(); ++i) {  // (M4)
      const Support& s = scenario_.supports[i];
      const double length = s.higher.empty() ? 0 : (stretch++)->Value(theta);
      const double slope = equations_.SpringOf(i, length).slope;
      laws_[contacts + i][j] = {
          .by_deformation = pace * slope, .by_rate = pace * s.damping, .by_memory = -pace * slope};
    }
  }
}

double Tangents::Plan() {
  double parts = 1;
  bool decays = false;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const double inverse = linked_.links()[i].left_inverse + linked_.links()[i].right_inverse;
    for (std::size_t j = 0; j < 2; ++j) {
      const Law& law = laws_[i][j];
      const double damping = law.by_rate * inverse;
      const double swing = std::sqrt(std::max(0.0, law.by_deformation * inverse * pace_[j]));
      // With so much damping a link does not swing. It creeps.
      const double motion = damping > kDecay ? std::min(swing, swing * swing / damping) : swing;
      parts = std::max(parts, motion / kSwing);
      decays = decays || damping > kDecay;
    }
  }
  if (decays) method_ = &kRadau;
  return std::ceil(parts);
}

// With the stages V_j = v + Σ a_jk A_k and U_j = u + Σ a_jk p_k V_k the force of a link is
// F_j = K_j ΔU_j + D_j ΔV_j, linear in the accelerations A_k of its bodies.
void Tangents::Assemble() {
  system_.Resize(2 * linked_.size(), 2 * linked_.reach() + 1);
  system_.Reset();
  const auto& table = method_->table;
  double lever[2][2];
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t k = 0; k < 2; ++k) {
      lever[j][k] = table[j][0] * pace_[0] * table[0][k] + table[j][1] * pace_[1] * table[1][k];
    }
  }
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const Link& link = linked_.links()[i];
    if (!link.couples) continue;
    double block[2][2];
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t k = 0; k < 2; ++k) {
        block[j][k] = laws_[i][j].by_deformation * lever[j][k] + laws_[i][j].by_rate * table[j][k];
      }
    }
    link.ForEntries([&](std::ptrdiff_t body, std::ptrdiff_t other, double factor) {
      system_.Add(2 * body, 2 * other, factor, block);
    });
  }
  system_.Factor();
}

// (S1): v' = f_u u + f_v v + f_μ at the stages, where u and v would be without accelerations.
template <class Count>
void Tangents::AddForces(Count count) {
  sides_.setZero();
  const std::ptrdiff_t half = count * equations_.bodies();
  double time[2];
  for (std::size_t j = 0; j < 2; ++j) {
    time[j] = method_->table[j][0] * pace_[0] + method_->table[j][1] * pace_[1];
  }
  for (std::size_t l = 0; l < laws_.size(); ++l) {
    const Link link = linked_.links()[l];  // Copies, which no store can change.
    const std::array<Law, 2> laws = laws_[l];
    const double* left = y_.data() + count * linked_.body(link.left);
    const double* right = y_.data() + count * linked_.body(link.right);
    double* a_left = sides_.data() + count * 2 * link.left;
    double* a_right = sides_.data() + count * 2 * link.right;
    InRows(count, [&](auto rows, std::ptrdiff_t i) {
      using Array = typename decltype(rows)::Array;
      const Array deformation =
          link.left_counts * rows(left + i) - link.right_counts * rows(right + i);
      const Array rate =
          link.left_counts * rows(left + half + i) - link.right_counts * rows(right + half + i);
      for (std::size_t j = 0; j < 2; ++j) {
        const double by_rate = laws[j].by_rate + time[j] * laws[j].by_deformation;
        const Array force = laws[j].by_deformation * deformation + by_rate * rate;
        const std::ptrdiff_t stage = count * static_cast<std::ptrdiff_t>(j);
        rows(a_left + stage + i) -= link.left_inverse * force;
        rows(a_right + stage + i) += link.right_inverse * force;
      }
    });
    if (link.column == kNone) continue;
    for (std::size_t j = 0; j < 2; ++j) {
      const std::ptrdiff_t place = count * static_cast<std::ptrdiff_t>(j) + link.column;
      a_left[place] -= link.left_inverse * laws[j].damping;
      a_right[place] += link.right_inverse * laws[j].damping;
    }
  }
}

template <class Count>
void Tangents::Move(Count count) {
  const std::ptrdiff_t half = count * equations_.bodies(), stage_half = count * linked_.size();
  const double *pace = pace_, *weight = method_->weight;
  for (std::ptrdiff_t place = 0; place < linked_.size(); ++place) {
    double* u = y_.data() + count * linked_.body(place);
    double* u1 = at_[0].data() + count * place;
    double* u2 = at_[1].data() + count * place;
    const double* a = sides_.data() + count * 2 * place;
    InRows(count, [&](auto rows, std::ptrdiff_t i) {
      using Array = typename decltype(rows)::Array;
      const Array a1 = rows(a + i), a2 = rows(a + count + i), v = rows(u + half + i);
      const Array v1 = v + method_->table[0][0] * a1 + method_->table[0][1] * a2;
      const Array v2 = v + method_->table[1][0] * a1 + method_->table[1][1] * a2;
      const Array u0 = rows(u + i), d1 = pace[0] * v1, d2 = pace[1] * v2;
      rows(u1 + stage_half + i) = v1, rows(u2 + stage_half + i) = v2;
      rows(u1 + i) = u0 + method_->table[0][0] * d1 + method_->table[0][1] * d2;
      rows(u2 + i) = u0 + method_->table[1][0] * d1 + method_->table[1][1] * d2;
      rows(u + i) = u0 + (weight[0] * d1 + weight[1] * d2);
      rows(u + half + i) = v + (weight[0] * a1 + weight[1] * a2);
    });
  }
}

// To the forces, and to the works of contacts, of which that is all that AddWorks leaves out.
void Tangents::AddMemories() {
  const std::size_t contacts = equations_.active.size();
  for (std::size_t l = 0; l < laws_.size(); ++l) {
    const Link& link = linked_.links()[l];
    const bool of_contact = l < contacts;
    const auto memory =
        Memory(of_contact ? equations_.active[l].contact
                          : equations_.contacts() + static_cast<Eigen::Index>(l - contacts));
    for (std::ptrdiff_t j = 0; j < 2; ++j) {
      const Law& law = laws_[l][static_cast<std::size_t>(j)];
      sides_.col(2 * link.left + j) -= link.left_inverse * law.by_memory * memory;
      sides_.col(2 * link.right + j) += link.right_inverse * law.by_memory * memory;
      if (!of_contact) continue;
      y_.col(equations_.work(equations_.active[l].contact)) +=
          method_->weight[j] * law.rate * law.by_memory * memory;
    }
  }
}

// (S2): W' = F δ̇ differentiated by each μ.
template <class Count>
void Tangents::AddWorks(Count count) {
  const std::ptrdiff_t half = count * linked_.size();
  for (std::size_t l = 0; l < equations_.active.size(); ++l) {
    double* work = y_.data() + count * equations_.work(equations_.active[l].contact);
    const Link link = linked_.links()[l];
    const std::array<Law, 2> laws = laws_[l];
    for (std::size_t j = 0; j < 2; ++j) {
      const Law& law = laws[j];
      const double* left = at_[j].data() + count * link.left;
      const double* right = at_[j].data() + count * link.right;
      const double weight = method_->weight[j];
      const double by_deformation = weight * law.rate * law.by_deformation;
      const double by_rate = weight * (law.rate * law.by_rate + law.force);
      InRows(count, [&](auto rows, std::ptrdiff_t i) {
        rows(work + i) += by_deformation * (link.left_counts * rows(left + i) -
                                            link.right_counts * rows(right + i)) +
                          by_rate * (link.left_counts * rows(left + half + i) -
                                     link.right_counts * rows(right + half + i));
      });
      if (link.column != kNone) work[link.column] += weight * law.rate * law.damping;
    }
  }
}

void Tangents::Follow(const StepTime& step, const std::vector<DeformationPath>& paths, double from,
                      double to) {
  if (count() == 0 || !(to > from)) return;
  method_ = &kGauss;
  Evaluate(step, paths, from, to);
  const double parts = Plan(), length = (to - from) / parts;
  const bool anew = parts > 1 || method_ != &kGauss;
  for (Eigen::ArrayXXd* each : {&sides_, &at_[0], &at_[1]}) {
    each->resize(count(), 2 * linked_.size());
  }
  for (double part = 0; part < parts; ++part) {
    if (anew) Evaluate(step, paths, from + part * length, from + (part + 1) * length);
    Assemble();
    WithCount<1, 2, 3, 4>(count(), [&](auto n) {
      AddForces(n);
      if (remembers_) AddMemories();
      system_.Solve(n, sides_.data());
      Move(n);
      AddWorks(n);
    });
  }
  const double time = step.Offset(to) - step.Offset(from);
  for (int body = 0; body < equations_.bodies(); ++body) {  // Free flight.
    if (linked_.place(body) == kNone) U(body) += time * V(body);
  }
}

// A change of the instant changes nothing in what both remember, for the rate is 0 then.
void Tangents::Stick(std::size_t support, const Sides& sides) {
  Remember(equations_.contacts() + static_cast<Eigen::Index>(support), sides);
}

void Tangents::Yield(int contact, const Sides& sides) { Remember(contact, sides); }

void Tangents::Remember(Eigen::Index link, const Sides& sides) {
  Memory(link) = sides.left_counts * U(sides.left) - sides.right_counts * U(sides.right);
  remembers_ = remembers_ || count() > 0;
}

// A change of the instant, −δ_μ/δ̇, changes the velocities after it.
void Tangents::Jump(const Sides& sides, double growth) {
  const Eigen::ArrayXd late =
      sides.right_counts * U(sides.right) - sides.left_counts * U(sides.left);
  V(sides.left) += growth * sides.left_inverse * late;
  V(sides.right) -= growth * sides.right_inverse * late;
}

}  // namespace contact
