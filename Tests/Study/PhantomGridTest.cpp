// SPDX-License-Identifier: MIT
// Points of a grid, and the cell that a place belongs to.
#include "Lab/Study/Identification.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(PhantomGrid, CornersAreSharedAndPointsAreTheirOwnNearest) {
    for (const PhantomGrid grid :
         {PhantomGrid{3, 3}, {4, 4}, {5, 5}, {7, 5}, {7, 5, PhantomGrid::Points::middles}, {1, 1}})
        for (const GridCell& cell : grid.cells()) EXPECT_EQ(grid.nearest(grid.place(cell)), cell);
    EXPECT_EQ((PhantomGrid{5, 5}.place({1, 1})), (FieldPlace{0.0, 0.0}));
    EXPECT_EQ((PhantomGrid{4, 4}.place({4, 4})), (FieldPlace{1.0, 1.0}));
    EXPECT_EQ((PhantomGrid{7, 5}.cells().size()), 35u);
    EXPECT_EQ((PhantomGrid{7, 5, PhantomGrid::Points::middles}.place({1, 7})), (FieldPlace{6.5 / 7, 0.1}));
}

} // namespace
} // namespace physvib
