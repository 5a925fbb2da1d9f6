#include "cli/text/comparison/signal_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The value of largest size.
double PeakOf(const std::vector<double>& values) {
  double peak = 0;
  for (const double value : values) {
    if (std::abs(value) > std::abs(peak)) peak = value;
  }
  return peak;
}

// A recorded channel as a function of time.
class Curve {
 public:
  Curve(const Recording& run, const std::string& channel)
      : times_(run.Find("time")->values), values_(run.Find(channel)->values) {}

  // The value between two samples; nothing outside of the run.
  std::optional<double> At(double time) const {
    if (!Holds(time)) return std::nullopt;
    const std::size_t next = From(time);
    if (next == 0) return values_.front();
    const double before = times_[next - 1];
    const double part = (time - before) / (times_[next] - before);
    return std::lerp(values_[next - 1], values_[next], part);
  }

  // The value of largest size in an interval of time.
  double Peak(double low, double high) const {
    double peak = 0;
    const auto take = [&peak](double value) {
      if (std::abs(value) > std::abs(peak)) peak = value;
    };
    for (const double end : {low, high}) take(At(end).value_or(0));
    for (std::size_t i = From(low); i < times_.size() && times_[i] <= high; ++i) take(values_[i]);
    return peak;
  }

 private:
  bool Holds(double time) const {
    return !times_.empty() && time >= times_.front() && time <= times_.back();
  }

  // The first sample that is not before a time.
  std::size_t From(double time) const {
    const auto found = std::ranges::lower_bound(times_, time);
    return static_cast<std::size_t>(found - times_.begin());
  }

  const std::vector<double>& times_;
  const std::vector<double>& values_;
};

// The mean squared deviation of one signal, relative to its peak, as a function of the shift.
class Misfit {
 public:
  Misfit(const MeasuredSignal& signal, const Recording& run)
      : signal_(signal), curve_(run, signal.channel), peak_(PeakOf(signal.values)) {}

  // Infinite if less than half of the points lie within the run.
  double At(double shift) const {
    // As many points as decide; a recorder may have millions.
    constexpr std::size_t kMostPoints = 4000;
    const std::size_t step = signal_.times.size() / kMostPoints + 1;
    double sum = 0;
    std::size_t inside = 0, all = 0;
    for (std::size_t i = 0; i < signal_.times.size(); i += step, ++all) {
      const auto simulated = curve_.At(signal_.times[i] + shift);
      if (!simulated) continue;
      ++inside;
      sum += std::pow(signal_.values[i] - *simulated, 2);
    }
    if (inside == 0 || 2 * inside < all) return kInfinite;
    return sum / static_cast<double>(inside) / (peak_ == 0 ? 1 : peak_ * peak_);
  }

 private:
  const MeasuredSignal& signal_;
  const Curve curve_;
  const double peak_;
};

// The place of the least value of f between two ends, by golden sections.
template <class F>
double Least(F f, double low, double high) {
  constexpr int kSections = 60;  // Of 0.618: to the last digits of a double.
  constexpr double kPart = 1 / std::numbers::phi;
  double left = high - kPart * (high - low), right = low + kPart * (high - low);
  double at_left = f(left), at_right = f(right);
  for (int i = 0; i < kSections; ++i) {
    if (at_left <= at_right) {
      high = right, right = left, at_right = at_left;
      at_left = f(left = high - kPart * (high - low));
    } else {
      low = left, left = right, at_left = at_right;
      at_right = f(right = low + kPart * (high - low));
    }
  }
  return at_left <= at_right ? left : right;
}

SignalComparison::Row RowOf(const MeasuredSignal& signal, const Recording& run, double shift,
                            const SignalTolerance& tolerance) {
  const Curve curve(run, signal.channel);
  SignalComparison::Row row{.channel = signal.channel, .unit = signal.unit};
  double first = kInfinite, last = -kInfinite, squares = 0;
  for (std::size_t i = 0; i < signal.times.size(); ++i) {
    const double time = signal.times[i];
    const auto simulated = curve.At(time + shift);
    ++(simulated ? row.points : row.outside);
    if (!simulated) continue;
    const double deviation = signal.values[i] - *simulated;
    squares += deviation * deviation;
    if (row.points == 1 || std::abs(deviation) > std::abs(row.largest)) {
      row.largest = deviation;
      row.largest_time = time;
    }
    if (std::abs(signal.values[i]) > std::abs(row.measured_peak)) {
      row.measured_peak = signal.values[i];
    }
    first = std::min(first, time), last = std::max(last, time);
  }
  if (row.points == 0) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("no measured point of {} lies within the run; --shift moves them, "
                              "--fit-shift looks for the shift",
                              signal.channel));
  }
  row.rms = std::sqrt(squares / static_cast<double>(row.points));
  row.simulated_peak = curve.Peak(first + shift, last + shift);
  row.allowed = std::max(tolerance.absolute, tolerance.relative * std::abs(row.measured_peak));
  return row;
}

}  // namespace

bool SignalComparison::Row::Holds() const { return std::abs(largest) <= allowed; }

bool SignalComparison::Holds() const {
  return std::ranges::all_of(rows, [](const Row& row) { return row.Holds(); });
}

double FitShift(const std::vector<MeasuredSignal>& signals, const Recording& run,
                const TimeRange& range) {
  constexpr int kShifts = 1000;
  std::vector<Misfit> misfits;
  for (const MeasuredSignal& signal : signals) misfits.emplace_back(signal, run);
  const auto misfit = [&misfits](double shift) {
    double sum = 0;
    for (const Misfit& each : misfits) sum += each.At(shift);
    return sum;
  };
  double best = range.low, least = kInfinite;
  for (int i = 0; i <= kShifts; ++i) {
    const double shift = std::lerp(range.low, range.high, static_cast<double>(i) / kShifts);
    const double found = misfit(shift);
    if (found < least) best = shift, least = found;
  }
  if (least == kInfinite) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--fit-shift {:g}:{:g}: at no shift half of the measured points lie "
                              "within the run",
                              range.low, range.high));
  }
  const double step = (range.high - range.low) / kShifts;
  const double refined =
      Least(misfit, std::max(range.low, best - step), std::min(range.high, best + step));
  return misfit(refined) < least ? refined : best;
}

SignalComparison Compare(const std::vector<MeasuredSignal>& signals, const Recording& run,
                         double shift, const SignalTolerance& common,
                         const std::map<std::string, SignalTolerance>& own) {
  SignalComparison comparison{.job = run.job.name(), .file = {}, .shift = shift};
  for (const MeasuredSignal& signal : signals) {
    const auto found = own.find(signal.channel);
    comparison.rows.push_back(
        RowOf(signal, run, shift, found == own.end() ? common : found->second));
  }
  return comparison;
}

}  // namespace contact::cli
