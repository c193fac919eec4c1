// Boxes in four columns, as scans read them.
#pragma once

#include "im/matching/advance.h"
#include "im/matching/buffer.h"
#include "im/matching/index/scan.h"
#include "im/matching/projection.h"

namespace rink::im {

/// Grows without losing what there is.
class BoxStore {
 public:
  /// Scans read this many boxes past the last.
  static constexpr std::size_t readable_past_the_end = 8;

  void resize(std::size_t count) {
    for (Buffer<float>* column : {&low_x_, &low_y_, &high_x_, &high_y_}) {
      column->resize(count + readable_past_the_end);
      for (std::size_t i = count; i < column->size(); ++i) (*column)[i] = 0.0f;
    }
  }
  void set(std::size_t i, const FloatBox& box) {
    low_x_[i] = box.low_x, low_y_[i] = box.low_y, high_x_[i] = box.high_x, high_y_[i] = box.high_y;
  }
  FloatBox operator[](std::size_t i) const {
    return {low_x_[i], low_y_[i], high_x_[i], high_y_[i]};
  }
  BoxColumnsOut columns() { return {low_x_.data(), low_y_.data(), high_x_.data(), high_y_.data()}; }
  BoxColumns columns() const {
    return {low_x_.data(), low_y_.data(), high_x_.data(), high_y_.data()};
  }
  std::size_t bytes() const { return 4 * sizeof(float) * low_x_.capacity(); }

 private:
  Buffer<float> low_x_, low_y_, high_x_, high_y_;
};

}  // namespace rink::im
