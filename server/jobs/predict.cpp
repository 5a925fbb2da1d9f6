#include "jobs/predict.h"

#include <vector>

#include "wire/estimate.h"
#include "wire/scenario_advice.h"

namespace contact {
namespace {

void AddWarnings(const std::vector<Violation>& advice, v1::Job* job) {
  for (const Violation& a : advice) job->add_warnings(Text(a));
}

}  // namespace

void Predict(const ScenarioLimits& limits, v1::Job* job) {
  if (job->has_sweep()) {
    const DecodedSweep plan = DecodeSweep(job->sweep(), limits);
    *job->mutable_estimate() = EstimateSweep(job->sweep(), plan);
    AddWarnings(Advise(job->sweep(), plan), job);
  } else {
    const DecodedScenario decoded = DecodeScenario(job->scenario(), limits);
    *job->mutable_estimate() = EstimateRun(decoded.scenario);
    AddWarnings(Advise(job->scenario(), decoded.scenario), job);
  }
}

}  // namespace contact
