#include "cli/figures/run_report.h"

#include <gmock/gmock.h>

#include "testing/sample_run.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kMarkup[] = "<script>alert('x')</script>";

RunPart Part(const std::string& title = "t") { return {SampleRun(title), {"<svg>1</svg>"}}; }

TEST(ReportPage, EscapesEveryTextOfUserAndServer) {
  RunPart part = Part(kMarkup);
  v1::Job& job = part.recording.job;
  job.add_warnings(kMarkup);
  job.mutable_error()->set_message(kMarkup);
  job.mutable_cycles(0)->set_contact(kMarkup);
  job.add_final_bodies()->set_name(kMarkup);
  part.recording.iterations[0].mutable_unknowns(0)->set_contact(kMarkup);
  job.set_server_version(kMarkup);
  const std::string page = ReportPage({part, part}, "", kMarkup);
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;script&gt;"), Not(HasSubstr("<script"))));
}

TEST(ReportPage, NeedsNoOtherFile) {
  const std::string page = ReportPage({Part()}, "", "127.0.0.1:7070");
  EXPECT_THAT(page, AllOf(Not(HasSubstr("src=")), Not(HasSubstr("url("))));
}

TEST(ReportPage, BeginsWithItsContentsOfWhichEveryLinkLeadsSomewhere) {
  const std::string page = ReportPage({Part(), Part("other")}, "", "s");
  std::size_t links = 0;
  for (std::size_t at = 0; (at = page.find("href=\"", at)) != std::string::npos; ++links) {
    at += std::string("href=\"").size();
    const std::string target = page.substr(at, page.find('"', at) - at);
    ASSERT_EQ(target.front(), '#');
    EXPECT_THAT(page, HasSubstr(" id=\"" + target.substr(1) + "\"")) << target;
  }
  EXPECT_EQ(links, 11U);  // Of each run it, ledger, figures, iteration, how; where they differ.
  EXPECT_LT(page.find("<nav>"), page.find("<h2"));
}

TEST(ReportPage, ShowsResultsBeforeDifferences) {
  const std::string page = ReportPage({Part(), Part("other")}, "", "s");
  EXPECT_LT(page.rfind("How to repeat it"), page.find("Where they differ"));
}

TEST(ReportPage, OfOneRunHasItsFiguresAndNoComparison) {
  const std::string page = ReportPage({Part("Two balls")}, "<svg>overlay</svg>", "s");
  EXPECT_THAT(page,
              AllOf(HasSubstr("<h1>Two balls</h1>"), HasSubstr("<figure><svg>1</svg></figure>"),
                    Not(HasSubstr("Where they differ")), Not(HasSubstr("overlay"))));
}

TEST(ReportPage, OfSeveralRunsTellsWhereTheyDiffer) {
  RunPart other = Part();
  other.recording.job.mutable_scenario()->mutable_contacts(0)->set_restitution(0.5);
  const std::string page = ReportPage({Part(), other}, "<svg>overlay</svg>", "s");
  EXPECT_THAT(page, AllOf(HasSubstr("Report of 2 runs"), HasSubstr("contacts[0].restitution"),
                          HasSubstr("<figure><svg>overlay</svg></figure>")));
}

TEST(ReportPage, LongLedgersAreCutAndSayWhereTheRestIs) {
  RunPart part = Part();
  v1::Job& job = part.recording.job;
  while (job.cycles_size() < 205) *job.add_cycles() = job.cycles(0);
  EXPECT_THAT(ReportPage({part}, "", "s"), HasSubstr("5 more cycles; contactctl export has"));
}

TEST(ReportPage, ShowsGroupsThatTheLedgerDoesNotTell) {
  RunPart part = Part();
  v1::Group& group = *part.recording.job.add_groups();
  group.set_contact("W");
  group.set_first_cycle(1);
  group.set_cycles(1);
  group.set_status(v1::Cycle::CONVERGED);
  EXPECT_THAT(ReportPage({part}, "", "s"), Not(HasSubstr("Groups of cycles")));
  group.set_cycles(2);
  group.set_status(v1::Cycle::JUMP);
  group.set_too_much_mu(2);
  group.set_too_much_restitution(0.75);
  group.set_too_little_mu(3);
  group.set_too_little_restitution(0.5);
  EXPECT_THAT(ReportPage({part}, "", "s"),
              AllOf(HasSubstr("Groups of cycles"), HasSubstr(">1 to 2<"),
                    HasSubstr("it jumps from 0.75 at μ = 2 to 0.5 at μ = 3")));
}

TEST(ReportPage, TellsHowToRepeatTheRun) {
  const std::string page = ReportPage({Part()}, "", "example:1");
  EXPECT_THAT(page, AllOf(HasSubstr("contactctl --server example:1 run --like jobs/sample"),
                          HasSubstr("scenario_sha256: 0123456789abcdef"),
                          HasSubstr("&quot;mass_kg&quot;: 2")));
}

TEST(ReportPage, ARunWithoutIterationsSaysSo) {
  RunPart part = Part();
  part.recording.iterations.clear();
  EXPECT_THAT(ReportPage({part}, "", "s"), HasSubstr("Nothing was iterated."));
}

}  // namespace
}  // namespace contact::cli
