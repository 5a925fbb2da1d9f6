#include "jobs/read/series_builder.h"

#include <utility>

#include "jobs/read/frame_values.h"
#include "wire/column_bytes.h"

namespace contact {

SeriesBuilder::SeriesBuilder(SeriesSelection selection,
                             std::vector<v1::FrameChunk::Column> channels)
    : selection_(std::move(selection)), channels_(std::move(channels)) {
  Restart();
}

void SeriesBuilder::Restart() {
  decimator_.reset();
  if (!selection_.raw) decimator_.emplace(selection_.columns.size(), selection_.max_rows);
  joiner_ = {};
  rows_.clear();
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
  if (whole->columns_size() != static_cast<int>(channels_.size())) return false;
  for (int row = 0; row < whole->samples(); ++row) {
    const double time = ValueAt(whole->columns(0), row);
    if (time < selection_.start_time || time > selection_.end_time) continue;
    AddRow(*whole, row);
  }
  return true;
}

void SeriesBuilder::AddRow(const v1::FrameChunk& chunk, int row) {
  ++recorded_;
  if (selection_.raw && recorded_ > static_cast<std::int64_t>(selection_.max_rows)) return;
  const std::size_t begin = rows_.size();
  for (const int column : selection_.columns) rows_.push_back(ValueAt(chunk.columns(column), row));
  if (!decimator_) return;
  decimator_->Add(std::span(rows_).subspan(begin));
  rows_.clear();
}

Result<v1::Series> SeriesBuilder::Finish() const {
  if (selection_.raw && recorded_ > static_cast<std::int64_t>(selection_.max_rows)) {
    return SeriesTooLarge(selection_.max_rows);
  }
  const std::vector<double> rows = decimator_ ? decimator_->Rows() : rows_;
  const std::size_t width = selection_.columns.size();
  v1::Series series;
  series.set_samples(static_cast<std::int32_t>(rows.size() / width));
  series.set_recorded_samples(recorded_);
  for (std::size_t i = 0; i < width; ++i) {
    v1::FrameChunk::Column& column = *series.add_columns();
    column = channels_[static_cast<std::size_t>(selection_.columns[i])];
    if (!selection_.plain_numbers) {
      column.set_values(ColumnBytes(rows, width, i));
      continue;
    }
    for (std::size_t at = i; at < rows.size(); at += width) column.add_numbers(rows[at]);
  }
  return series;
}

}  // namespace contact
