#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace contact::testing {

/// A step of the explicit midpoint rule in 2, 4, … 12 parts, extrapolated to order 12, with an
/// error of order 10, for y' = f(y, t): Gragg, Bulirsch and Stoer. Its error is seen also where f
/// depends on t only, which those of embedded Fehlberg methods are not.
class ExtrapolatedMidpoint {
 public:
  std::vector<double> reached, error;

  /// `slopes(y, dy, t)` sets dy to f.
  template <class Slopes>
  void Take(const Slopes& slopes, const std::vector<double>& y, double t, double h) {
    start_.resize(y.size()), slope_.resize(y.size());
    slopes(y, start_, t);
    for (std::size_t row = 0; row < kRows; ++row) {
      Parts(slopes, y, t, h, 2 * (row + 1), table_[row]);
      // Aitken and Neville, in powers of the square of a part.
      for (std::size_t column = row; column-- > 0;) {
        const double ratio = static_cast<double>(row + 1) / static_cast<double>(column + 1);
        for (std::size_t i = 0; i < y.size(); ++i) {
          table_[column][i] = table_[column + 1][i] +
                              (table_[column + 1][i] - table_[column][i]) / (ratio * ratio - 1);
        }
      }
    }
    reached = table_[0];
    error.resize(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) error[i] = table_[0][i] - table_[1][i];
  }

 private:
  static constexpr std::size_t kRows = 6;

  template <class Slopes>
  void Parts(const Slopes& slopes, const std::vector<double>& y, double t, double h,
             std::size_t parts, std::vector<double>& to) {
    const double part = h / static_cast<double>(parts);
    before_ = y, to = y;
    for (std::size_t i = 0; i < y.size(); ++i) to[i] += part * start_[i];
    for (std::size_t k = 1; k < parts; ++k) {
      slopes(to, slope_, t + static_cast<double>(k) * part);
      for (std::size_t i = 0; i < y.size(); ++i) before_[i] += 2 * part * slope_[i];
      before_.swap(to);
    }
    // Gragg's smoothing: without it nothing looks at the end of the step.
    slopes(to, slope_, t + h);
    for (std::size_t i = 0; i < y.size(); ++i) to[i] = (before_[i] + to[i] + part * slope_[i]) / 2;
  }

  std::array<std::vector<double>, kRows> table_;
  std::vector<double> start_, slope_, before_;
};

}  // namespace contact::testing
