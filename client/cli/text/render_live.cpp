#include "cli/text/render_live.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/base/number.h"
#include "cli/text/render_job.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kBeforeProgress = 200ms;  // Most runs are over by then.
constexpr int kBar = 24;

std::string Row(const std::string& episode, const std::string& n, const std::string& contact,
                const std::string& mu, const std::string& out, const std::string& error,
                const std::string& update) {
  return fmt::format("{} {}  {} {} {} {}  {}", Pad(episode, -7), Pad(n, -3), Pad(contact, 14),
                     Pad(mu, -15), Pad(out, -13), Pad(error, -9), update);
}

// The interval in which μ is known to lie; a side that is not known yet is `-`.
std::string Bracket(const v1::Iteration::Unknown& unknown) {
  const auto side = [](double mu) { return mu == 0 ? "-" : Digits(mu, 9); };
  return fmt::format("[{}, {}]", side(unknown.bracket_low()), side(unknown.bracket_high()));
}

// What stands to the right of a row in wide tables.
std::string WithBracket(const std::string& row, const std::string& bracket, const Style& style) {
  constexpr int kRow = 82;
  return style.wide ? Pad(row, kRow) + bracket : row;
}

std::string NextStep(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown) {
  if (iteration.accepted()) return "accepted";
  if (unknown.update() == v1::Iteration::UPDATE_UNSPECIFIED) return "-";
  return v1::Iteration::Update_Name(unknown.update());
}

}  // namespace

LiveView::LiveView(std::FILE* rows, const Style& rows_style, std::FILE* messages,
                   const Style& messages_style, Options options)
    : rows_(rows),
      rows_style_(rows_style),
      messages_(messages),
      messages_style_(messages_style),
      options_(std::move(options)) {
  if (options_.progress == ProgressForm::kJson) signals_.emplace(messages_, options_.job);
}

LiveView::~LiveView() { EraseProgress(); }

void LiveView::OnSnapshot(const v1::Job& job) {
  if (job.has_progress() && !IsFinal(job.state())) progress_ = job.progress();
  if (job.has_progress() && signals_) signals_->Hear(job.progress());
}

void LiveView::OnEvent(const v1::Event& event) {
  switch (event.payload_case()) {
    case v1::Event::kIteration:
      return ShowIteration(event.iteration());
    case v1::Event::kCycle:
      return ShowCycle(event.cycle());
    case v1::Event::kStateChanged:
      return ShowState(event.state_changed());
    case v1::Event::kLogEntry: {
      const bool warning = event.log_entry().severity() == v1::LogEntry::WARNING;
      const Tone tone = warning ? Tone::kWarning : Tone::kFaint;
      return Write(rows_, Paint(warning ? "warning: " : "note: ", tone, rows_style_) +
                              event.log_entry().message());
    }
    case v1::Event::kAttemptStarted:
      if (event.attempt_started().attempt() > 1) {
        Write(rows_, fmt::format("attempt {} starts anew", event.attempt_started().attempt()));
      }
      return;
    case v1::Event::kProgress:
      progress_ = event.progress();
      if (signals_) signals_->Hear(*progress_);
      return;
    default:  // Frames are for programs; of kinds to come nothing is known.
      return;
  }
}

void LiveView::OnLost(const std::string& why, std::chrono::milliseconds pause) {
  Write(messages_, fmt::format("connection lost ({}); trying again in {}", why,
                               Seconds(static_cast<double>(pause.count()) / 1e3)));
}

void LiveView::OnTick() { DrawProgress(); }

void LiveView::Write(std::FILE* stream, const std::string& line) {
  EraseProgress();
  std::fputs((line + "\n").c_str(), stream);
  std::fflush(stream);
}

void LiveView::ShowIteration(const v1::Iteration& iteration) {
  for (const v1::Iteration::Unknown& unknown : iteration.unknowns()) {
    ++iterations_;
    if (options_.most_iterations > 0 && iterations_ > options_.most_iterations) {
      if (iterations_ == options_.most_iterations + 1) {
        Write(rows_, fmt::format("… more iterations; contactctl watch {} shows all", options_.job));
      }
      continue;
    }
    if (!std::exchange(header_shown_, true)) {
      const std::string header = Row("EPISODE", "n", "CONTACT", "μ", "ε OUT", "|Δε|/ε", "NEXT");
      Write(rows_,
            Paint(WithBracket(header, "BRACKET OF μ", rows_style_), Tone::kFaint, rows_style_));
    }
    const double error = RestitutionError(unknown.restitution_out(), unknown.restitution_in());
    const std::string row =
        Row(fmt::to_string(iteration.episode()), fmt::to_string(iteration.number()),
            unknown.contact(), Digits(unknown.mu(), 9), Digits(unknown.restitution_out(), 8),
            RelativeError(error), NextStep(iteration, unknown));
    Write(rows_, Paint(WithBracket(row, Bracket(unknown), rows_style_),
                       iteration.accepted() ? Tone::kStrong : Tone::kPlain, rows_style_));
  }
}

void LiveView::ShowCycle(const v1::Cycle& cycle) {
  if (!options_.cycles) return;
  Write(rows_,
        fmt::format(
            "{} cycle {}: {} to {}, {} from {} s to {} s, ε {}", cycle.contact(), cycle.number(),
            v1::Cycle::Kind_Name(cycle.kind()), v1::Cycle::End_Name(cycle.end()),
            Paint(v1::Cycle::Status_Name(cycle.status()), ToneOf(cycle.status()), rows_style_),
            Digits(cycle.start_time_s(), 7), Digits(cycle.end_time_s(), 7),
            Digits(cycle.restitution_out(), 8)));
}

void LiveView::ShowState(const v1::StateChanged& change) {
  if (!options_.cycles) return;  // The result that follows says it.
  std::string line =
      Paint(v1::Job::State_Name(change.state()), ToneOf(change.state()), rows_style_);
  if (!change.state_reason().empty()) line += fmt::format(" ({})", change.state_reason());
  if (change.convergence() == v1::Job::PARTIAL) line += ", convergence PARTIAL";
  if (!change.message().empty()) line += ": " + change.message();
  Write(rows_, line);
}

void LiveView::DrawProgress() {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  if (!progress_ || elapsed < kBeforeProgress) return;
  const double seconds = std::chrono::duration<double>(elapsed).count();
  if (options_.progress == ProgressForm::kLines) TellProgress(seconds);
  if (options_.progress != ProgressForm::kBar) return;
  const int width = StyleOf(fileno(messages_), "never").width;  // It may have been resized.
  const std::string line =
      RenderProgress(*progress_, seconds, std::max(width - 1, 0), TerminalHasUtf8());
  std::fputs(("\r\x1b[K" + line).c_str(), messages_);
  std::fflush(messages_);
  drawn_ = true;
}

void LiveView::TellProgress(double elapsed_s) {
  const int tenths = static_cast<int>(10 * PartDone(*progress_));
  if (tenths <= told_tenths_) return;
  told_tenths_ = tenths;
  Write(messages_, ProgressWords(*progress_, elapsed_s));
}

void LiveView::EraseProgress() {
  if (!std::exchange(drawn_, false)) return;
  std::fputs("\r\x1b[K", messages_);
  std::fflush(messages_);
}

std::string TimeLeft(double part_done, double elapsed_s) {
  const std::optional<double> left = TimeToGo(part_done, elapsed_s);
  return left ? fmt::format(", {} left", Seconds(*left)) : "";
}

std::string ProgressWords(const v1::Progress& progress, double elapsed_s) {
  const double done = PartDone(progress);
  return fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} s, {} cycles, {} iterations{}", 100 * done,
                     progress.time_s(), progress.end_time_s(), progress.cycles(),
                     progress.iterations(), TimeLeft(done, elapsed_s));
}

std::string RenderProgress(const v1::Progress& progress, double elapsed_s, int width, bool utf8) {
  const int filled = static_cast<int>(std::lround(PartDone(progress) * kBar));
  std::string bar;
  for (int i = 0; i < kBar; ++i) bar += i < filled ? (utf8 ? "━" : "#") : (utf8 ? "─" : "-");
  const std::string words = ProgressWords(progress, elapsed_s);
  if (width <= 0 || Width(words) + kBar + 1 <= width) return bar + " " + words;
  return Cut(words, width);
}

}  // namespace contact::cli
