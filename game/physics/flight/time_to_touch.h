// When two discs in straight flight first touch: the stable quadratic, in any scalar.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace rink::physics {

/// Two discs that graze each other at a gap of some roundings close at a rate that is a rounding
/// itself, and the root of D, which has another way to be computed, may be greater: by 4e-8 of the
/// relative speed and the reach at most (docs/physics.md, "Discs"); seven roots of epsilon are
/// more.
template <class Scalar>
constexpr Scalar root_rounding = std::is_same_v<Scalar, float> ? Scalar(2.5e-3) : Scalar(1e-7);

template <class Scalar>
Scalar cross(const Eigen::Matrix<Scalar, 2, 1>& a, const Eigen::Matrix<Scalar, 2, 1>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Time [s] until two discs first touch, or nothing if they never do. `offset` [m] and `velocity`
/// [m/s] are those of B seen from A, `reach` [m] is the sum of the radii. Discs in contact and
/// closing give 0. Nothing, too, if the time exceeds `limit` [s].
template <class Scalar>
std::optional<Scalar> time_to_touch(
    const Eigen::Matrix<std::type_identity_t<Scalar>, 2, 1>& offset,
    const Eigen::Matrix<std::type_identity_t<Scalar>, 2, 1>& velocity, Scalar reach,
    std::type_identity_t<Scalar> limit = std::numeric_limits<Scalar>::infinity()) {
  const Scalar closing = -offset.dot(velocity);
  if (closing <= 0.0) return std::nullopt;
  const Scalar gap = offset.squaredNorm() - reach * reach;
  if (gap <= 0.0) return Scalar(0.0);
  // Two square roots saved in most cases: sqrt(D) <= closing, but for roundings.
  const Scalar slack =
      root_rounding<Scalar> * reach * (std::abs(velocity.x()) + std::abs(velocity.y()));
  if (gap > (2.001 * closing + slack) * limit) return std::nullopt;
  // closing^2 - |velocity|^2 gap is the same number but cancels: 40 to 300 times larger median
  // error on long and grazing flights (docs/physics.md, "Discs").
  const Scalar miss = cross(offset, velocity), square = velocity.squaredNorm();
  if (miss * miss > 1.001 * square * reach * reach) return std::nullopt;
  const Scalar speed_reach = std::sqrt(square) * reach;
  const Scalar discriminant = (speed_reach - miss) * (speed_reach + miss);
  if (discriminant < 0.0) return std::nullopt;
  const Scalar wait = gap / (closing + std::sqrt(discriminant));
  if (wait > limit) return std::nullopt;
  return wait;
}

}  // namespace rink::physics
