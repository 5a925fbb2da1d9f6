#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// A column of a result: numbers with a unit, or words.
struct DataColumn {
  std::string name;
  /// SI; `1` for a number without dimension, empty for words.
  std::string unit;
  /// What the column holds, in words, for formats that have a place for it.
  std::string description;
  /// One value a row. NaN where there is no number.
  std::variant<std::vector<double>, std::vector<std::string>> values;

  /// The header in text files; see ColumnHeader.
  std::string Header() const;
  /// Number of values.
  std::size_t size() const {
    return std::visit([](const auto& all) { return all.size(); }, values);
  }
};

/// A part of a result as columns of equal length.
struct DataTable {
  std::string name;  ///< series, cycles, groups, iterations or bodies.
  /// What tells rows apart: `cycle`, or the column `time`.
  std::string row;
  /// All of the same length.
  std::vector<DataColumn> columns;

  /// Number of rows.
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// The trajectory, a row a sample. The columns are moved out of the recording.
DataTable SeriesTable(Recording&& recording);
/// The ledger of a job, a row a cycle.
DataTable CyclesTable(const v1::Job& job);
/// The groups of the cycles of a job, a row a group.
DataTable GroupsTable(const v1::Job& job);
/// A row for each group of cycles in each pass of each episode.
DataTable IterationsTable(const std::vector<v1::Iteration>& iterations);
/// The bodies of a job at the end of the run, a row a body.
DataTable BodiesTable(const v1::Job& job);

}  // namespace contact::cli
