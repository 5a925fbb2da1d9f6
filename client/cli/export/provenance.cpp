#include "cli/export/provenance.h"

#include <fmt/format.h>

#include "base/spelling.h"
#include "cli/base/escape.h"
#include "cli/base/number.h"
#include "cli/input/no_limits.h"
#include "cli/text/render_json.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {
namespace {

std::string Line(const google::protobuf::Message& message) {
  std::string line = ToJsonLine(message);
  line.pop_back();
  return line;
}

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

v1::Solver SolverInFull(const v1::Scenario& scenario) {
  const SolverOptions options = DecodeScenario(scenario, kNoLimits).scenario.solver;
  v1::Solver solver = scenario.solver();
  solver.set_method(options.fixed_step > 0 ? v1::Solver::RK4 : v1::Solver::ADAPTIVE);
  if (options.fixed_step > 0) {
    solver.set_step_s(options.fixed_step);
  } else {
    solver.set_relative_tolerance(options.relative_tolerance);
  }
  solver.set_restitution_tolerance(options.restitution_tolerance);
  if (solver.update() == v1::Solver::UPDATE_UNSPECIFIED) {
    solver.set_update(v1::Solver::NEWTON_COUPLED);
  }
  const bool at_force = options.phase_split == PhaseSplit::kPeakForce;
  solver.set_phase_split(at_force ? v1::Solver::PEAK_FORCE : v1::Solver::PEAK_DEFORMATION);
  solver.set_max_iterations(options.max_iterations);
  solver.set_tension(options.clip_tension ? v1::Solver::CLIP : v1::Solver::ALLOW);
  solver.set_on_not_converged(options.fail_if_not_converged ? v1::Solver::FAIL
                                                            : v1::Solver::REPORT);
  solver.set_settled_fraction(options.settled_fraction);
  solver.set_max_steps(options.max_steps);
  return solver;
}

Provenance ProvenanceOf(const v1::Job& job) {
  return {{"title", job.scenario().title()},
          {"job", job.name()},
          {"scenario", ToJson(job.scenario())},
          {"scenario_sha256", job.spec_sha256()},
          {"version", job.server_version()},
          {"revision", job.server_revision()},
          {"solver", Line(SolverInFull(job.scenario()))},
          {"convergence", v1::Job::Convergence_Name(job.convergence())}};
}

Provenance SourceOf(const v1::Job& job) {
  const v1::Scenario& scenario = job.has_sweep() ? job.sweep().base() : job.scenario();
  return {{"title", scenario.title()},
          {"job", job.name()},
          {"scenario_sha256", job.spec_sha256()},
          {"version", job.server_version()},
          {"revision", job.server_revision()}};
}

std::string CommentLines(const Provenance& source) {
  std::string text;
  for (const auto& [name, value] : source) {
    // A title may be of more lines; in the second it could become a command.
    text += fmt::format("# {}: {}\n", name, Printable(value, ' '));
  }
  return text;
}

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
