#include "wire/result_codec.h"

#include <gmock/gmock.h>

#include <cstring>

#include "simulation/model/derived.h"
#include "two_contacts.h"
#include "wire/scenario/channels.h"

namespace contact {
namespace {

using testing::ElementsAre;

std::vector<double> Values(const v1::FrameChunk::Column& column) {
  std::vector<double> values(column.values().size() / sizeof(double));
  std::memcpy(values.data(), column.values().data(), column.values().size());
  return values;
}

TEST(Encode, IterationKeepsEveryField) {
  Iteration iteration{.episode = 2, .number = 3, .start_time = 4, .accepted = true, .unknowns = {}};
  using U = Iteration::Update;
  for (const U update : {U::kNothing, U::kNewton, U::kDampedNewton, U::kBisection, U::kZero,
                         U::kPaperNewton, U::kPaperRatio, U::kBracketing}) {
    iteration.unknowns.push_back({.contact = 1,
                                  .number = 5,
                                  .mu = 6,
                                  .restitution_out = 7,
                                  .restitution_in = 8,
                                  .residual = 9,
                                  .bracket_low = 10,
                                  .bracket_high = 11,
                                  .update = update});
  }
  const v1::Iteration message = Encode(TwoContacts(), iteration);
  EXPECT_EQ(message.episode(), 2);
  EXPECT_EQ(message.number(), 3);
  EXPECT_EQ(message.start_time_s(), 4);
  EXPECT_TRUE(message.accepted());
  EXPECT_EQ(message.unknowns(1).ShortDebugString(),
            "contact: \"b-wall\" number: 5 mu: 6 restitution_out: 7 restitution_in: 8 residual: 9 "
            "bracket_low: 10 bracket_high: 11 update: NEWTON");
  std::vector<int> updates;
  for (const auto& unknown : message.unknowns()) updates.push_back(unknown.update());
  using V = v1::Iteration;
  EXPECT_THAT(updates, ElementsAre(V::UPDATE_UNSPECIFIED, V::NEWTON, V::DAMPED_NEWTON, V::BISECTION,
                                   V::ZERO, V::PAPER_NEWTON, V::PAPER_RATIO, V::BRACKETING));
}

TEST(Encode, SamplesBecomeColumnsInTheOrderOfTheContract) {
  Scenario scenario = TwoContacts();
  scenario.supports = {{.body = 0}, {.body = 1, .other = 0}, {.body = 0}};
  Samples samples{.first = 512, .columns = SampleColumns(scenario), .values = {}};
  for (int i = 0; i < 2 * samples.columns; ++i) samples.values.push_back(i + 0.5);
  const v1::FrameChunk chunk = Encode(scenario, samples);

  EXPECT_EQ(chunk.first_sample(), 512);
  EXPECT_EQ(chunk.samples(), 2);
  std::vector<std::string> names;
  for (int i = 0; i < chunk.columns_size(); ++i) {
    const v1::FrameChunk::Column& column = chunk.columns(i);
    names.push_back(column.name() + " " + column.quantity() + " " + column.unit());
    EXPECT_THAT(Values(column), ElementsAre(i + 0.5, i + 0.5 + samples.columns)) << names.back();
  }
  EXPECT_THAT(names, ElementsAre("time time s",                                           //
                                 "a.position position m", "a.velocity velocity m/s",      //
                                 "b.position position m", "b.velocity velocity m/s",      //
                                 "a-b.deformation deformation m",                         //
                                 "a-b.deformation_velocity deformation_velocity m/s",     //
                                 "a-b.contact_force contact_force N",                     //
                                 "a-b.external_force external_force N",                   //
                                 "b-wall.deformation deformation m",                      //
                                 "b-wall.deformation_velocity deformation_velocity m/s",  //
                                 "b-wall.contact_force contact_force N",                  //
                                 "b-wall.external_force external_force N",                //
                                 "a.acceleration acceleration m/s^2",                     //
                                 "b.acceleration acceleration m/s^2",                     //
                                 "a-ground.support_force support_force N",                //
                                 "a-ground.support_energy support_energy J",              //
                                 "b-a.support_force support_force N",                     //
                                 "b-a.support_energy support_energy J",                   //
                                 "a-ground#2.support_force support_force N",              //
                                 "a-ground#2.support_energy support_energy J",            //
                                 "system.kinetic_energy kinetic_energy J",                //
                                 "system.contact_energy contact_energy J",                //
                                 "system.support_energy support_energy J",                //
                                 "system.dissipated_energy dissipated_energy J",          //
                                 "system.load_work load_work J"));
  EXPECT_EQ(chunk.columns(static_cast<int>(FirstChannels(scenario))).name(), "a.acceleration");
}

TEST(Encode, ColumnsAreLittleEndianDoubles) {
  Samples samples{.columns = 13, .values = std::vector<double>(13)};
  samples.values[0] = 1;
  EXPECT_EQ(Encode(TwoContacts(), samples).columns(0).values(),
            std::string("\0\0\0\0\0\0\xF0\x3F", 8));
}

TEST(Encode, ProgressKnowsWhereTheRunEndsAndWhatKeepsItBusy) {
  const Progress progress{
      .time = 1, .steps = 2, .cycles = 3, .iterations = 4, .busy_with = "contact a-b"};
  EXPECT_EQ(Encode(TwoContacts(), progress).ShortDebugString(),
            "time_s: 1 end_time_s: 8 steps: 2 cycles: 3 iterations: 4 "
            "busy_with: \"contact a-b\"");
}

TEST(Encode, OutcomeFillsItsFieldsOfTheJobAndNoOthers) {
  const Outcome outcome{.message = {},
                        .time = 8,
                        .all_converged = false,
                        .cut_cycles = 16,
                        .positions = {1, 2},
                        .velocities = {3, 4},
                        .steps = 5,
                        .evaluations = 6,
                        .iterations = 7,
                        .episodes = 8,
                        .worst_identity_residual = 9,
                        .momentum_residual = 10,
                        .energy_residual = 11,
                        .kinetic_energy = 12,
                        .growths = 14,
                        .growths_no_progress = 15};
  v1::Job job;
  job.set_name("jobs/x");
  job.mutable_summary()->set_wall_time_s(13);
  EncodeOutcome(TwoContacts(), outcome, &job);
  EXPECT_EQ(job.ShortDebugString(),
            "name: \"jobs/x\" convergence: PARTIAL "
            "final_bodies { name: \"a\" position_m: 1 velocity_m_per_s: 3 } "
            "final_bodies { name: \"b\" position_m: 2 velocity_m_per_s: 4 } "
            "summary { steps: 5 evaluations: 6 iterations: 7 episodes: 8 wall_time_s: 13 "
            "worst_identity_residual: 9 momentum_residual: 10 energy_residual: 11 "
            "kinetic_energy_j: 12 time_reached_s: 8 growths: 14 growths_no_progress: 15 "
            "cycles_cut: 16 }");
}

TEST(Encode, OutcomeCountsTheCyclesThatMissTheirRestitution) {
  v1::Job job;
  for (const v1::Cycle::Status status :
       {v1::Cycle::CONVERGED, v1::Cycle::NOT_CONVERGED, v1::Cycle::INFEASIBLE,
        v1::Cycle::NOT_CONVERGED, v1::Cycle::JUMP}) {
    job.add_cycles()->set_status(status);
  }
  EncodeOutcome(TwoContacts(), {}, &job);
  EXPECT_EQ(job.summary().cycles(), 5);
  EXPECT_EQ(job.summary().cycles_not_converged(), 2);
  EXPECT_EQ(job.summary().cycles_infeasible(), 1);
}

}  // namespace
}  // namespace contact
