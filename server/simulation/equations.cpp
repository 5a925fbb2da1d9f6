#include "simulation/equations.h"

#include <algorithm>
#include <limits>

#include "simulation/rows.h"

namespace contact {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

Equations::Equations(const Scenario& scenario)
    : scenario_(scenario),
      bodies_(static_cast<int>(scenario.bodies.size())),
      contacts_(static_cast<int>(scenario.contacts.size())) {
  for (const Body& body : scenario.bodies) {
    base.push_back(body.position);
    inverse_mass_.push_back(body.fixed ? 0 : 1 / body.mass);
  }
  for (const Load& load : scenario.loads) {
    breakpoints_.push_back(load.begin);
    breakpoints_.push_back(load.end);
  }
  std::sort(breakpoints_.begin(), breakpoints_.end());
  SelectLoads(0);
}

double Equations::SelectLoads(double time) {
  acting_.clear();
  for (const Load& load : scenario_.loads) {
    if (load.begin <= time && time < load.end) acting_.push_back(load);
  }
  const auto next = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), time);
  return next == breakpoints_.end() ? std::numeric_limits<double>::infinity() : *next;
}

double Equations::effective_mass(int contact) const {
  const Contact& c = scenario_.contacts[At(contact)];
  return 1 / ((c.left == kNone ? 0 : inverse_mass_[At(c.left)]) +
              (c.right == kNone ? 0 : inverse_mass_[At(c.right)]));
}

double Equations::ForcingTime() const {
  double rate = 0;
  for (const Load& load : acting_) {
    if (load.amplitude != 0) rate = std::max(rate, load.angular_frequency);
  }
  for (const Support& s : scenario_.supports) {
    double w = inverse_mass_[At(s.body)];
    if (s.other != kNone) w += inverse_mass_[At(s.other)];
    rate = std::max({rate, std::sqrt(s.stiffness * w), s.damping * w});
  }
  return rate == 0 ? std::numeric_limits<double>::infinity() : 1 / rate;
}

double Equations::LoadForce(const Load& load, double t) const {
  const double since = t - load.begin;
  double force = load.constant + load.slope * since;
  if (load.amplitude != 0) {
    force += load.amplitude * std::sin(load.angular_frequency * since + load.phase);
  }
  return force;
}

double Equations::SupportForce(const Support& s, const double* u, const double* v) const {
  double x = base[At(s.body)] + u[s.body];
  double rate = v[s.body];
  if (s.other != kNone) {
    x -= base[At(s.other)] + u[s.other];
    rate -= v[s.other];
  }
  return -s.stiffness * (x - s.rest_position) - s.damping * rate;  // (M4)
}

ActiveContact Equations::Activate(int contact, double gap, double mu, int column) const {
  const Contact& c = scenario_.contacts[At(contact)];
  ActiveContact made{.contact = contact, .column = column, .gap = gap, .mu = mu};
  if (c.left == kNone) {
    made.left_counts = 0;
  } else {
    made.left = c.left;
    made.left_inverse = inverse_mass_[At(c.left)];
  }
  if (c.right == kNone) {
    made.right_counts = 0;
  } else {
    made.right = c.right;
    made.right_inverse = inverse_mass_[At(c.right)];
  }
  made.stiffness = c.stiffness;
  made.exponent = c.exponent;
  made.damping_exponent = DampingExponent(c.damping, c.exponent);
  made.clipped = scenario_.solver.clip_tension;
  made.plain = made.exponent == 1.5 && made.damping_exponent == 1.5;
  return made;
}

void Equations::operator()(double t, const double* y, double* dy) const {
  const int n = bodies();
  const int blocks = recording ? 1 : columns + 1;
  for (int i = 0; i < blocks; ++i) {  // u̇ = v, in each block; to the rest is added.
    const double* from = y + i * block() + n;
    double* to = dy + i * block();
    InRows(n, [&](auto rows, std::ptrdiff_t j) { rows(to + j) = rows(from + j); });
    InRows(n + contacts(), [&](auto rows, std::ptrdiff_t j) { rows(to + n + j).setZero(); });
  }
  if (recording) std::fill(dy + block(), dy + size(), 0.0);
  for (const Load& load : acting_) {
    dy[n + load.body] += LoadForce(load, t) * inverse_mass_[At(load.body)];
  }
  if (!scenario_.supports.empty()) AddSupports(y, dy);
  AddContacts(y, dy);
  if (recording) AddRecord(t, y, dy);
}

void Equations::AddSupports(const double* y, double* dy) const {
  const int n = bodies();
  for (const Support& s : scenario_.supports) {
    const auto add = [&](double force, double* a) {
      a[s.body] += force * inverse_mass_[At(s.body)];
      if (s.other != kNone) a[s.other] -= force * inverse_mass_[At(s.other)];
    };
    add(SupportForce(s, y, y + n), dy + n);
    for (int column = 1; !recording && column <= columns; ++column) {  // (S1)
      const double* u = y + column * block();
      const double* v = u + n;
      const double length = u[s.body] - (s.other == kNone ? 0 : u[s.other]);
      const double rate = v[s.body] - (s.other == kNone ? 0 : v[s.other]);
      add(-s.stiffness * length - s.damping * rate, dy + column * block() + n);
    }
  }
}

void Equations::AddContacts(const double* y, double* dy) const {
  const int n = bodies();
  const int sensitive = recording ? 0 : columns;
  for (const ActiveContact& c : active) {
    const double rate = c.Relative(y + n);
    const ActiveContact::Force f = c.At(c.Relative(y) - c.gap, rate);
    dy[n + c.left] -= f.force * c.left_inverse;
    dy[n + c.right] += f.force * c.right_inverse;
    dy[2 * n + c.contact] = f.force * rate;  // (W1)
    // The variational equations (S1): y' = f(y, μ) differentiated by the μ of each column.
    const double* s = y;
    double* ds = dy;
    for (int column = 0; column < sensitive; ++column) {
      s += block();
      ds += block();
      const double rate_s = c.Relative(s + n);
      double force_s = f.by_deformation * c.Relative(s) + f.by_rate * rate_s;
      if (column == c.column) force_s += f.damping;
      ds[n + c.left] -= force_s * c.left_inverse;
      ds[n + c.right] += force_s * c.right_inverse;
      ds[2 * n + c.contact] = force_s * rate + f.force * rate_s;
    }
  }
}

// Quadratures of the ledger and of the run's balances: (W3), (B1), (B2).
void Equations::AddRecord(double t, const double* y, double* dy) const {
  const int n = bodies();
  const double* v = y + n;
  const auto free = [&](int body) { return body != kNone && inverse_mass_[At(body)] != 0; };
  double impulse_rate = 0;  // Internal forces cancel in it, those on fixed bodies do not.
  for (const ActiveContact& c : active) {
    const double rate = c.Relative(v);
    const double force = c.At(c.Relative(y) - c.gap, rate).force;
    const double external = c.Relative(dy + n) / (c.left_inverse + c.right_inverse) + force;
    dy[external_work(c.contact)] = external * rate;  // F_e δ̇
    impulse_rate += force * ((c.right_inverse != 0) - (c.left_inverse != 0));
  }
  for (const Load& load : acting_) {
    const double force = LoadForce(load, t);
    dy[load_work()] += force * v[load.body];
    impulse_rate += force * free(load.body);
  }
  for (const Support& s : scenario_.supports) {
    const double rate = v[s.body] - (s.other == kNone ? 0 : v[s.other]);
    dy[support_loss()] += s.damping * rate * rate;
    impulse_rate += SupportForce(s, y, v) * (free(s.body) - free(s.other));
  }
  dy[impulse()] = impulse_rate;
}

double Equations::Energy(const double* y) const {
  const int n = bodies();
  double energy = 0;
  for (int i = 0; i < n; ++i) {
    if (inverse_mass_[At(i)] != 0) energy += 0.5 * y[n + i] * y[n + i] / inverse_mass_[At(i)];
  }
  for (const Support& s : scenario_.supports) {
    const double x = base[At(s.body)] + y[s.body] -
                     (s.other == kNone ? 0 : base[At(s.other)] + y[s.other]) - s.rest_position;
    energy += 0.5 * s.stiffness * x * x;
  }
  for (const ActiveContact& c : active) {
    energy += ElasticEnergy(scenario_.contacts[At(c.contact)], c.Relative(y) - c.gap);
  }
  return energy;
}

double Equations::Momentum(const double* y) const {
  const int n = bodies();
  double momentum = 0;
  for (int i = 0; i < n; ++i) {
    if (inverse_mass_[At(i)] != 0) momentum += y[n + i] / inverse_mass_[At(i)];
  }
  return momentum;
}

double ElasticEnergy(const Contact& contact, double deformation) {
  const Power p(deformation, contact.exponent);
  return contact.stiffness * p.value * std::max(deformation, 0.0) / (contact.exponent + 1);
}

}  // namespace contact
