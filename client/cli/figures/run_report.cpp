#include "cli/figures/run_report.h"

#include <fmt/format.h>

#include <cstddef>

#include "base/spelling.h"
#include "cli/base/escape.h"
#include "cli/base/html.h"
#include "cli/base/number.h"
#include "cli/export/provenance.h"
#include "cli/text/comparison/render_comparison.h"
#include "cli/text/render_groups.h"
#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

constexpr int kMostRows = 200;  // Of a table; the rest is for export.

std::string Preformatted(const std::string& text) {
  return fmt::format("<pre>{}</pre>\n", HtmlText(text));
}

// What is said below a table of a list of which only the first rows are shown.
std::string More(int all, const std::string& one, const std::string& many) {
  if (all <= kMostRows) return "";
  return fmt::format("<p>{}; contactctl export has all.</p>\n",
                     Count(all - kMostRows, "more " + one, "more " + many));
}

bool Missed(v1::Cycle::Status status) {
  return status == v1::Cycle::NOT_CONVERGED || status == v1::Cycle::INFEASIBLE;
}

std::string Ledger(const v1::Job& job) {
  std::vector<HtmlRow> rows;
  for (const v1::Cycle& cycle : job.cycles()) {
    if (rows.size() == kMostRows) break;
    rows.push_back({{cycle.contact(), fmt::to_string(cycle.number()),
                     cycle.group() == 0 ? "-" : fmt::to_string(cycle.group()),
                     v1::Cycle::Kind_Name(cycle.kind()), v1::Cycle::End_Name(cycle.end()),
                     v1::Cycle::Status_Name(cycle.status()), fmt::to_string(cycle.iterations()),
                     Digits(cycle.mu(), 7), AlphaOrRatio(cycle), Digits(cycle.restitution_in(), 6),
                     Digits(RestitutionOf(cycle), 8), RelativeError(RestitutionError(cycle)),
                     Digits(cycle.peak_force_n(), 7), Digits(cycle.start_time_s(), 7),
                     Digits(cycle.end_time_s(), 7)},
                    Missed(cycle.status())});
  }
  return HtmlTable({"Contact", "#", "Group", "Kind", "End", "Status", "n", "μ", "α, or μ/k", "ε in",
                    "ε out", "Error", "Peak force [N]", "Start [s]", "End [s]"},
                   rows) +
         More(job.cycles_size(), "cycle", "cycles");
}

// The groups of which the ledger does not tell all.
std::string Groups(const v1::Job& job) {
  std::vector<HtmlRow> rows;
  int all = 0;
  for (const v1::Group& group : job.groups()) {
    if (!IsNotable(group) || ++all > kMostRows) continue;
    rows.push_back(
        {{group.contact(), fmt::to_string(group.number()), CyclesOf(group),
          v1::Cycle::End_Name(group.end()), v1::Cycle::Status_Name(group.status()),
          v1::Group::Growth_Name(group.growth()), Digits(group.mu(), 7),
          Digits(group.restitution_in(), 6), Digits(group.restitution_out(), 8),
          RelativeError(RestitutionError(group.restitution_out(), group.restitution_in())),
          RelativeError(group.residual()), Digits(group.start_time_s(), 7),
          Digits(group.end_time_s(), 7), Certificate(group)},
         Missed(group.status())});
  }
  if (rows.empty()) return "";
  return "<h3>Groups of cycles</h3>\n" +
         HtmlTable({"Contact", "Group", "Cycles", "End", "Status", "Grew", "μ", "ε in", "ε out",
                    "Error", "Residual", "Start [s]", "End [s]", "Reached"},
                   rows) +
         More(all, "group", "groups");
}

std::string Iterations(const std::vector<v1::Iteration>& iterations) {
  std::vector<HtmlRow> rows;
  int all = 0;
  for (const v1::Iteration& pass : iterations) {
    for (const auto& unknown : pass.unknowns()) {
      if (++all > kMostRows) continue;
      rows.push_back(
          {{fmt::to_string(pass.episode()), fmt::to_string(pass.number()),
            fmt::format("{} #{}", unknown.contact(), unknown.number()), Digits(unknown.mu(), 9),
            Digits(unknown.restitution_out(), 8), RelativeError(unknown.residual()),
            pass.accepted() ? "accepted" : v1::Iteration::Update_Name(unknown.update())}});
    }
  }
  if (rows.empty()) return "<p>Nothing was iterated.</p>\n";
  return HtmlTable({"Episode", "Pass", "Cycle", "μ", "ε out", "Residual", "Next"}, rows) +
         More(all, "row", "rows");
}

std::string Bodies(const v1::Job& job) {
  std::vector<HtmlRow> rows;
  for (const v1::FinalBody& body : job.final_bodies()) {
    if (rows.size() == kMostRows) break;
    rows.push_back(
        {{body.name(), Digits(body.position_m(), 10), Digits(body.velocity_m_per_s(), 10)}});
  }
  return HtmlTable({"Body", "Final position [m]", "Final velocity [m/s]"}, rows) +
         More(job.final_bodies_size(), "body", "bodies");
}

std::string Balances(const v1::RunSummary& summary) {
  return HtmlTable({"Balance", "Relative residual"},
                   {{{"Momentum", RelativeError(summary.momentum_residual())}},
                    {{"Energy", RelativeError(summary.energy_residual())}},
                    {{"Worst cycle identity", RelativeError(summary.worst_identity_residual())}}}) +
         fmt::format("<p>{} simulated; {}, {}, {} in {}; {} wall time.</p>\n",
                     Seconds(summary.time_reached_s()), Count(summary.steps(), "step", "steps"),
                     Count(summary.evaluations(), "evaluation", "evaluations"),
                     Count(summary.iterations(), "iteration", "iterations"),
                     Count(summary.episodes(), "episode", "episodes"),
                     Seconds(summary.wall_time_s()));
}

std::string Warnings(const v1::Job& job) {
  std::string list;
  if (job.has_error()) list += fmt::format("<li>{}</li>", HtmlText(job.error().message()));
  for (const std::string& warning : job.warnings()) {
    list += fmt::format("<li>{}</li>", HtmlText(warning));
  }
  return list.empty() ? "" : fmt::format("<h3>Warnings</h3>\n<ul>{}</ul>\n", list);
}

std::string HowToRepeat(const v1::Job& job, const std::string& server) {
  std::string text = fmt::format(
      "# while {0} has {1}:\ncontactctl --server {0} run --like {1}\n# anywhere: save the scenario "
      "below as scenario.json, then\ncontactctl run scenario.json\n\n",
      server, job.name());
  std::string scenario;
  for (const auto& [name, value] : ProvenanceOf(job)) {
    if (name == "scenario") {
      scenario = value;
    } else {
      text += fmt::format("{}: {}\n", name, value);
    }
  }
  return Preformatted(text) + "<h3>Scenario</h3>\n" + Preformatted(scenario);
}

// The name of a section, for links inside the page.
std::string Anchor(const v1::Job& job, const char* section = "run") {
  return HtmlText(fmt::format("{}-{}", section, job.name()));
}

std::string Heading(int level, const std::string& id, const std::string& markup) {
  return fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level, id, markup);
}

std::string Link(const std::string& id, const std::string& markup) {
  return fmt::format("<a href=\"#{}\">{}</a>", id, markup);
}

std::string TitleOf(const v1::Job& job) {
  const std::string& title = job.scenario().title();
  return HtmlText(job.name()) + (title.empty() ? "" : ": " + HtmlText(title));
}

// Every run in a line: how it went, and where on the page what of it is.
std::string Contents(const std::vector<RunPart>& runs) {
  std::string list;
  for (const RunPart& run : runs) {
    const v1::Job& job = run.recording.job;
    list += fmt::format(
        "<li>{}: {}, convergence {}, {}; {}{}, {}, {}</li>\n", Link(Anchor(job), TitleOf(job)),
        v1::Job::State_Name(job.state()), v1::Job::Convergence_Name(job.convergence()),
        Count(job.summary().cycles(), "cycle", "cycles"), Link(Anchor(job, "ledger"), "ledger"),
        run.figures.empty() ? "" : ", " + Link(Anchor(job, "figures"), "figures"),
        Link(Anchor(job, "iteration"), "iteration of μ"),
        Link(Anchor(job, "repeat"), "how to repeat it"));
  }
  if (runs.size() > 1)
    list += fmt::format("<li>{}</li>\n", Link("differences", "where they differ"));
  return fmt::format("<nav><ul>\n{}</ul></nav>\n", list);
}

std::string Figures(const RunPart& run) {
  if (run.figures.empty()) return "";
  std::string section = Heading(3, Anchor(run.recording.job, "figures"), "Figures");
  for (const std::string& figure : run.figures) {
    section += fmt::format("<figure>{}</figure>\n", figure);
  }
  return section;
}

std::string Section(const RunPart& run, const std::string& server) {
  const v1::Job& job = run.recording.job;
  return Heading(2, Anchor(job), TitleOf(job)) +
         fmt::format("<p>{}, convergence {}.</p>\n", v1::Job::State_Name(job.state()),
                     v1::Job::Convergence_Name(job.convergence())) +
         Warnings(job) + Heading(3, Anchor(job, "ledger"), "Ledger") + Ledger(job) + Groups(job) +
         Bodies(job) + "<h3>Balances</h3>\n" + Balances(job.summary()) + Figures(run) +
         Heading(3, Anchor(job, "iteration"), "Iteration of μ") +
         Iterations(run.recording.iterations) +
         Heading(3, Anchor(job, "repeat"), "How to repeat it") + HowToRepeat(job, server);
}

std::string Differences(const std::vector<RunPart>& runs, const std::string& overlay) {
  if (runs.size() == 1) return "";
  std::vector<v1::Job> jobs;
  for (const RunPart& run : runs) jobs.push_back(run.recording.job);
  return Heading(2, "differences", "Where they differ") + ComparisonHtml(Compare(jobs, {})) +
         (overlay.empty() ? "" : fmt::format("<figure>{}</figure>\n", overlay));
}

}  // namespace

std::string ReportPage(const std::vector<RunPart>& runs, const std::string& overlay,
                       const std::string& server) {
  std::string body = Contents(runs);
  for (const RunPart& run : runs) body += Section(run, server);
  body += Differences(runs, overlay);
  const std::string& title = runs.front().recording.job.scenario().title();
  return HtmlPage(runs.size() > 1 ? fmt::format("Report of {} runs", runs.size())
                  : title.empty() ? runs.front().recording.job.name()
                                  : title,
                  body);
}

}  // namespace contact::cli
