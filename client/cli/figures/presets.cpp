#include "cli/figures/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "cli/base/failure.h"
#include "cli/base/number.h"
#include "cli/figures/run_energy.h"
#include "cli/input/no_limits.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {
namespace {

using Mark = Figure::Mark;
using Panel = Figure::Panel;

constexpr int kMostLabels = 12;             // More would hide the curves.
constexpr std::ptrdiff_t kFewSamples = 10;  // Fewer show no cycle.

// y at x between samples; the samples' x ascend.
double Interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto next = std::ranges::lower_bound(xs, x);
  if (next == xs.end()) return ys.back();
  const auto i = static_cast<std::size_t>(next - xs.begin());
  if (i == 0) return ys.front();
  const double part = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + part * (ys[i] - ys[i - 1]);
}

std::ptrdiff_t SamplesIn(const v1::Cycle& cycle, const std::vector<double>& time) {
  return std::ranges::upper_bound(time, cycle.end_time_s()) -
         std::ranges::lower_bound(time, cycle.start_time_s());
}

// Draws the figures of one run.
class Artist {
 public:
  explicit Artist(const Recording& recording)
      : recording_(recording), scenario_(DecodeRun(recording.job)) {}

  Panel Position() const {
    Panel panel = Bodies("position", "position [m]");
    for (const auto& contact : scenario_.contacts) {
      if (contact.left >= 0 && contact.right >= 0) continue;
      const bool right = contact.right < 0;
      const auto& body =
          scenario_.bodies[static_cast<std::size_t>(right ? contact.left : contact.right)];
      panel.dotted_lines.push_back(contact.wall_position - (right ? body.radius : -body.radius));
    }
    return panel;
  }

  Panel Velocity() const { return Bodies("velocity", "velocity [m/s]"); }

  Panel Force() const {
    Panel panel = OverTime("force [N]");
    EachContact([&](const std::string& name, int colour) {
      AddColumn(name + ".contact_force", name, colour, Mark::kLine, &panel);
      AddColumn(name + ".external_force", name + " equivalent external", colour, Mark::kDashed,
                &panel);
      AddMarks(name, name + ".contact_force", colour, &panel);
    });
    for (const v1::Cycle& cycle : recording_.job.cycles()) {
      if (std::isnan(cycle.turn_time_s()) || panel.labels.size() == kMostLabels) continue;
      if (SamplesIn(cycle, Column("time")) < kFewSamples) continue;  // Its peak is not drawn.
      panel.labels.push_back({cycle.turn_time_s(), cycle.peak_force_n(),
                              fmt::format("μ/k = {:.4g} s/m", cycle.mu_over_k_s_per_m())});
    }
    return panel;
  }

  Panel DeformationVelocity() const {
    Panel panel = OverTime("deformation velocity [m/s]");
    EachContact([&](const std::string& name, int colour) {
      AddColumn(name + ".deformation_velocity", name, colour, Mark::kLine, &panel);
      AddMarks(name, name + ".deformation_velocity", colour, &panel);
    });
    return panel;
  }

  Panel Hysteresis() const {
    Panel panel{.x_label = "deformation [m]", .y_label = "contact force [N]"};
    EachContact([&](const std::string& name, int colour) {
      std::string label = name;
      for (const v1::Cycle& cycle : recording_.job.cycles()) {
        if (cycle.contact() == name) AddLoop(cycle, std::exchange(label, ""), colour, &panel);
      }
    });
    return panel;
  }

  Panel Restitution() const {
    Panel panel{.x_label = "cycle, in order of its end",
                .y_label = "energy restitution coefficient",
                .counted_x = true,
                .lowest_y = 0};
    EachContact([&](const std::string& name, int colour) {
      Figure::Curve asked{name + " asked for", colour, Mark::kStart, {}, {}};
      Figure::Curve had{name + " had", colour, Mark::kEnd, {}, {}};
      double place = 0;
      for (const v1::Cycle& cycle : recording_.job.cycles()) {
        ++place;
        if (cycle.contact() != name) continue;
        asked.x.push_back(place);
        asked.y.push_back(cycle.restitution_in());
        had.x.push_back(place);
        had.y.push_back(cycle.restitution_out());
      }
      panel.curves.push_back(std::move(asked));
      panel.curves.push_back(std::move(had));
    });
    return panel;
  }

  // μ and the residual over the passes of the longest episode.
  std::vector<Panel> Iterations() const {
    const auto& all = recording_.iterations;
    if (all.empty()) throw Failure(ExitCode::kUsage, "this run iterated nothing");
    const int episode = std::ranges::max(all, {}, &v1::Iteration::number).episode();
    const bool only = std::ranges::all_of(
        all, [episode](const v1::Iteration& pass) { return pass.episode() == episode; });
    const std::string x_label = only ? "pass" : fmt::format("pass of episode {}", episode);
    std::map<std::pair<std::string, int>, std::size_t> places;
    std::vector<std::pair<Figure::Curve, Figure::Curve>> curves;  // As cycles come.
    for (const v1::Iteration& pass : all) {
      if (pass.episode() != episode) continue;
      for (const auto& unknown : pass.unknowns()) {
        const auto [place, added] =
            places.try_emplace({unknown.contact(), unknown.number()}, curves.size());
        if (added) curves.push_back(IterationCurves(unknown, static_cast<int>(curves.size())));
        auto& [mu, residual] = curves[place->second];
        mu.x.push_back(pass.number());
        mu.y.push_back(unknown.mu());
        residual.x.push_back(pass.number());
        residual.y.push_back(std::max(std::abs(unknown.residual()), kLeastResidual));
      }
    }
    Panel mu{.x_label = x_label, .y_label = "μ [N s/m^(n+1)]", .counted_x = true};
    Panel residual{
        .x_label = x_label, .y_label = "|W_r/W_c + ε²| [1]", .counted_x = true, .log_y = true};
    for (auto& [of_mu, of_residual] : curves) {
      mu.curves.push_back(std::move(of_mu));
      residual.curves.push_back(std::move(of_residual));
    }
    return {std::move(mu), std::move(residual)};
  }

  Panel Energy() const {
    Panel panel = OverTime("energy [J]");
    int colour = 0;
    for (auto& [label, values] : MechanicalEnergy(scenario_, recording_)) {
      panel.curves.push_back({label, colour++, Mark::kLine, Column("time"), std::move(values)});
    }
    return panel;
  }

 private:
  static constexpr double kLeastResidual = 1e-17;  // Zero has no logarithm.

  static Scenario DecodeRun(const v1::Job& job) {
    return DecodeScenario(job.scenario(), kNoLimits).scenario;
  }

  static std::pair<Figure::Curve, Figure::Curve> IterationCurves(
      const v1::Iteration::Unknown& unknown, int colour) {
    const Figure::Curve curve{fmt::format("{} #{}", unknown.contact(), unknown.number()),
                              colour,
                              Mark::kLinePoints,
                              {},
                              {}};
    return {curve, curve};
  }

  const std::vector<double>& Column(const std::string& name) const {
    const SampleColumn* column = recording_.Find(name);
    if (column != nullptr) return column->values;
    throw Failure(ExitCode::kUsage,
                  fmt::format("this run recorded no {}; see output.ledger_only", name));
  }

  template <class Act>
  void EachContact(Act act) const {
    int colour = 0;
    for (const auto& contact : scenario_.contacts) act(contact.name, colour++);
  }

  Panel OverTime(const std::string& label) const {
    Panel panel{.x_label = "time [s]", .y_label = label};
    EachContact([&](const std::string& name, int colour) {
      for (const v1::Cycle& cycle : recording_.job.cycles()) {
        if (cycle.contact() != name) continue;
        panel.bands.push_back({cycle.start_time_s(), cycle.end_time_s(), colour});
      }
    });
    return panel;
  }

  Panel Bodies(const std::string& quantity, const std::string& label) const {
    Panel panel = OverTime(label);
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      const int index = static_cast<int>(i);
      const std::string column = scenario_.bodies[i].name + "." + quantity;
      AddColumn(column, scenario_.bodies[i].name, index, Mark::kLine, &panel);
      for (const auto& contact : scenario_.contacts) {
        if (contact.left != index && contact.right != index) continue;
        AddMarks(contact.name, column, index, &panel);
      }
    }
    return panel;
  }

  void AddColumn(const std::string& name, const std::string& label, int colour, Mark mark,
                 Panel* panel) const {
    panel->curves.push_back({label, colour, mark, Column("time"), Column(name)});
  }

  // o and × on a column where the cycles of a contact start and end.
  void AddMarks(const std::string& contact, const std::string& column, int colour,
                Panel* panel) const {
    Figure::Curve starts{"", colour, Mark::kStart, {}, {}};
    Figure::Curve ends{"", colour, Mark::kEnd, {}, {}};
    for (const v1::Cycle& cycle : recording_.job.cycles()) {
      if (cycle.contact() != contact) continue;
      AddPoint(cycle.start_time_s(), column, &starts);
      AddPoint(cycle.end_time_s(), column, &ends);
    }
    if (starts.x.empty()) return;
    panel->curves.push_back(std::move(starts));
    panel->curves.push_back(std::move(ends));
  }

  void AddPoint(double time, const std::string& column, Figure::Curve* curve) const {
    curve->x.push_back(time);
    curve->y.push_back(Interpolate(Column("time"), Column(column), time));
  }

  void AddLoop(const v1::Cycle& cycle, const std::string& label, int colour, Panel* panel) const {
    const std::vector<double>& time = Column("time");
    const std::vector<double>& delta = Column(cycle.contact() + ".deformation");
    const std::vector<double>& force = Column(cycle.contact() + ".contact_force");
    Figure::Curve loop{label, colour, Mark::kLine, {}, {}};
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (time[i] < cycle.start_time_s() || time[i] > cycle.end_time_s()) continue;
      loop.x.push_back(delta[i]);
      loop.y.push_back(force[i]);
    }
    if (loop.x.empty()) return;
    panel->curves.push_back(loop);
    panel->curves.push_back({"", colour, Mark::kStart, {loop.x.front()}, {loop.y.front()}});
    panel->curves.push_back({"", colour, Mark::kEnd, {loop.x.back()}, {loop.y.back()}});
  }

  const Recording& recording_;
  const Scenario scenario_;
};

using Draw = std::vector<Panel> (*)(const Artist&);

const std::pair<const char*, Draw> kPresets[] = {
    {"position", [](const Artist& a) { return std::vector{a.Position()}; }},
    {"velocity", [](const Artist& a) { return std::vector{a.Velocity()}; }},
    {"force", [](const Artist& a) { return std::vector{a.Force()}; }},
    {"deformation-velocity", [](const Artist& a) { return std::vector{a.DeformationVelocity()}; }},
    {"hysteresis", [](const Artist& a) { return std::vector{a.Hysteresis()}; }},
    {"restitution", [](const Artist& a) { return std::vector{a.Restitution()}; }},
    {"iterations", [](const Artist& a) { return a.Iterations(); }},
    {"energy", [](const Artist& a) { return std::vector{a.Energy()}; }},
};

bool IsEmpty(const Panel& panel) {
  return std::ranges::all_of(panel.curves, [](const auto& curve) { return curve.x.empty(); });
}

}  // namespace

std::vector<std::string> PresetNames() {
  std::vector<std::string> names;
  for (const auto& [name, draw] : kPresets) names.emplace_back(name);
  return names;
}

Figure DrawPreset(const std::string& preset, const Recording& recording) {
  const auto* const found =
      std::ranges::find(kPresets, preset, [](const auto& entry) { return entry.first; });
  Figure figure{.title = recording.job.scenario().title(),
                .panels = found->second(Artist(recording)),
                .sources = {SourceOf(recording.job)}};
  for (Panel& panel : figure.panels) {
    std::erase_if(panel.curves, [](const auto& curve) { return curve.x.empty(); });
    if (IsEmpty(panel)) throw Failure(ExitCode::kUsage, "this run has nothing to show there");
  }
  return figure;
}

std::string CoarseSampling(const Recording& recording) {
  constexpr double kEnoughSamples = 50;
  const SampleColumn* time = recording.Find("time");
  if (time == nullptr) return "";
  double shortest = std::numeric_limits<double>::infinity();
  std::int64_t coarse = 0;
  for (const v1::Cycle& cycle : recording.job.cycles()) {
    if (cycle.end() == v1::Cycle::RUN_END) continue;
    if (SamplesIn(cycle, time->values) < kFewSamples) ++coarse;
    shortest = std::min(shortest, cycle.end_time_s() - cycle.start_time_s());
  }
  if (coarse == 0) return "";
  return fmt::format(
      "{} fewer than {} samples, too few to show. For more:\n"
      "  contactctl run --like {} --set output.sample_interval_s={:.0e}",
      Count(coarse, "contact cycle has", "contact cycles have"), kFewSamples, recording.job.name(),
      shortest / kEnoughSamples);
}

}  // namespace contact::cli
