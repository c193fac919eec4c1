// Decides by distances from a post's middle to the way between the eye and a corner, without rounding.
#include "im/view/shadow.h"

#include "im/view/exact.h"

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
  const int towards = sign_of(numbers, [](const auto& n) { return (n[5] - n[3]) * (n[0] - n[3]) + (n[6] - n[4]) * (n[1] - n[4]); });
  if (towards <= 0) return false;  // the eye is the nearest of the way
  const int past = sign_of(numbers, [](const auto& n) { return (n[5] - n[3]) * (n[5] - n[0]) + (n[6] - n[4]) * (n[6] - n[1]); });
  if (past <= 0) return distance_sign(post, x, y) < 0;  // the point is
  return sign_of(numbers, [](const auto& n) {
           const auto way_x = n[5] - n[3], way_y = n[6] - n[4], post_x = n[0] - n[3], post_y = n[1] - n[4];
           const auto miss = way_x * post_y - way_y * post_x;
           return miss * miss - n[2] * n[2] * (way_x * way_x + way_y * way_y);
         }) < 0;
}

}  // namespace

bool hides(const Disc& post, const Eye& eye, const Region& box) {
  // What reaches to the other side of the eye than the post is on is not behind it; most pairs end here. Strictly: then the rounding of the post's edge cannot matter.
  if ((box.low_x < eye.x && eye.x < post.x - post.radius) || (box.high_x > eye.x && eye.x > post.x + post.radius)) return false;
  if ((box.low_y < eye.y && eye.y < post.y - post.radius) || (box.high_y > eye.y && eye.y > post.y + post.radius)) return false;
  if (distance_sign(post, eye.x, eye.y) < 0) return false;
  return hides_point(post, eye, box.low_x, box.low_y) && hides_point(post, eye, box.low_x, box.high_y) && hides_point(post, eye, box.high_x, box.low_y) &&
         hides_point(post, eye, box.high_x, box.high_y);
}

}  // namespace rink::im
