#include "simulation/equations.h"

#include <algorithm>
#include <limits>

namespace contact {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

}  // namespace

Equations::Equations(const Scenario& scenario) : scenario_(scenario) {
  for (const Body& body : scenario.bodies) {
    base.push_back(body.position);
    inverse_mass_.push_back(body.fixed ? 0 : 1 / body.mass);
  }
}

double Equations::effective_mass(int contact) const {
  const Contact& c = scenario_.contacts[At(contact)];
  return 1 / ((c.left == kNone ? 0 : inverse_mass_[At(c.left)]) +
              (c.right == kNone ? 0 : inverse_mass_[At(c.right)]));
}

double Equations::ForcingTime() const {
  double rate = 0;
  for (const Load& load : scenario_.loads) {
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
  double force = load.constant;
  if (load.amplitude != 0) {
    force += load.amplitude * std::sin(load.angular_frequency * t + load.phase);
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

void Equations::operator()(double t, const double* y, double* dy) const {
  const int n = bodies();
  const double* u = y;
  const double* v = y + n;
  double* a = dy + n;
  std::copy(v, v + n, dy);
  std::fill(a, dy + size(), 0.0);
  for (const Load& load : scenario_.loads) {
    a[load.body] += LoadForce(load, t) * inverse_mass_[At(load.body)];
  }
  for (const Support& s : scenario_.supports) {
    const double force = SupportForce(s, u, v);
    a[s.body] += force * inverse_mass_[At(s.body)];
    if (s.other != kNone) a[s.other] -= force * inverse_mass_[At(s.other)];
  }
  AddContactForces(y, dy);
  if (recording) {
    AddRecord(t, y, dy);
  } else {
    for (int column = 0; column < columns; ++column) AddColumn(column, y, dy);
  }
}

void Equations::AddContactForces(const double* y, double* dy) const {
  const int n = bodies();
  double* a = dy + n;
  double* power = dy + 2 * n;
  for (const ActiveContact& active_contact : active) {
    const Contact& c = scenario_.contacts[At(active_contact.contact)];
    const double deformation = Relative(active_contact.contact, y) - active_contact.gap;
    const double rate = Relative(active_contact.contact, y + n);
    const Power p(deformation, c.exponent);
    const double force = p.value * (c.stiffness + active_contact.mu * rate);  // (M2)
    if (c.left != kNone) a[c.left] -= force * inverse_mass_[At(c.left)];
    if (c.right != kNone) a[c.right] += force * inverse_mass_[At(c.right)];
    power[active_contact.contact] = force * rate;  // (W1)
  }
}

// The variational equations (S1): y' = f(y, μ) differentiated by the μ of one cycle.
void Equations::AddColumn(int column, const double* y, double* dy) const {
  const int n = bodies();
  const int offset = (column + 1) * block();
  const double* s = y + offset;
  double* ds = dy + offset;
  double* a = ds + n;
  double* power = ds + 2 * n;
  std::copy(s + n, s + 2 * n, ds);
  for (const Support& support : scenario_.supports) {
    double x = s[support.body];
    double rate = s[n + support.body];
    if (support.other != kNone) {
      x -= s[support.other];
      rate -= s[n + support.other];
    }
    const double force = -support.stiffness * x - support.damping * rate;
    a[support.body] += force * inverse_mass_[At(support.body)];
    if (support.other != kNone) a[support.other] -= force * inverse_mass_[At(support.other)];
  }
  for (const ActiveContact& active_contact : active) {
    const Contact& c = scenario_.contacts[At(active_contact.contact)];
    const double mu = active_contact.mu;
    const double deformation = Relative(active_contact.contact, y) - active_contact.gap;
    const double rate = Relative(active_contact.contact, y + n);
    const Power p(deformation, c.exponent);
    const double own = active_contact.column == column ? p.value * rate : 0;
    const double deformation_s = Relative(active_contact.contact, s);
    const double rate_s = Relative(active_contact.contact, s + n);
    const double force_s =  // dF/dμ
        p.slope * (c.stiffness + mu * rate) * deformation_s + mu * p.value * rate_s + own;
    if (c.left != kNone) a[c.left] -= force_s * inverse_mass_[At(c.left)];
    if (c.right != kNone) a[c.right] += force_s * inverse_mass_[At(c.right)];
    const double force = p.value * (c.stiffness + mu * rate);
    power[active_contact.contact] = force_s * rate + force * rate_s;
  }
}

// Quadratures of the ledger and of the run's balances: (W3), (B1), (B2).
void Equations::AddRecord(double t, const double* y, double* dy) const {
  const int n = bodies();
  const double* v = y + n;
  const auto free = [&](int body) { return body != kNone && inverse_mass_[At(body)] != 0; };
  double impulse_rate = 0;  // Internal forces cancel in it, those on fixed bodies do not.
  for (const ActiveContact& active_contact : active) {
    const Contact& c = scenario_.contacts[At(active_contact.contact)];
    const double deformation = Relative(active_contact.contact, y) - active_contact.gap;
    const double rate = Relative(active_contact.contact, v);
    const double force =
        Power(deformation, c.exponent).value * (c.stiffness + active_contact.mu * rate);
    const double external =
        effective_mass(active_contact.contact) * Relative(active_contact.contact, dy + n) + force;
    dy[external_work(active_contact.contact)] = external * rate;  // F_e δ̇
    impulse_rate += force * (free(c.right) - free(c.left));
  }
  for (const Load& load : scenario_.loads) {
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
  for (const ActiveContact& active_contact : active) {
    const double deformation = Relative(active_contact.contact, y) - active_contact.gap;
    energy += ElasticEnergy(scenario_.contacts[At(active_contact.contact)], deformation);
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
