#include "simulation/course/sample_log.h"

#include <utility>

#include "simulation/model/derived.h"

namespace contact {

SampleLog::SampleLog(const Scenario& scenario, std::stop_token stop,
                     std::function<void(const Samples&)> hand_out)
    : scenario_(scenario), stop_(std::move(stop)), hand_out_(std::move(hand_out)) {
  samples_.columns = SampleColumns(scenario);
}

double SampleLog::NextRegular(double instant) const {
  const double interval = scenario_.sample_interval;
  const double time = static_cast<double>(regular_) * interval;
  const bool is_late = time > instant + 1e-9 * interval;
  return is_late || time > scenario_.end_time * (1 + 1e-12) ? kNever : time;
}

void SampleLog::Begin(double time) {
  samples_.values.push_back(time);
  last_ = time;
  ++next_;
}

void SampleLog::End() {
  if (samples_.rows() == RowsPerChunk(samples_.columns)) Flush();
}

void SampleLog::Flush() {
  if (samples_.rows() == 0) return;
  samples_.first = next_ - samples_.rows();
  hand_out_(samples_);
  samples_.values.clear();
}

void SampleLog::CutShort() {
  cut_short_ = true;
  samples_.values.clear();  // They would follow a hole.
}

bool SampleLog::full() const {
  const bool asked = scenario_.sample_interval > 0 && scenario_.samples_per_contact > 0;
  return asked && next_ - regular_ >= scenario_.most_contact_samples;
}

Sampling SampleLog::Save() const {
  Sampling now{.pending = samples_, .regular = regular_, .last = last_};
  now.pending.first = next_ - samples_.rows();
  return now;
}

void SampleLog::Restore(Sampling from) {
  next_ = from.pending.first + from.pending.rows();
  regular_ = from.regular;
  last_ = from.last;
  samples_ = std::move(from.pending);
}

}  // namespace contact
