#include <gmock/gmock.h>

#include "cli/export/provenance.h"
#include "testing/sample_run.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Citation, HasThePaperAndWhatRepeatsTheRun) {
  v1::Job job = SampleRun("Stoß 50 % & {more}").job;
  job.set_server_revision("abc1234");
  job.mutable_create_time()->set_seconds(1767225599);  // The last second of 2025, UTC.
  const std::string text = BibTeX(job);
  EXPECT_THAT(text, StartsWith("@article{"));
  EXPECT_THAT(text, HasSubstr("\n  doi = {10.1007/s11071-024-10065-4}\n}\n"));
  EXPECT_THAT(text, HasSubstr("\n@misc{contactd-sample,\n"
                              "  author = {{contactd maintainers}},\n"
                              "  title = {{Stoß 50 \\% \\& \\{more\\}}: a run with contactd},\n"
                              "  year = {2025},\n"
                              "  howpublished = {contactd 0.1.0, revision abc1234},\n"
                              "  note = {jobs/sample, scenario SHA-256 0123456789abcdef}\n"
                              "}\n"));
}

TEST(Citation, SweepHasTheTitleOfItsBase) {
  v1::Job job;
  job.set_name("jobs/s");
  job.mutable_sweep()->mutable_base()->set_title("Base");
  EXPECT_THAT(BibTeX(job), HasSubstr("  title = {{Base}: a sweep with contactd},\n"));
}

TEST(Citation, DoesWithoutTitleAndRevision) {
  const std::string text = BibTeX(SampleRun("").job);
  EXPECT_THAT(text, HasSubstr("  title = {{jobs/sample}: a run with contactd},\n"));
  EXPECT_THAT(text, HasSubstr("  howpublished = {contactd 0.1.0},\n"));
}

}  // namespace
}  // namespace contact::cli
