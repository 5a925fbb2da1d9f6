#include "cli/text/render_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/style.h"

namespace contact::cli {

double PartDone(const v1::Progress& progress) {
  if (progress.cells() > 0) return static_cast<double>(progress.cells_done()) / progress.cells();
  if (progress.end_time_s() <= 0) return 0;
  return std::clamp(progress.time_s() / progress.end_time_s(), 0.0, 1.0);
}

std::optional<double> TimeToGo(double part_done, double elapsed_s) {
  if (part_done <= 0.01) return std::nullopt;
  return elapsed_s * (1 - part_done) / part_done;
}

std::string TimeLeft(double part_done, double elapsed_s) {
  const std::optional<double> left = TimeToGo(part_done, elapsed_s);
  return left ? fmt::format(", {} left", Seconds(*left)) : "";
}

std::string ProgressWords(const v1::Progress& progress, double elapsed_s) {
  const double done = PartDone(progress);
  const std::string& busy = progress.busy_with();
  return fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} s, {}, {}{}{}", 100 * done, progress.time_s(),
                     progress.end_time_s(), Count(progress.cycles(), "cycle", "cycles"),
                     Count(progress.iterations(), "iteration", "iterations"),
                     TimeLeft(done, elapsed_s), busy.empty() ? "" : "; busy: " + OneLine(busy));
}

std::string RenderProgress(const v1::Progress& progress, double elapsed_s, int width, bool utf8) {
  constexpr int kBar = 24;
  const int filled = static_cast<int>(std::lround(PartDone(progress) * kBar));
  std::string bar;
  for (int i = 0; i < kBar; ++i) bar += i < filled ? (utf8 ? "━" : "#") : (utf8 ? "─" : "-");
  const std::string words = ProgressWords(progress, elapsed_s);
  if (width <= 0 || Width(words) + kBar + 1 <= width) return bar + " " + words;
  return Cut(words, width);
}

}  // namespace contact::cli
