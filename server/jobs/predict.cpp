#include "jobs/predict.h"

#include <vector>

#include "wire/estimate.h"
#include "wire/scenario_advice.h"

namespace contact {
void Predict(const ScenarioLimits& limits, v1::Job* job) {
  std::vector<Violation> advice;
  if (job->has_sweep()) {
    const DecodedSweep plan = DecodeSweep(job->sweep(), limits);
    *job->mutable_estimate() = EstimateSweep(job->sweep(), plan);
    advice = Advise(job->sweep(), plan);
  } else {
    const DecodedScenario decoded = DecodeScenario(job->scenario(), limits);
    *job->mutable_estimate() = EstimateRun(decoded.scenario);
    advice = Advise(job->scenario(), decoded.scenario);
  }
  for (const Violation& a : advice) job->add_warnings(Text(a));
}

}  // namespace contact
