#include "cli/text/render_groups.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "cli/text/render_job.h"
#include "from_text.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

v1::Group Reached(v1::Cycle::Status status, const std::string& certificate) {
  v1::Group group = JobFrom(
                        "groups { contact: 'wall' number: 2 first_cycle: 3 cycles: 1 "
                        "restitution_in: 0.5 " +
                        certificate + " }")
                        .groups(0);
  group.set_status(status);
  return group;
}

TEST(RenderGroups, ShowsThoseOfSeveralCycles) {
  const v1::Job job = JobFrom(R"(
      groups { contact: "A-B" number: 1 first_cycle: 1 cycles: 1 status: CONVERGED }
      groups { contact: "wall" number: 2 first_cycle: 3 cycles: 2 status: CONVERGED
               end: SEPARATION growth: TOO_LITTLE mu: 2.76e8 restitution_in: 0.5
               restitution_out: 0.5000000005 start_time_s: 1e-3 end_time_s: 2.5e-3 })");
  EXPECT_EQ(RenderGroups(job, {}),
            "\n"
            "CONTACT  GROUP  CYCLES  END         STATUS     GREW               μ  ε IN  ε OUT    "
            "ERROR  t START [s]  t END [s]\n"
            "wall         2  3 to 4  SEPARATION  CONVERGED  TOO_LITTLE  2.76e+08   0.5    0.5  "
            "1.0e-09        0.001     0.0025\n");
}

TEST(RenderGroups, IsEmptyWhereTheLedgerTellsAll) {
  EXPECT_THAT(RenderGroups({}, {}), IsEmpty());
  EXPECT_THAT(RenderGroups(JobFrom(R"(
                  groups { cycles: 1 status: CONVERGED } groups { cycles: 1 status: NOT_CONVERGED }
                  groups { cycles: 1 status: GIVEN_LAW } groups { cycles: 1 status: SETTLED })"),
                           {}),
              IsEmpty());
}

TEST(RenderGroups, ShowsThoseWithoutAnAnswerAndWhatWasReached) {
  v1::Job job;
  *job.add_groups() = Reached(v1::Cycle::UNFINISHED, "");
  EXPECT_THAT(RenderGroups(job, {}), AllOf(HasSubstr("UNFINISHED"), Not(HasSubstr("no μ gives"))));
  *job.add_groups() = Reached(v1::Cycle::JUMP,
                              "too_much_mu: 2e8 too_much_restitution: 0.75 too_little_mu: 2.1e8 "
                              "too_little_restitution: 0.25");
  EXPECT_THAT(
      RenderGroups(job, {}),
      HasSubstr("\nwall group 2: no μ gives a restitution of 0.5: it jumps from 0.75 at μ = "
                "2e+08 to 0.25 at μ = 2.1e+08\n"));
}

TEST(RenderGroups, ShowsWhatALimitedGroupReachedAndWhatAReleasedOneGivesBack) {
  v1::Job job;
  *job.add_groups() = Reached(v1::Cycle::LIMITED, "too_much_mu: 8 too_much_restitution: 0.75");
  EXPECT_THAT(RenderGroups(job, {}),
              HasSubstr("\nwall group 2: no μ gives a restitution of 0.5: too much comes back at "
                        "every μ: ε is 0.75 at μ = 8, for loads drive or hold the contact\n"));
  *job.mutable_groups(0) =
      Reached(v1::Cycle::RELEASED, "work_restitution_j: -0.25 restitution_out: nan");
  EXPECT_THAT(RenderGroups(job, {}),
              AllOf(HasSubstr("RELEASED"),
                    HasSubstr("\nwall group 2: it gives back 0.25 J that was stored before\n")));
  job.mutable_groups(0)->set_work_restitution_j(NAN);
  EXPECT_THAT(RenderGroups(job, {}), HasSubstr(": it gives back what was stored before\n"));
}

TEST(RenderGroups, TellsOfLargerRoots) {
  v1::Job job;
  *job.add_groups() = Reached(v1::Cycle::CONVERGED, "other_roots: 8 other_roots: 3e8");
  EXPECT_THAT(
      RenderGroups(job, {}),
      HasSubstr("\nwall group 2: the smallest μ with a restitution of 0.5; so has 8, 3e+08\n"));
}

TEST(Certificate, SaysWhichWayTheRestitutionMisses) {
  const auto words = [](const std::string& reached) {
    return Certificate(Reached(v1::Cycle::INFEASIBLE, reached));
  };
  EXPECT_EQ(words("too_little_mu: 0 too_little_restitution: 0.25"),
            "too little comes back at every μ: ε is 0.25 at μ = 0");
  EXPECT_EQ(words("too_much_mu: 8 too_much_restitution: 0.75"),
            "too much comes back at every μ: ε is 0.75 at μ = 8");
  EXPECT_EQ(words("too_much_mu: 8 too_much_restitution: 0.75 too_little_mu: 9"),
            "it is 0.75 at μ = 8, and with μ = 9 the contact stays closed");
  EXPECT_THAT(Certificate(Reached(v1::Cycle::CONVERGED, "too_much_mu: 8")), IsEmpty());
}

// The ε of one cycle among several is not what was asked for, and no error.
TEST(RenderJob, CyclesOfLongerGroupsHaveNoErrorOfTheirOwn) {
  v1::Job job = JobFrom(R"(
      cycles { contact: "wall" number: 1 group: 1 restitution_in: 0.5 restitution_out: 0.25 }
      groups { contact: "wall" number: 1 first_cycle: 1 cycles: 1 restitution_in: 0.5
               restitution_out: 0.5 })");
  EXPECT_THAT(RenderJob(job, {}), HasSubstr("5.0e-01"));
  job.mutable_groups(0)->set_cycles(2);
  EXPECT_THAT(RenderJob(job, {}), Not(HasSubstr("5.0e-01")));
}

}  // namespace
}  // namespace contact::cli
