// Decides by the point of the rectangle that is nearest to the eye, or else by where an edge of the
// sector enters the rectangle.
#include "im/view/sector.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>

#include "im/basics/exact.h"

namespace rink::im {
namespace {

/// The cosine and the sine of an angle, up to a common factor: exact where they have one that
/// doubles can say.
Heading turned(double angle_deg) {
  constexpr double degree = 0.017453292519943295;
  if (angle_deg == 45.0) return {1.0, 1.0};
  if (angle_deg == 90.0) return {0.0, 1.0};
  if (angle_deg == 135.0) return {-1.0, 1.0};
  return {std::cos(angle_deg * degree), std::sin(angle_deg * degree)};
}

/// A point as seen from the eye: a difference that is not rounded yet.
struct Seen {
  double x, eye_x, y, eye_y;
};

/// That of a stretch which is nearest to `from`.
double nearest(double from, double low, double high) { return std::max(low, std::min(from, high)); }

int cross_sign(const Heading& a, const Seen& b) {
  return sign_of(std::array{a.x, a.y, b.x, b.eye_x, b.y, b.eye_y},
                 [](const auto& n) { return n[0] * (n[4] - n[5]) - n[1] * (n[2] - n[3]); });
}
int dot_sign(const Heading& a, const Seen& b) {
  return sign_of(std::array{a.x, a.y, b.x, b.eye_x, b.y, b.eye_y},
                 [](const auto& n) { return n[0] * (n[2] - n[3]) + n[1] * (n[4] - n[5]); });
}

/// Both sides of the subscription are at least twice as long as the way to the point.
bool is_in_reach(const Region& subscription, const Seen& point) {
  const auto reaches = [&point](double low, double high) {
    return sign_of(std::array{point.x, point.eye_x, point.y, point.eye_y, low, high},
                   [](const auto& n) {
                     const auto x = n[0] - n[1], y = n[2] - n[3], side = n[5] - n[4];
                     const auto square = x * x + y * y, doubled = square + square;
                     return doubled + doubled - side * side;
                   }) <= 0;
  };
  return reaches(subscription.low_x, subscription.high_x) &&
         reaches(subscription.low_y, subscription.high_y);
}

/// Along one axis a ray from the eye meets the side of a box that it enters through, if it does;
/// across it, the stretch of that side.
struct Crossing {
  double side, eye, low, high, across_eye, ray, across;
};

bool enters_in_reach(const Region& subscription, const Crossing& crossing) {
  const double side = crossing.side, eye = crossing.eye, ray = crossing.ray,
               across = crossing.across;
  if (!((side > eye && ray > 0.0) || (side < eye && ray < 0.0))) return false;
  // (side - eye) across / |ray| lies within the stretch, multiplied by |ray|.
  const double forward = std::abs(ray), sideways = ray > 0.0 ? across : -across;
  const auto beyond = [&](double end) {
    return sign_of(std::array{side, eye, end, crossing.across_eye, forward, sideways},
                   [](const auto& n) { return (n[0] - n[1]) * n[5] - (n[2] - n[3]) * n[4]; });
  };
  if (beyond(crossing.low) < 0 || beyond(crossing.high) > 0) return false;
  const auto reaches = [&](double from, double to) {
    return sign_of(std::array{side, eye, from, to, ray, across}, [](const auto& n) {
             const auto way = n[0] - n[1], diameter = n[3] - n[2];
             const auto doubled = way + way;
             return doubled * doubled * (n[4] * n[4] + n[5] * n[5]) -
                    diameter * diameter * (n[4] * n[4]);
           }) <= 0;
  };
  return reaches(subscription.low_x, subscription.high_x) &&
         reaches(subscription.low_y, subscription.high_y);
}

/// The edge along `ray` comes into `box` before it ends.
bool edge_touches(const Region& subscription, const Eye& eye, const Region& box,
                  const Heading& ray) {
  return enters_in_reach(subscription, {eye.x < box.low_x ? box.low_x : box.high_x, eye.x,
                                        box.low_y, box.high_y, eye.y, ray.x, ray.y}) ||
         enters_in_reach(subscription, {eye.y < box.low_y ? box.low_y : box.high_y, eye.y,
                                        box.low_x, box.high_x, eye.x, ray.y, ray.x});
}

/// Of the corners of `box` seen from the eye: the least distance to the left of a line through the
/// eye.
double least_left_of(const Heading& line, double low_x, double low_y, double high_x,
                     double high_y) {
  const double across_low = line.x * low_y, across_high = line.x * high_y,
               along_low = line.y * low_x, along_high = line.y * high_x;
  return (std::min(across_low, across_high) - std::max(along_low, along_high)) /
         std::sqrt(line.x * line.x + line.y * line.y);
}

}  // namespace

Heading scaled(Heading heading) {
  assert(std::isfinite(heading.x) && std::isfinite(heading.y));
  const double longer = std::max(std::abs(heading.x), std::abs(heading.y));
  if (longer == 0.0) return heading;
  const int exponent = std::ilogb(longer);
  heading = {std::scalbn(heading.x, -exponent), std::scalbn(heading.y, -exponent)};
  for (double* component : {&heading.x, &heading.y})
    if (std::abs(*component) < 0x1p-100) *component = 0.0;
  assert(std::abs(heading.x) < 2.0 && std::abs(heading.y) < 2.0);
  assert(std::abs(heading.x) >= 1.0 || std::abs(heading.y) >= 1.0);
  return heading;
}

/// A box is apart from a sector by its distance from the disc or from one of the two half planes
/// whose common part the wedge is (or, if it is wider than half, from both); it touches as long as
/// one of its points, the nearest or the middle, is inside.
double Wedge::clearance(const Region& subscription, const Region& box) const {
  const Eye eye(subscription);
  const double radius = 0.5 * std::min(subscription.high_x - subscription.low_x,
                                       subscription.high_y - subscription.low_y);
  assert(radius >= 0.0);
  const double low_x = box.low_x - eye.x, low_y = box.low_y - eye.y, high_x = box.high_x - eye.x,
               high_y = box.high_y - eye.y;
  const double error = 1e-12 * (std::abs(eye.x) + std::abs(eye.y) + radius + std::abs(low_x) +
                                std::abs(low_y) + std::abs(high_x) + std::abs(high_y)) +
                       1e-50;
  const double x = nearest(0.0, low_x, high_x), y = nearest(0.0, low_y, high_y);
  double apart = std::sqrt(x * x + y * y) - radius;
  if (width_ != Width::all) {
    const double left = least_left_of(left_, low_x, low_y, high_x, high_y),
                 right = least_left_of({-right_.x, -right_.y}, low_x, low_y, high_x, high_y);
    apart = std::max(apart,
                     width_ == Width::at_most_half ? std::max(left, right) : std::min(left, right));
  }
  if (apart > error) return error - apart;
  const auto depth = [&](double px, double py) {
    const double within_disc = radius - std::sqrt(px * px + py * py);
    if (width_ == Width::all) return within_disc;
    const double left = -least_left_of(left_, px, py, px, py),
                 right = -least_left_of({-right_.x, -right_.y}, px, py, px, py);
    return std::min(within_disc,
                    width_ == Width::at_most_half ? std::min(left, right) : std::max(left, right));
  };
  const double touching =
      std::max(depth(x, y), depth(0.5 * (low_x + high_x), 0.5 * (low_y + high_y)));
  return touching > error ? touching - error : 0.0;
}

Wedge::Wedge(const Heading& ahead, double half_angle_deg) : ahead_(scaled(ahead)) {
  assert(0.0 <= half_angle_deg && half_angle_deg <= 180.0);
  if ((ahead_.x == 0.0 && ahead_.y == 0.0) || half_angle_deg >= 180.0) return;
  width_ = half_angle_deg <= 90.0 ? Width::at_most_half : Width::more_than_half;
  const Heading turn = turned(half_angle_deg);
  left_ = scaled({turn.x * ahead_.x - turn.y * ahead_.y, turn.y * ahead_.x + turn.x * ahead_.y});
  right_ = scaled({turn.x * ahead_.x + turn.y * ahead_.y, turn.x * ahead_.y - turn.y * ahead_.x});
}

/// Of all that the rectangle and the wedge share, the point nearest to the eye decides. If it is
/// not on an edge of the wedge, it is the rectangle's own nearest one: the distance has no other
/// least value on a convex set. So it suffices to look there and where the edges come in.
bool Wedge::touches(const Region& subscription, const Region& box) const {
  assert(subscription == plain(subscription) && box == plain(box));
  const Eye eye(subscription);
  const Seen point{nearest(eye.x, box.low_x, box.high_x), eye.x,
                   nearest(eye.y, box.low_y, box.high_y), eye.y};
  if (!is_in_reach(subscription, point)) return false;
  if (width_ == Width::all) return true;
  const bool is_left_of_right = cross_sign(right_, point) >= 0,
             is_right_of_left = cross_sign(left_, point) <= 0;
  if (width_ == Width::at_most_half
          ? is_left_of_right && is_right_of_left && dot_sign(ahead_, point) >= 0
          : is_left_of_right || is_right_of_left)
    return true;
  return edge_touches(subscription, eye, box, left_) ||
         edge_touches(subscription, eye, box, right_);
}

}  // namespace rink::im
