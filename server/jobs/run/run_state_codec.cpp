#include "jobs/run/run_state_codec.h"

#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "simulation/clusters/cluster_state.h"
#include "version.h"

namespace contact {

// Reads what cereal::BinaryOutputArchive has written. Unlike cereal::BinaryInputArchive it makes no
// room for a list with more entries than bytes are left.
class RunStateReader : public cereal::InputArchive<RunStateReader> {
 public:
  explicit RunStateReader(std::string_view bytes) : InputArchive(this), rest_(bytes) {}

  void Read(void* data, std::size_t size) {
    Require(size);
    std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  void Require(std::size_t bytes) const {
    if (bytes > rest_.size()) throw cereal::Exception("ends too early");
  }

 private:
  std::string_view rest_;
};

}  // namespace contact

// cereal wants to know which archive writes what this one reads.
template <>
struct cereal::traits::detail::get_output_from_input<contact::RunStateReader> {
  using type = cereal::BinaryOutputArchive;
};

namespace contact {

// cereal finds these functions by their name.

template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> load(RunStateReader& reader, T& value) {
  reader.Read(std::addressof(value), sizeof value);
}

// A byte that is neither 0 nor 1 is no bool, not even to compare it.
inline void load(RunStateReader& reader, bool& value) {
  std::uint8_t byte = 0;
  reader.Read(&byte, sizeof byte);
  if (byte > 1) throw cereal::Exception("holds no bool");
  value = byte == 1;
}

template <class T>
void load(RunStateReader& reader, cereal::BinaryData<T>& block) {
  if (block.size > 0) reader.Read(block.data, block.size);
}

template <class T>
void load(RunStateReader& reader, cereal::NameValuePair<T>& named) {
  reader(named.value);
}

template <class T>
void load(RunStateReader& reader, cereal::SizeTag<T>& list) {
  load(reader, list.size);
  reader.Require(list.size);
}

// Every member of each value, in order; these too.

template <class Archive>
void serialize(Archive& archive, Cycle& c) {
  archive(c.contact, c.number, c.group, c.episode, c.kind, c.end, c.status, c.iterations);
  archive(c.start_time, c.turn_time, c.end_time);
  archive(c.start_deformation, c.max_deformation, c.end_deformation);
  archive(c.approach_velocity, c.separation_velocity, c.mu);
  archive(c.work_compression, c.work_restitution);
  archive(c.dissipated_compression, c.dissipated_restitution);
  archive(c.external_compression, c.external_restitution);
  archive(c.restitution_in, c.restitution_out);
  archive(c.peak_force, c.tension_time, c.identity_residual);
}

template <class Archive>
void serialize(Archive& archive, Group::Reached& r) {
  archive(r.mu, r.restitution);
}

template <class Archive>
void serialize(Archive& archive, Group& g) {
  archive(g.contact, g.number, g.encounter, g.first_cycle, g.cycles);
  archive(g.start_time, g.end_time, g.end, g.status, g.growth, g.mu);
  archive(g.work_compression, g.work_restitution, g.restitution_in, g.restitution_out);
  archive(g.residual, g.beside_cut, g.too_much, g.too_little, g.other_roots);
}

template <class Archive>
void serialize(Archive& archive, ContactState::Membership& m) {
  archive(m.open, m.after_rest, m.disproved, m.nothing, m.place, m.lasts, m.groups, m.iterations,
          m.imbalance, m.group);
}

template <class Archive>
void serialize(Archive& archive, ContactState::Peak& p) {
  archive(p.time, p.deformation, p.velocity, p.work, p.external_work);
}

template <class Archive>
void serialize(Archive& archive, ContactState& c) {
  archive(c.phase, c.gap, c.cycles, c.last_mu, c.largest_work, c.settled, c.duration);
  archive(c.work, c.external_work, c.column, c.peak, c.cycle, c.imbalance);
  archive(c.encounter, c.member);
  archive(c.largest_motion, c.largest_speed, c.woken, c.released, c.start_velocity, c.rest_until,
          c.rest_mark, c.stored, c.yield);
}

template <class Archive>
void serialize(Archive& archive, Slip& s) {
  archive(s.slack, s.side);
}

template <class Archive>
void serialize(Archive& archive, State& s) {
  archive(s.time, s.step, s.positions, s.velocities, s.contacts, s.slips);
  archive(s.load_work, s.support_loss, s.contact_loss, s.impulse);
}

template <class Archive>
void serialize(Archive& archive, Outcome& o) {
  archive(o.end, o.message, o.time, o.all_converged, o.positions, o.velocities);
  archive(o.steps, o.evaluations, o.iterations, o.episodes);
  archive(o.worst_identity_residual, o.momentum_residual, o.energy_residual, o.kinetic_energy);
  archive(o.growths, o.growths_no_progress, o.cut_cycles);
}

template <class Archive>
void serialize(Archive& archive, Samples& s) {
  archive(s.first, s.columns, s.values);
}

template <class Archive>
void serialize(Archive& archive, Turn& t) {
  archive(t.time, t.channel, t.value);
}

template <class Archive>
void serialize(Archive& archive, Extremes::Row& r) {
  archive(r.turn, r.values);
}

template <class Archive>
void serialize(Archive& archive, Extremes& e) {
  archive(e.low, e.high, e.turns, e.scale);
}

template <class Archive>
void serialize(Archive& archive, Sampling& s) {
  archive(s.pending, s.regular, s.in_cycles, s.last, s.due, s.extremes);
}

template <class Archive>
void serialize(Archive& archive, GroupId& id) {
  archive(id.contact, id.encounter, id.place);
}

template <class Archive>
void serialize(Archive& archive, Unknown& u) {
  archive(u.id, u.mu, u.first_mu, u.lasts, u.start_time, u.restitution_out);
  archive(u.length, u.speed, u.corrected, u.kept, u.guesses, u.weak, u.reopened, u.flips, u.cut,
          u.given_up, u.iterations);
  archive(u.growth, u.status, u.too_much, u.too_little, u.tried, u.other_roots);
}

template <class Archive>
void serialize(Archive& archive, RestEnd& r) {
  archive(r.before, r.time);
}

template <class Archive>
void serialize(Archive& archive, Report::Warning& w) {
  archive(w.text);
}

template <class Archive>
void serialize(Archive& archive, Report::Item& i) {
  archive(i.time, i.news);
}

template <class Archive>
void serialize(Archive& archive, Place& p) {
  archive(p.u, p.v);
}

template <class Archive>
void serialize(Archive& archive, Flight& f) {
  archive(f.time, f.start, f.acceleration);
}

template <class Archive>
void serialize(Archive& archive, StepTime& s) {
  archive(s.start, s.h, s.warp);
}

template <class Archive>
void serialize(Archive& archive, Trace::Ends& e) {
  archive(e.from, e.to, e.from_acceleration, e.to_acceleration);
}

template <class Archive>
void serialize(Archive& archive, Trace::Pressed& p) {
  archive(p.contact, p.mu, p.yield);
}

template <class Archive>
void serialize(Archive& archive, CycleSample& s) {
  archive(s.time, s.near);
}

template <class Archive>
void serialize(Archive& archive, Trace::Exchange& e) {
  archive(e.dissipated, e.work, e.from_power, e.to_power);
}

template <class Archive>
void serialize(Archive& archive, Trace& t) {
  archive(t.bodies, t.steps, t.ends, t.exchanged, t.pressed, t.presses, t.samples, t.turns);
}

template <class Archive>
void serialize(Archive& archive, Outlook& o) {
  archive(o.step, o.solved_until, o.record_until, o.finely, o.cut_since, o.unknowns, o.rest_ends,
          o.episode);
}

template <class Archive>
void serialize(Archive& archive, Waiting& w) {
  archive(w.time, w.lasted, w.bodies, w.outlook);
}

template <class Archive>
void serialize(Archive& archive, Cast& c) {
  archive(c.time, c.bodies, c.places, c.contacts, c.states, c.outlook);
}

template <class Archive>
void serialize(Archive& archive, Piece& p) {
  archive(p.number, p.touch, p.start, p.end, p.before, p.trace, p.report.items, p.told);
  archive(p.pause, p.whereabouts, p.has_episode, p.steps, p.evaluations);
  archive(p.iterations, p.growths, p.growths_no_progress, p.loss, p.work, p.impulse);
  archive(p.warned, p.unproven, p.missed);
  std::vector<Waiting> waited;
  for (const auto& group : p.waited) waited.push_back(*group);
  archive(waited);
  p.waited.clear();
  for (Waiting& group : waited) {
    p.waited.push_back(std::make_shared<const Waiting>(std::move(group)));
  }
}

template <class Archive>
void serialize(Archive& archive, ClusterState::Station& s) {
  archive(s.from, s.piece, s.flight);
}

template <class Archive>
void serialize(Archive& archive, ClusterState& s) {
  archive(s.pieces, s.stations, s.waiting, s.number, s.look_at, s.blocks);
  archive(s.useful, s.wasted, s.dissipated, s.loss, s.work, s.impulse);
}

template <class Archive>
void serialize(Archive& archive, RunState& s) {
  archive(s.state, s.outcome, s.cycles, s.steps, s.evaluations, s.iterations);
  archive(s.start_energy, s.start_momentum, s.energy_scale, s.momentum_scale);
  archive(s.growths, s.growths_no_progress, s.solved_until, s.record_until, s.finely, s.cut_since);
  archive(s.unknowns, s.rest_ends, s.warned, s.missed, s.unproven, s.sampling);
  bool parted = s.clusters != nullptr;
  archive(parted);
  if (!parted) return;
  ClusterState clusters = s.clusters != nullptr ? *s.clusters : ClusterState{};
  archive(clusters);
  s.clusters = std::make_shared<const ClusterState>(std::move(clusters));
}

namespace {

std::string Build() { return std::string(kVersion) + ' ' + kRevision; }

}  // namespace

std::string EncodeRunState(const RunState& state) {
  std::ostringstream bytes;
  cereal::BinaryOutputArchive archive(bytes);
  archive(Build(), state);
  return bytes.str();
}

std::optional<RunState> DecodeRunState(const std::string& bytes) {
  if (bytes.empty()) return std::nullopt;
  try {
    RunStateReader archive(bytes);
    std::string build;
    archive(build);
    if (build != Build()) return std::nullopt;
    RunState state;
    archive(state);
    return state;
  } catch (const cereal::Exception&) {
    return std::nullopt;
  }
}

}  // namespace contact
