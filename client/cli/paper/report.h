#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/figures/figure.h"

namespace contact::cli {

/// Stands for a number that the paper does not print, or that is not compared.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A number of the paper beside ours, all in the same unit.
struct Comparison {
  /// What the number is, with its unit.
  std::string what;
  /// As printed; NaN: the print cannot be read.
  double published = kNoNumber;
  /// Ours by the published process and definition.
  double process = kNoNumber;
  /// Ours by the default solver, to its tolerance.
  double converged = kNoNumber;
  /// Documented |process − published|; NaN: not compared.
  double limit = kNoNumber;
  /// Why they differ, in a line; empty where they do not.
  std::string why{};

  /// process − published.
  double deviation() const { return process - published; }
  /// True if the deviation is within the limit, or nothing is compared.
  bool holds() const;
};

/// Columns of numbers, which become a CSV file.
struct Data {
  std::string name;                       ///< Of the file, without its ending.
  std::vector<std::string> columns;       ///< Names with units, such as `force [N]`.
  std::vector<std::vector<double>> rows;  ///< Each as long as `columns`.
  std::string note = {};                  ///< What the rows are, where the columns do not tell.
};

/// A figure or table of the paper, made again.
struct PaperItem {
  std::string id;     ///< Such as `fig12`.
  std::string title;  ///< What it shows.
  /// Its numbers beside those of the paper; empty if none are shown.
  std::vector<Comparison> numbers;
  /// What its curves or cells are drawn from.
  std::vector<Data> data;
  std::optional<Figure> figure = {};  ///< None for tables.

  /// What a reader should know of all its numbers, as a sentence; empty if nothing.
  std::string note = {};

  /// True if all its numbers hold.
  bool holds() const;
};

/// Writes an item to files of `directory`: its data as CSV, its numbers as ID.txt and ID.json.
/// Throws Failure (kLocal) if a file cannot be written.
void Write(const PaperItem& item, const std::filesystem::path& directory);

/// A number with five significant digits; empty for NaN.
std::string Short(double value);

/// The deviation with its sign, such as `+1.2e-04`; empty for a number that is not compared.
std::string DeviationText(const Comparison& number);

/// The documented limit of the deviation, such as `0.0007`; empty for a number that is not
/// compared.
std::string LimitText(const Comparison& number);

/// The numbers of all items as one table with their notes below; empty if there are none.
std::string Summary(const std::vector<PaperItem>& items, const Style& style);

}  // namespace contact::cli
