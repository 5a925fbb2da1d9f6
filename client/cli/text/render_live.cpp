#include "cli/text/render_live.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/link/printable_answers.h"
#include "cli/text/render_groups.h"
#include "cli/text/render_job.h"
#include "cli/text/render_ledger.h"
#include "cli/text/render_progress.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kBeforeProgress = 200ms;  // Most runs end sooner and need no bar.

// What was sent may be as it is, for JSON; rows are for people in any case.
template <class Message>
Message PrintableCopy(Message sent) {
  MakePrintable(&sent);
  return sent;
}

constexpr int kRow = 80;           // Of all columns but the bracket.
constexpr int kWithBracket = 120;  // Of all columns.
constexpr int kWithRestitution = 60;

// The cells of a row, in the order of the columns.
struct Cells {
  std::string episode, n, contact, mu, out, error, update, bracket;
};

// As many columns as the terminal has room for.
std::string Row(const Cells& cells, const Style& style) {
  const bool narrow = style.width > 0 && style.width < kRow;
  const bool small = narrow && style.width < kWithRestitution;
  if (small) {
    return fmt::format("{}  {} {} {}", Pad(cells.n, -3), Pad(OneLine(cells.contact, 10), 10),
                       Pad(cells.mu, -12), Pad(cells.error, -9));
  }
  const std::string row = fmt::format(
      "{}  {} {} {} {}", Pad(cells.n, -3), Pad(OneLine(cells.contact, narrow ? 14 : 0), 14),
      Pad(cells.mu, -15), Pad(cells.out, -13), Pad(cells.error, -9));
  if (narrow) return row;
  const std::string all = fmt::format("{} {}  {}", Pad(cells.episode, -7), row, cells.update);
  return style.wide || style.width >= kWithBracket ? Pad(all, kRow + 2) + cells.bracket : all;
}

// The interval in which μ is known to lie; a side that is not known yet is `-`.
std::string Bracket(const v1::Iteration::Unknown& unknown) {
  const auto side = [](double mu) { return mu == 0 ? "-" : Digits(mu, 9); };
  return fmt::format("[{}, {}]", side(unknown.bracket_low()), side(unknown.bracket_high()));
}

std::string NextStep(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown) {
  if (iteration.accepted()) return "accepted";
  if (unknown.update() == v1::Iteration::UPDATE_UNSPECIFIED) return "-";
  return v1::Iteration::Update_Name(unknown.update());
}

}  // namespace

LiveView::LiveView(Options options) : options_(std::move(options)) {
  options_.job = PrintableLines(options_.job);
  if (options_.progress == ProgressForm::kJson) json_.emplace(options_.messages, options_.job);
}

LiveView::~LiveView() { EraseProgress(); }

void LiveView::OnSnapshot(const v1::Job& job) {
  if (job.has_progress() && !IsFinal(job.state())) progress_ = PrintableCopy(job.progress());
  if (job.has_progress() && json_) json_->Update(job.progress());
}

void LiveView::OnEvent(const v1::Event& sent) {
  if (sent.has_frame_chunk()) return;  // Frames are for programs.
  const v1::Event event = PrintableCopy(sent);
  switch (event.payload_case()) {
    case v1::Event::kIteration:
      return ShowIteration(event.iteration());
    case v1::Event::kGroupGrowth:
      return ShowGrowth(event.group_growth());
    case v1::Event::kCycle:
      return ShowCycle(event.cycle());
    case v1::Event::kGroup:
      return ShowGroup(event.group());
    case v1::Event::kStateChanged:
      return ShowState(event.state_changed());
    case v1::Event::kLogEntry:
      return ShowLogEntry(event.log_entry());
    case v1::Event::kAttemptStarted:
      return ShowAttempt(event.attempt_started());
    case v1::Event::kProgress:
      progress_ = event.progress();
      if (json_) json_->Update(*progress_);
      return;
    default:  // A newer server may send kinds that are unknown here.
      return;
  }
}

void LiveView::OnLost(const std::string& why) {
  Write(options_.messages, fmt::format("connection lost ({}); trying again", why));
}

void LiveView::OnRegained() { Write(options_.messages, "connected again"); }

void LiveView::Write(std::FILE* stream, const std::string& line) {
  EraseProgress();
  std::fputs((line + "\n").c_str(), stream);
  std::fflush(stream);
}

void LiveView::ShowIteration(const v1::Iteration& iteration) {
  for (const v1::Iteration::Unknown& unknown : iteration.unknowns()) {
    ++iterations_;
    if (TooMany()) {
      if (iterations_ == options_.most_iterations + 1) {
        Write(options_.rows,
              fmt::format("… more iterations; contactctl watch {} shows all", options_.job));
      }
      continue;
    }
    if (!std::exchange(header_shown_, true)) {
      Write(options_.rows,
            Paint(IterationHeader(options_.rows_style), Tone::kFaint, options_.rows_style));
    }
    Write(options_.rows,
          Paint(IterationRow(iteration, unknown, options_.rows_style),
                iteration.accepted() ? Tone::kStrong : Tone::kPlain, options_.rows_style));
  }
}

void LiveView::ShowCycle(const v1::Cycle& cycle) {
  if (!options_.cycles) return;
  Write(options_.rows,
        fmt::format("{} cycle {}: {} to {}, {} from {} s to {} s, ε {}", cycle.contact(),
                    cycle.number(), v1::Cycle::Kind_Name(cycle.kind()),
                    v1::Cycle::End_Name(cycle.end()),
                    Paint(v1::Cycle::Status_Name(cycle.status()), ToneOf(cycle.status()),
                          options_.rows_style),
                    Digits(cycle.start_time_s(), 7), Digits(cycle.end_time_s(), 7),
                    Digits(RestitutionOf(cycle), 8)));
}

void LiveView::ShowGrowth(const v1::GroupGrowth& growth) {
  if (!TooMany()) Write(options_.rows, GrowthLine(growth));
}

void LiveView::ShowGroup(const v1::Group& group) {
  if (!options_.cycles || !IsNotable(group)) return;
  const std::string certificate = Certificate(group);
  Write(options_.rows, fmt::format("{} group {}, cycle {}: {}, μ {}, ε {}{}{}", group.contact(),
                                   group.number(), CyclesOf(group),
                                   Paint(v1::Cycle::Status_Name(group.status()),
                                         ToneOf(group.status()), options_.rows_style),
                                   Digits(group.mu(), 9), Digits(group.restitution_out(), 8),
                                   certificate.empty() ? "" : "; ", certificate));
}

void LiveView::ShowState(const v1::StateChanged& change) {
  if (!options_.cycles) return;  // The result that is printed at the end says it.
  std::string line = StateText(change.state(), change.state_reason(), options_.rows_style);
  if (change.convergence() == v1::Job::PARTIAL) line += ", convergence PARTIAL";
  if (!change.message().empty()) line += ": " + change.message();
  Write(options_.rows, line);
}

void LiveView::ShowLogEntry(const v1::LogEntry& entry) {
  const bool warning = entry.severity() == v1::LogEntry::WARNING;
  const Tone tone = warning ? Tone::kWarning : Tone::kFaint;
  Write(options_.rows,
        Paint(warning ? "warning: " : "note: ", tone, options_.rows_style) + entry.message());
}

void LiveView::ShowAttempt(const v1::AttemptStarted& start) {
  if (start.has_resume_time_s()) {
    return Write(options_.rows, fmt::format("attempt {} goes on from t = {}; what was recorded "
                                            "before follows again",
                                            start.attempt(), Seconds(start.resume_time_s())));
  }
  if (start.attempt() == 1) return;
  const bool sweep = progress_ && progress_->cells() > 0;
  Write(options_.rows,
        fmt::format("attempt {} {}", start.attempt(),
                    sweep ? "goes on; the cells that were solved are kept" : "starts anew"));
}

void LiveView::OnTick() {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  if (!progress_ || elapsed < kBeforeProgress) return;
  const double seconds = std::chrono::duration<double>(elapsed).count();
  if (options_.progress == ProgressForm::kLines) WriteProgressLine(seconds);
  if (options_.progress != ProgressForm::kBar) return;
  const int width = StyleOf(fileno(options_.messages), "never").width;  // It may have been resized.
  const std::string line =
      RenderProgress(*progress_, seconds, std::max(width - 1, 0), TerminalHasUtf8());
  std::fputs(("\r\x1b[K" + line).c_str(), options_.messages);
  std::fflush(options_.messages);
  drawn_ = true;
}

void LiveView::WriteProgressLine(double elapsed_s) {
  const int tenths = static_cast<int>(10 * PartDone(*progress_));
  if (tenths <= written_tenths_) return;
  written_tenths_ = tenths;
  Write(options_.messages, ProgressWords(*progress_, elapsed_s));
}

void LiveView::EraseProgress() {
  if (!std::exchange(drawn_, false)) return;
  std::fputs("\r\x1b[K", options_.messages);
  std::fflush(options_.messages);
}

std::string IterationHeader(const Style& style) {
  return Row({"EPISODE", "n", "CONTACT", "μ", "ε OUT", "|Δε|/ε", "NEXT", "BRACKET OF μ"}, style);
}

std::string IterationRow(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown,
                         const Style& style) {
  const bool small = style.width > 0 && style.width < kWithRestitution;
  const double error = RestitutionError(unknown.restitution_out(), unknown.restitution_in());
  return Row(
      {fmt::to_string(iteration.episode()), fmt::to_string(iteration.number()), unknown.contact(),
       Digits(unknown.mu(), small ? 6 : 9), Digits(unknown.restitution_out(), 8),
       RelativeError(error), NextStep(iteration, unknown), Bracket(unknown)},
      style);
}

}  // namespace contact::cli
