// SPDX-License-Identifier: MIT
// What channels are called, on both sides of each number at which letters, numbers and names change.
#include "Pictures/PictureParts.h"
#include "Pictures/RenderPicture.h"
#include <gtest/gtest.h>
#include <set>
#include <string>

namespace physvib {
namespace {

TEST(ChannelLabels, AreLettersAsLongAsThereAreSomeThenNumbersAndAlwaysDifferent) {
    for (const int count : {1, 2, 25, 26, 27, 28, 63, 64}) {
        PictureInput input;
        input.layout.count = count;
        std::set<std::string> labels;
        for (int j = 0; j < count; ++j) {
            const std::string label = picture::labelOf(input, j);
            EXPECT_EQ(label, count <= 26 ? std::string(1, static_cast<char>('A' + j)) : std::to_string(j + 1))
                << j << " of " << count;
            labels.insert(label);
        }
        EXPECT_EQ(static_cast<int>(labels.size()), count);
    }
}

TEST(ChannelLabels, NamesOfTheirOwnComeFirst) {
    for (const std::size_t named : {0U, 1U, 3U, 4U}) {
        PictureInput input;
        input.layout.count = 4;
        std::vector<std::string> names{"one", "two", "three", "four"};
        names.resize(named);
        input.labels = names;
        for (std::size_t j = 0; j < 4; ++j)
            EXPECT_EQ(picture::labelOf(input, static_cast<int>(j)),
                      j < named ? names[j] : std::string(1, static_cast<char>('A' + j)));
    }
}

} // namespace
} // namespace physvib
