#include "cli/text/render_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/text/convergence.h"
#include "cli/text/render_groups.h"
#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostBodies = 40;

// How far the job is, in parts that are not broken between lines.
std::vector<std::string> Extent(const v1::Job& job) {
  const v1::Progress& progress = job.progress();
  if (job.has_summary()) {
    return {Seconds(job.summary().time_reached_s()) + " simulated, ",
            Count(std::max<std::int64_t>(job.summary().cycles(), job.cycles_size()), "cycle",
                  "cycles") +
                ", ",
            Count(job.summary().iterations(), "iteration", "iterations") + ", ",
            Seconds(job.summary().wall_time_s()) + " wall"};
  }
  if (progress.cells() > 0) {
    return {
        fmt::format("{} of {}, ", progress.cells_done(), Count(progress.cells(), "cell", "cells")),
        fmt::format("{} failed, ", progress.cells_failed()),
        fmt::format("{} not converged", progress.cells_not_converged())};
  }
  if (progress.end_time_s() <= 0) return {};
  return {fmt::format("{} of {} simulated, ", Seconds(progress.time_s()),
                      Seconds(progress.end_time_s())),
          Count(progress.cycles(), "cycle", "cycles")};
}

std::string Title(const v1::Job& job, const Style& style) {
  std::vector<std::string> parts = {Paint(job.name(), Tone::kStrong, style) + "  ",
                                    StateText(job.state(), job.state_reason(), style)};
  const std::vector<std::string> extent = Extent(job);
  if (!extent.empty()) parts.back() += "  ";
  parts.insert(parts.end(), extent.begin(), extent.end());
  const std::string& title = TitleOf(job);
  return fmt::format("{}\n", fmt::join(Fold(parts, style.width), "\n")) +
         (title.empty() ? "" : Wrap(OneLine(title) + "\n", style));
}

// A line with what keeps a run of many steps busy.
std::string Busy(const v1::Job& job) {
  const std::string& busy = job.progress().busy_with();
  return busy.empty() || job.state() != v1::Job::RUNNING ? "" : "busy: " + OneLine(busy) + "\n";
}

double InSeconds(const google::protobuf::Duration& span) {
  return static_cast<double>(span.seconds()) + span.nanos() / 1e9;
}

// What people say of the job: its labels, and each line of its note.
std::string Remarks(const v1::Job& job) {
  std::string text = job.labels().empty() ? "" : "labels: " + OneLine(LabelsText(job)) + "\n";
  const char* begin = "note: ";
  std::istringstream note(job.note());
  for (std::string line; std::getline(note, line); begin = "      ") {
    text += begin + OneLine(line) + "\n";
  }
  return text;
}

// A line with priority, budget and time to live, as far as the user set them.
std::string RequestedOptions(const v1::Job& job) {
  std::vector<std::string> parts;
  if (job.priority() != 0) parts.push_back(fmt::format("priority {}", job.priority()));
  const v1::Budget& budget = job.budget();
  if (budget.has_wall_time()) {
    parts.push_back(fmt::format("budget {} wall", Seconds(InSeconds(budget.wall_time()))));
  }
  if (budget.steps() > 0) parts.push_back("budget " + Count(budget.steps(), "step", "steps"));
  if (budget.output_bytes() > 0) {
    parts.push_back("budget " + Count(budget.output_bytes(), "byte", "bytes"));
  }
  if (job.has_expire_time()) {
    parts.push_back(fmt::format("kept until {} UTC", Instant(job.expire_time())));
  } else if (job.has_time_to_live()) {
    parts.push_back(fmt::format("kept {} after its end", Seconds(InSeconds(job.time_to_live()))));
  }
  return parts.empty() ? "" : fmt::format("{}\n", fmt::join(parts, ", "));
}

std::string Bodies(const v1::Job& job, const Style& style) {
  if (job.final_bodies().empty()) return "";
  Table table({{"BODY"}, {"POSITION [m]", true}, {"VELOCITY [m/s]", true}});
  for (const v1::FinalBody& body : job.final_bodies()) {
    table.Add({body.name(), Digits(body.position_m(), 10), Digits(body.velocity_m_per_s(), 10)});
  }
  Style all = style;
  all.columns.clear();
  return fmt::format("\n{}", table.Text(all, kMostBodies, "… {} more bodies; -o json prints all"));
}

std::string Balances(const v1::Job& job, const Style& style) {
  if (!job.has_summary()) return "";
  const v1::RunSummary& summary = job.summary();
  std::string line = "\n";
  if (job.convergence() != v1::Job::CONVERGENCE_UNSPECIFIED) {
    const bool full = job.convergence() == v1::Job::FULL;
    line += fmt::format("convergence {}; ",
                        Paint(ConvergenceText(job), full ? Tone::kGood : Tone::kWarning, style));
  }
  line += fmt::format(
      "residuals: momentum {}, energy {}, cycle identity {}; {}\n",
      RelativeError(summary.momentum_residual()), RelativeError(summary.energy_residual()),
      RelativeError(summary.worst_identity_residual()), Count(summary.steps(), "step", "steps"));
  return Wrap(line, style);
}

}  // namespace

std::string RenderJob(const v1::Job& job, const Style& style) {
  std::string text = Title(job, style) +
                     Wrap(Busy(job) + RequestedOptions(job) + Remarks(job), style) +
                     ErrorLine(job, style) + RenderLedger(job, style) + RenderGroups(job, style) +
                     Bodies(job, style) + Balances(job, style);
  if (job.has_sweep()) {
    text += fmt::format("cells: contactctl sweep watch {}\n", job.name());
  }
  for (const std::string& warning : job.warnings()) {
    text += Wrap(Paint("warning: ", Tone::kWarning, style) + OneLine(warning) + "\n", style);
  }
  return text;
}

const std::string& TitleOf(const v1::Job& job) {
  return job.title().empty() ? job.scenario().title() : job.title();
}

std::string LabelsText(const v1::Job& job) {
  const std::map<std::string, std::string> sorted(job.labels().begin(), job.labels().end());
  std::vector<std::string> labels;
  for (const auto& [key, value] : sorted) labels.push_back(fmt::format("{}={}", key, value));
  return fmt::format("{}", fmt::join(labels, ", "));
}

std::string StateText(v1::Job::State state, const std::string& reason, const Style& style) {
  const std::string painted = Paint(v1::Job::State_Name(state), ToneOf(state), style);
  return reason.empty() ? painted : fmt::format("{} ({})", painted, reason);
}

std::string ErrorLine(const v1::Job& job, const Style& style) {
  if (!job.has_error()) return "";
  return Wrap(Paint("error: ", Tone::kBad, style) + OneLine(job.error().message()) + "\n", style);
}

Tone ToneOf(v1::Job::State state) {
  if (state == v1::Job::SUCCEEDED) return Tone::kGood;
  if (state == v1::Job::FAILED) return Tone::kBad;
  return state == v1::Job::CANCELLED ? Tone::kWarning : Tone::kPlain;
}

}  // namespace contact::cli
