#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/base/table.h"
#include "cli/settings/settings.h"
#include "wire/scenario/law_catalogue.h"

namespace contact::cli {

/// The restitution that a law delivers in an isolated collision.
struct LawPoint {
  /// In the catalogue, which is never destroyed.
  const LawEntry* law = nullptr;
  /// Restitution asked for, in (0, 1].
  double requested = 0;
  /// Restitution that results; 0: not known yet.
  double delivered = 0;

  /// Deviation relative to the restitution asked for.
  double miss() const { return delivered / requested - 1; }
  /// Where `delivered` comes from: `closed form` or `simulation`.
  std::string_view method() const { return law->closed_form() ? "closed form" : "simulation"; }
};

/// A point of a law. `delivered` is filled if the law has a closed form, else left to Simulate.
/// `requested` is in (0, 1].
LawPoint PointOf(const LawEntry& law, double requested);

/// The law with this name, written as HUNT_CROSSLEY or hunt-crossley. Throws Failure (kUsage) with
/// the nearest name if there is no such law.
const LawEntry& FindLaw(const std::string& text);

/// The laws with these names, as FindLaw finds them, in this order. Without names all laws of the
/// catalogue, or with `closed_form` those that need no run.
std::vector<const LawEntry*> ChooseLaws(const std::vector<std::string>& names, bool closed_form);

/// A scenario with a ball and a wall for each point. The balls hit their walls one after the other.
/// Contact i is point i.
v1::Scenario CollisionsOf(const std::vector<LawPoint>& points);

/// Fills `delivered` of the points whose law has no closed form, from one run on the server. The
/// job is deleted afterwards. Without such points no server is asked. Throws Failure and
/// CallFailure.
void Simulate(std::vector<LawPoint>* points, const Settings& settings);

/// A law as a JSON object: law, formula, source, range, closed_form.
std::string LawJson(const LawEntry& law);

/// Laws as a JSON array of what LawJson prints.
std::string LawsJson(const std::vector<LawEntry>& laws);

/// Points as a JSON array of objects: law, requested, delivered, miss, method.
std::string PointsJson(const std::vector<LawPoint>& points);

/// What a law with a closed form delivers: a row for each restitution asked for, with α and the
/// miss. `restitutions` are in (0, 1].
Table DeliveryTable(const LawEntry& law, const std::vector<double>& restitutions);

/// The columns of PointTable.
std::vector<Table::Column> PointColumns();

/// A row for each point, numbers with all their digits; for CSV.
Table PointTable(const std::vector<LawPoint>& points);

/// The columns of ComparisonTable: the law, and the restitutions asked for.
std::vector<Table::Column> ComparisonColumns(const std::vector<double>& restitutions);

/// A row for each law, a column for each restitution asked for; a miss of more than 1 % stands out.
/// `points` has the points of each law one after the other, in the order of `restitutions`.
Table ComparisonTable(const std::vector<LawPoint>& points, const std::vector<double>& restitutions);

}  // namespace contact::cli
