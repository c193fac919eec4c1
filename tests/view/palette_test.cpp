// Whether colour-blind people tell the teams apart: seen through a model of their eyes.
#include "game/view/palette.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <set>

namespace rink::view {
namespace {

using Matrix = Eigen::Matrix3d;

/// Of linear red, green and blue (Machado, Oliveira and Fernandes, IEEE TVCG 15, 2009, severity 1).
Matrix matrix(std::initializer_list<double> rows) {
  Matrix m;
  int at = 0;
  for (const double each : rows) m(at / 3, at % 3) = each, ++at;
  return m;
}
const Matrix protan = matrix({0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216,
                              -0.003882, -0.048116, 1.051998}),
             deutan = matrix({0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413,
                              -0.011820, 0.042940, 0.968881}),
             tritan = matrix({1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602,
                              0.004733, 0.691367, 0.303900});

Eigen::Vector3d lab(const Colour& colour, const Matrix& eye) {
  const auto linear = [](float shown) {
    const auto c = static_cast<double>(shown);
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const Eigen::Vector3d seen =
      (eye * Eigen::Vector3d(linear(colour.red), linear(colour.green), linear(colour.blue)))
          .cwiseMax(0.0)
          .cwiseMin(1.0);
  const Eigen::Vector3d xyz = (matrix({0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522,
                                       0.0721750, 0.0193339, 0.1191920, 0.9503041}) *
                               seen)
                                  .cwiseQuotient(Eigen::Vector3d(0.95047, 1.0, 1.08883));
  const Eigen::Vector3d f =
      xyz.unaryExpr([](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

/// The least difference (CIE 1976; 2.3 is just noticed) between the teams, and each and the puck.
double least_difference(const Palette& palette, const Matrix& eye) {
  const auto apart = [&](const Colour& a, const Colour& b) {
    return (lab(a, eye) - lab(b, eye)).norm();
  };
  return std::min({apart(palette.left, palette.right), apart(palette.left, palette.ring),
                   apart(palette.right, palette.ring)});
}

TEST(Palettes, AreToldApartBestByThoseForWhomTheyAre) {
  const Palette &usual = palette_of(PaletteKind::standard),
                &orange = palette_of(PaletteKind::no_red_green),
                &green = palette_of(PaletteKind::no_blue_yellow);
  for (const Matrix& eye : {protan, deutan}) {
    EXPECT_GT(least_difference(orange, eye), 75.0);
    EXPECT_GT(least_difference(orange, eye), 1.5 * least_difference(usual, eye));
  }
  EXPECT_GT(least_difference(green, tritan), 52.0);
  EXPECT_GT(least_difference(green, tritan), least_difference(usual, tritan));
  for (const Palette& palette : palettes)
    EXPECT_GT(least_difference(palette, Matrix::Identity()), 50.0) << palette.name;
}

TEST(Palettes, AreFoundByTheirNamesAlone) {
  std::set<std::string> names;
  for (const Palette& palette : palettes) {
    EXPECT_EQ(&palette_of(palette_from_name(palette.name).value()), &palette);
    EXPECT_TRUE(names.insert(palette.name).second);
  }
  EXPECT_FALSE(palette_from_name("Red-Blue"));
  EXPECT_FALSE(palette_from_name(""));
}

}  // namespace
}  // namespace rink::view
