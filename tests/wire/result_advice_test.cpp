#include "wire/result_advice.h"

#include <gmock/gmock.h>

#include "simulation/model/derived.h"
#include "wire/result_codec.h"
#include "wire/scenario_builder.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A meets B, and C stands behind it without a contact.
Scenario Row() {
  v1::Scenario message = TwoBalls();
  *message.add_bodies() =
      FromText(R"(bodies { name: "B3" mass_kg: 0.5 radius_m: 0.05 position_m: 0.3 })").bodies(0);
  return DecodeScenario(message).scenario;
}

v1::FrameChunk ChunkOf(const Scenario& scenario, std::vector<double> positions, double time) {
  Samples samples;
  samples.columns = SampleColumns(scenario);
  samples.values.assign(static_cast<std::size_t>(samples.columns), 0);
  samples.values[0] = time;
  for (std::size_t i = 0; i < positions.size(); ++i) samples.values[1 + 2 * i] = positions[i];
  return Encode(scenario, samples);
}

v1::Job Ended(const Scenario& scenario, const std::vector<double>& positions, double deepest) {
  v1::Job job;
  v1::Cycle& cycle = *job.add_cycles();
  cycle.set_contact(scenario.contacts[0].name);
  cycle.set_number(1);
  cycle.set_delta_max_m(deepest);
  for (const double position : positions) job.add_final_bodies()->set_position_m(position);
  job.mutable_summary()->set_time_reached_s(4e-3);
  return job;
}

std::vector<std::string> AdviceOnResult(const Scenario& scenario, const v1::Job& job) {
  return Lines(AdviseOnResult(scenario, job, Passings(scenario)));
}

TEST(ResultAdvice, IsNoneForARunThatTouchedAndStayedShallow) {
  const Scenario scenario = Row();
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {0, 0.1, 0.3}, 1e-4)), IsEmpty());
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {0, 0.1, 0.3}, 5e-3)), IsEmpty());
}

TEST(ResultAdvice, TellsThatNothingWasTouched) {
  const Scenario scenario = Row();
  EXPECT_THAT(AdviceOnResult(scenario, v1::Job()),
              ElementsAre("contacts: were not touched in 0.004 s — see velocities, gaps, the signs "
                          "of loads, and end_time_s"));
  Scenario free = scenario;
  free.contacts.clear();
  EXPECT_THAT(AdviceOnResult(free, v1::Job()), IsEmpty());
}

TEST(ResultAdvice, TellsOfADeformationTooLargeForTheSmallerSphere) {
  Scenario scenario = Row();
  scenario.bodies[0].radius = 0.02;
  EXPECT_THAT(
      AdviceOnResult(scenario, Ended(scenario, {}, 3e-3)),
      ElementsAre("contacts[B1-B2]: is 0.003 m deep in cycle 1, more than a tenth of the radius of "
                  "B1, 0.02 m — Hertz's law is of deformations far below the radius; is the "
                  "stiffness right?"));
  scenario.bodies[0].radius = 0;  // A point has no radius to compare with.
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {}, 3e-3)), IsEmpty());
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {}, 6e-3)),
              ElementsAre(HasSubstr("of B2, 0.05 m")));
  scenario.contacts[0].exponent = 1;
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {}, 6e-3)), IsEmpty());
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {}, 0.06)),
              ElementsAre("contacts[B1-B2]: is 0.06 m deep in cycle 1, more than the radius of B2, "
                          "0.05 m — a sphere ends there; is the stiffness right?"));
}

TEST(ResultAdvice, NamesTheDeepestCycleAndCountsTheOtherContacts) {
  Scenario scenario = Row();
  Contact second = scenario.contacts[0];
  second.name = "second";
  scenario.contacts.push_back(second);
  v1::Job job = Ended(scenario, {}, 6e-3);
  v1::Cycle& deeper = *job.add_cycles();
  deeper = job.cycles(0);
  deeper.set_number(2);
  deeper.set_delta_max_m(9e-3);
  job.add_cycles()->CopyFrom(job.cycles(0));
  job.mutable_cycles(2)->set_contact("second");
  EXPECT_THAT(AdviceOnResult(scenario, job),
              ElementsAre(testing::AllOf(HasSubstr("contacts[B1-B2]: is 0.009 m deep in cycle 2"),
                                         HasSubstr("; and so 1 other contact"))));
}

TEST(ResultAdvice, TellsOfNeighboursThatOverlappedInASample) {
  const Scenario scenario = Row();
  Passings passings(scenario);
  passings.See(ChunkOf(scenario, {0, 0.1, 0.2}, 1e-3));  // They touch.
  EXPECT_FALSE(passings.Advice());
  passings.See(ChunkOf(scenario, {0, 0.11, 0.2}, 2e-3));
  passings.See(ChunkOf(scenario, {0, 0.15, 0.2}, 3e-3));
  const v1::Job job = Ended(scenario, {0, 0.1, 0.3}, 1e-4);  // Apart again.
  EXPECT_THAT(Lines(AdviseOnResult(scenario, job, passings)),
              ElementsAre("contacts: have none between B2 and B3, which passed into each other by "
                          "0.002 s — add one with between: [B2, B3]"));
}

TEST(ResultAdvice, TellsOfNeighboursThatChangedPlacesInARunWithoutSamples) {
  const Scenario scenario = Row();
  EXPECT_THAT(AdviceOnResult(scenario, Ended(scenario, {0, 0.5, 0.3}, 1e-4)),
              ElementsAre(HasSubstr("passed into each other by 0.004 s")));
}

}  // namespace
}  // namespace contact
