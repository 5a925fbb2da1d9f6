#include "wire/scenario/contact_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "base/spelling.h"
#include "wire/scenario/contact_law_codec.h"
#include "wire/scenario/material_codec.h"
#include "wire/scenario/motion_codec.h"

namespace contact {
namespace {

// The name of a pair of neighbours, whether their contact is one or two.
std::string PairName(const v1::Contact& entry, int number) {
  if (entry.name().empty()) {
    return fmt::format(
        "{}-{}", entry.between(number - 1),
        entry.has_wall() || number >= entry.between_size() ? "wall" : entry.between(number));
  }
  return entry.between_size() > 2 ? fmt::format("{}-{}", entry.name(), number) : entry.name();
}

// Reads the contacts one after the other and keeps what they must not share.
class ContactDecoder {
 public:
  ContactDecoder(const v1::Scenario& scenario, const std::vector<Body>& bodies,
                 const BodyNames& names)
      : scenario_(scenario), bodies_(bodies), names_(names) {}

  void Decode(const v1::Contact& message, const Rules& rules) {
    if (!message.name().empty() && !IsName(message.name())) {
      BreakName(message.name(), rules);
    }
    const std::vector<int> touching = FindBodies(message, rules);
    if (message.has_wall()) CheckWall(message, rules.In("wall"));
    CheckStiffness(message, touching, rules);
    Contact law = DecodeContactLaw(message, rules);
    if (message.has_clearance_m()) return AddPlay(message, std::move(law), touching, rules);
    if (message.has_wall()) {
      if (touching.size() == 1 && touching[0] != kNone) AddWall(message, law, touching[0], rules);
      return;
    }
    for (std::size_t i = 0; i + 1 < touching.size(); ++i) {
      if (touching[i] == kNone || touching[i + 1] == kNone) continue;
      AddPair(message, law, touching[i], touching[i + 1], static_cast<int>(i) + 1, rules);
    }
  }

  DecodedContacts Take() { return std::move(made_); }

 private:
  std::vector<int> FindBodies(const v1::Contact& message, const Rules& rules) const {
    if (const auto body = BodyBesideWall(message)) return {BreakWall(message, *body, rules)};
    CheckArity(message, rules);
    std::vector<int> touching;
    for (int i = 0; i < message.between_size(); ++i) {
      touching.push_back(names_.Find(message.between(i), "", rules.In("between", i)));
    }
    return touching;
  }

  // The place in `between` of the body that stands there beside what can only mean the wall: a
  // name that is no body's.
  std::optional<int> BodyBesideWall(const v1::Contact& message) const {
    if (message.between_size() != 2) return std::nullopt;
    for (const int body : {0, 1}) {
      const std::string& other = message.between(1 - body);
      if (!names_.Has(message.between(body)) || names_.Has(other)) continue;
      if ((message.has_wall() && !other.empty()) || other == "wall") return body;
    }
    return std::nullopt;
  }

  // Notes that `between` names the wall. Returns the body beside it.
  int BreakWall(const v1::Contact& message, int place, const Rules& rules) const {
    const std::string& body = message.between(place);
    rules.Break("between",
                fmt::format("names {} beside {}; must name the body alone",
                            Quoted(message.between(1 - place)), Quoted(body)),
                fmt::format("between: [{}] names the body; the wall is only in wall{}",
                            Shortened(body), message.has_wall() ? "" : ": {side: LEFT or RIGHT}"));
    return names_.Find(body, "", rules);
  }

  static void CheckArity(const v1::Contact& message, const Rules& rules) {
    const int count = message.between_size();
    if (count == 0) {
      rules.Break("between", "is missing", "name two bodies, or one body and give wall");
    } else if (count == 1 && !message.has_wall()) {
      rules.Break("between", "names one body", "name two bodies, or give wall");
    } else if (count > 1 && message.has_wall()) {
      rules.Break("between", fmt::format("names {} bodies beside a wall; must name one", count),
                  "remove wall, or all names but one");
    }
  }

  static void CheckWall(const v1::Contact& message, const Rules& rules) {
    rules.Read(message.wall(), v1::Wall::kPositionMFieldNumber);
    if (message.has_clearance_m()) {
      if (message.wall().side() != v1::Wall::SIDE_UNSPECIFIED) {
        rules.Break("side", "is given beside clearance_m, which has both sides", "remove it");
      }
    } else if (message.wall().side() == v1::Wall::SIDE_UNSPECIFIED) {
      rules.Break("side", "is missing", "LEFT or RIGHT of the body");
    } else {
      rules.RequireKnown("side", message.wall().side());
    }
    if (!message.wall().has_material()) return;
    CheckMaterial(message.wall().material(), rules.In("material"));
    if (IsStiff(message)) {
      rules.Break(
          "material",
          fmt::format("is given beside {}", message.has_stiffness() ? "stiffness" : "force_table"),
          "give one of the two");
    }
  }

  // Whether the force asks for no materials.
  static bool IsStiff(const v1::Contact& message) {
    return message.has_stiffness() || message.damping() == v1::Contact::FORCE_TABLE;
  }

  const v1::Body& Message(int body) const { return scenario_.bodies(body); }

  // A stiffness is given, or follows from materials.
  void CheckStiffness(const v1::Contact& message, const std::vector<int>& touching,
                      const Rules& rules) const {
    if (IsStiff(message)) return;
    if (message.has_clearance_m()) {
      rules.Break("stiffness", "is missing", "k, in N/m^exponent; clearance_m needs it");
      return;
    }
    const bool materials =
        message.wall().has_material() || std::ranges::any_of(touching, [this](int body) {
          return body != kNone && Message(body).has_material();
        });
    if (!materials) {
      rules.Break("stiffness", "is missing", "k, in N/m^exponent; or the material of both sides");
      return;
    }
    for (const int body : touching) {
      if (body != kNone) CheckHertz(body, rules);
    }
    if (message.has_wall() && !message.wall().has_material()) {
      rules.Break("wall.material", "is missing, and so is stiffness", "give one of the two");
    }
    if (message.has_exponent() && message.exponent() != 1.5) {
      rules.Break(
          "exponent",
          fmt::format("is {}; must be 1.5 where stiffness is not given", message.exponent()),
          "materials make a Hertz contact");
    }
  }

  void CheckHertz(int body, const Rules& rules) const {
    const std::string name = Quoted(Message(body).name());
    if (!Message(body).has_material()) {
      rules.Break("stiffness", fmt::format("is missing, and {} has no material", name),
                  "give stiffness, or the material of both sides");
    }
    if (Message(body).radius_m() == 0) {
      rules.Break("stiffness", fmt::format("is missing, and {} has no radius", name),
                  "that of a Hertz contact needs radius_m > 0");
    }
  }

  // Fills the stiffness that follows from materials, once they and the radii are right.
  void FillStiffness(const v1::Contact& message, Contact* contact, const Rules& rules) const {
    if (IsStiff(message)) return;
    double compliance = message.has_wall() ? Compliance(message.wall().material()) : 0;
    double curvature = 0;
    for (const int body : {contact->left, contact->right}) {
      if (body == kNone) continue;
      compliance += Compliance(Message(body).material());
      curvature += 1 / Message(body).radius_m();
    }
    contact->stiffness = HertzStiffness(compliance, curvature);
    const Range& range = NumberOf<v1::Contact>(v1::Contact::kStiffnessFieldNumber).range;
    if (rules.empty() && !range.Contains(contact->stiffness)) {
      rules.Break("stiffness",
                  fmt::format("is missing, and follows as {} from the materials; must be {}",
                              contact->stiffness, range.text));
    }
  }

  void AddWall(const v1::Contact& message, Contact contact, int index, const Rules& rules) {
    const Body& body = bodies_[static_cast<std::size_t>(index)];
    const bool left = message.wall().side() == v1::Wall::LEFT;
    (left ? contact.right : contact.left) = index;
    FillStiffness(message, &contact, rules);
    contact.name = ContactName(message, 1);
    const auto [side, wall] = Place(message.wall(), contact.name, rules);
    (left ? contact.left : contact.right) = side;
    contact.wall_position = wall;

    CheckBesideWall(body, rules);
    if (!pairs_.insert({index, left ? -1 : -2, message.wall().position_m()}).second) {
      rules.Break("between", "repeats another contact of this body and this wall");
    }
    const double deformation =
        left ? wall - (body.position - body.radius) : body.position + body.radius - wall;
    if (Overlap(deformation, {body.radius, body.position, wall})) {
      BreakOverlap(deformation, fmt::format("{} and the wall", Quoted(body.name)), rules);
    }
    Add(std::move(contact), rules);
  }

  static void CheckBesideWall(const Body& body, const Rules& rules) {
    if (!body.fixed) return;
    rules.Break("between", fmt::format("forces do not move {}, nor the wall", Quoted(body.name)),
                "one side of a contact must be able to move");
  }

  // A wall, and where it is at t = 0: kNone, or a body of its own where it moves.
  struct WallPlace {
    int side;
    double position;
  };
  WallPlace Place(const v1::Wall& wall, const std::string& name, const Rules& rules) {
    if (!wall.has_motion()) return {kNone, wall.position_m()};
    const auto index = static_cast<int>(bodies_.size() + made_.walls.size());
    Body body{.name = name, .position = wall.position_m(), .fixed = true};
    AddMotion(DecodeMotion(wall.motion(), wall.position_m(), rules.In("wall").In("motion")), index,
              &body, &made_.drives);
    if (names_.Has(name)) {
      rules.Break("name", fmt::format("is {}, which a body is called", Quoted(name)),
                  "results tell a wall that moves by the name of its contact");
    }
    made_.walls.push_back(body);
    return {index, body.position};
  }

  // Two contacts, one for each side of a play.
  void AddPlay(const v1::Contact& message, Contact contact, const std::vector<int>& touching,
               const Rules& rules) {
    contact.play =
        rules.Check<v1::Contact>(v1::Contact::kClearanceMFieldNumber, message.clearance_m());
    if (message.between_size() > 2) {
      rules.Break("clearance_m", "is given for more than two bodies",
                  "give each pair its own entry");
    }
    const std::size_t sides = message.has_wall() ? 1 : 2;
    if (touching.size() != sides || std::ranges::count(touching, kNone) > 0) return;
    const std::optional<WallPlace> stop = StopOf(message, touching, rules);
    if (!stop) return;
    CheckPlay(contact.play, touching[0], *stop, rules);
    contact.wall_position = stop->position;
    for (const bool left : {true, false}) {
      contact.left = left ? stop->side : touching[0];
      contact.right = left ? touching[0] : stop->side;
      contact.name = ContactName(message, left ? 1 : 2);
      Add(contact, rules);
    }
  }

  // What a body has its play to: another body, or a wall. None if both are one body.
  std::optional<WallPlace> StopOf(const v1::Contact& message, const std::vector<int>& touching,
                                  const Rules& rules) {
    const Body& body = bodies_[static_cast<std::size_t>(touching[0])];
    if (message.has_wall()) {
      CheckBesideWall(body, rules);
      return Place(message.wall(), PairName(message, 1), rules);
    }
    const Body& other = bodies_[static_cast<std::size_t>(touching[1])];
    if (!CheckSides(body, other, rules)) return std::nullopt;
    return WallPlace{touching[1], other.position};
  }

  void CheckPlay(double play, int index, const WallPlace& stop, const Rules& rules) {
    const Body& body = bodies_[static_cast<std::size_t>(index)];
    const double where = stop.side == kNone ? stop.position : 0;
    if (!pairs_.insert({std::min(index, stop.side), std::max(index, stop.side), where}).second) {
      rules.Break("between", "repeats another contact of this pair");
    }
    const double offset = std::abs(body.position - stop.position);
    if (Overlap(offset - play, {body.position, stop.position, play})) {
      BreakOverlap(offset - play, fmt::format("{} and its stop", Quoted(body.name)), rules);
    }
  }

  void AddPair(const v1::Contact& message, Contact contact, int left, int right, int number,
               const Rules& rules) {
    const Body& a = bodies_[static_cast<std::size_t>(left)];
    const Body& b = bodies_[static_cast<std::size_t>(right)];
    contact.left = left;
    contact.right = right;
    FillStiffness(message, &contact, rules);
    contact.name = ContactName(message, number);
    if (CheckPair(a, b, rules)) {
      if (!pairs_.insert({std::min(left, right), std::max(left, right), 0.0}).second) {
        rules.Break("between", fmt::format("repeats the contact of {} and {}", Quoted(a.name),
                                           Quoted(b.name)));
      }
      Add(std::move(contact), rules);
    }
  }

  // False for a pair that is none.
  static bool CheckSides(const Body& a, const Body& b, const Rules& rules) {
    if (&a == &b) {
      rules.Break("between", fmt::format("names {} twice in a row", Quoted(a.name)),
                  "a body cannot touch itself");
      return false;
    }
    if (a.fixed && b.fixed) {
      rules.Break("between",
                  fmt::format("forces move neither {} nor {}", Quoted(a.name), Quoted(b.name)),
                  "one side of a contact must be able to move");
    }
    return true;
  }

  bool CheckPair(const Body& a, const Body& b, const Rules& rules) const {
    if (!CheckSides(a, b, rules)) return false;
    if (a.position > b.position) {
      rules.Break("between",
                  fmt::format("names {} first, which stands to the right of {} ({} > {} m)",
                              Quoted(a.name), Quoted(b.name), a.position, b.position),
                  fmt::format("left body first: [{}, {}]", b.name, a.name));
      return true;
    }
    const double deformation = a.radius + b.radius - (b.position - a.position);
    if (Overlap(deformation, {a.radius, b.radius, a.position, b.position})) {
      BreakOverlap(deformation, fmt::format("{} and {}", Quoted(a.name), Quoted(b.name)), rules);
    }
    return true;
  }

  // Whether they overlap where they must not. A deformation of the size of the round-off of its
  // terms is a touch.
  bool Overlap(double deformation, std::initializer_list<double> terms) const {
    const bool apart = scenario_.start() != v1::Scenario::AS_GIVEN &&
                       scenario_.start() != v1::Scenario::AT_EQUILIBRIUM;
    if (!apart) return false;
    double scale = 0;
    for (const double term : terms) scale = std::max(scale, std::abs(term));
    return deformation > 1e-12 * scale;
  }

  static void BreakOverlap(double deformation, const std::string& who, const Rules& rules) {
    rules.Break("between",
                fmt::format("{} overlap at the start: δ = {} m; must be ≤ 0", who, deformation),
                "move them apart, or set start: AS_GIVEN");
  }

  void Add(Contact contact, const Rules& rules) {
    if (!contact_names_.insert(contact.name).second) {
      rules.Break("name",
                  fmt::format("is {}, which another contact is called", Quoted(contact.name)),
                  "give each contact a name of its own");
    }
    made_.contacts.push_back(std::move(contact));
  }

  const v1::Scenario& scenario_;
  const std::vector<Body>& bodies_;
  const BodyNames& names_;
  DecodedContacts made_;
  std::set<std::tuple<int, int, double>> pairs_;  // two bodies; or a body, −1 or −2, and the wall
  std::unordered_set<std::string> contact_names_;
};

}  // namespace

std::int64_t CountContacts(const v1::Scenario& message) {
  std::int64_t count = 0;
  for (const v1::Contact& contact : message.contacts()) {
    count += std::max(contact.has_clearance_m() ? 2 : 1, contact.between_size() - 1);
  }
  return count;
}

int ContactsOf(const v1::Contact& entry) {
  if (entry.has_clearance_m()) return entry.between().empty() ? 0 : 2;
  return entry.has_wall() ? std::min(1, entry.between_size())
                          : std::max(0, entry.between_size() - 1);
}

std::string ContactName(const v1::Contact& entry, int number) {
  if (entry.has_clearance_m()) {
    return fmt::format("{}-{}", PairName(entry, 1), number == 1 ? "left" : "right");
  }
  return PairName(entry, number);
}

DecodedContacts DecodeContacts(const v1::Scenario& message, const std::vector<Body>& bodies,
                               const BodyNames& names, std::vector<Violation>* violations) {
  ContactDecoder decoder(message, bodies, names);
  for (int i = 0; i < message.contacts_size(); ++i) {
    decoder.Decode(message.contacts(i), Rules(violations, "contacts", i));
  }
  return decoder.Take();
}

}  // namespace contact
