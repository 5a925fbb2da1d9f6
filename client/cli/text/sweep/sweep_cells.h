#pragma once

#include <map>
#include <string>
#include <string_view>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "contact/v1/scenario.pb.h"

namespace contact::cli {

/// The cells of a sweep that have been computed, by their index.
using SweepCells = std::map<int, v1::SweepCell>;

/// A value of an axis for people: the word of an enum, such as `EXACT`, else the number with so
/// many significant digits. 0 digits: as few as give the same double back.
std::string AxisText(const v1::Sweep::Axis& axis, double value, int digits = 0);

/// Where the metric of a cell comes from; RESULT if the server does not tell.
v1::SweepCell::Source SourceOf(const v1::SweepCell& cell, int metric);

/// The word for a metric that is no known number: `CUT`, `no contact`; empty for RESULT.
std::string_view SourceWord(v1::SweepCell::Source source);

/// A metric of a cell for people: its word, else the number with so many significant digits, `-`
/// where there is none.
std::string MetricText(const v1::SweepCell& cell, int metric, int digits);

/// The convergence of a cell that did not fail, and what else its ledger is: `FULL, no contact`,
/// `FULL, 2 cut`.
std::string VerdictText(const v1::SweepCell& cell);

/// Which metrics of a cell are no known numbers: `cycles[0].mu: CUT`. `no contact` if the cell has
/// no cycle at all.
std::string UnknownMetrics(const v1::Sweep& sweep, const v1::SweepCell& cell);

}  // namespace contact::cli
