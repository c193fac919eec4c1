// Cuts polygons and solves for nearest points in numbers so wide that only true ties are closer
// than they can tell.
#include "tests/im/view_truth.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

namespace rink::im {
namespace {

using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<1600, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

/// The same is worked out in long double first; true after a comparison that it may have got wrong.
bool is_doubtful = false;

template <class Real>
struct Point {
  Real x, y;
};

template <class Real>
Real dot(const Point<Real>& a, const Point<Real>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Real>
Real cross(const Point<Real>& a, const Point<Real>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Real>
Point<Real> operator-(const Point<Real>& a, const Point<Real>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class Real>
Point<Real> operator+(const Point<Real>& a, const Point<Real>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class Real>
Point<Real> operator*(const Real& scale, const Point<Real>& a) {
  return {scale * a.x, scale * a.y};
}

/// 2^-1000 of `scale` is what 1600 bits may have lost; a difference of doubles that is not 0 is
/// larger.
int sign(const Wide& value, const Wide& scale) {
  static const Wide lost = ldexp(Wide(1), -1000);
  if (abs(value) <= lost * scale) return 0;
  return value > 0 ? 1 : -1;
}
int sign(long double value, long double scale) {
  if (!(std::abs(value) > 1e-12L * scale)) is_doubtful = true;
  return value > 0.0L ? 1 : value < 0.0L ? -1 : 0;
}

/// Runs `judge` with long doubles, and if they may have erred with wide numbers.
template <class Judge>
bool sure(const Judge& judge) {
  is_doubtful = false;
  const bool answer = judge(0.0L);
  return is_doubtful ? judge(Wide(0)) : answer;
}

/// As the schemes take numbers: none beyond 2^200, and those below 2^-200 are 0.
double plain_of(double number) {
  return std::abs(number) < 0x1p-200 ? 0.0 : std::max(-0x1p200, std::min(0x1p200, number));
}
Region plain_of(const Region& region) {
  return {plain_of(region.low_x), plain_of(region.low_y), plain_of(region.high_x),
          plain_of(region.high_y)};
}

template <class Real>
Point<Real> middle_of(const Region& region) {
  const auto [x, y] = eye_of(region);
  return {Real(x), Real(y)};
}

/// Sutherland and Hodgman: what of a convex polygon lies to the left of `edge`.
template <class Real>
std::vector<Point<Real>> left_of(const Point<Real>& edge, const std::vector<Point<Real>>& polygon) {
  using std::abs;
  const auto side = [&edge](const Point<Real>& point) {
    return sign(cross(edge, point),
                Real((abs(edge.x) + abs(edge.y)) * (abs(point.x) + abs(point.y))));
  };
  std::vector<Point<Real>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point<Real>&from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const int from_side = side(from), to_side = side(to);
    if (from_side >= 0) kept.push_back(from);
    if (from_side * to_side < 0)
      kept.push_back(from +
                     Real(cross(edge, from) / (cross(edge, from) - cross(edge, to))) * (to - from));
  }
  return kept;
}

template <class Real>
Real nearest_squared(const std::vector<Point<Real>>& polygon, Real best) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point<Real>&from = polygon[i], way = polygon[(i + 1) % polygon.size()] - from;
    const Real length = dot(way, way);
    const Real share =
        length == 0 ? Real(0) : std::clamp(Real(-dot(from, way) / length), Real(0), Real(1));
    const Point<Real> point = from + share * way;
    best = std::min(best, Real(dot(point, point)));
  }
  return best;
}

/// As the scheme defines its edges: rotated in doubles, with the whole and half right angles exact.
template <class Real>
Point<Real> rotated(const Heading& heading, double angle_deg, double towards) {
  double c = std::cos(angle_deg * 0.017453292519943295),
         s = std::sin(angle_deg * 0.017453292519943295);
  if (angle_deg == 90.0) c = 0.0, s = 1.0;
  if (angle_deg == 45.0) c = s = 1.0;
  if (angle_deg == 135.0) c = -1.0, s = 1.0;
  const auto shown = [](double a, double b) {
    const int exponent = std::ilogb(std::max(std::abs(a), std::abs(b)));
    const auto part = [exponent](double length) {
      return std::abs(std::ldexp(length, -exponent)) < 0x1p-100 ? 0.0
                                                                : std::ldexp(length, -exponent);
    };
    return std::pair{part(a), part(b)};
  };
  const auto [x, y] = shown(heading.x, heading.y);
  const double turn = towards * s;
  const auto [edge_x, edge_y] = shown(c * x - turn * y, turn * x + c * y);
  return {Real(edge_x), Real(edge_y)};
}

template <class Real>
bool sector_touches_in(const FilterSettings& settings, const Observer& observer,
                       const Region& update) {
  const Point<Real> eye = middle_of<Real>(observer);
  const auto corner = [&eye](double x, double y) { return Point<Real>{Real(x), Real(y)} - eye; };
  using Polygon = std::vector<Point<Real>>;
  const Polygon box{corner(update.low_x, update.low_y), corner(update.high_x, update.low_y),
                    corner(update.high_x, update.high_y), corner(update.low_x, update.high_y)};
  if (update.low_x <= eye.x && eye.x <= update.high_x && update.low_y <= eye.y &&
      eye.y <= update.high_y)
    return true;
  const Real diameter = std::min(Real(Real(observer.high_x) - observer.low_x),
                                 Real(Real(observer.high_y) - observer.low_y));
  const auto reaches = [&](const Polygon& polygon) {
    if (polygon.empty()) return false;
    const Real nearest = nearest_squared(polygon, Real(dot(polygon.front(), polygon.front())));
    return sign(Real(4 * nearest - diameter * diameter), Real(4 * nearest + diameter * diameter)) <=
           0;
  };
  if (observer.heading == Heading{} || settings.half_angle_deg >= 180.0) return reaches(box);
  // Parts less than a straight angle wide: of what is ahead the two sides of the middle, and of
  // what is behind what is left of each side.
  const auto edge = [&](double towards) {
    return rotated<Real>(observer.heading, towards == 0.0 ? 0.0 : settings.half_angle_deg, towards);
  };
  const Point<Real> ahead = edge(0.0), left = edge(1.0), right = edge(-1.0),
                    around_left{-ahead.y, ahead.x}, around_right{ahead.y, -ahead.x};
  const Polygon before = left_of(around_right, box);
  const auto between = [&](const Point<Real>& from, const Point<Real>& to, const Polygon& polygon) {
    return reaches(left_of(from, left_of(Point<Real>{-to.x, -to.y}, polygon)));
  };
  if (settings.half_angle_deg <= 90.0)
    return between(right, ahead, before) || between(ahead, left, before);
  return reaches(before) || between(around_left, left, box) || between(right, around_right, box);
}

template <class Real>
bool is_in_shadow_in(const Disc& post, const Region& subscription, double x, double y) {
  const Point<Real> eye = middle_of<Real>(subscription), way = Point<Real>{Real(x), Real(y)} - eye,
                    middle = Point<Real>{Real(post.x), Real(post.y)} - eye;
  const Real length = dot(way, way), radius = Real(post.radius) * post.radius;
  const Real share =
      length == 0 ? Real(0) : std::clamp(Real(dot(way, middle) / length), Real(0), Real(1));
  const Point<Real> offset = share * way - middle;
  return sign(Real(dot(offset, offset) - radius), Real(radius + dot(middle, middle))) < 0;
}

bool are_apart(const Region& a, const Region& b) {
  return b.high_x < a.low_x || a.high_x < b.low_x || b.high_y < a.low_y || a.high_y < b.low_y;
}

}  // namespace

std::pair<double, double> eye_of(const Region& subscription) {
  const Region seen = plain_of(subscription);
  return {plain_of(0.5 * seen.low_x + 0.5 * seen.high_x),
          plain_of(0.5 * seen.low_y + 0.5 * seen.high_y)};
}

bool sector_touches(const FilterSettings& settings, const Observer& observer,
                    const Region& update) {
  if (are_apart(observer, update)) return false;
  const Observer seen{plain_of(static_cast<const Region&>(observer)), observer.heading, {}};
  return sure([&]<class Real>(const Real&) {
    return sector_touches_in<Real>(settings, seen, plain_of(update));
  });
}

bool is_in_shadow(const Disc& post, const Region& subscription, double x, double y) {
  return sure([&]<class Real>(const Real&) {
    return is_in_shadow_in<Real>(post, plain_of(subscription), plain_of(x), plain_of(y));
  });
}

bool is_in_sight(const FilterSettings& settings, const Region& subscription, const Region& update) {
  if (are_apart(subscription, update)) return false;
  const std::array eye{eye_of(subscription).first, eye_of(subscription).second};
  return std::none_of(settings.posts.begin(), settings.posts.end(), [&](const Disc& post) {
    const auto is_dark = [&](double x, double y) { return is_in_shadow(post, subscription, x, y); };
    if (is_dark(eye[0], eye[1])) return false;
    return is_dark(update.low_x, update.low_y) && is_dark(update.low_x, update.high_y) &&
           is_dark(update.high_x, update.low_y) && is_dark(update.high_x, update.high_y);
  });
}

}  // namespace rink::im
