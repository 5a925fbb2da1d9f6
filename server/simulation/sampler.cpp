#include "simulation/sampler.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace contact {
namespace {

std::vector<int> Count(std::size_t size) {
  std::vector<int> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

Sampler::Sampler(const Scenario& scenario, Motion& motion, Observer& observer, std::stop_token stop)
    : scenario_(scenario),
      motion_(motion),
      observer_(observer),
      stop_(std::move(stop)),
      log_(scenario, stop_, [this](const Samples& samples) { HandOut(samples); }),
      bodies_(Count(scenario.bodies.size())),
      contacts_(Count(scenario.contacts.size())),
      turn_finder_(scenario, motion, bodies_, contacts_) {}

void Sampler::RecordStart(const State& state) {
  if (scenario_.sample_interval == 0) return;
  // Its first step tells the force of what is pressed, with the μ that is then found.
  if (std::ranges::any_of(state.contacts, StartsPressed)) return;
  motion_.Begin(state, true);
  log_.TakeUntil(0, {}, {}, 0, [&](double, std::vector<double>* row) {
    Append(0, motion_.integrator().y0, row);
  });
}

void Sampler::OnStep(const StepTime& step) {
  if (scenario_.sample_interval == 0) return;
  planned_.clear();
  if (!log_.full()) FindCycleSamples(scenario_, motion_, step, &planned_);
  turn_finder_.Find(step, motion_.equations().base(), &turns_);
  bool prepared = !turns_.empty();  // Where there are turns, the finder has.
  const auto take = [&](double time, std::vector<double>* row) {
    if (!prepared) motion_.PrepareInterpolation();
    prepared = true;
    motion_.Interpolate(std::clamp(step.Theta(time), 0.0, 1.0), &y_);
    Append(std::min(time, scenario_.end_time), y_, row);
  };
  log_.TakeUntil(step.At(1), planned_, turns_, motion_.steps(), take);
}

void Sampler::Append(double time, const Eigen::ArrayXd& y, std::vector<double>* row) {
  const Equations& equations = motion_.equations();
  const Eigen::Index n = equations.bodies();
  slope_.resize(y.size());
  equations(time, y.data(), slope_.data());
  for (int i = 0; i < n; ++i) {
    row->push_back(equations.base()[static_cast<std::size_t>(i)] + y[i]);
    row->push_back(y[n + i]);
  }
  AppendContacts(y, row);
  row->insert(row->end(), slope_.begin() + n, slope_.begin() + 2 * n);
  const double supports = AppendSupports(y, row);
  const Exchanged exchanged = motion_.ExchangedUntil(y);
  row->insert(row->end(), {equations.KineticEnergy(y.data()), equations.ContactEnergy(y.data()),
                           supports, exchanged.dissipated, exchanged.load_work});
}

void Sampler::AppendContacts(const Eigen::ArrayXd& y, std::vector<double>* row) const {
  const Equations& equations = motion_.equations();
  const int n = equations.bodies();
  auto active = equations.active.begin();  // In the order of the contacts, as this loop.
  for (int c = 0; c < equations.contacts(); ++c) {
    const double deformation = motion_.Deformation(c, y.data());
    const double rate = equations.Relative(c, y.data() + n);
    double force = 0;
    if (active != equations.active.end() && active->contact == c) {
      force = (active++)->At(deformation, rate).force;
    }
    const double external =
        equations.effective_mass(c) * equations.Relative(c, slope_.data() + n) + force;
    row->insert(row->end(), {deformation, rate, force, external});
  }
}

double Sampler::AppendSupports(const Eigen::ArrayXd& y, std::vector<double>* row) const {
  const Equations& equations = motion_.equations();
  double sum = 0;
  for (std::size_t i = 0; i < scenario_.supports.size(); ++i) {
    const double energy = equations.SupportEnergy(i, y.data());
    row->push_back(equations.SupportForce(i, y.data(), y.data() + equations.bodies()));
    row->push_back(energy);
    sum += energy;
  }
  return sum;
}

void Sampler::HandOut(const Samples& samples) {
  if (before_) {
    held_.push_back(samples);
  } else {
    observer_.OnSamples(samples);
  }
}

void Sampler::Hold() { before_ = log_.Save(); }

void Sampler::Release() {
  before_.reset();
  for (const Samples& samples : held_) {
    if (stop_.stop_requested()) log_.CutShort();
    if (log_.cut_short()) break;
    observer_.OnSamples(samples);
  }
  held_.clear();
}

void Sampler::TakeBack() {
  assert(before_);
  log_.Restore(*std::exchange(before_, std::nullopt));
  held_.clear();
}

}  // namespace contact
