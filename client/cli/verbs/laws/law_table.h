#pragma once

#include <string>
#include <vector>

#include "cli/base/table.h"
#include "cli/verbs/laws/law_study.h"

namespace contact::cli {

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
