#include "cli/figures/run/iteration_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

constexpr double kLeastResidual = 1e-17;

// The curves of one panel, a curve for each cycle in the order in which the cycles come.
class CycleCurves {
 public:
  void Add(const v1::Iteration::Unknown& unknown, int pass, double value) {
    const auto [place, added] =
        places_.try_emplace({unknown.contact(), unknown.number()}, curves_.size());
    if (added) {
      curves_.push_back({fmt::format("{} #{}", unknown.contact(), unknown.number()),
                         static_cast<int>(curves_.size()), Figure::Mark::kLinePoints});
    }
    curves_[place->second].x.push_back(pass);
    curves_[place->second].y.push_back(value);
  }
  /// True if the values are > 0 and some are thousands of times as large as others, so that these
  /// would lie on the axis.
  bool HaveManySizes() const {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const Figure::Curve& curve : curves_) {
      const auto [least, most] = std::ranges::minmax(curve.y);
      low = std::min(low, least);
      high = std::max(high, most);
    }
    return low > 0 && high > 1000 * low;
  }
  std::vector<Figure::Curve> Take() { return std::move(curves_); }

 private:
  std::map<std::pair<std::string, int>, std::size_t> places_;
  std::vector<Figure::Curve> curves_;
};

}  // namespace

std::vector<Figure::Panel> IterationPanels(const std::vector<v1::Iteration>& iterations) {
  if (iterations.empty()) throw Failure(ExitCode::kUsage, "this run iterated nothing");
  const int episode = std::ranges::max(iterations, {}, &v1::Iteration::number).episode();
  bool only = true;
  CycleCurves mu;
  CycleCurves residual;
  for (const v1::Iteration& pass : iterations) {
    only = only && pass.episode() == episode;
    if (pass.episode() != episode) continue;
    for (const auto& unknown : pass.unknowns()) {
      mu.Add(unknown, pass.number(), unknown.mu());
      residual.Add(unknown, pass.number(), std::max(std::abs(unknown.residual()), kLeastResidual));
    }
  }
  const std::string x_label = only ? "pass" : fmt::format("pass of episode {}", episode);
  const bool log_mu = mu.HaveManySizes();
  return {{.x_label = x_label,
           .y_label = "μ [N·s/m^(n+1)]",
           .counted_x = true,
           .log_y = log_mu,
           .curves = mu.Take()},
          {.x_label = x_label,
           .y_label = "|W_r/W_c + ε²| [1]",
           .counted_x = true,
           .log_y = true,
           .curves = residual.Take()}};
}

}  // namespace contact::cli
