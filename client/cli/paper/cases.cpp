#include "cli/paper/cases.h"

#include <fmt/format.h>

namespace contact::cli {
namespace {

constexpr double kMass = 0.5;     // [kg]
constexpr double kRadius = 0.05;  // [m]

v1::Body* AddBall(v1::Scenario* scenario, const std::string& name, double position,
                  double velocity) {
  v1::Body* ball = scenario->add_bodies();
  ball->set_name(name);
  ball->set_mass_kg(kMass);
  ball->set_radius_m(kRadius);
  ball->set_position_m(position);
  ball->set_velocity_m_per_s(velocity);
  return ball;
}

v1::Contact* AddPair(v1::Scenario* scenario, const std::string& left, const std::string& right,
                     double stiffness, double restitution) {
  v1::Contact* contact = scenario->add_contacts();
  contact->set_name(left + "-" + right);
  contact->add_between(left);
  contact->add_between(right);
  contact->set_stiffness(stiffness);
  contact->set_restitution(restitution);
  return contact;
}

v1::Contact* AddWall(v1::Scenario* scenario, const std::string& ball, double position,
                     double stiffness, double restitution) {
  v1::Contact* contact = scenario->add_contacts();
  contact->add_between(ball);
  contact->mutable_wall()->set_position_m(position);
  contact->mutable_wall()->set_side(v1::Wall::RIGHT);
  contact->set_stiffness(stiffness);
  contact->set_restitution(restitution);
  return contact;
}

}  // namespace

v1::Scenario TripleChain(double restitution12, double restitution23, double velocity) {
  v1::Scenario scenario;
  scenario.set_title("Triple-ball chain, paper 6.1");
  AddBall(&scenario, "B1", 0, velocity);
  AddBall(&scenario, "B2", 0.1, 0);
  AddBall(&scenario, "B3", 0.2, 0);
  AddPair(&scenario, "B1", "B2", 1e8, restitution12);
  AddPair(&scenario, "B2", "B3", 1e8, restitution23);
  scenario.set_end_time_s(3e-3);
  scenario.mutable_output()->set_sample_interval_s(5e-6);
  return scenario;
}

v1::Scenario SpringWall() {
  v1::Scenario scenario;
  scenario.set_title("Ball on a spring, paper 6.2");
  AddBall(&scenario, "ball", -0.01, 0);
  AddWall(&scenario, "ball", 0.048, 1.8e7, 0.9)->set_name("ball-wall");
  v1::Support* support = scenario.add_supports();
  support->set_body("ball");
  support->set_stiffness_n_per_m(1e6);
  support->set_damping_n_s_per_m(100);
  v1::Load* constant = scenario.add_loads();
  constant->set_body("ball");
  constant->mutable_constant()->set_force_n(500);
  v1::Load* sine = scenario.add_loads();
  sine->set_body("ball");
  sine->mutable_sine()->set_amplitude_n(250);
  sine->mutable_sine()->set_angular_frequency_rad_per_s(2000);
  scenario.set_end_time_s(0.035);
  scenario.mutable_output()->set_sample_interval_s(1e-5);
  return scenario;
}

v1::Scenario Collisions(const std::vector<double>& restitutions, v1::Contact::Damping damping) {
  v1::Scenario scenario;
  scenario.set_title("Collisions of the paper's section 3");
  for (std::size_t i = 0; i < restitutions.size(); ++i) {
    const std::string ball = fmt::format("ball{}", i);
    const auto place = static_cast<double>(i);
    AddBall(&scenario, ball, place - kRadius, kStudyVelocity);
    v1::Contact* contact = AddWall(&scenario, ball, place, kStudyStiffness, restitutions[i]);
    contact->set_name(fmt::format("{}", i));
    contact->set_damping(damping);
  }
  scenario.set_end_time_s(2e-3);
  RecordLedgerOnly(&scenario);
  return scenario;
}

void SolveAsPaper(v1::Scenario* scenario, v1::Solver::Update update, double tolerance) {
  v1::Solver* solver = scenario->mutable_solver();
  solver->set_method(v1::Solver::RK4);
  solver->set_step_s(1e-6);
  solver->set_update(update);
  solver->set_restitution_tolerance(tolerance);
}

void SplitAtPeakForce(v1::Scenario* scenario) {
  scenario->mutable_solver()->set_phase_split(v1::Solver::PEAK_FORCE);
}

void UseLaw(v1::Scenario* scenario, v1::Contact::Damping damping, double restitution,
            double velocity) {
  for (v1::Contact& contact : *scenario->mutable_contacts()) {
    contact.set_damping(damping);
    contact.set_restitution(restitution);
    contact.set_reference_velocity_m_per_s(velocity);
  }
}

void UseReferenceVelocity(v1::Scenario* scenario, double velocity) {
  for (v1::Contact& contact : *scenario->mutable_contacts()) {
    contact.set_reference_velocity_m_per_s(velocity);
  }
}

void RecordLedgerOnly(v1::Scenario* scenario) {
  scenario->mutable_output()->Clear();
  scenario->mutable_output()->set_ledger_only(true);
}

}  // namespace contact::cli
