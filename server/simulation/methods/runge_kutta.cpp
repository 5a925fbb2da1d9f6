#include "simulation/methods/runge_kutta.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace contact {
namespace {

// The slopes that the terms above the cubic take, and what each term takes of them.
constexpr std::array<int, 12> kDenseSlopes = {0, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr double kDense[4][kDenseSlopes.size()] = {
    {-0.84289382761090128651353491142e1, 0.56671495351937776962531783590,
     -0.30689499459498916912797304727e1, 0.23846676565120698287728149680e1,
     0.21170345824450282767155149946e1, -0.87139158377797299206789907490,
     0.22404374302607882758541771650e1, 0.63157877876946881815570249290,
     -0.88990336451333310820698117400e-1, 0.18148505520854727256656404962e2,
     -0.91946323924783554000451984436e1, -0.44360363875948939664310572000e1},
    {0.10427508642579134603413151009e2, 0.24228349177525818288430175319e3,
     0.16520045171727028198505394887e3, -0.37454675472269020279518312152e3,
     -0.22113666853125306036270938578e2, 0.77334326684722638389603898808e1,
     -0.30674084731089398182061213626e2, -0.93321305264302278729567221706e1,
     0.15697238121770843886131091075e2, -0.31139403219565177677282850411e2,
     -0.93529243588444783865713862664e1, 0.35816841486394083752465898540e2},
    {0.19985053242002433820987653617e2, -0.38703730874935176555105901742e3,
     -0.18917813819516756882830838328e3, 0.52780815920542364900561016686e3,
     -0.11573902539959630126141871134e2, 0.68812326946963000169666922661e1,
     -0.10006050966910838403183860980e1, 0.77771377980534432092869265740,
     -0.27782057523535084065932004339e1, -0.60196695231264120758267380846e2,
     0.84320405506677161018159903784e2, 0.11992291136182789328035130030e2},
    {-0.25693933462703749003312586129e2, -0.15418974869023643374053993627e3,
     -0.23152937917604549567536039109e3, 0.35763911791061412378285349910e3,
     0.93405324183624310003907691704e2, -0.37458323136451633156875139351e2,
     0.10409964950896230045147246184e3, 0.29840293426660503153343363579e2,
     -0.43533456590011143754432175058e2, 0.96324553959188282948394950600e2,
     -0.39177261675615439165231486172e2, -0.14972683625798562581422125276e3},
};

}  // namespace

double StepTime::Theta(double t) const {
  // The root of (1 − w) θ² + w θ = x in the form that does not cancel.
  const double x = (t - start) / h;
  const double root = std::sqrt(std::max(0.0, warp * warp + 4 * (1 - warp) * x));
  return warp + root > 0 ? 2 * x / (warp + root) : 0;
}

void RungeKutta::Resize(Eigen::Index size, Eigen::Index coupled) {
  coupled_ = coupled;
  y0.resize(size);
  y1.resize(size);
  slope0.resize(size);
  slope1.resize(size);
  stage_.resize(size);
  k_.resize(size, 16);
  dense_.setZero(size, 7);
}

void RungeKutta::Errors(Eigen::Index first, Eigen::Index rows_wanted, double* error5,
                        double* error3) const {
  const std::ptrdiff_t n = size();
  const double* k = k_.data() + first;
  const auto estimate = [=](auto rows, std::ptrdiff_t i) __attribute__((always_inline)) {
    const auto slope = [=](int stage) { return rows(k + stage * n + i); };
    rows(error5 + i) =
        0.1312004499419488073250102996e-1 * slope(0) - 0.1225156446376204440720569753e1 * slope(5) -
        0.4957589496572501915214079952 * slope(6) + 0.1664377182454986536961530415e1 * slope(7) -
        0.3503288487499736816886487290 * slope(8) + 0.3341791187130174790297318841 * slope(9) +
        0.8192320648511571246570742613e-1 * slope(10) -
        0.2235530786388629525884427845e-1 * slope(11);
    rows(error3 + i) =
        (5.42937341165687622380535766363e-2 - 0.244094488188976377952755905512) * slope(0) +
        4.45031289275240888144113950566 * slope(5) + 1.89151789931450038304281599044 * slope(6) -
        5.8012039600105847814672114227 * slope(7) +
        (3.1116436695781989440891606237e-1 - 0.733846688281611857341361741547) * slope(8) -
        1.52160949662516078556178806805e-1 * slope(9) +
        2.01365400804030348374776537501e-1 * slope(10) +
        (4.47106157277725905176885569043e-2 - 0.220588235294117647058823529412e-1) * slope(11);
  };
  WithCount<2, 4, 6>(rows_wanted, [&](auto count) { InRows(count, estimate); });
}

// The cubic through value and slope at both ends, to which the others add.
void RungeKutta::PrepareCubic(double h) {
  dense_.col(0) = y1 - y0;
  dense_.col(1) = h * k_.col(0) - dense_.col(0);
  dense_.col(2) = 2 * dense_.col(0) - h * (k_.col(0) + k_.col(12));
}

void RungeKutta::PrepareCoefficients(double h) {
  const std::ptrdiff_t n = size();
  const double* k = k_.data();
  double* dense = dense_.data();
  InRows(n, [=](auto rows, std::ptrdiff_t i) {
    std::array<typename decltype(rows)::Array, 4> sums;
    for (std::size_t c = 0; c < sums.size(); ++c) sums[c] = kDense[c][0] * rows(k + i);
    for (std::size_t j = 1; j < kDenseSlopes.size(); ++j) {
      const typename decltype(rows)::Array slope = rows(k + kDenseSlopes[j] * n + i);
      for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += kDense[c][j] * slope;
    }
    for (std::size_t c = 0; c < sums.size(); ++c) {
      rows(dense + (3 + static_cast<std::ptrdiff_t>(c)) * n + i) = h * sums[c];
    }
  });
}

void RungeKutta::Interpolate(double theta, Vector* y) const {
  const std::ptrdiff_t n = size();
  const double* dense = dense_.data();
  const double* start = y0.data();
  y->resize(n);
  double* to = y->data();
  const double rest = 1 - theta;
  InRows(n, [=](auto rows, std::ptrdiff_t i) {
    // Powers of θ and 1 − θ in turn, from the inside out.
    typename decltype(rows)::Array sum = rows(dense + 6 * n + i) * theta;
    for (int c = 5; c >= 0; --c) {
      sum = (sum + rows(dense + c * n + i)) * (c % 2 == 0 ? theta : rest);
    }
    rows(to + i) = rows(start + i) + sum;
  });
}

}  // namespace contact
