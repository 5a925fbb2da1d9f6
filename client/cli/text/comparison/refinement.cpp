#include "cli/text/comparison/refinement.h"

#include <cmath>

namespace contact::cli {
namespace {

// Below it differences shrink so slowly that the sum of those to come is a guess.
constexpr double kLeastOrder = 0.5;

}  // namespace

double ObservedOrder(double coarse, double middle, double fine, double ratio) {
  const double order = std::log(std::abs((coarse - middle) / (middle - fine))) / std::log(ratio);
  return std::isfinite(order) ? order : std::numeric_limits<double>::quiet_NaN();
}

double Richardson(double middle, double fine, double ratio, double order) {
  return fine + (fine - middle) / (std::pow(ratio, order) - 1);
}

Refinement Refine(double coarse, double middle, double fine, double ratio, double floor) {
  const double first = middle - coarse, second = fine - middle;
  Refinement refinement{.limit = fine, .settles = std::abs(second) <= floor};
  if (refinement.settles || !(std::abs(first) > floor)) return refinement;
  if (std::signbit(first) != std::signbit(second)) return refinement;
  refinement.order = ObservedOrder(coarse, middle, fine, ratio);
  if (!(refinement.order >= kLeastOrder)) return refinement;
  refinement.limit = Richardson(middle, fine, ratio, refinement.order);
  refinement.settles = true;
  return refinement;
}

}  // namespace contact::cli
