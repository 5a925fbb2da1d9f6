#include "cli/export/citation.h"

#include <fmt/format.h>

#include "cli/base/escape.h"
#include "cli/base/number.h"

namespace contact::cli {
namespace {

// Without authors: the copy of the paper that this program is made from does not name them.
constexpr char kPaper[] =
    R"(@article{contact-force-calculation-approach,
  title = {A contact force calculation approach for collision analysis with zero or non-zero initial relative velocity},
  journal = {Nonlinear Dynamics},
  year = {2024},
  doi = {10.1007/s11071-024-10065-4}
}
)";

}  // namespace

std::string BibTeX(const v1::Job& job) {
  const v1::Scenario& scenario = job.has_sweep() ? job.sweep().base() : job.scenario();
  const std::string title = scenario.title().empty() ? job.name() : LatexText(scenario.title());
  const std::string year = Instant(job.create_time()).substr(0, 4);
  const std::string revision =  // Unknown of a build without git.
      job.server_revision().empty() ? "" : ", revision " + job.server_revision();
  const std::string id = job.name().substr(job.name().find('/') + 1);
  return fmt::format(
      R"({}
@misc{{contactd-{},
  author = {{{{contactd maintainers}}}},
  title = {{{{{}}}: a {} with contactd}},
  year = {{{}}},
  howpublished = {{contactd {}{}}},
  note = {{{}, scenario SHA-256 {}}}
}}
)",
      kPaper, id, title, job.has_sweep() ? "sweep" : "run", year, job.server_version(), revision,
      job.name(), job.spec_sha256());
}

}  // namespace contact::cli
