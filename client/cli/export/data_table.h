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
  std::string unit;  ///< SI; `1` for a number without dimension, empty for words.
  std::string description;
  std::variant<std::vector<double>, std::vector<std::string>> values;

  /// `velocity [m/s]`; the bare name of a column of words.
  std::string Header() const;
  std::size_t size() const {
    return std::visit([](const auto& all) { return all.size(); }, values);
  }
};

/// A part of a result as columns of equal length.
struct DataTable {
  std::string name;  ///< series, cycles, iterations or bodies.
  std::string row;   ///< What tells rows apart: `cycle`, or the column `time`.
  std::vector<DataColumn> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// The trajectory; its columns are moved out of the recording.
DataTable SeriesTable(Recording&& recording);
/// The ledger.
DataTable CyclesTable(const v1::Job& job);
/// A row for each cycle in each pass of each episode.
DataTable IterationsTable(const std::vector<v1::Iteration>& iterations);
/// The bodies at the end of the run.
DataTable BodiesTable(const v1::Job& job);

}  // namespace contact::cli
