#include "simulation/forecast/first_meeting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/laws/isolated_collision.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// The forces on a body that depend on its position and on time alone.
struct Forces {
  double constant = 0;   // Sum of the constant loads that never end [N].
  double stiffness = 0;  // Sum of the supports to the ground [N/m].
  double rest = 0;       // Force of these supports at x = 0 [N].
  double swinging = 0;   // Sum of the amplitudes of the sines that never end [N].
  double right = 0;      // Largest push to the right of the loads that end [N].
  double left = 0;       // Largest push to the left of the loads that end [N].
  double passing = 0;    // Total duration of the loads that end [s].
  bool linked = false;   // Whether a support ties it to another body, or is not linear.
};

void Add(const Load& load, double end_time, Forces* forces) {
  if (load.begin == 0 && std::isinf(load.end)) {
    forces->constant += load.constant;
    forces->swinging += std::abs(load.amplitude);
    return;
  }
  const double duration = std::min(load.end, end_time) - load.begin;
  if (duration <= 0) return;
  const double last = load.constant + load.slope * duration;
  // A half-sine pulse pushes to one side only.
  const bool half = load.phase == 0 && load.angular_frequency * duration <= std::numbers::pi * 1.01;
  const double up = half ? std::max(0.0, load.amplitude) : std::abs(load.amplitude);
  const double down = half ? std::max(0.0, -load.amplitude) : std::abs(load.amplitude);
  forces->right = std::max(forces->right, std::max(load.constant, last) + up);
  forces->left = std::max(forces->left, down - std::min(load.constant, last));
  forces->passing += duration;
}

std::vector<Forces> ForcesOn(const Scenario& scenario) {
  std::vector<Forces> forces(scenario.bodies.size());
  for (const Load& load : scenario.loads) Add(load, scenario.end_time, &forces[At(load.body)]);
  for (const Support& support : scenario.supports) {
    Forces& own = forces[At(support.body)];
    if (!support.IsLinear()) own.linked = true;
    if (support.other == kNone) {
      own.stiffness += support.stiffness;
      own.rest += support.stiffness * support.rest_position;
    } else {
      own.linked = forces[At(support.other)].linked = true;
    }
  }
  return forces;
}

// The relative motion of the two sides of a contact before they meet, positive toward each other.
// After closing by d the acceleration is `acceleration` − `stiffening` · d.
struct Approach {
  double gap = 0;           // Distance of the two sides at t = 0 [m], ≥ 0.
  double speed = 0;         // Closing speed at t = 0 [m/s].
  double acceleration = 0;  // Closing acceleration at t = 0 [m/s²], without swinging and passing.
  double stiffening = 0;    // k/m of the support of the only side that moves [1/s²].
  double inverse_mass = 0;  // 1/m_e [1/kg].
  double swinging = 0;      // Amplitude of the acceleration by sines that never end [m/s²].
  double passing = 0;       // Largest closing acceleration by loads that end [m/s²].
  double passing_time = 0;  // Total duration of the loads that end [s].
  bool known = true;        // False where the motion depends on other bodies.
};

class Forecast {
 public:
  explicit Forecast(const Scenario& scenario)
      : scenario_(scenario), forces_(ForcesOn(scenario)), turns_(scenario.bodies.size()) {
    for (const Drive& drive : scenario.drives) {
      const bool steady = drive.begin == 0 && std::isinf(drive.end) && drive.amplitude == 0;
      if (!steady) turns_[At(drive.body)] = true;
    }
  }

  std::optional<FirstMeeting> Of(const Contact& contact) const {
    const Approach approach = ApproachOf(contact);
    if (!approach.known) return std::nullopt;
    FirstMeeting meeting{
        .swing = approach.stiffening > 0 ? std::numbers::pi / std::sqrt(approach.stiffening) : 0,
        .driven = approach.swinging > 0};
    if (approach.gap == 0 && approach.speed == 0) return Pressed(contact, approach, meeting);
    return Impact(contact, approach, meeting);
  }

 private:
  // Adds a side that `sign` (1: from the left, −1: from the right) moves to close the contact.
  void AddSide(int index, double sign, Approach* approach) const {
    const Body& body = scenario_.bodies[At(index)];
    if (body.fixed) {  // Of a driven body that changes its velocity nothing is known.
      approach->speed += sign * body.velocity;
      if (turns_[At(index)]) approach->known = false;
      return;
    }
    const Forces& forces = forces_[At(index)];
    approach->speed += sign * body.velocity;
    approach->inverse_mass += 1 / body.mass;
    approach->acceleration +=
        sign * (forces.constant + forces.rest - forces.stiffness * body.position) / body.mass;
    approach->stiffening += forces.stiffness / body.mass;
    approach->swinging += forces.swinging / body.mass;
    approach->passing += (sign > 0 ? forces.right : forces.left) / body.mass;
    approach->passing_time = std::max(approach->passing_time, forces.passing);
    if (forces.linked) approach->known = false;
  }

  Approach ApproachOf(const Contact& contact) const {
    Approach approach{.gap = std::max(0.0, InitialGap(scenario_, contact))};
    if (contact.left != kNone) AddSide(contact.left, 1, &approach);
    if (contact.right != kNone) AddSide(contact.right, -1, &approach);
    // What the supports of two sides that move do depends on how far each of them goes.
    const bool both = Moves(contact.left) && Moves(contact.right);
    if (both && approach.stiffening > 0) approach.known = false;
    return approach;
  }

  bool Moves(int index) const { return index != kNone && !scenario_.bodies[At(index)].fixed; }

  std::optional<FirstMeeting> Pressed(const Contact& contact, const Approach& approach,
                                      FirstMeeting meeting) const {
    const double steady = approach.acceleration + approach.swinging;
    const double most = approach.acceleration + std::max(approach.swinging, approach.passing);
    if (most <= 0) return std::nullopt;
    meeting.push = approach.acceleration;
    meeting.duration = SwingPeriod(1 / approach.inverse_mass, most / approach.inverse_mass,
                                   contact.stiffness, contact.exponent);
    meeting.deformation = Depth(contact, 0, most / approach.inverse_mass);
    meeting.pressed = steady > 0 ? scenario_.end_time : approach.passing_time;
    return meeting;
  }

  // The speed of impact from the energy gained while the gap closes. Sides that move apart meet
  // only if an acceleration draws them back.
  std::optional<FirstMeeting> Impact(const Contact& contact, const Approach& approach,
                                     FirstMeeting meeting) const {
    const double w = approach.speed;
    if (w <= 0 && approach.acceleration <= 0) return std::nullopt;
    const double squared = w * w + 2 * approach.acceleration * approach.gap -
                           approach.stiffening * approach.gap * approach.gap;
    if (!(squared > 0)) return std::nullopt;
    meeting.speed = std::sqrt(squared);
    meeting.start = w > 0 ? 2 * approach.gap / (w + meeting.speed)
                          : (meeting.speed - w) / approach.acceleration;
    if (!(meeting.start < scenario_.end_time)) return std::nullopt;
    meeting.push = approach.acceleration - approach.stiffening * approach.gap;
    meeting.duration = ImpactDuration(1 / approach.inverse_mass, meeting.speed, contact.stiffness,
                                      contact.exponent);
    const double load = std::max(0.0, meeting.push) / approach.inverse_mass;
    meeting.deformation =
        Depth(contact, ImpactEnergy(contact, 1 / approach.inverse_mass, meeting.speed), load);
    return meeting;
  }

  static double Depth(const Contact& contact, double energy, double load) {
    return contact.table.empty()
               ? PressedDeformation(energy, load, contact.stiffness, contact.exponent)
               : contact.table.DepthOf(energy, load);
  }

  // The part of an impact's energy that compresses; all of it where no α of the law is known [J].
  static double ImpactEnergy(const Contact& contact, double effective_mass, double speed) {
    const bool known = RowOf(contact.damping).scale == DampingScale::kVelocity;
    const double alpha = known ? DampingCoefficient(contact.damping, contact.restitution) : 0;
    if (!contact.table.empty()) return 0.5 * effective_mass * speed * speed;
    const double deformation =
        MaximumDeformation(effective_mass, speed, contact.stiffness, contact.exponent, alpha);
    return ElasticEnergy(contact.stiffness, contact.exponent, deformation);
  }

  const Scenario& scenario_;
  const std::vector<Forces> forces_;
  std::vector<bool> turns_;  // Whether a driven body changes its velocity.
};

}  // namespace

double ImpactDuration(double effective_mass, double speed, double stiffness, double exponent) {
  const double share = 1 / (exponent + 1);
  const double deformation = MaximumDeformation(effective_mass, speed, stiffness, exponent, 0);
  return 2 * deformation / speed * std::sqrt(std::numbers::pi) * std::tgamma(1 + share) /
         std::tgamma(0.5 + share);
}

double PressedDeformation(double energy, double force, double stiffness, double exponent) {
  const double power = exponent + 1;
  // What either of the two does alone adds up to more than both do, from where Newton's steps on
  // this convex function fall.
  double deformation = std::pow(power * energy / stiffness, 1 / power) +
                       std::pow(power * force / stiffness, 1 / exponent);
  for (int i = 0; i < 20; ++i) {  // Six are enough for round-off.
    const double spring = stiffness * std::pow(deformation, exponent);
    deformation -= (spring * deformation / power - force * deformation - energy) / (spring - force);
  }
  return deformation;
}

double SwingPeriod(double effective_mass, double force, double stiffness, double exponent) {
  const double deformation = std::pow(force / stiffness, 1 / exponent);
  return 2 * std::numbers::pi * std::sqrt(effective_mass * deformation / (exponent * force));
}

std::vector<std::optional<FirstMeeting>> ForecastFirstMeetings(const Scenario& scenario) {
  const Forecast forecast(scenario);
  std::vector<std::optional<FirstMeeting>> meetings;
  meetings.reserve(scenario.contacts.size());
  for (const Contact& contact : scenario.contacts) meetings.push_back(forecast.Of(contact));
  return meetings;
}

}  // namespace contact
