// The usual projections, built from the camera's own three directions.
#include "game/view/render/camera.h"

#include <Eigen/Geometry>
#include <cmath>

namespace rink::view {
namespace {

constexpr float near = 0.05f, far = 60.0f;  // m

Eigen::Matrix4f perspective(const Vector3& eye, const Vector3& right, const Vector3& up,
                            const Vector3& forward, const Eigen::Vector2f& tangents) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Zero();
  matrix.block<1, 3>(0, 0) = right.transpose() / tangents.x();
  matrix.block<1, 3>(1, 0) = up.transpose() / tangents.y();
  matrix.block<1, 3>(2, 0) = forward.transpose() * ((far + near) / (far - near));
  matrix.block<1, 3>(3, 0) = forward.transpose();
  matrix.col(3) = matrix * Eigen::Vector4f(-eye.x(), -eye.y(), -eye.z(), 0.0f);
  matrix(2, 3) -= 2.0f * far * near / (far - near);
  return matrix;
}

}  // namespace

Sight::Sight(const Camera& camera, float aspect) : is_plan_(camera.is_plan) {
  if (is_plan_) {
    eye_ = Vector3(camera.centre_x, camera.centre_y, 10.0f);
    right_ = Vector3(camera.half_height * aspect, 0.0f, 0.0f);
    up_ = Vector3(0.0f, camera.half_height, 0.0f);
    forward_ = Vector3(0.0f, 0.0f, -1.0f);
    matrix_ = Eigen::Matrix4f::Identity();
    matrix_(0, 0) = 1.0f / right_.x(), matrix_(0, 3) = -eye_.x() / right_.x();
    matrix_(1, 1) = 1.0f / up_.y(), matrix_(1, 3) = -eye_.y() / up_.y();
    matrix_(2, 2) = -0.05f;
    return;
  }
  eye_ = camera.eye;
  forward_ = (camera.target - camera.eye).normalized();
  const Vector3 right = forward_.cross(Vector3::UnitZ()).normalized(), up = right.cross(forward_);
  const float tangent_y = std::tan(camera.opening / 2.0f), tangent_x = tangent_y * aspect;
  matrix_ = perspective(eye_, right, up, forward_, {tangent_x, tangent_y});
  right_ = right * tangent_x;
  up_ = up * tangent_y;
}

Eigen::Vector2f Sight::project(const Vector3& place) const {
  const Eigen::Vector4f clip = matrix_ * place.homogeneous();
  return clip.head<2>() / clip.w();
}

Eigen::Vector2f Sight::on_table(const Eigen::Vector2f& window) const {
  const Vector3 aside = right_ * window.x() + up_ * window.y();
  if (is_plan_) return (eye_ + aside).head<2>();
  const Vector3 ray = forward_ + aside;
  return (eye_ - ray * (eye_.z() / ray.z())).head<2>();
}

}  // namespace rink::view
