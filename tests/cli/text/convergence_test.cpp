#include "cli/text/convergence.h"

#include <gmock/gmock.h>

#include "cli/text/render_job.h"
#include "from_text.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

v1::Job Partial(const std::string& more) {
  return JobFrom("name: 'jobs/a' state: SUCCEEDED convergence: PARTIAL " + more);
}

TEST(ConvergenceText, CountsTheCyclesThatMiss) {
  const v1::Job job =
      Partial("summary { cycles: 249 cycles_not_converged: 2 cycles_infeasible: 1 }");
  EXPECT_EQ(ConvergenceText(job), "PARTIAL (3 of 249 cycles)");
  EXPECT_EQ(MissedCount(job), "3");
  EXPECT_THAT(RenderJob(job, {}), HasSubstr("\nconvergence PARTIAL (3 of 249 cycles); residuals:"));
}

TEST(ConvergenceText, CountsTheCellsOfASweepThatFailOrMiss) {
  const v1::Job job =
      Partial("progress { cells: 50 cells_done: 50 cells_failed: 1 cells_not_converged: 4 }");
  EXPECT_EQ(ConvergenceText(job), "PARTIAL (5 of 50 cells)");
}

TEST(ConvergenceText, CountsTheLedgerOfAServerThatDoesNotCount) {
  const v1::Job job = Partial("summary {} cycles { status: INFEASIBLE } cycles { status: JUMP }");
  EXPECT_EQ(ConvergenceText(job), "PARTIAL (1 of 2 cycles)");
  EXPECT_EQ(ConvergenceText(Partial("summary {}")), "PARTIAL") << "lists have no ledger";
  EXPECT_EQ(MissedCount(Partial("summary {}")), "-");
}

TEST(ConvergenceText, FullHasNothingToCount) {
  const v1::Job job = JobFrom("convergence: FULL summary { cycles: 2 }");
  EXPECT_EQ(ConvergenceText(job), "FULL");
  EXPECT_EQ(MissedCount(job), "0");
  EXPECT_EQ(ConvergenceText(JobFrom("state: RUNNING progress { cycles: 2 }")), "");
  EXPECT_EQ(MissedCount(JobFrom("state: RUNNING progress { cycles: 2 }")), "-");
}

TEST(ConvergenceText, CountsTheCyclesThatTheEndCuts) {
  const v1::Job full = JobFrom("convergence: FULL summary { cycles: 5 cycles_cut: 2 }");
  EXPECT_EQ(ConvergenceText(full), "FULL, 2 cycles cut by the end");
  EXPECT_THAT(RenderJob(full, {}), HasSubstr("\nconvergence FULL, 2 cycles cut by the end; resid"));
  EXPECT_EQ(ConvergenceText(Partial("summary { cycles: 9 cycles_not_converged: 3 cycles_cut: 1 }")),
            "PARTIAL (3 of 9 cycles), 1 cycle cut by the end");
}

TEST(ConvergenceText, CountsTheCutCyclesOfAServerThatDoesNotCount) {
  v1::Job job = JobFrom(R"(convergence: FULL summary { cycles: 3 }
      cycles { status: UNFINISHED } cycles { status: CUT } cycles { status: RELEASED })");
  EXPECT_EQ(ConvergenceText(job), "FULL, 2 cycles cut by the end");
  KeepMissed(&job);
  EXPECT_EQ(ConvergenceText(job), "FULL, 2 cycles cut by the end");
}

TEST(ConvergenceText, AnswersWithoutARestitutionMissNothing) {
  for (const auto status : {v1::Cycle::JUMP, v1::Cycle::LIMITED, v1::Cycle::RELEASED,
                            v1::Cycle::CUT, v1::Cycle::UNFINISHED}) {
    EXPECT_FALSE(Misses(status)) << v1::Cycle::Status_Name(status);
  }
}

TEST(KeepMissed, LeavesWhatMissesAndTheCountsOfAll) {
  v1::Job job = Partial(R"(
      summary { cycles: 4 cycles_not_converged: 1 cycles_infeasible: 1 }
      cycles { number: 1 status: CONVERGED } cycles { number: 2 status: NOT_CONVERGED }
      cycles { number: 3 status: JUMP } cycles { number: 4 status: INFEASIBLE }
      groups { number: 1 status: CONVERGED } groups { number: 2 status: NOT_CONVERGED })");
  KeepMissed(&job);
  ASSERT_EQ(job.cycles_size(), 2);
  EXPECT_EQ(job.cycles(0).number(), 2);
  EXPECT_EQ(job.cycles(1).number(), 4);
  ASSERT_EQ(job.groups_size(), 1);
  EXPECT_EQ(job.groups(0).number(), 2);
  EXPECT_EQ(ConvergenceText(job), "PARTIAL (2 of 4 cycles)");
}

TEST(KeepMissed, CountsFirstWhatTheServerDoesNot) {
  v1::Job job = Partial("summary {} cycles { status: CONVERGED } cycles { status: INFEASIBLE }");
  KeepMissed(&job);
  EXPECT_EQ(ConvergenceText(job), "PARTIAL (1 of 2 cycles)");
}

// A NOT_CONVERGED cycle of an episode of its own.
std::string Cycle(int episode, int iterations, double restitution_out) {
  return "cycles { contact: 'A-B' number: " + std::to_string(episode) +
         " episode: " + std::to_string(episode) + " iterations: " + std::to_string(iterations) +
         " status: NOT_CONVERGED restitution_in: 0.5 restitution_out: " +
         std::to_string(restitution_out) + " } ";
}

TEST(ConvergenceHints, MoreCorrectionsAreForCyclesThatUsedAll) {
  const v1::Job job = Partial(Cycle(1, 50, 0.9) + Cycle(2, 49, 0.9));
  EXPECT_THAT(ConvergenceHints(job), HasSubstr("Try:   --set solver.max_iterations=100   1 cycle"));
  const std::string few = "scenario { solver { max_iterations: 3 } } ";
  EXPECT_THAT(ConvergenceHints(Partial(few + Cycle(1, 3, 0.9))),
              HasSubstr("max_iterations=50   1 cycle used up the 3 corrections\n"));
  const std::string most = "scenario { solver { max_iterations: 1000 } } ";
  EXPECT_THAT(ConvergenceHints(Partial(most + Cycle(1, 1000, 0.9))),
              Not(HasSubstr("max_iterations")));
}

TEST(ConvergenceHints, CorrectionsAreThoseOfTheEpisode) {
  const v1::Job job = Partial(Cycle(1, 2, 0.9) + Cycle(1, 50, 0.9));
  EXPECT_THAT(ConvergenceHints(job), HasSubstr("2 cycles used up the 50 corrections"));
}

TEST(ConvergenceHints, SearchThatEndedEarlyIsNotSentOn) {
  const std::string cycles = Cycle(1, 12, 0.01) + Cycle(2, 12, 0.9);
  const std::string stuck =
      "       No better μ was found for 2 cycles; more corrections would not help\n";
  EXPECT_EQ(ConvergenceHints(Partial(cycles)),
            stuck +
                "Try:   --set solver.relative_tolerance=1e-13   a search of finer motions often "
                "ends otherwise\n");
  const std::string finest = "scenario { solver { relative_tolerance: 1e-13 } } ";
  const std::string fixed = "scenario { solver { method: RK4 } } ";
  EXPECT_EQ(ConvergenceHints(Partial(finest + cycles)), stuck);
  EXPECT_EQ(ConvergenceHints(Partial(fixed + cycles)), stuck);
}

TEST(ConvergenceHints, ToleranceIsForSmallMissesAndLargeEnough) {
  const v1::Job job = Partial(Cycle(1, 12, 0.500002) + Cycle(2, 12, 0.50001) + Cycle(3, 12, 0.4));
  EXPECT_THAT(ConvergenceHints(job),
              testing::AllOf(HasSubstr("Try:   --set solver.restitution_tolerance=1e-04   2 cycles "
                                       "miss by less\n"),
                             HasSubstr("No better μ was found for 1 cycle;")));
}

TEST(ConvergenceHints, MissIsThatOfTheGroup) {
  const std::string group =
      "groups { contact: 'A-B' number: 7 restitution_in: 0.5 restitution_out: 0.50000001 "
      "status: NOT_CONVERGED }";
  v1::Job job = Partial(Cycle(1, 12, 0.9) + group);
  EXPECT_THAT(ConvergenceHints(job), Not(HasSubstr("restitution_tolerance")));
  job.mutable_cycles(0)->set_group(7);
  EXPECT_THAT(ConvergenceHints(job), HasSubstr("restitution_tolerance=1e-07"));
}

TEST(ConvergenceHints, CycleWhoseEnergyDoesNotBalanceIsNotSentToTheSearch) {
  v1::Job job = Partial(Cycle(1, 50, 0.5));
  job.mutable_cycles(0)->set_identity_residual(0.22);
  EXPECT_EQ(
      ConvergenceHints(job),
      "       The energy of 1 cycle does not balance, by up to 2.2e-01 of its work; a smaller "
      "solver.relative_tolerance may help\n");
  job.mutable_scenario()->mutable_solver()->set_restitution_tolerance(0.05);
  EXPECT_THAT(ConvergenceHints(job), Not(HasSubstr("does not balance")));
}

TEST(ConvergenceHints, PapersProcessHasAnAlternative) {
  const std::string paper =
      "scenario { solver { update: PAPER_NEWTON restitution_scope: CYCLE } } ";
  EXPECT_THAT(ConvergenceHints(Partial(paper + Cycle(1, 12, 0.9))),
              HasSubstr("Try:   --set solver.update=NEWTON_COUPLED"));
  EXPECT_THAT(ConvergenceHints(Partial(paper + "cycles { status: INFEASIBLE }")),
              testing::AllOf(HasSubstr("Try:   --set solver.update=NEWTON_COUPLED"),
                             Not(HasSubstr("restitution_scope"))));
}

TEST(ConvergenceHints, InfeasibleCyclesMayShareOneFactorUnlessTheyDoAlready) {
  const std::string cycle = "cycles { status: INFEASIBLE } ";
  EXPECT_THAT(ConvergenceHints(Partial(cycle + "scenario { solver { restitution_scope: CYCLE } }")),
              testing::StartsWith("Try:   --set solver.restitution_scope=AUTO"));
  const std::string hints = ConvergenceHints(Partial(cycle + R"(
      groups { contact: 'A-B' number: 2 status: INFEASIBLE too_much_restitution: nan
               too_little_restitution: 0.3125 }
      groups { contact: 'A-B' number: 3 status: INFEASIBLE too_much_restitution: 0.75
               too_little_restitution: nan }
      groups { contact: 'A-B' number: 4 status: INFEASIBLE too_much_restitution: 0.75
               too_little_restitution: 0.5 })"));
  EXPECT_EQ(hints,
            "       An INFEASIBLE group has no μ that would do\n"
            "       A-B group 2 can have a restitution of at most 0.3125\n"
            "       A-B group 3 can have a restitution of at least 0.75\n");
}

TEST(ConvergenceHints, RunThatIsFullNeedsNone) {
  v1::Job job = Partial(Cycle(1, 50, 0.9));
  job.set_convergence(v1::Job::FULL);
  EXPECT_EQ(ConvergenceHints(job), "");
}

}  // namespace
}  // namespace contact::cli
