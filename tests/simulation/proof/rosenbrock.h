#pragma once

#include <Eigen/Dense>

namespace contact::testing {

/// A step of Rosenbrock's method RODAS, of order 4 with an error of order 3, L-stable, for y' =
/// f(y, t): Hairer and Wanner, Solving Ordinary Differential Equations II, IV.7.
struct RosenbrockStep {
  Eigen::VectorXd reached, error;

  /// `slopes(y, t)` is f; j = ∂f/∂y and by_time = ∂f/∂t at its start.
  template <class Slopes>
  void Take(const Slopes& slopes, const Eigen::VectorXd& y, double t, double h,
            const Eigen::MatrixXd& j, const Eigen::VectorXd& by_time) {
    const auto unit = Eigen::MatrixXd::Identity(y.size(), y.size());
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(unit / (0.25 * h) - j);
    const Eigen::VectorXd g1 = lu.solve(slopes(y, t) + 0.25 * h * by_time);
    const Eigen::VectorXd g2 =
        lu.solve(slopes(y + 1.544 * g1, t + 0.386 * h) - 0.1043 * h * by_time - 5.6688 / h * g1);
    const Eigen::VectorXd g3 =
        lu.solve(slopes(y + 0.9466785280815826 * g1 + 0.2557011698983284 * g2, t + 0.21 * h) +
                 0.1035 * h * by_time - (2.430093356833875 * g1 + 0.2063599157091915 * g2) / h);
    const Eigen::VectorXd g4 = lu.solve(
        slopes(y + 3.314825187068521 * g1 + 2.896124015972201 * g2 + 0.9986419139977817 * g3,
               t + 0.63 * h) +
        0.03620000000000023 * h * by_time -
        (0.1073529058151375 * g1 + 9.594562251023355 * g2 + 20.47028614809616 * g3) / h);
    reached = y + 1.221224509226641 * g1 + 6.019134481288629 * g2 + 12.53708332932087 * g3 -
              0.6878860361058950 * g4;
    const Eigen::VectorXd g5 =
        lu.solve(slopes(reached, t + h) + (7.496443313967647 * g1 - 10.24680431464352 * g2 -
                                           33.99990352819905 * g3 + 11.70890893206160 * g4) /
                                              h);
    reached += g5;
    error = lu.solve(slopes(reached, t + h) +
                     (8.083246795921522 * g1 - 7.981132988064893 * g2 - 31.52159432874371 * g3 +
                      16.31930543123136 * g4 - 6.058818238834054 * g5) /
                         h);
    reached += error;
  }
};

}  // namespace contact::testing
