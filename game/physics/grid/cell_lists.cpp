// Room for cells, and for more in each.
#include "game/physics/grid/cell_lists.h"

#include <utility>

namespace rink::physics {

void CellLists::restart(std::uint32_t columns, std::uint32_t rows) {
  assert(columns > 0 && rows > 0);
  pitch_ = std::size_t{columns} + 2;
  stride_ = stride_min;
  collected_max_ = room_for_nine();
  lists_.assign((std::size_t{rows} + 2) * pitch_ * stride_, 0);
}

void CellLists::widen() {
  const std::size_t count = lists_.size() / stride_;
  LargeArray<std::uint32_t> wider(2 * lists_.size());
  for (std::size_t cell = 0; cell < count; ++cell)
    std::copy_n(&lists_[cell * stride_], stride_, &wider[cell * 2 * stride_]);
  lists_ = std::move(wider);
  stride_ *= 2;
  require_room(room_for_nine());
}

}  // namespace rink::physics
