// The camera on the table: in perspective from the players' places, or from straight above.
#pragma once

#include <Eigen/Core>

namespace rink::view {

using Vector3 = Eigen::Vector3f;

/// Metres; x along the field, y across it, z up, the table's surface is z = 0.
struct Camera {
  bool is_plan = false;  ///< from straight above, without perspective
  Vector3 eye{0.0f, 0.0f, 1.0f}, target{1.0f, 0.0f, 0.0f};
  float opening = 0.6f;                    ///< angle of view from bottom to top [rad]
  float centre_x = 0.0f, centre_y = 0.0f;  ///< of a plan
  float half_height = 1.0f;                ///< of a plan: half the visible height [m]
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// A camera in a window of some shape: converts between pixels and places.
class Sight {
 public:
  /// `aspect` is width by height of the window.
  Sight(const Camera& camera, float aspect);

  /// Column-major, to OpenGL's clip space.
  const Eigen::Matrix4f& matrix() const { return matrix_; }
  const Vector3& eye() const { return eye_; }
  const Vector3& right() const {
    return right_;
  }                                          ///< scaled by half the window's width at distance 1
  const Vector3& up() const { return up_; }  ///< scaled by half the window's height at distance 1
  const Vector3& forward() const { return forward_; }
  /// The place of `place` in the window, from -1 to 1 each way, y up.
  Eigen::Vector2f project(const Vector3& place) const;
  /// The place on the table that is seen at `window`.
  Eigen::Vector2f on_table(const Eigen::Vector2f& window) const;

 private:
  Eigen::Matrix4f matrix_;
  Vector3 eye_, right_, up_, forward_;
  bool is_plan_;
};

}  // namespace rink::view
