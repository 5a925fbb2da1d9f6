#include "wire/scenario_advice.h"

#include <gmock/gmock.h>

#include <cmath>

#include "simulation/forecast/first_meeting.h"
#include "wire/scenario_builder.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> AdviceOn(const v1::Scenario& message) {
  const DecodedScenario decoded = DecodeScenario(message);
  EXPECT_THAT(Lines(decoded.violations), IsEmpty());
  return Lines(Advise(message, decoded.scenario));
}

std::optional<FirstMeeting> FirstMeetingOf(const v1::Scenario& message) {
  return ForecastFirstMeetings(DecodeScenario(message).scenario).front();
}

v1::Scenario FallingBall() {
  return FromText(R"(
      bodies { name: "ball" mass_kg: 0.5 radius_m: 0.05 position_m: 1 }
      contacts { between: "ball" wall { side: LEFT } stiffness: 1e8 restitution: 0.8 }
      loads { gravity { acceleration_m_per_s2: -9.81 } }
      output { sample_interval_s: 5e-5 }
      end_time_s: 3)");
}

v1::Scenario PressedTooth() {
  return FromText(R"(
      bodies { name: "tooth" mass_kg: 0.2 }
      contacts { between: "tooth" wall { side: RIGHT } stiffness: 1e8 restitution: 0.6 }
      loads { body: "tooth" constant { force_n: 200 } }
      end_time_s: 0.01)");
}

TEST(Advice, TellsWhatCouldStandElsewhereAtEquilibrium) {
  v1::Scenario message = PressedTooth();
  message.set_start(v1::Scenario::AT_EQUILIBRIUM);
  EXPECT_THAT(AdviceOn(message), IsEmpty());
  for (const char* name : {"idle", "other"}) {
    v1::Body& body = *message.add_bodies();
    body.set_name(name), body.set_mass_kg(1), body.set_position_m(-1 - message.bodies_size());
  }
  EXPECT_THAT(
      AdviceOn(message),
      ElementsAre("start: is AT_EQUILIBRIUM, which holds idle and 1 more at no one place: it "
                  "rests near where it was given — a support, or a contact that a load "
                  "presses, fixes the place"));
}

TEST(FirstMeeting, DurationOfAnImpactIsThatOfHertz) {
  const double mass = 2800 * 4 / 3.0 * M_PI * 1e-6 / 2;
  const double modulus = 48e9 / (1 - 0.04) / 2;
  EXPECT_NEAR(ImpactDuration(mass, 20, 4 / 3.0 * modulus * std::sqrt(0.005), 1.5), 40.33946e-6,
              1e-10);
}

TEST(FirstMeeting, DurationOfALinearImpactIsHalfAPeriodWhateverTheSpeed) {
  for (const double speed : {0.1, 10.0}) {
    EXPECT_NEAR(ImpactDuration(0.5, speed, 2e6, 1), M_PI * std::sqrt(0.5 / 2e6), 1e-12);
  }
}

TEST(FirstMeeting, SwingAboutALoadOfALinearContactIsItsPeriod) {
  EXPECT_NEAR(SwingPeriod(0.5, 30, 2e6, 1), 2 * M_PI * std::sqrt(0.5 / 2e6), 1e-12);
}

TEST(FirstMeeting, DeformationUnderALoadIsThatOfItsEnergyOrTwiceThatOfRest) {
  EXPECT_NEAR(PressedDeformation(2, 0, 1e6, 1), std::sqrt(2 * 2 / 1e6), 1e-15);
  EXPECT_NEAR(PressedDeformation(0, 30, 1e6, 1), 2 * 30 / 1e6, 1e-17);
  EXPECT_NEAR(PressedDeformation(0, 30, 1e6, 3), std::cbrt(4 * 30 / 1e6), 1e-15);
  const double both = PressedDeformation(2, 30, 1e6, 1.5);
  EXPECT_NEAR(1e6 * std::pow(both, 2.5) / 2.5, 2 + 30 * both, 1e-12);
}

TEST(FirstMeeting, DeformationIsLessWhereDampingTakesEnergy) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_contacts(0)->set_restitution(1);
  const double elastic = FirstMeetingOf(scenario)->deformation;
  EXPECT_NEAR(elastic, std::pow(2.5 / 2 * 0.25 * 0.04 / 1e8, 0.4), 1e-12);
  scenario.mutable_contacts(0)->set_restitution(0.5);
  EXPECT_LT(FirstMeetingOf(scenario)->deformation, 0.9 * elastic);
}

TEST(FirstMeeting, OfAFallingBallIsKnown) {
  const auto meeting = FirstMeetingOf(FallingBall());
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->speed, std::sqrt(2 * 9.81 * 0.95), 1e-12);
  EXPECT_NEAR(meeting->start, std::sqrt(2 * 0.95 / 9.81), 1e-12);
}

TEST(FirstMeeting, OfABallThrownUpIsThatOfItsFall) {
  v1::Scenario scenario = FallingBall();
  scenario.mutable_bodies(0)->set_velocity_m_per_s(2);
  const auto meeting = FirstMeetingOf(scenario);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->speed, std::sqrt(4 + 2 * 9.81 * 0.95), 1e-12);
  EXPECT_NEAR(meeting->start, (meeting->speed + 2) / 9.81, 1e-12);
}

TEST(FirstMeeting, OfABallOnASpringHasTheEnergyOfTheSpring) {
  const auto meeting = FirstMeetingOf(FromText(R"(
      bodies { name: "ball" mass_kg: 0.5 position_m: -0.01 }
      contacts { between: "ball" wall { side: RIGHT } stiffness: 1e8 restitution: 0.8 }
      supports { body: "ball" stiffness_n_per_m: 1e6 }
      end_time_s: 1)"));
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->speed, 0.01 * std::sqrt(1e6 / 0.5), 1e-9);
}

TEST(FirstMeeting, OfBodiesThatOnlyAnotherContactMovesIsNotGuessedAt) {
  v1::Scenario row = TwoBalls();
  *row.add_bodies() =
      FromText(R"(bodies { name: "B3" mass_kg: 0.5 radius_m: 0.05 position_m: 0.2 })").bodies(0);
  row.mutable_contacts(0)->add_between("B3");
  const auto meetings = ForecastFirstMeetings(DecodeScenario(row).scenario);
  ASSERT_EQ(meetings.size(), 2u);
  EXPECT_TRUE(meetings[0]);
  EXPECT_FALSE(meetings[1]);
}

TEST(FirstMeeting, OfAPulseIsOnTheSideToWhichItPushes) {
  v1::Scenario scenario = PressedTooth();
  v1::Load::HalfSinePulse& pulse = *scenario.mutable_loads(0)->mutable_half_sine_pulse();
  pulse.set_amplitude_n(800);
  pulse.set_start_time_s(1e-3);
  pulse.set_duration_s(4e-3);
  const auto meeting = FirstMeetingOf(scenario);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->speed, 0);
  EXPECT_NEAR(meeting->pressed, 4e-3, 1e-12);
  pulse.set_amplitude_n(-800);
  EXPECT_FALSE(FirstMeetingOf(scenario));
}

TEST(FirstMeeting, AfterTheEndIsNone) {
  v1::Scenario scenario = FallingBall();
  scenario.set_end_time_s(0.4);
  EXPECT_FALSE(FirstMeetingOf(scenario));
  scenario.set_end_time_s(0.5);
  EXPECT_TRUE(FirstMeetingOf(scenario));
}

TEST(ScenarioAdvice, IsNoneForAScenarioThatShowsItsContacts) {
  EXPECT_THAT(AdviceOn(TwoBalls()), IsEmpty());
  EXPECT_THAT(AdviceOn(FallingBall()), IsEmpty());
  EXPECT_THAT(AdviceOn(PressedTooth()), IsEmpty());
}

TEST(ScenarioAdvice, TellsOfAStepTooLongForAContact) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_solver()->set_method(v1::Solver::RK4);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
  scenario.mutable_solver()->set_step_s(1e-5);
  EXPECT_THAT(AdviceOn(scenario),
              ElementsAre("solver.step_s: gives a contact of B1-B2 161 steps; it lasts about "
                          "0.0016 s at 0.2 m/s — 8e-06 gives it 200"));
}

TEST(ScenarioAdvice, TellsOfAStepTooLongForASwingUnderALoad) {
  v1::Scenario scenario = PressedTooth();
  scenario.mutable_solver()->set_method(v1::Solver::RK4);
  scenario.mutable_solver()->set_step_s(2e-5);
  EXPECT_THAT(AdviceOn(scenario), ElementsAre(HasSubstr("under its load")));
}

TEST(ScenarioAdvice, TellsOfSamplesTooFewForAContact) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_output()->set_sample_interval_s(1e-4);
  scenario.mutable_output()->set_samples_per_contact(0);
  EXPECT_THAT(AdviceOn(scenario),
              ElementsAre("output.sample_interval_s: gives a contact of B1-B2 16.1 samples; it "
                          "lasts about 0.0016 s at 0.2 m/s — 8e-06 gives it 200"));
  scenario.mutable_output()->set_ledger_only(true);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
}

TEST(ScenarioAdvice, AsksNobodyToRecordMillionsOfSamples) {
  v1::Scenario scenario = TwoBalls();
  scenario.set_end_time_s(1000);
  scenario.mutable_output()->set_samples_per_contact(0);
  EXPECT_THAT(AdviceOn(scenario), ElementsAre(HasSubstr("or output.ledger_only")));
}

TEST(ScenarioAdvice, SamplesOfItsOwnAreEnoughForAContact) {
  v1::Scenario scenario = TwoBalls();
  scenario.set_end_time_s(1000);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
  scenario.mutable_output()->set_samples_per_contact(19);
  EXPECT_THAT(AdviceOn(scenario), ElementsAre(HasSubstr("set output.samples_per_contact")));
  scenario.mutable_output()->set_samples_per_contact(20);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
}

TEST(ScenarioAdvice, TellsOfMoreStepsThanTheRunMayMake) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_solver()->set_method(v1::Solver::RK4);
  scenario.mutable_output()->set_ledger_only(true);
  scenario.set_end_time_s(200);
  EXPECT_THAT(AdviceOn(scenario), ElementsAre(HasSubstr("makes 2e+08 steps, more than max_steps")));
  scenario.mutable_solver()->set_max_steps(1'000'000'000'000);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
  scenario.set_end_time_s(2000);
  EXPECT_THAT(AdviceOn(scenario), ElementsAre(HasSubstr("makes 2e+09 steps")));
}

TEST(ScenarioAdvice, TellsOfALawThatMissesALowRestitution) {
  v1::Scenario scenario = TwoBalls();
  v1::Contact& contact = *scenario.mutable_contacts(0);
  contact.set_restitution(0.2);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());  // Iterated: nothing is lost.
  contact.set_damping(v1::Contact::EXACT);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
  contact.set_damping(v1::Contact::PAPER_EQ23);
  EXPECT_THAT(AdviceOn(scenario),
              ElementsAre("contacts[0].restitution: is 0.2; with PAPER_EQ23 an isolated collision "
                          "has 0.1960 — ENERGY_RESTITUTION and EXACT deliver what is asked for"));
  contact.set_restitution(0.5);
  contact.set_damping(v1::Contact::HUNT_CROSSLEY);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());  // The run tells of it.
}

TEST(ScenarioAdvice, TellsThatThePapersProcessOftenFailsForLowRestitution) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_solver()->set_update(v1::Solver::PAPER_RATIO);
  scenario.mutable_contacts(0)->set_restitution(0.2);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());  // Alone it converges.
  *scenario.add_bodies() =
      FromText(R"(bodies { name: "B3" mass_kg: 0.5 radius_m: 0.05 position_m: 0.2 })").bodies(0);
  scenario.mutable_contacts(0)->add_between("B3");
  EXPECT_THAT(
      AdviceOn(scenario),
      ElementsAre(HasSubstr("solver.update: is PAPER_RATIO, which often does not converge")));
}

TEST(ScenarioAdvice, TellsWhereOneFactorACycleMayNotBeEnough) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_solver()->set_restitution_scope(v1::Solver::CYCLE);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());  // Nothing pushes the balls together again.
  scenario = PressedTooth();
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
  scenario.mutable_solver()->set_restitution_scope(v1::Solver::CYCLE);
  EXPECT_THAT(AdviceOn(scenario), ElementsAre(HasSubstr("solver.restitution_scope: is CYCLE; ")));
  scenario.mutable_contacts(0)->set_damping(v1::Contact::EXACT);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());  // Nothing is iterated.
}

TEST(ScenarioAdvice, TellsThatNoGroupGrowsInThePapersProcess) {
  v1::Scenario scenario = TwoBalls();
  scenario.mutable_solver()->set_update(v1::Solver::PAPER_NEWTON);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());  // AUTO is not asked for.
  scenario.mutable_solver()->set_restitution_scope(v1::Solver::AUTO);
  EXPECT_THAT(AdviceOn(scenario),
              ElementsAre(HasSubstr("no group grows with update PAPER_NEWTON")));
}

// Two balls, and a third one to the right of them without a contact.
v1::Scenario TwoBallsAndOne(double position_m, double velocity_m_per_s) {
  v1::Scenario scenario = TwoBalls();
  v1::Body& third = *scenario.add_bodies();
  third = scenario.bodies(1);
  third.set_name("B3");
  third.set_position_m(position_m);
  third.set_velocity_m_per_s(velocity_m_per_s);
  return scenario;
}

TEST(ScenarioAdvice, TellsOfNeighboursThatMeetWithoutAContact) {
  EXPECT_THAT(
      AdviceOn(TwoBallsAndOne(0.202, -2)),
      ElementsAre("contacts: have none between B2 and B3, which meet after 0.001 s at 2 m/s "
                  "and pass through each other — add one with between: [B2, B3]"));
  EXPECT_THAT(AdviceOn(TwoBallsAndOne(0.202, 2)), IsEmpty());     // They part.
  EXPECT_THAT(AdviceOn(TwoBallsAndOne(0.202, -0.1)), IsEmpty());  // Not before the end.
  EXPECT_THAT(AdviceOn(TwoBallsAndOne(0.15, -2)), IsEmpty());     // They overlap on purpose.
}

TEST(ScenarioAdvice, IsNoneWhereAWallStandsBetweenNeighbours) {
  v1::Scenario scenario = TwoBallsAndOne(0.202, -2);
  v1::Contact& wall = *scenario.add_contacts();
  wall = scenario.contacts(0);
  wall.clear_between();
  wall.add_between("B3");
  wall.mutable_wall()->set_side(v1::Wall::LEFT);
  wall.mutable_wall()->set_position_m(0.151);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
}

TEST(ScenarioAdvice, TellsOfAContactThatGoesDeeperThanTheRadius) {
  v1::Scenario scenario = FallingBall();
  v1::Contact& contact = *scenario.mutable_contacts(0);
  contact.set_exponent(1);
  contact.set_restitution(1);
  contact.set_stiffness(100);
  EXPECT_THAT(AdviceOn(scenario),
              ElementsAre("contacts[0].stiffness: makes ball-wall about 0.36 m deep at 4.32 m/s, "
                          "more than the radius of ball, 0.05 m — a stiffness of 600000 keeps it "
                          "below a tenth of the radius"));
  contact.set_stiffness(6e5);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
  EXPECT_LT(FirstMeetingOf(scenario)->deformation, 0.1 * 0.05);
  scenario.mutable_bodies(0)->set_radius_m(0);  // A point has no radius to compare with.
  contact.set_stiffness(100);
  EXPECT_THAT(AdviceOn(scenario), IsEmpty());
}

TEST(ScenarioAdvice, NamesTheEntryOfTheDeepestContactAndTheSmallerSphere) {
  v1::Scenario scenario = TwoBallsAndOne(0.3, 0);
  *scenario.add_contacts() = scenario.contacts(0);
  v1::Contact& soft = *scenario.mutable_contacts(1);
  soft.set_name("soft");
  soft.set_between(0, "B3");
  soft.set_between(1, "B4");
  soft.set_stiffness(1);
  v1::Body& fourth = *scenario.add_bodies();
  fourth = scenario.bodies(2);
  fourth.set_name("B4");
  fourth.set_radius_m(0.01);
  fourth.set_position_m(0.36);
  fourth.set_velocity_m_per_s(-0.5);
  scenario.mutable_contacts(0)->add_between("B3");
  EXPECT_THAT(AdviceOn(scenario),
              ElementsAre(testing::AllOf(HasSubstr("contacts[1].stiffness: makes soft about"),
                                         HasSubstr("the radius of B4, 0.01 m"))));
}

TEST(ScenarioAdvice, OfASweepIsThatOfItsBaseButForWhatAxesSet) {
  v1::Sweep sweep;
  *sweep.mutable_base() = TwoBalls();
  sweep.mutable_base()->mutable_solver()->set_method(v1::Solver::RK4);
  sweep.mutable_base()->mutable_solver()->set_step_s(1e-5);
  sweep.mutable_base()->mutable_output()->set_sample_interval_s(1e-3);
  sweep.mutable_base()->mutable_output()->set_samples_per_contact(0);
  sweep.add_metrics("iterations");
  sweep.add_axes()->set_field("bodies[0].velocity_m_per_s");
  sweep.mutable_axes(0)->add_values(0.2);
  const auto advice = [&sweep] { return Lines(Advise(sweep, DecodeSweep(sweep))); };
  EXPECT_THAT(advice(), ElementsAre(HasSubstr("base.solver.step_s: gives")));
  sweep.add_keep_trajectories(0);
  EXPECT_THAT(advice(), ElementsAre(HasSubstr("base.solver.step_s"),
                                    HasSubstr("base.output.sample_interval_s")));
  sweep.mutable_axes(0)->set_field("solver.step_s");
  sweep.mutable_axes(0)->set_values(0, 1e-5);
  EXPECT_THAT(advice(), ElementsAre(HasSubstr("base.output.sample_interval_s")));
  *sweep.mutable_base() = TwoBallsAndOne(0.202, -2);
  sweep.mutable_axes(0)->set_field("bodies[0].velocity_m_per_s");
  sweep.mutable_axes(0)->set_values(0, 0.2);
  EXPECT_THAT(advice(), ElementsAre(HasSubstr("base.contacts: have none between B2 and B3")));
}

}  // namespace
}  // namespace contact
