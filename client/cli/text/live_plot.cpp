#include "cli/text/live_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "base/spelling.h"
#include "cli/base/dot_canvas.h"
#include "cli/base/number.h"
#include "cli/base/style.h"

namespace contact::cli {
namespace {

const SampleColumn* Find(const std::vector<SampleColumn>& columns, const std::string& name) {
  const auto found = std::ranges::find(columns, name, &SampleColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

int Scaled(double value, double low, double high, int dots) {
  const double part = high > low ? (value - low) / (high - low) : 0.5;
  return static_cast<int>(std::lround(part * (dots - 1)));
}

// Adds the lines of one channel: a title, and the first `shown` samples as a curve below it. The
// axes are those of all samples, so that a replay does not rescale them.
void AddPanel(const std::vector<double>& time, const SampleColumn& column, std::size_t shown,
              int columns, int rows, bool braille, std::vector<std::string>* lines) {
  const auto [low, high] = std::ranges::minmax(column.values);
  const std::string now = shown > 0 ? Digits(column.values[shown - 1], 5) : "-";
  lines->push_back(Cut(fmt::format("{} [{}]  {} .. {}  now {}", column.name, column.unit,
                                   Digits(low, 5), Digits(high, 5), now),
                       columns));
  DotCanvas canvas(columns, rows - 1, braille);
  int last_x = 0;
  int last_y = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    const int x = Scaled(time[i], time.front(), time.back(), canvas.width());
    const int y = canvas.height() - 1 - Scaled(column.values[i], low, high, canvas.height());
    canvas.Line(i == 0 ? x : last_x, i == 0 ? y : last_y, x, y);
    last_x = x;
    last_y = y;
  }
  for (std::string& row : canvas.Rows()) lines->push_back(std::move(row));
}

PlotSize SizeOf(std::FILE* terminal) {
  winsize size{};
  if (ioctl(fileno(terminal), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return {size.ws_col, size.ws_row};
}

}  // namespace

std::vector<std::string> RenderLivePlot(const std::vector<SampleColumn>& columns,
                                        const std::vector<std::string>& channels, double until,
                                        const PlotSize& size, bool braille) {
  std::vector<std::string> lines;
  const SampleColumn* time = Find(columns, "time");
  const int rows = std::max(2, (size.rows - 1) / static_cast<int>(channels.size()));
  std::size_t shown = 0;
  if (time != nullptr) {
    shown = static_cast<std::size_t>(std::ranges::upper_bound(time->values, until) -
                                     time->values.begin());
  }
  for (const std::string& channel : channels) {
    const SampleColumn* column = Find(columns, channel);
    if (time == nullptr || column == nullptr || column->values.empty()) {
      lines.push_back(Cut(channel + "  nothing yet", size.columns));
    } else {
      AddPanel(time->values, *column, shown, size.columns, rows, braille, &lines);
    }
  }
  if (shown > 0) lines.push_back(Cut("t = " + Seconds(time->values[shown - 1]), size.columns));
  const auto most = static_cast<std::size_t>(std::max(size.rows, 1));
  if (lines.size() > most) lines.resize(most);
  return lines;
}

LivePlot::LivePlot(std::FILE* terminal, Options options)
    : terminal_(terminal), options_(std::move(options)) {
  fmt::print(terminal_, "\x1b[?1049h\x1b[?25l");  // Second screen, no cursor.
}

LivePlot::~LivePlot() { Write(fmt::format("\x1b[?25h\x1b[?1049l{}\n", fmt::join(Plot(), "\n"))); }

void LivePlot::OnEvent(const v1::Event& event) {
  Recorder::OnEvent(event);
  if (!event.has_frame_chunk()) return;
  stale_ = true;
  for (const auto& column : event.frame_chunk().columns()) names_.push_back(column.name());
  if (event.frame_chunk().columns_follow()) return;
  const std::vector<std::string> all = std::exchange(names_, {});
  const std::vector<std::string_view> names(all.begin(), all.end());
  for (const std::string& channel : options_.channels) {
    if (std::ranges::find(names, channel) != names.end()) continue;
    mistake_ = WithHint(fmt::format("{} is no channel of this job", Quoted(channel)),
                        DidYouMean(channel, names));
  }
}

void LivePlot::OnTick() {
  if (stale_ && !has_holes()) columns_ = Columns();
  stale_ = false;
  if (!start_ && !columns_.empty()) start_ = std::chrono::steady_clock::now();
  Write(fmt::format("\x1b[H{}\x1b[K\x1b[J", fmt::join(Plot(), "\x1b[K\r\n")));
}

void LivePlot::Write(const std::string& text) {
  std::fputs(text.c_str(), terminal_);
  std::fflush(terminal_);
}

bool LivePlot::replaying() const {
  const SampleColumn* time = Find(columns_, "time");
  return options_.replay > 0 && time != nullptr && !time->values.empty() &&
         Until() < time->values.back();
}

double LivePlot::Until() const {
  if (options_.replay <= 0) return std::numeric_limits<double>::infinity();
  if (!start_) return 0;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - *start_;
  return elapsed.count() * options_.replay;
}

std::vector<std::string> LivePlot::Plot() const {
  return RenderLivePlot(columns_, options_.channels, Until(), SizeOf(terminal_), options_.braille);
}

}  // namespace contact::cli
