#include "simulation/motion/equations.h"

#include <algorithm>
#include <limits>

#include "simulation/methods/rows.h"
#include "simulation/model/contact_spring.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {

ActiveContact::Force ActiveContact::General(double deformation, double rate) const {
  if (table != nullptr) {
    const Power at = table->At(deformation, yield);
    return {at.value, at.slope, 0, 0};
  }
  const Power n(deformation, exponent);
  Power p = n;
  if (damping_exponent != exponent) p = Power(deformation, damping_exponent);
  if (damping_exponent == 0) p.value = 1, p.slope = 0;
  const double force = stiffness * n.value + mu * p.value * rate;
  if (clipped && force < 0) return {};
  return {force, stiffness * n.slope + mu * p.slope * rate, mu * p.value, p.value * rate};
}

Equations::Equations(const Scenario& scenario)
    : StateLayout(static_cast<int>(scenario.bodies.size()),
                  static_cast<int>(scenario.contacts.size())),
      slips(scenario.supports.size()),
      scenario_(scenario),
      loads_(scenario.loads),
      drives_(scenario.drives) {
  std::vector<double> positions;
  for (const Body& body : scenario.bodies) {
    positions.push_back(body.position);
    inverse_mass_.push_back(body.fixed ? 0 : 1 / body.mass);
  }
  Rebase(positions);
  support_rates_.resize(positions.size());
  for (const Support& s : scenario.supports) {
    const double stiffness = StiffnessOf(scenario, s);
    support_rates_[At(s.body)] += stiffness * inverse_mass_[At(s.body)];
    if (s.other != kNone) support_rates_[At(s.other)] += stiffness * inverse_mass_[At(s.other)];
  }
  for (const Contact& c : scenario.contacts) sides_.push_back(SidesOf(c.left, c.right));
  const auto mark = [this](const auto& pieces) {
    for (const auto& piece : pieces) {
      breakpoints_.push_back(piece.begin);
      breakpoints_.push_back(piece.end);
    }
  };
  mark(scenario.loads);
  mark(scenario.drives);
  std::sort(breakpoints_.begin(), breakpoints_.end());
  SelectLoads(0);
}

Sides Equations::SidesOf(int left, int right) const {
  Sides sides;
  if (left != kNone) {
    sides.left = left;
    sides.left_counts = 1;
    sides.left_inverse = inverse_mass_[At(left)];
  }
  if (right != kNone) {
    sides.right = right;
    sides.right_counts = 1;
    sides.right_inverse = inverse_mass_[At(right)];
  }
  return sides;
}

double Equations::SelectLoads(double time, const double* u) {
  const auto select = [time](const auto& pieces, auto* selected) {
    selected->clear();
    for (const auto& row : pieces.rows()) {
      if (const auto* piece = pieces.At(row, time)) selected->push_back(*piece);
    }
  };
  select(loads_, &acting_);
  select(drives_, &driving_);
  selected_ = time;
  driven_from_.clear();
  for (const Drive& drive : driving_) {
    driven_from_.push_back(u == nullptr ? 0 : u[drive.body]);
  }
  const auto next = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), time);
  return next == breakpoints_.end() ? std::numeric_limits<double>::infinity() : *next;
}

double Equations::effective_mass(int contact) const {
  return 1 / (sides(contact).left_inverse + sides(contact).right_inverse);
}

double Equations::ForcingTime() const {
  const double rate = ForcingRate(scenario_, acting_, driving_);
  return rate == 0 ? std::numeric_limits<double>::infinity() : 1 / rate;
}

void Equations::AddLoadChange(double from, double to, double* accelerations) const {
  for (const Load& load : acting_) {
    if (load.slope == 0 && load.amplitude == 0) continue;
    accelerations[load.body] +=
        (LoadForce(load, to) - LoadForce(load, from)) * inverse_mass_[At(load.body)];
  }
  for (const Drive& drive : driving_) {
    accelerations[drive.body] +=
        MotionAt(drive, to).acceleration - MotionAt(drive, from).acceleration;
  }
}

void Equations::PlaceDriven(double t, double* y) const {
  for (std::size_t i = 0; i < driving_.size(); ++i) {
    const Drive& drive = driving_[i];
    y[drive.body] = driven_from_[i] + Displacement(drive, selected_, t);
    y[bodies() + drive.body] = MotionAt(drive, t).velocity;
  }
}

void Equations::Rebase(const std::vector<double>& positions) {
  base_ = positions;
  stretches_.clear();
  for (const Support& s : scenario_.supports) {
    stretches_.push_back(Relative(s, base_.data()) - s.rest_position);
  }
}

ActiveContact Equations::Activate(int contact, double gap, double mu, int column,
                                  double yield) const {
  const Contact& c = scenario_.contacts[At(contact)];
  ActiveContact made{sides(contact)};
  made.contact = contact;
  made.column = column;
  made.gap = gap;
  made.mu = mu;
  if (At(bodies()) <= made.response.size()) {
    made.response[static_cast<std::size_t>(made.left)] -= made.left_inverse;
    made.response[static_cast<std::size_t>(made.right)] += made.right_inverse;
  }
  made.stiffness = c.stiffness;
  made.exponent = c.exponent;
  if (!c.table.empty()) made.table = &c.table;
  made.yield = yield;
  made.damping_exponent = DampingExponent(c.damping, c.exponent);
  made.clipped = scenario_.solver.clip_tension;
  made.plain = made.exponent == 1.5 && made.damping_exponent == 1.5;
  made.outward = (made.right_inverse != 0) - (made.left_inverse != 0);
  return made;
}

template <class Count>
[[gnu::always_inline]] inline void Equations::AddContacts(Count n, const double* y, double* dy,
                                                          double* works, double pace) const {
  double* a = dy + n;
  for (const ActiveContact& c : active) {
    const double rate = c.Relative(y + n);
    const double force = pace * c.ForceAt(c.Relative(y) - c.gap, rate);
    a[c.left] -= force * c.left_inverse;
    a[c.right] += force * c.right_inverse;
    works[c.contact] = force * rate;                    // (W1)
    if (recording) dy[impulse()] += force * c.outward;  // (B2)
  }
}

template <class Count>
[[gnu::always_inline]] inline void Equations::Evaluate(Count n, double t, const double* y,
                                                       double* dy, double pace) const {
  InRows(n, [=](auto rows, std::ptrdiff_t j) {  // u̇ = v; to the rest is added.
    rows(dy + j) = pace * rows(y + n + j);
    rows(dy + n + j).setZero();
  });
  double* works = dy + 2 * n;
  InRows(contacts() + (recording ? contacts() + 3 : 0),
         [=](auto rows, std::ptrdiff_t j) { rows(works + j).setZero(); });
  for (const Load& load : acting_) {
    dy[n + load.body] += pace * LoadForce(load, t) * inverse_mass_[At(load.body)];
  }
  for (const Drive& drive : driving_) {
    dy[n + drive.body] += pace * MotionAt(drive, t).acceleration;
  }
  if (!scenario_.supports.empty()) AddSupports(y, dy, pace);
  AddContacts(n, y, dy, works, pace);
  if (recording) AddRecord(t, y, dy, pace);
}

// The same for a few bodies, all accelerations in registers.
template <std::ptrdiff_t n, std::size_t kCount, bool kWalls>
void Equations::EvaluateFew(const Equations& of, const double* y, double* dy, double pace) {
  const ActiveContact* const contact = of.active.data();
  const auto relative = [](const Sides& sides, const double* of_bodies) {
    return kWalls ? sides.Relative(of_bodies) : of_bodies[sides.left] - of_bodies[sides.right];
  };
  double* work = dy + 2 * n;
  const std::ptrdiff_t works = of.contacts() + (of.recording ? of.contacts() + 3 : 0);
  if (works != kCount) {
    InRows(works, [=](auto rows, std::ptrdiff_t j) { rows(work + j).setZero(); });
  }
  std::array<double, kCount> rate, force;
  for (std::size_t j = 0; j < kCount; ++j) {
    const ActiveContact& c = contact[j];
    rate[j] = relative(c, y + n);
    force[j] = pace * c.Plain(relative(c, y) - c.gap, rate[j]).force;
    work[c.contact] = force[j] * rate[j];  // (W1)
  }
  const auto slope = [&](std::ptrdiff_t i) {
    if (i < n) return pace * y[n + i];
    double sum = force[0] * contact[0].response[static_cast<std::size_t>(i - n)];
    for (std::size_t j = 1; j < kCount; ++j) {
      sum += force[j] * contact[j].response[static_cast<std::size_t>(i - n)];
    }
    return sum;
  };
  // Stored in pairs, as the integrator loads them: else it had to wait for the stores.
  for (std::ptrdiff_t i = 0; i < 2 * n; i += 2) {
    Rows<2>()(dy + i) = Rows<2>::Array(slope(i), slope(i + 1));
  }
  if (!of.recording) return;
  double* const external = dy + of.external_work(0);
  double impulse = 0;
  for (std::size_t j = 0; j < kCount; ++j) {  // There are no loads.
    const ActiveContact& c = contact[j];
    const double net = relative(c, dy + n) / (c.left_inverse + c.right_inverse);
    external[c.contact] = net * rate[j] + force[j] * rate[j];  // (W3)
    impulse += force[j] * c.outward;                           // (B2)
  }
  dy[of.impulse()] = impulse;
}

void Equations::Prepare() {
  few_ = nullptr;
  const bool plain =
      std::ranges::all_of(active, [](const ActiveContact& c) { return c.plain && !c.clipped; });
  const bool driven = !acting_.empty() || !driving_.empty() || !scenario_.supports.empty();
  if (!plain || driven) return;
  const bool walls = std::ranges::any_of(
      active, [](const Sides& s) { return s.left_counts == 0 || s.right_counts == 0; });
  const auto choose = [&]<std::ptrdiff_t n, std::size_t kCount>() {
    few_ = walls ? &Equations::EvaluateFew<n, kCount, true>
                 : &Equations::EvaluateFew<n, kCount, false>;
  };
  if (active.size() == 1) {
    if (bodies() == 1) choose.operator()<1, 1>();
    if (bodies() == 2) choose.operator()<2, 1>();
    if (bodies() == 3) choose.operator()<3, 1>();
  } else if (active.size() == 2) {
    if (bodies() == 2) choose.operator()<2, 2>();
    if (bodies() == 3) choose.operator()<3, 2>();
  }
}

// A driven body is where its motion says, not where the integrator's stages lead it.
void Equations::EvaluateMany(double t, const double* y, double* dy, double pace) const {
  if (!driving_.empty()) {
    placed_.assign(y, y + coupled());
    PlaceDriven(t, placed_.data());
    y = placed_.data();
  }
  WithCount<1, 2, 3, 4, 5>(bodies(), [&](auto n) { Evaluate(n, t, y, dy, pace); });
}

void Equations::AddSupports(const double* y, double* dy, double pace) const {
  const int n = bodies();
  for (std::size_t i = 0; i < scenario_.supports.size(); ++i) {
    const Support& s = scenario_.supports[i];
    const double force = pace * SupportForce(i, y, y + n);
    dy[n + s.body] += force * inverse_mass_[At(s.body)];
    if (s.other != kNone) dy[n + s.other] -= force * inverse_mass_[At(s.other)];
  }
}

// Quadratures of the ledger and of the run's balances: (W3), (B1), (B2).
void Equations::AddRecord(double t, const double* y, double* dy, double pace) const {
  const int n = bodies();
  const double* v = y + n;
  const auto free = [&](int body) { return body != kNone && inverse_mass_[At(body)] != 0; };
  for (const ActiveContact& c : active) {  // F_e δ̇ = (m_e δ̈ + F) δ̇
    const double net = c.Relative(dy + n) / (c.left_inverse + c.right_inverse);
    dy[external_work(c.contact)] = net * c.Relative(v) + dy[work(c.contact)];
  }
  for (const Load& load : acting_) {
    const double force = pace * LoadForce(load, t);
    dy[load_work()] += force * v[load.body];
    dy[impulse()] += force * free(load.body);
  }
  if (!driving_.empty()) AddDriveWork(y, dy, pace);
  for (std::size_t i = 0; i < scenario_.supports.size(); ++i) {
    const Support& s = scenario_.supports[i];
    const double rate = Relative(s, v);
    dy[support_loss()] += pace * s.damping * rate * rate;
    if (slips[i].side != 0) dy[support_loss()] += pace * s.slip_force * slips[i].side * rate;
    dy[impulse()] += pace * SupportForce(i, y, v) * (free(s.body) - free(s.other));
  }
}

// What a driven body is held with against the forces on it does work, (B1).
void Equations::AddDriveWork(const double* y, double* dy, double pace) const {
  const double* v = y + bodies();
  for (const ActiveContact& c : active) {
    const double driven = (c.left_inverse == 0) * c.left_counts * v[c.left] -
                          (c.right_inverse == 0) * c.right_counts * v[c.right];
    if (driven == 0) continue;
    dy[load_work()] += pace * c.ForceAt(c.Relative(y) - c.gap, c.Relative(v)) * driven;
  }
  for (std::size_t i = 0; i < scenario_.supports.size(); ++i) {
    const int other = scenario_.supports[i].other;
    if (other == kNone || inverse_mass_[At(other)] != 0 || v[other] == 0) continue;
    dy[load_work()] += pace * SupportForce(i, y, v) * v[other];
  }
}

double Equations::SupportEnergy(std::size_t support, const double* u) const {
  return SpringOf(support, Stretch(support, u)).energy;
}

double Equations::KineticEnergy(const double* y) const {
  const int n = bodies();
  double energy = 0;
  for (int i = 0; i < n; ++i) {
    if (inverse_mass_[At(i)] != 0) energy += 0.5 * y[n + i] * y[n + i] / inverse_mass_[At(i)];
  }
  return energy;
}

double Equations::ContactEnergy(const double* y) const {
  double energy = 0;
  for (const ActiveContact& c : active) {
    energy += ElasticEnergy(scenario_.contacts[At(c.contact)], c.Relative(y) - c.gap, c.yield);
  }
  return energy;
}

double Equations::Energy(const double* y) const {
  double energy = KineticEnergy(y);
  for (std::size_t i = 0; i < scenario_.supports.size(); ++i) energy += SupportEnergy(i, y);
  return energy + ContactEnergy(y);
}

double Equations::Momentum(const double* y) const {
  const int n = bodies();
  double momentum = 0;
  for (int i = 0; i < n; ++i) {
    if (inverse_mass_[At(i)] != 0) momentum += y[n + i] / inverse_mass_[At(i)];
  }
  return momentum;
}

double Equations::MomentumScale(const double* y) const {
  double sum = 0;
  for (int i = 0; i < bodies(); ++i) {
    if (inverse_mass_[At(i)] != 0) sum += std::abs(y[bodies() + i]) / inverse_mass_[At(i)];
  }
  return sum;
}

}  // namespace contact
