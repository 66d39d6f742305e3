// SPDX-License-Identifier: MIT
// Moments and insets of outlines with numbers known by hand.
#include "Scene/World/BodyMass.h"
#include <gtest/gtest.h>
#include <numbers>

namespace physvib::shape_geometry_test {

/// 3 x 2 m, its lower left corner at (10, 20).
const PolygonShape rectangle{{{10.0, 20.0}, {13.0, 20.0}, {13.0, 22.0}, {10.0, 22.0}}};

TEST(ShapeGeometry, RectangleIsTheSameAsPolygonAndAsBox) {
    const ShapeMoments polygon = momentsOf(rectangle), box = momentsOf(BoxShape{3.0, 2.0});
    EXPECT_NEAR(polygon.areaSquareMetres, 6.0, 1.0e-12);
    EXPECT_NEAR(polygon.centroidMetres.x, 11.5, 1.0e-12);
    EXPECT_NEAR(polygon.centroidMetres.y, 21.0, 1.0e-12);
    EXPECT_NEAR(polygon.inertiaPerKg, box.inertiaPerKg, 1.0e-12);
    EXPECT_DOUBLE_EQ(box.inertiaPerKg, 13.0 / 12.0);
    EXPECT_NEAR(thicknessMetres(rectangle), 2.0, 1.0e-12);
}

TEST(ShapeGeometry, TriangleHasATwelfthOfItsSquares) {
    const ShapeMoments m = momentsOf(PolygonShape{{{0.0, 0.0}, {3.0, 0.0}, {0.0, 4.0}}});
    EXPECT_DOUBLE_EQ(m.areaSquareMetres, 6.0);
    EXPECT_DOUBLE_EQ(m.centroidMetres.x, 1.0);
    EXPECT_DOUBLE_EQ(m.centroidMetres.y, 4.0 / 3.0);
    EXPECT_NEAR(m.inertiaPerKg, 25.0 / 18.0, 1.0e-12); // right triangle: (a^2 + b^2) / 18
    EXPECT_NEAR(thicknessMetres(PolygonShape{{{0.0, 0.0}, {3.0, 0.0}, {0.0, 4.0}}}), 12.0 / 5.0, 1.0e-12);
}

TEST(ShapeGeometry, CircleAndChain) {
    EXPECT_DOUBLE_EQ(momentsOf(CircleShape{2.0}).areaSquareMetres, 4.0 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(momentsOf(CircleShape{2.0}).inertiaPerKg, 2.0);
    EXPECT_EQ(momentsOf(ChainShape{{{0.0, 0.0}, {1.0, 0.0}}}).areaSquareMetres, 0.0);
}

TEST(ShapeGeometry, InsetMovesEveryEdgeInwards) {
    const auto inner = inset(rectangle.verticesMetres, 0.5);
    const ShapeMoments m = momentsOf(PolygonShape{inner});
    EXPECT_NEAR(m.areaSquareMetres, 2.0, 1.0e-12);
    EXPECT_NEAR(m.centroidMetres.x, 11.5, 1.0e-12);
    EXPECT_TRUE(isConvexCounterClockwise(inner));
}

TEST(ShapeGeometry, InsetLosesEdgesThatAreTooShort) {
    // A corner cut off by 0.1 m: half a metre inside, nothing of the cut is left.
    const auto inner = inset({{0.0, 0.0}, {3.9, 0.0}, {4.0, 0.1}, {4.0, 4.0}, {0.0, 4.0}}, 0.5);
    EXPECT_EQ(inner.size(), 4U);
    EXPECT_NEAR(momentsOf(PolygonShape{inner}).areaSquareMetres, 9.0, 1.0e-12);
}

TEST(ShapeGeometry, InsetDeeperThanTheOutlineIsEmpty) {
    EXPECT_TRUE(inset(rectangle.verticesMetres, 1.1).empty());
}

} // namespace physvib::shape_geometry_test
