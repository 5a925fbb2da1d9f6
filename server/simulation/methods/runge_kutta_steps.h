// The stages of RungeKutta; included by runge_kutta.h only. Table: see there.
#pragma once

#include <array>

#include "simulation/methods/rows.h"

namespace contact {

template <int... kSlopes, class Count>
[[gnu::always_inline]] inline void RungeKutta::Combine(
    Vector& out, Count count, double h, const double (&weights)[sizeof...(kSlopes)]) {
  constexpr std::array kFrom = {kSlopes...};
  const std::ptrdiff_t n = size();
  const double* k = k_.data();
  const double* y = y0.data();
  double* to = out.data();
  InRows(count, [=, &weights](auto rows, std::ptrdiff_t i) {
    const auto slope = [=](int stage) { return rows(k + stage * n + i); };
    typename decltype(rows)::Array sum = weights[0] * slope(kFrom[0]);
    for (std::size_t j = 1; j < kFrom.size(); ++j) sum += weights[j] * slope(kFrom[j]);
    rows(to + i) = rows(y + i) + h * sum;
  });
}

template <int... kSlopes, class F, class Count>
[[gnu::always_inline]] inline void RungeKutta::Stage(F&& f, const StepTime& time, Count count,
                                                     int i, double theta,
                                                     const double (&weights)[sizeof...(kSlopes)]) {
  Combine<kSlopes...>(stage_, count, time.h, weights);
  f(time.At(theta), stage_.data(), k_.data() + i * size(), time.Rate(theta));
}

template <class F>
void RungeKutta::Step(F&& f, const StepTime& time) {
  k_.col(0) = slope0 * time.Rate(0);
  if (method_ == Method::kClassical) return ClassicalStep(f, time);
  WithCount<2, 4, 6>(coupled_, [&](auto coupled) { DormandPrinceStep(f, time, coupled); });
}

template <class F>
void RungeKutta::ClassicalStep(F&& f, const StepTime& time) {
  Stage<0>(f, time, coupled_, 1, 1.0 / 2, {1.0 / 2});
  Stage<1>(f, time, coupled_, 2, 1.0 / 2, {1.0 / 2});
  Stage<2>(f, time, coupled_, 3, 1.0, {1.0});
  Combine<0, 1, 2, 3>(y1, size(), time.h, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6});
}

template <class F, class Count>
void RungeKutta::DormandPrinceStep(F&& f, const StepTime& time, Count coupled) {
  Stage<0>(f, time, coupled, 1, 0.526001519587677318785587544488e-01,
           {5.26001519587677318785587544488e-2});
  Stage<0, 1>(f, time, coupled, 2, 0.789002279381515978178381316732e-01,
              {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2});
  Stage<0, 2>(f, time, coupled, 3, 0.118350341907227396726757197510,
              {2.95875854768068491816892993775e-2, 8.87627564304205475450678981324e-2});
  Stage<0, 2, 3>(f, time, coupled, 4, 0.281649658092772603273242802490,
                 {2.41365134159266685502369798665e-1, -8.84549479328286085344864962717e-1,
                  9.24834003261792003115737966543e-1});
  Stage<0, 3, 4>(f, time, coupled, 5, 1.0 / 3,
                 {3.7037037037037037037037037037e-2, 1.70828608729473871279604482173e-1,
                  1.25467687566822425016691814123e-1});
  Stage<0, 3, 4, 5>(f, time, coupled, 6, 0.25,
                    {3.7109375e-2, 1.70252211019544039314978060272e-1,
                     6.02165389804559606850219397283e-2, -1.7578125e-2});
  Stage<0, 3, 4, 5, 6>(f, time, coupled, 7, 0.307692307692307692307692307692,
                       {3.70920001185047927108779319836e-2, 1.70383925712239993810214054705e-1,
                        1.07262030446373284651809199168e-1, -1.53194377486244017527936158236e-2,
                        8.27378916381402288758473766002e-3});
  Stage<0, 3, 4, 5, 6, 7>(f, time, coupled, 8, 0.651282051282051282051282051282,
                          {6.24110958716075717114429577812e-1, -3.36089262944694129406857109825,
                           -8.68219346841726006818189891453e-1, 2.75920996994467083049415600797e1,
                           2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1});
  Stage<0, 3, 4, 5, 6, 7, 8>(
      f, time, coupled, 9, 0.6,
      {4.77662536438264365890433908527e-1, -2.48811461997166764192642586468,
       -5.90290826836842996371446475743e-1, 2.12300514481811942347288949897e1,
       1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1,
       -2.03312017085086261358222928593e-2});
  Stage<0, 3, 4, 5, 6, 7, 8, 9>(
      f, time, coupled, 10, 0.857142857142857142857142857142,
      {-9.3714243008598732571704021658e-1, 5.18637242884406370830023853209,
       1.09143734899672957818500254654, -8.14978701074692612513997267357,
       -1.85200656599969598641566180701e1, 2.27394870993505042818970056734e1,
       2.49360555267965238987089396762, -3.0467644718982195003823669022});
  Stage<0, 3, 4, 5, 6, 7, 8, 9, 10>(
      f, time, coupled, 11, 1.0,
      {2.27331014751653820792359768449, -1.05344954667372501984066689879e1,
       -2.00087205822486249909675718444, -1.79589318631187989172765950534e1,
       2.79488845294199600508499808837e1, -2.85899827713502369474065508674,
       -8.87285693353062954433549289258, 1.23605671757943030647266201528e1,
       6.43392746015763530355970484046e-1});
  Combine<0, 5, 6, 7, 8, 9, 10, 11>(
      y1, size(), time.h,
      {5.42937341165687622380535766363e-2, 4.45031289275240888144113950566,
       1.89151789931450038304281599044, -5.8012039600105847814672114227,
       3.1116436695781989440891606237e-1, -1.52160949662516078556178806805e-1,
       2.01365400804030348374776537501e-1, 4.47106157277725905176885569043e-2});
}

template <class F>
void RungeKutta::PrepareInterpolation(F&& f, const StepTime& time) {
  const double h = time.h;
  k_.col(12) = slope1 * time.Rate(1);
  PrepareCubic(h);
  if (method_ == Method::kClassical) return;
  Stage<0, 6, 7, 8, 9, 10, 11, 12>(
      f, time, coupled_, 13, 0.1,
      {5.61675022830479523392909219681e-2, 2.53500210216624811088794765333e-1,
       -2.46239037470802489917441475441e-1, -1.24191423263816360469010140626e-1,
       1.5329179827876569731206322685e-1, 8.20105229563468988491666602057e-3,
       7.56789766054569976138603589584e-3, -8.298e-3});
  Stage<0, 5, 6, 7, 10, 11, 12, 13>(
      f, time, coupled_, 14, 0.2,
      {3.18346481635021405060768473261e-2, 2.83009096723667755288322961402e-2,
       5.35419883074385676223797384372e-2, -5.49237485713909884646569340306e-2,
       -1.08347328697249322858509316994e-4, 3.82571090835658412954920192323e-4,
       -3.40465008687404560802977114492e-4, 1.41312443674632500278074618366e-1});
  Stage<0, 5, 6, 7, 8, 12, 13, 14>(
      f, time, coupled_, 15, 0.777777777777777777777777777778,
      {-4.28896301583791923408573538692e-1, -4.69762141536116384314449447206,
       7.68342119606259904184240953878, 4.06898981839711007970213554331,
       3.56727187455281109270669543021e-1, -1.39902416515901462129418009734e-3,
       2.9475147891527723389556272149, -9.15095847217987001081870187138});
  PrepareCoefficients(h);
}

}  // namespace contact
