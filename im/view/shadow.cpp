// Decides by distances from a post's middle to the way between the eye and a corner, without
// rounding.
#include "im/view/shadow.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/basics/exact.h"

namespace rink::im {
namespace {

/// Of the squared distance of two points against that of the post's radius.
int distance_sign(const Disc& post, double x, double y) {
  return sign_of(std::array{post.x, post.y, post.radius, x, y}, [](const auto& n) {
    const auto dx = n[3] - n[0], dy = n[4] - n[1];
    return dx * dx + dy * dy - n[2] * n[2];
  });
}

/// The eye is not inside the post.
bool hides_point(const Disc& post, const Eye& eye, double x, double y) {
  const std::array numbers{post.x, post.y, post.radius, eye.x, eye.y, x, y};
  const int towards = sign_of(numbers, [](const auto& n) {
    return (n[5] - n[3]) * (n[0] - n[3]) + (n[6] - n[4]) * (n[1] - n[4]);
  });
  if (towards <= 0) return false;  // the eye is the nearest of the way
  const int past = sign_of(numbers, [](const auto& n) {
    return (n[5] - n[3]) * (n[5] - n[0]) + (n[6] - n[4]) * (n[6] - n[1]);
  });
  if (past <= 0) return distance_sign(post, x, y) < 0;  // the point is
  return sign_of(numbers, [](const auto& n) {
           const auto way_x = n[5] - n[3], way_y = n[6] - n[4], post_x = n[0] - n[3],
                      post_y = n[1] - n[4];
           const auto miss = way_x * post_y - way_y * post_x;
           return miss * miss - n[2] * n[2] * (way_x * way_x + way_y * way_y);
         }) < 0;
}

/// From `post` to the straight way from the eye to a point.
double distance_to_way(const Disc& post, const Eye& eye, double x, double y) {
  const double way_x = x - eye.x, way_y = y - eye.y, post_x = post.x - eye.x,
               post_y = post.y - eye.y, length = way_x * way_x + way_y * way_y;
  const double part =
      length > 0.0 ? std::clamp((way_x * post_x + way_y * post_y) / length, 0.0, 1.0) : 0.0;
  return std::hypot(post_x - part * way_x, post_y - part * way_y);
}

}  // namespace

/// The way to one point of the box that is free shows it, and stays free while neither of its ends
/// has come so far; the ways to all corners must pass through to hide it.
double shadow_clearance(const Disc& post, const Eye& eye, const Region& box) {
  assert(post.radius >= 0.0 && is_valid(box));
  const double sizes = std::abs(post.x) + std::abs(post.y) + post.radius + std::abs(eye.x) +
                       std::abs(eye.y) + std::abs(box.low_x) + std::abs(box.low_y) +
                       std::abs(box.high_x) + std::abs(box.high_y);
  const double error = 1e-12 * sizes + 1e-50,
               from_eye = std::hypot(post.x - eye.x, post.y - eye.y) - post.radius;
  const double free = std::max(distance_to_way(post, eye, 0.5 * box.low_x + 0.5 * box.high_x,
                                               0.5 * box.low_y + 0.5 * box.high_y) -
                                   post.radius,
                               -from_eye);
  if (free > error) return error - free;
  double hidden = from_eye;
  for (const double x : {box.low_x, box.high_x})
    for (const double y : {box.low_y, box.high_y})
      hidden = std::min(hidden, post.radius - distance_to_way(post, eye, x, y));
  return hidden > error ? hidden - error : 0.0;
}

bool holds(const Disc& post, double x, double y) { return distance_sign(post, x, y) < 0; }

bool hides(const Disc& post, const Eye& eye, const Region& box) {
  assert(post.radius >= 0.0 && box == plain(box));
  // What reaches to the other side of the eye than the post is on is not behind it; most pairs end
  // here. Strictly: then the rounding of the post's edge cannot matter.
  if ((box.low_x < eye.x && eye.x < post.x - post.radius) ||
      (box.high_x > eye.x && eye.x > post.x + post.radius))
    return false;
  if ((box.low_y < eye.y && eye.y < post.y - post.radius) ||
      (box.high_y > eye.y && eye.y > post.y + post.radius))
    return false;
  if (distance_sign(post, eye.x, eye.y) < 0) return false;
  return hides_point(post, eye, box.low_x, box.low_y) &&
         hides_point(post, eye, box.low_x, box.high_y) &&
         hides_point(post, eye, box.high_x, box.low_y) &&
         hides_point(post, eye, box.high_x, box.high_y);
}

}  // namespace rink::im
