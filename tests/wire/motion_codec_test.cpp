// Prescribed motions, plays and places beside other bodies, as the contract writes them.
#include "wire/scenario/motion_codec.h"

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "simulation/model/derived.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/scenario_builder.h"

namespace contact {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

template <class Message>
Message Parsed(const std::string& text) {
  Message message;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &message)) << text;
  return message;
}

// A ball of 1 kg at x = 2 m between what `rest` adds.
DecodedScenario Decoded(const std::string& rest) {
  return DecodeScenario(Parsed<v1::Scenario>(
      "bodies {name: 'ball' mass_kg: 1 radius_m: 0.1 position_m: 2} end_time_s: 1 " + rest));
}

std::vector<Drive> Motion(const std::string& text, double origin = 0) {
  std::vector<Violation> violations;
  std::vector<Drive> pieces =
      DecodeMotion(Parsed<v1::Motion>(text), origin, Rules(&violations, "motion"));
  EXPECT_THAT(Lines(violations), IsEmpty());
  return pieces;
}

// Where the pieces lead at t.
DrivenMotion At(const std::vector<Drive>& pieces, double t) {
  for (const Drive& piece : pieces) {
    if (piece.begin <= t && t < piece.end) return MotionAt(piece, t);
  }
  ADD_FAILURE() << "no piece at " << t;
  return {};
}

// Points of sin 3t at equal times.
std::string SineTable(int points) {
  std::string text = "position_table {";
  for (int i = 0; i < points; ++i) {
    const double t = 0.5 + 2.0 * i / (points - 1);
    text += "points {time_s: " + std::to_string(t) +
            " position_m: " + std::to_string(std::sin(3 * t)) + "} ";
  }
  return text + "}";
}

TEST(DecodeMotion, PiecesJoinInPositionAndVelocity) {
  for (const char* text :
       {"position_table {points {time_s: 0.2 position_m: 1} points {time_s: 0.3 position_m: -2} "
        "points {time_s: 1.1 position_m: 0.5} points {time_s: 1.2 position_m: 0.5}}",
        "velocity_table {points {time_s: 0 velocity_m_per_s: 1} points {time_s: 0.7 "
        "velocity_m_per_s: -3} points {time_s: 0.9 velocity_m_per_s: 2}}",
        "acceleration_table {velocity_m_per_s: 4 points {time_s: 0.1 acceleration_m_per_s2: 9} "
        "points {time_s: 0.5 acceleration_m_per_s2: -30}}"}) {
    const std::vector<Drive> pieces = Motion(text, 7);
    EXPECT_EQ(pieces.front().begin, 0);
    EXPECT_TRUE(std::isinf(pieces.back().end));
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const double t = pieces[i].begin;
      ASSERT_EQ(pieces[i - 1].end, t);
      const DrivenMotion before = MotionAt(pieces[i - 1], t), after = MotionAt(pieces[i], t);
      EXPECT_NEAR(before.position, after.position, 1e-14) << text << i;
      EXPECT_NEAR(before.velocity, after.velocity, 1e-13) << text << i;
    }
  }
}

TEST(DecodeMotion, ATableOfPositionsPassesThroughItsPoints) {
  const auto pieces = Motion(
      "position_table {points {time_s: 1 position_m: 0} points {time_s: 2 position_m: 1} "
      "points {time_s: 3 position_m: 4}}",
      10);
  // A parabola is met everywhere, and left along its tangents.
  for (const double t : {1.0, 1.3, 2.0, 2.9, 3.0}) {
    EXPECT_NEAR(At(pieces, t).position, 10 + (t - 1) * (t - 1), 1e-14) << t;
    EXPECT_NEAR(At(pieces, t).velocity, 2 * (t - 1), 1e-14) << t;
  }
  EXPECT_NEAR(At(pieces, 0).position, 10, 1e-14);
  EXPECT_NEAR(At(pieces, 5).position, 14 + 2 * 4, 1e-13);
}

TEST(DecodeMotion, ATableOfPositionsConvergesWithTheCubeOfItsSpacing) {
  const auto miss = [](int points) {
    const std::vector<Drive> pieces = Motion(SineTable(points));
    double most = 0;
    for (double t = 1; t < 2; t += 0.001) {
      most = std::max(most, std::abs(At(pieces, t).position - std::sin(3 * t)));
    }
    return most;
  };
  EXPECT_NEAR(std::log2(miss(21) / miss(41)), 3, 0.2);
}

TEST(DecodeMotion, TablesOfVelocityAndAccelerationAreIntegrated) {
  const auto ramp = Motion(
      "velocity_table {points {time_s: 1 velocity_m_per_s: 0} "
      "points {time_s: 3 velocity_m_per_s: 4}}",
      5);
  EXPECT_DOUBLE_EQ(At(ramp, 0.5).position, 5);
  EXPECT_DOUBLE_EQ(At(ramp, 2).position, 6);
  EXPECT_DOUBLE_EQ(At(ramp, 4).position, 9 + 4);
  const auto jerk = Motion(
      "acceleration_table {velocity_m_per_s: 1 points {time_s: 0 acceleration_m_per_s2: 0} "
      "points {time_s: 2 acceleration_m_per_s2: 6}}");
  EXPECT_DOUBLE_EQ(At(jerk, 2).position, 2 + 3.0 * 8 / 6);
  EXPECT_DOUBLE_EQ(At(jerk, 3).velocity, 1 + 6);
  EXPECT_DOUBLE_EQ(At(jerk, 3).acceleration, 0);
}

TEST(DecodeMotion, ASineMayBeGivenInHertz) {
  const auto swing = Motion("sine {amplitude_m: 2 frequency_hz: 3 phase_rad: 0.5}", 1);
  EXPECT_DOUBLE_EQ(At(swing, 0).position, 1 + 2 * std::sin(0.5));
  EXPECT_DOUBLE_EQ(At(swing, 0).velocity, 2 * 6 * std::numbers::pi * std::cos(0.5));
}

TEST(DecodeMotion, DisplacementsKeepTheirDigits) {
  const Drive swing{.position = 1e6, .amplitude = 3, .angular_frequency = 40, .phase = 0.3};
  const double h = 1e-9;
  EXPECT_NEAR(Displacement(swing, 2, 2 + h) / (MotionAt(swing, 2 + h / 2).velocity * h), 1, 1e-6);
  const Drive thrown{.begin = 1, .velocity = 2, .acceleration = 3, .jerk = 4};
  EXPECT_NEAR(Displacement(thrown, 2, 5),
              MotionAt(thrown, 5).position - MotionAt(thrown, 2).position, 1e-13);
}

TEST(DecodeScenario, AMovingWallIsOneMoreBody) {
  const DecodedScenario d = Decoded(
      "contacts {name: 'table' between: 'ball' stiffness: 1e6 restitution: 0.5 wall {side: LEFT "
      "position_m: 1 motion {sine {amplitude_m: 0.1 frequency_hz: 1 phase_rad: 0.5}}}}"
      "loads {gravity {}}");
  ASSERT_THAT(Lines(d.violations), IsEmpty());
  ASSERT_THAT(d.scenario.bodies, SizeIs(2));
  const Body& wall = d.scenario.bodies[1];
  EXPECT_EQ(wall.name, "table");
  EXPECT_TRUE(wall.fixed);
  EXPECT_DOUBLE_EQ(wall.position, 1 + 0.1 * std::sin(0.5));
  EXPECT_EQ(d.scenario.contacts[0].left, 1);
  EXPECT_EQ(d.scenario.contacts[0].right, 0);
  ASSERT_THAT(d.scenario.drives, SizeIs(1));
  EXPECT_EQ(d.scenario.drives[0].body, 1);
  EXPECT_THAT(d.scenario.loads, SizeIs(1));  // Gravity does not load the wall.
}

TEST(DecodeScenario, APlayIsTwoContacts) {
  const DecodedScenario d = Decoded(
      "bodies {name: 'slot' mass_kg: 2 position_m: 2.03} "
      "contacts {between: ['ball', 'slot'] clearance_m: 0.05 stiffness: 1e6 restitution: 1}"
      "contacts {name: 'stop' between: 'slot' wall {position_m: 2} clearance_m: 0.5 stiffness: 1e6 "
      "restitution: 1}");
  ASSERT_THAT(Lines(d.violations), IsEmpty());
  const auto& contacts = d.scenario.contacts;
  ASSERT_THAT(contacts, SizeIs(4));
  EXPECT_EQ(contacts[0].name, "ball-slot-left");
  EXPECT_EQ(contacts[1].name, "ball-slot-right");
  EXPECT_EQ(contacts[2].name, "stop-left");
  EXPECT_EQ(contacts[3].name, "stop-right");
  // The ball may go 0.05 m to either side of 2.03 m, the slot 0.5 m to either side of 2 m.
  EXPECT_NEAR(InitialGap(d.scenario, contacts[0]), 0.02, 1e-15);
  EXPECT_NEAR(InitialGap(d.scenario, contacts[1]), 0.08, 1e-15);
  EXPECT_NEAR(InitialGap(d.scenario, contacts[2]), 0.53, 1e-15);
  EXPECT_NEAR(InitialGap(d.scenario, contacts[3]), 0.47, 1e-15);
}

TEST(DecodeScenario, ABodyStandsNextToAnother) {
  const DecodedScenario d = Decoded(
      "bodies {name: 'B' mass_kg: 1 radius_m: 0.2 next_to: 'ball'} "
      "bodies {name: 'C' mass_kg: 1 radius_m: 0.3 next_to: 'B' gap_m: 0.01} "
      "bodies {name: 'D' next_to: 'C' motion {uniform {velocity_m_per_s: -1}}} "
      "contacts {between: ['ball', 'B', 'C', 'D'] stiffness: 1e6 restitution: 1}");
  ASSERT_THAT(Lines(d.violations), IsEmpty());
  EXPECT_DOUBLE_EQ(d.scenario.bodies[1].position, 2.3);
  EXPECT_DOUBLE_EQ(d.scenario.bodies[2].position, 2.81);
  EXPECT_DOUBLE_EQ(d.scenario.bodies[3].position, 3.11);
  EXPECT_EQ(d.scenario.bodies[3].velocity, -1);
  EXPECT_EQ(InitialGap(d.scenario, d.scenario.contacts[0]), 0);
}

struct Broken {
  const char* text;
  std::vector<std::string> lines;
};

TEST(DecodeScenario, TellsWhatMotionsBreak) {
  const Broken all[] = {
      // Each is told, whatever else is wrong.
      {"bodies {name: 'B' motion {sine {amplitude_m: 1e7 phase_rad: 2000}}} bodies {name: 'C' "
       "motion "
       "{sine {amplitude_m: 1 frequency_hz: 1e7}}}",
       {"bodies[1].motion.sine.amplitude_m: is 10000000; must be in [-1e6, 1e6]",
        "bodies[1].motion.sine.phase_rad: is 2000; must be in [-1e3, 1e3]",
        "bodies[2].motion.sine.amplitude_m: makes a speed of 62831853.071795866 m/s; must be in "
        "[-1e6, 1e6]"}},
      {"bodies {name: 'B' fixed: true velocity_m_per_s: 1 motion {}}",
       {"bodies[1].fixed: is true beside motion — give one of the two",
        "bodies[1].velocity_m_per_s: is given beside motion, which tells the velocity — remove it",
        "bodies[1].motion: has no kind — give one of uniform, sine, position_table, "
        "velocity_table and acceleration_table"}},
      {"bodies {name: 'B' motion {sine {amplitude_m: 1 frequency_hz: 1 "
       "angular_frequency_rad_per_s: 1}}}",
       {"bodies[1].motion.sine.frequency_hz: is given beside angular_frequency_rad_per_s — give "
        "one of the two"}},
      {"bodies {name: 'B' motion {sine {amplitude_m: 1 frequency_hz: 1e7}}}",
       {"bodies[1].motion.sine.amplitude_m: makes a speed of 62831853.071795866 m/s; must be in "
        "[-1e6, 1e6]"}},
      {"bodies {name: 'B' motion {velocity_table {points {time_s: 1} points {time_s: 1}}}}",
       {"bodies[1].motion.velocity_table.points[1].time_s: is 1, which is not after the 1 before "
        "— points follow one another in time"}},
      {"bodies {name: 'B' motion {position_table {points {time_s: 1}}}}",
       {"bodies[1].motion.position_table.points: holds 1; must hold 2 to 10000"}},
      {"bodies {name: 'B' motion {uniform {}}} loads {body: 'B' constant {force_n: 1}}",
       {"loads[0].body: moves as its motion says; forces do not move it"}},
      {"bodies {name: 'B' position_m: 1 mass_kg: 1 next_to: 'C'} bodies {name: 'D' mass_kg: 1 "
       "gap_m: 1}",
       {"bodies[1].position_m: is given beside next_to — give one of the two",
        "bodies[1].next_to: is 'C', which no body before is called — name a body that comes "
        "earlier in the list",
        "bodies[2].gap_m: is given, but goes only with next_to — remove it"}},
      {"contacts {between: 'ball' clearance_m: 0.1 restitution: 1 wall {side: LEFT position_m: "
       "2.3}}",
       {"contacts[0].wall.side: is given beside clearance_m, which has both sides — remove it",
        "contacts[0].stiffness: is missing — k, in N/m^exponent; clearance_m needs it",
        "contacts[0].between: 'ball' and its stop overlap at the start: δ = 0.19999999999999982 m; "
        "must be ≤ 0 — move them apart, or set start: AS_GIVEN"}},
      {"bodies {name: 'wall' mass_kg: 1} contacts {name: 'wall' between: 'ball' stiffness: 1 "
       "restitution: 1 wall {side: LEFT motion {uniform {}}}}",
       {"contacts[0].name: is 'wall', which a body is called — results tell a wall that moves by "
        "the name of its contact"}},
  };
  for (const Broken& broken : all) {
    EXPECT_EQ(Lines(Decoded(broken.text).violations), broken.lines) << broken.text;
  }
}

}  // namespace
}  // namespace contact
