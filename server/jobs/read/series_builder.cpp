#include "jobs/read/series_builder.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "jobs/read/frame_values.h"
#include "wire/column_bytes.h"

namespace contact {

SeriesBuilder::SeriesBuilder(SeriesSelection selection,
                             std::vector<v1::FrameChunk::Column> channels, std::size_t first)
    : selection_(std::move(selection)), channels_(std::move(channels)), first_(first) {
  Restart();
}

void SeriesBuilder::Restart() {
  columns_ = selection_.columns;
  missing_.clear();
  const std::size_t width = columns_.size();
  decimator_.reset();
  if (!selection_.raw) decimator_.emplace(width, selection_.max_rows);
  joiner_ = {};
  raw_.assign(width, "");
  recorded_ = 0;
}

bool SeriesBuilder::Fits(const v1::FrameChunk& chunk) const {
  return chunk.columns_size() > 0 && chunk.columns_size() <= static_cast<int>(channels_.size()) &&
         IsWhole(chunk);
}

bool SeriesBuilder::IsBefore(const v1::FrameChunk& chunk) const {
  const int rows = chunk.samples();
  return rows > 0 && ValueAt(chunk.columns(0), rows - 1) < selection_.start_time;
}

bool SeriesBuilder::IsPast(const v1::FrameChunk& chunk) const {
  return chunk.samples() > 0 && ValueAt(chunk.columns(0), 0) > selection_.end_time;
}

bool SeriesBuilder::Add(const v1::FrameChunk& chunk) {
  if (!Fits(chunk)) return false;
  const v1::FrameChunk* const whole = joiner_.Add(chunk);
  if (whole == nullptr) return true;
  if (!Narrow(static_cast<std::size_t>(whole->columns_size()))) return false;
  const v1::FrameChunk::Column& times = whole->columns(0);
  int first = 0;
  while (first < whole->samples() && ValueAt(times, first) < selection_.start_time) ++first;
  int end = first;
  while (end < whole->samples() && ValueAt(times, end) <= selection_.end_time) ++end;
  AddRows(*whole, static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
  return true;
}

bool SeriesBuilder::Narrow(std::size_t columns) {
  if (columns == channels_.size()) return true;
  if (columns != first_) return false;
  const auto lacks = [&](int column) { return static_cast<std::size_t>(column) >= columns; };
  if (std::ranges::none_of(columns_, lacks)) return true;
  for (const int column : columns_) {
    if (lacks(column) && !selection_.all) {
      missing_.push_back(channels_[static_cast<std::size_t>(column)]);
    }
  }
  std::erase_if(columns_, lacks);
  if (decimator_) decimator_.emplace(columns_.size(), selection_.max_rows);
  raw_.resize(columns_.size());
  return true;
}

void SeriesBuilder::AddRows(const v1::FrameChunk& chunk, std::size_t first, std::size_t count) {
  std::vector<std::string_view> table;
  for (const int column : columns_) table.emplace_back(chunk.columns(column).values());
  recorded_ += count;
  if (decimator_) return decimator_->Add(table, first, count);
  if (TooLarge()) return;
  for (std::size_t i = 0; i < table.size(); ++i) {
    raw_[i] += table[i].substr(first * sizeof(double), count * sizeof(double));
  }
}

bool SeriesBuilder::TooLarge() const { return selection_.raw && recorded_ > selection_.max_rows; }

Result<v1::Series> SeriesBuilder::Finish() const {
  if (!missing_.empty()) return NotRecorded(missing_);
  if (TooLarge()) return SeriesTooLarge(selection_.max_rows);
  const std::size_t width = columns_.size();
  const std::vector<double> rows = decimator_ ? decimator_->Rows() : std::vector<double>();
  v1::Series series;
  series.set_samples(static_cast<std::int32_t>(decimator_ ? rows.size() / width : recorded_));
  series.set_recorded_samples(static_cast<std::int64_t>(recorded_));
  for (std::size_t i = 0; i < width; ++i) {
    v1::FrameChunk::Column& column = *series.add_columns();
    column = channels_[static_cast<std::size_t>(columns_[i])];
    std::string values = decimator_ ? ColumnBytes(rows, width, i) : raw_[i];
    if (selection_.plain_numbers) {
      const std::vector<double> numbers = Doubles(values);
      column.mutable_numbers()->Add(numbers.begin(), numbers.end());
    } else {
      column.set_values(std::move(values));
    }
  }
  return series;
}

}  // namespace contact
