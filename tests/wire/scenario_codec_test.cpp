#include "wire/scenario/scenario_codec.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "simulation/model/derived.h"
#include "wire/scenario_builder.h"

namespace contact {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::SizeIs;

TEST(DecodeScenario, FillsEveryDefault) {
  const DecodedScenario decoded = DecodeScenario(TwoBalls());
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  const Scenario& scenario = decoded.scenario;

  EXPECT_THAT(scenario.bodies, SizeIs(2));
  ASSERT_THAT(scenario.contacts, SizeIs(1));
  const Contact& contact = scenario.contacts[0];
  EXPECT_EQ(contact.name, "B1-B2");
  EXPECT_EQ(contact.left, 0);
  EXPECT_EQ(contact.right, 1);
  EXPECT_EQ(contact.exponent, 1.5);
  EXPECT_EQ(contact.damping, DampingLaw::kEnergyRestitution);
  EXPECT_EQ(contact.reference_velocity, 0);
  EXPECT_EQ(scenario.solver.relative_tolerance, 1e-11);
  EXPECT_EQ(scenario.solver.restitution_tolerance, 1e-8);
  EXPECT_EQ(scenario.solver.max_iterations, 50);
  EXPECT_EQ(scenario.solver.restitution_scope, RestitutionScope::kAuto);
  EXPECT_EQ(scenario.solver.encounter_cycles, 8);
  EXPECT_EQ(scenario.solver.settled_fraction, 1e-9);
  EXPECT_EQ(scenario.solver.max_steps, 100'000'000);
  EXPECT_FALSE(scenario.solver.fail_if_not_converged);
  EXPECT_EQ(scenario.end_time, 4e-3);
  EXPECT_EQ(scenario.sample_interval, 4e-6);
}

TEST(DecodeScenario, TakesThePapersProcess) {
  v1::Scenario message = TwoBalls();
  message.mutable_solver()->set_method(v1::Solver::RK4);
  message.mutable_solver()->set_update(v1::Solver::PAPER_RATIO);
  message.mutable_solver()->set_phase_split(v1::Solver::PEAK_FORCE);
  const DecodedScenario decoded = DecodeScenario(message);
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  EXPECT_EQ(decoded.scenario.solver.fixed_step, 1e-6);
  EXPECT_EQ(decoded.scenario.solver.update, UpdateRule::kPaperRatio);
  EXPECT_EQ(decoded.scenario.solver.phase_split, PhaseSplit::kPeakForce);
}

TEST(DecodeScenario, TakesEveryScopeOfTheRestitution) {
  const std::pair<v1::Solver::RestitutionScope, RestitutionScope> scopes[] = {
      {v1::Solver::RESTITUTION_SCOPE_UNSPECIFIED, RestitutionScope::kAuto},
      {v1::Solver::AUTO, RestitutionScope::kAuto},
      {v1::Solver::CYCLE, RestitutionScope::kCycle},
      {v1::Solver::ENCOUNTER, RestitutionScope::kEncounter}};
  for (const auto& [sent, taken] : scopes) {
    v1::Scenario message = TwoBalls();
    message.mutable_solver()->set_restitution_scope(sent);
    EXPECT_EQ(DecodeScenario(message).scenario.solver.restitution_scope, taken);
  }
}

TEST(DecodeScenario, TakesEveryFieldFromTheMessage) {
  const DecodedScenario decoded = DecodeScenario(FromText(R"(
      title: "All of it"
      bodies { name: "a" density_kg_per_m3: 1000 radius_m: 0.1 position_m: -1 velocity_m_per_s: 2 }
      bodies { name: "b" mass_kg: 3 position_m: 5 fixed: true }
      contacts { name: "touch" between: "a" between: "b" stiffness: 7 exponent: 2 damping: MU mu: 9 }
      contacts { name: "floor" between: "a" wall { position_m: -4 side: LEFT } stiffness: 1
                 restitution: 0.5 damping: FLORES reference_velocity_m_per_s: 0.25 }
      supports { body: "a" other: "b" stiffness_n_per_m: 11 damping_n_s_per_m: 12
                 rest_position_m: 13 higher_stiffness: [-18, 19] }
      supports { body: "a" stiffness_n_per_m: 20 rest_position_m: -1 slip_force_n: 21 }
      loads { body: "a" constant { force_n: 14 } }
      loads { body: "a" sine { amplitude_n: 15 angular_frequency_rad_per_s: 16 phase_rad: 17 } }
      loads { body: "a" gravity { acceleration_m_per_s2: 2 } }
      solver { method: ADAPTIVE relative_tolerance: 1e-9 restitution_tolerance: 1e-6
               update: NEWTON_COUPLED phase_split: PEAK_DEFORMATION max_iterations: 20
               tension: CLIP on_not_converged: FAIL settled_fraction: 1e-4 max_steps: 12345
               restitution_scope: ENCOUNTER encounter_cycles: 3 }
      output { sample_interval_s: 0.25 samples_per_contact: 60 }
      end_time_s: 10)"));
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  const Scenario& s = decoded.scenario;
  const double mass = 4.0 / 3.0 * std::numbers::pi * 0.001 * 1000;
  EXPECT_THAT(s.bodies[0].mass, testing::DoubleNear(mass, 1e-12));
  EXPECT_EQ(s.bodies[0].radius, 0.1);
  EXPECT_EQ(s.bodies[0].position, -1);
  EXPECT_EQ(s.bodies[0].velocity, 2);
  EXPECT_TRUE(s.bodies[1].fixed);
  EXPECT_EQ(s.contacts[0].name, "touch");
  EXPECT_EQ(s.contacts[0].exponent, 2);
  EXPECT_EQ(s.contacts[0].damping, DampingLaw::kGiven);
  EXPECT_EQ(s.contacts[0].mu, 9);
  EXPECT_EQ(s.contacts[1].left, kNone);
  EXPECT_EQ(s.contacts[1].right, 0);
  EXPECT_EQ(s.contacts[1].wall_position, -4);
  EXPECT_EQ(s.contacts[1].damping, DampingLaw::kFlores);
  EXPECT_EQ(s.contacts[1].reference_velocity, 0.25);
  EXPECT_EQ(s.supports[0].body, 0);
  EXPECT_EQ(s.supports[0].other, 1);
  EXPECT_EQ(s.supports[0].stiffness, 11);
  EXPECT_EQ(s.supports[0].damping, 12);
  EXPECT_EQ(s.supports[0].rest_position, 13);
  EXPECT_THAT(s.supports[0].higher, testing::ElementsAre(-18, 19));
  EXPECT_TRUE(std::isinf(s.supports[0].slip_force));
  EXPECT_EQ(s.supports[1].slip_force, 21);
  EXPECT_EQ(s.loads[0].constant, 14);
  EXPECT_EQ(s.loads[1].amplitude, 15);
  EXPECT_EQ(s.loads[1].angular_frequency, 16);
  EXPECT_EQ(s.loads[1].phase, 17);
  EXPECT_THAT(s.loads[2].constant, DoubleEq(2 * s.bodies[0].mass));
  EXPECT_EQ(s.solver.relative_tolerance, 1e-9);
  EXPECT_EQ(s.solver.restitution_tolerance, 1e-6);
  EXPECT_EQ(s.solver.max_iterations, 20);
  EXPECT_EQ(s.solver.settled_fraction, 1e-4);
  EXPECT_EQ(s.solver.max_steps, 12345);
  EXPECT_EQ(s.solver.encounter_cycles, 3);
  EXPECT_TRUE(s.solver.fail_if_not_converged);
  EXPECT_TRUE(s.solver.clip_tension);
  EXPECT_EQ(s.sample_interval, 0.25);
  EXPECT_EQ(s.samples_per_contact, 60);
}

void GiveTable(v1::Scenario* message) {
  v1::Contact& contact = *message->mutable_contacts(0);
  contact.clear_stiffness(), contact.clear_restitution();
  contact.set_damping(v1::Contact::FORCE_TABLE);
  v1::ForceTable& table = *contact.mutable_force_table();
  for (const double part : {1, 3})
    table.add_deformations_m(part * 1e-4), table.add_forces_n(part * part);
}

TEST(DecodeScenario, ForceTableIsReadWithItsWayBack) {
  v1::Scenario message = TwoBalls();
  GiveTable(&message);
  const auto read = [&] { return DecodeScenario(message).scenario.contacts.at(0); };
  EXPECT_FALSE(read().table.yields());
  EXPECT_NEAR(read().table.At(2e-4, 0).value, 5, 1e-12);
  EXPECT_NEAR(read().stiffness, 9 / 3e-4, 1e-9);
  EXPECT_EQ(read().exponent, 1);
  message.mutable_contacts(0)->mutable_force_table()->set_unloading_stiffness_n_per_m(5e4);
  message.mutable_contacts(0)->mutable_force_table()->set_unloading_stiffening_per_m(1e3);
  EXPECT_NEAR(read().table.At(2e-4, 3e-4).value, 9 - 5.9e4 * 1e-4, 1e-12);
}

TEST(DecodeScenario, EveryDampingIsRead) {
  const auto& dampings = *google::protobuf::GetEnumDescriptor<v1::Contact::Damping>();
  std::set<DampingLaw> laws;
  for (int i = 0; i < dampings.value_count(); ++i) {
    const auto damping = static_cast<v1::Contact::Damping>(dampings.value(i)->number());
    v1::Scenario message = TwoBalls();
    message.mutable_contacts(0)->set_damping(damping);
    if (damping == v1::Contact::MU) message.mutable_contacts(0)->set_mu(1);
    const bool linear = damping == v1::Contact::KELVIN_VOIGT || damping == v1::Contact::DASHPOT;
    if (linear) message.mutable_contacts(0)->set_exponent(1);
    if (damping == v1::Contact::DASHPOT) message.mutable_contacts(0)->set_damping_n_s_per_m(1);
    if (damping == v1::Contact::FORCE_TABLE) GiveTable(&message);
    EXPECT_THAT(LinesOf(message), IsEmpty());
    laws.insert(DecodeScenario(message).scenario.contacts.at(0).damping);
  }
  EXPECT_THAT(laws, SizeIs(dampings.value_count() - 1)) << "the unspecified one is another";
}

TEST(DecodeScenario, LedgerOnlyRecordsNoTrajectory) {
  v1::Scenario message = TwoBalls();
  message.mutable_output()->set_ledger_only(true);
  EXPECT_EQ(DecodeScenario(message).scenario.sample_interval, 0);
  message.mutable_output()->set_sample_interval_s(1e-5);
  EXPECT_EQ(DecodeScenario(message).scenario.sample_interval, 0);
}

v1::Scenario Chain(int balls) {
  v1::Scenario message = TwoBalls();
  message.clear_bodies();
  message.mutable_contacts(0)->clear_between();
  for (int i = 0; i < balls; ++i) {
    v1::Body& body = *message.add_bodies();
    body.set_name("B" + std::to_string(i + 1));
    body.set_mass_kg(1);
    body.set_position_m(i);
    message.mutable_contacts(0)->add_between(body.name());
  }
  return message;
}

TEST(DecodeScenario, MoreThanTwoNamesMakeAContactOfEachNeighbouringPair) {
  const DecodedScenario decoded = DecodeScenario(Chain(4));
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  EXPECT_THAT(decoded.scenario.contacts,
              ElementsAre(Field(&Contact::name, "B1-B2"), Field(&Contact::name, "B2-B3"),
                          Field(&Contact::name, "B3-B4")));
  EXPECT_EQ(decoded.scenario.contacts[2].left, 2);
  EXPECT_EQ(decoded.scenario.contacts[2].right, 3);
  EXPECT_EQ(decoded.scenario.contacts[2].stiffness, 1e8);
}

TEST(DecodeScenario, NamedChainNumbersItsContacts) {
  v1::Scenario message = Chain(3);
  message.mutable_contacts(0)->set_name("chain");
  EXPECT_THAT(DecodeScenario(message).scenario.contacts,
              ElementsAre(Field(&Contact::name, "chain-1"), Field(&Contact::name, "chain-2")));
}

TEST(DecodeScenario, ContactWithAWallIsCalledAfterBoth) {
  v1::Scenario message = TwoBalls();
  v1::Contact& contact = *message.mutable_contacts(0);
  contact.mutable_between()->RemoveLast();
  contact.mutable_wall()->set_side(v1::Wall::RIGHT);
  contact.mutable_wall()->set_position_m(1);
  const Contact decoded = DecodeScenario(message).scenario.contacts.at(0);
  EXPECT_EQ(decoded.name, "B1-wall");
  EXPECT_EQ(decoded.left, 0);
  EXPECT_EQ(decoded.right, kNone);
  EXPECT_EQ(decoded.wall_position, 1);
}

TEST(DecodeScenario, GravityOfEveryBodyLeavesOutFixedOnes) {
  v1::Scenario message = TwoBalls();
  message.mutable_bodies(1)->set_fixed(true);
  message.add_loads()->mutable_gravity();
  const DecodedScenario decoded = DecodeScenario(message);
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  ASSERT_THAT(decoded.scenario.loads, SizeIs(1));
  EXPECT_EQ(decoded.scenario.loads[0].body, 0);
  EXPECT_THAT(decoded.scenario.loads[0].constant, DoubleEq(-0.5 * 9.80665));
}

TEST(DecodeScenario, LoadsBecomePiecesThatBeginAndEnd) {
  v1::Scenario message = TwoBalls();
  *message.mutable_loads() = FromText(R"(
      loads { body: "B1" step { force_n: 3 start_time_s: 0.5 } }
      loads { body: "B1" rectangular_pulse { force_n: 4 start_time_s: 1 duration_s: 2 } }
      loads { body: "B2" half_sine_pulse { amplitude_n: 5 start_time_s: 1 duration_s: 4 } }
      loads { body: "B2" table { points { time_s: 1 } points { time_s: 3 force_n: 8 }
                                 points { time_s: 4 force_n: 6 } } })")
                                 .loads();
  const DecodedScenario decoded = DecodeScenario(message);
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  const std::vector<Load>& loads = decoded.scenario.loads;
  ASSERT_THAT(loads, SizeIs(5));
  EXPECT_EQ(loads[0].begin, 0.5);
  EXPECT_EQ(loads[0].end, std::numeric_limits<double>::infinity());
  EXPECT_EQ(loads[0].constant, 3);
  EXPECT_EQ(loads[1].begin, 1);
  EXPECT_EQ(loads[1].end, 3);
  EXPECT_EQ(loads[1].constant, 4);
  EXPECT_EQ(loads[2].body, 1);
  EXPECT_EQ(loads[2].end, 5);
  EXPECT_EQ(loads[2].amplitude, 5);
  EXPECT_THAT(loads[2].angular_frequency, DoubleEq(std::numbers::pi / 4));
  EXPECT_EQ(loads[3].constant, 0);
  EXPECT_EQ(loads[3].slope, 4);
  EXPECT_EQ(loads[3].end, 3);
  EXPECT_EQ(loads[4].constant, 8);
  EXPECT_EQ(loads[4].slope, -2);
  EXPECT_EQ(loads[4].end, 4);
}

// Glass, E = 48 GPa, ν = 0.2, R = 10 mm, on itself, on steel, and on a glass wall.
TEST(DecodeScenario, StiffnessFollowsFromMaterials) {
  v1::Scenario message = FromText(R"(
      bodies { name: "A" density_kg_per_m3: 2800 radius_m: 0.01
               material { youngs_modulus_pa: 48e9 poisson_ratio: 0.2 } }
      bodies { name: "B" density_kg_per_m3: 2800 radius_m: 0.01 position_m: 0.02
               material { youngs_modulus_pa: 48e9 poisson_ratio: 0.2 } }
      bodies { name: "C" density_kg_per_m3: 7800 radius_m: 0.02 position_m: 0.05
               material { youngs_modulus_pa: 2.1e11 poisson_ratio: 0.3 } }
      contacts { between: "A" between: "B" between: "C" restitution: 1 }
      contacts { between: "A" restitution: 1
                 wall { side: LEFT position_m: -0.01
                        material { youngs_modulus_pa: 48e9 poisson_ratio: 0.2 } } }
      end_time_s: 1e-4)");
  const DecodedScenario decoded = DecodeScenario(message);
  ASSERT_THAT(Lines(decoded.violations), IsEmpty());
  const double glass = 0.96 / 48e9, steel = 0.91 / 2.1e11;
  const auto& contacts = decoded.scenario.contacts;
  EXPECT_THAT(contacts[0].stiffness, DoubleEq(4.0 / 3 / (2 * glass) * std::sqrt(0.005)));
  EXPECT_THAT(contacts[1].stiffness, DoubleEq(4.0 / 3 / (glass + steel) * std::sqrt(0.02 / 3)));
  EXPECT_THAT(contacts[2].stiffness, DoubleEq(4.0 / 3 / (2 * glass) * std::sqrt(0.01)));
}

TEST(DecodeScenario, FixedBodyNeedsNoMass) {
  v1::Scenario message = TwoBalls();
  message.mutable_bodies(1)->clear_mass_kg();
  message.mutable_bodies(1)->set_fixed(true);
  EXPECT_THAT(LinesOf(message), IsEmpty());
}

TEST(DecodeScenario, RoundOffOfATouchIsNoOverlap) {
  v1::Scenario message = TwoBalls();
  message.mutable_bodies(1)->set_position_m(0.1 - 0.9e-13);
  EXPECT_THAT(LinesOf(message), IsEmpty());
  message.mutable_bodies(1)->set_position_m(0.1 - 1.2e-13);
  EXPECT_THAT(LinesOf(message), SizeIs(1));
}

TEST(DecodeScenario, CountsAreCheckedBeforeAnythingIsAllocated) {
  v1::Scenario message;
  for (int i = 0; i < 1'000'000; ++i) message.add_bodies();
  const DecodedScenario decoded = DecodeScenario(message);
  EXPECT_THAT(Lines(decoded.violations),
              ElementsAre("bodies: holds 1000000; must hold at most 20000"));
  EXPECT_EQ(decoded.scenario.bodies.capacity(), 0U);
}

TEST(DecodeScenario, ExpandedContactsCountAgainstTheLimit) {
  const ScenarioLimits limits{.max_bodies = 10, .max_contacts = 3};
  EXPECT_THAT(DecodeScenario(Chain(4), limits).violations, IsEmpty());
  EXPECT_THAT(Lines(DecodeScenario(Chain(5), limits).violations),
              ElementsAre("contacts: holds 4; must hold at most 3"));
}

TEST(DecodeScenario, SamplesCountAgainstTheLimit) {
  v1::Scenario message = TwoBalls();
  message.set_end_time_s(1);
  message.mutable_output()->set_sample_interval_s(0.25);
  EXPECT_THAT(DecodeScenario(message, {.max_samples = 5}).violations, IsEmpty());
  EXPECT_THAT(Lines(DecodeScenario(message, {.max_samples = 4}).violations),
              ElementsAre("output.sample_interval_s: is 0.25, which makes 5 samples; must make at "
                          "most 4 — set output.ledger_only to record none"));
}

TEST(DecodeScenario, ByDefaultSamplesInContactsAreAsManyAsThoseOfTheInterval) {
  v1::Scenario message = TwoBalls();
  const Scenario s = DecodeScenario(message, {}).scenario;
  EXPECT_EQ(s.samples_per_contact, 20);
  EXPECT_EQ(s.most_contact_samples, 1001);
  EXPECT_FALSE(s.wants_all_contact_samples);
  EXPECT_EQ(DecodeScenario(message, {.max_samples = 1011}).scenario.most_contact_samples, 10);
  for (int i = 2; i < 1000; ++i) *message.add_bodies() = message.bodies(1);
  const double columns = SampleColumns(DecodeScenario(message, {}).scenario);
  EXPECT_EQ(DecodeScenario(message, {}).scenario.most_contact_samples,
            static_cast<std::int64_t>(1e6 / columns));
}

// Rows at extremes: two of each channel in each of 1001 intervals, of 16 columns and more.
TEST(DecodeScenario, ExtremesAreThoseOfAllOrOfForcesOrOfNothingByHowManyNumbersTheyMayMake) {
  v1::Scenario message = TwoBalls();
  EXPECT_EQ(DecodeScenario(message, {}).scenario.turning_channels, 5);
  EXPECT_EQ(DecodeScenario(message, {.max_samples = 20'000}).scenario.turning_channels, 1);
  EXPECT_EQ(DecodeScenario(message, {.max_samples = 1011}).scenario.turning_channels, 0);
  for (int i = 2; i < 20; ++i) *message.add_bodies() = message.bodies(1);
  EXPECT_EQ(DecodeScenario(message, {}).scenario.turning_channels, 1);
  for (int i = 20; i < 200; ++i) *message.add_bodies() = message.bodies(1);
  EXPECT_EQ(DecodeScenario(message, {}).scenario.turning_channels, 0);
}

TEST(DecodeScenario, ExtremesAreNoneWhereNobodyWantsSamplesInContacts) {
  v1::Scenario message = TwoBalls();
  message.mutable_output()->set_samples_per_contact(0);
  EXPECT_EQ(DecodeScenario(message, {}).scenario.turning_channels, 0);
  message.mutable_output()->clear_samples_per_contact();
  message.mutable_output()->set_ledger_only(true);
  EXPECT_EQ(DecodeScenario(message, {}).scenario.turning_channels, 0);
}

TEST(DecodeScenario, SamplesInContactsHaveWhatThoseOfTheIntervalAndExtremesLeaveOfTheLimit) {
  v1::Scenario message = TwoBalls();
  message.set_end_time_s(1);
  message.mutable_output()->set_sample_interval_s(0.25);
  message.mutable_output()->set_samples_per_contact(20);
  const auto most = [&](std::int64_t limit) {
    return DecodeScenario(message, {.max_samples = limit}).scenario.most_contact_samples;
  };
  EXPECT_EQ(most(5), 0);
  EXPECT_EQ(most(100), 95 - 2 * 5);  // 5 of the interval, and at most two of the force in each.
  EXPECT_EQ(most(105), 100 - 2 * 5 * 5);  // Two of all five channels.
  EXPECT_GT(most(std::numeric_limits<std::int64_t>::max()), 1'000'000'000'000);
  message.set_end_time_s(std::nan(""));
  EXPECT_EQ(most(5), 0);
}

TEST(DecodeScenario, AllViolationsComeAtOnceInFieldOrder) {
  v1::Scenario message = TwoBalls();
  message.mutable_bodies(1)->set_mass_kg(-1);
  message.mutable_contacts(0)->set_between(1, "B9");
  message.mutable_contacts(0)->set_restitution(1.2);
  message.add_supports()->set_body("B3");
  message.mutable_solver()->set_max_iterations(0);
  message.clear_end_time_s();
  EXPECT_THAT(LinesOf(message),
              ElementsAre("bodies[1].mass_kg: is -1; must be in (0, 1e12]",
                          "contacts[0].between[1]: is 'B9', which no body is called — did you mean "
                          "'B1'?",
                          "contacts[0].restitution: is 1.2; must be in (0, 1]",
                          "supports[0].body: is 'B3', which no body is called — did you mean 'B1'?",
                          "solver.max_iterations: is 0; must be in [1, 1000]",
                          "end_time_s: is missing; must be in (0, 1e6]"));
}

TEST(DecodeScenario, NotesAtMostAHundredViolations) {
  v1::Scenario message = TwoBalls();
  for (int i = 0; i < 20'000 - 2; ++i) message.add_bodies();
  for (int i = 0; i < 10'000; ++i) message.add_loads()->set_body("nobody");
  EXPECT_THAT(DecodeScenario(message).violations, SizeIs(100));
}

TEST(DecodeScenario, AtEquilibriumBodiesStandWhereLoadsAndContactsBalance) {
  v1::Scenario message = FromText(R"(
      bodies { name: "B1" mass_kg: 2 radius_m: 0.05 position_m: 0.5 }
      contacts { between: "B1" wall { side: LEFT } stiffness: 1e6 exponent: 1 restitution: 0.5 }
      loads { body: "B1" constant { force_n: -30 } }
      start: AT_EQUILIBRIUM
      end_time_s: 1)");
  const DecodedScenario decoded = DecodeScenario(message);
  ASSERT_THAT(LinesOf(message), IsEmpty());
  EXPECT_TRUE(decoded.scenario.starts_at_rest);
  EXPECT_NEAR(decoded.scenario.bodies[0].position, 0.05 - 30e-6, 1e-15);
}

TEST(DecodeScenario, AsGivenBodiesMayOverlap) {
  v1::Scenario message = TwoBalls();
  message.mutable_bodies(1)->set_position_m(message.bodies(0).position_m() + 1e-3);
  EXPECT_THAT(LinesOf(message), Not(IsEmpty()));
  message.set_start(v1::Scenario::AS_GIVEN);
  EXPECT_THAT(LinesOf(message), IsEmpty());
  EXPECT_FALSE(DecodeScenario(message).scenario.starts_at_rest);
}

}  // namespace
}  // namespace contact
