#include "results/results_blocks.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

constexpr std::size_t kBlock = 1U << 16U;  // numbers

}  // namespace

double* BlockVariable::at(std::size_t variant) {
  if (!held_.empty() && variant - first_ >= std::max<std::size_t>(1, kBlock / size_)) flush();
  if (held_.empty()) first_ = variant;
  const std::size_t variants = variant - first_ + 1;
  if (held_.size() < variants * size_) held_.resize(variants * size_, kNone);
  return held_.data() + (variant - first_) * size_;
}

void BlockVariable::flush() {
  if (held_.empty()) return;
  std::vector<std::size_t> first(extent_.size(), 0);
  std::vector<std::size_t> extent = extent_;
  if (swept_) {
    first.insert(first.begin(), first_);
    extent.insert(extent.begin(), held_.size() / size_);
  }
  file_->put(id_, held_, first, extent);
  held_.clear();
}

void RowVariable::add(double value) {
  values_.push_back(value);
  if (values_.size() == kBlock) flush();
}

void RowVariable::add(std::string word) {
  words_.push_back(std::move(word));
  if (words_.size() == kBlock) flush();
}

void RowVariable::flush() {
  const std::size_t count = values_.size() + words_.size();
  file_->put(id_, std::span<const double>(values_), {written_}, {count});
  file_->put(id_, std::span<const std::string>(words_), {written_}, {count});
  written_ += count;
  values_.clear();
  words_.clear();
}

}  // namespace flexspline::studies
