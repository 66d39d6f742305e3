// SPDX-License-Identifier: GPL-3.0-or-later
// An enchanter that rings while it gets another output is never cut off, and never heard with another one.
#include "Live/Devices/OutputMap.h"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace physvib {
namespace {

constexpr int rate = 48000, outputs = 4;

/// Two enchanters that play a constant, which shows every step, in blocks of `frames`.
class Player {
public:
    explicit Player(int frames)
        : frames_{frames} {
        for (int k = 0; k < outputs; ++k) everything_.insert(k);
        EXPECT_EQ(map_.want(2, {0, 1}), "");
        map_.place(everything_);
        map_.settle(rate);
    }
    void assign(const std::vector<int>& to) {
        EXPECT_EQ(map_.want(2, to), "");
        map_.place(everything_);
    }
    void play(double seconds) {
        for (int done = 0; done < static_cast<int>(seconds * rate); done += frames_) {
            std::array<std::vector<float>, outputs> block;
            for (auto& out : block) out.assign(static_cast<std::size_t>(frames_), 0.0f);
            for (int j = 0; j < 2; ++j) {
                std::vector<float> samples(static_cast<std::size_t>(frames_), j == 0 ? 1.0f : 0.5f);
                const int k = map_.play(j, samples.data(), frames_);
                if (k < 0) continue;
                for (const float x : block[static_cast<std::size_t>(k)])
                    EXPECT_EQ(x, 0.0f) << "two on one output";
                block[static_cast<std::size_t>(k)] = samples;
            }
            for (std::size_t k = 0; k < outputs; ++k)
                for (const float x : block[k]) {
                    largestStep = std::max(largestStep, hasBegun_ ? std::abs(x - levels[k]) : 0.0f);
                    levels[k] = x;
                }
            hasBegun_ = true;
        }
    }
    std::array<float, outputs> levels{};
    float largestStep = 0.0f;

private:
    OutputMap map_;
    ChannelSet everything_;
    const int frames_;
    bool hasBegun_ = false;
};

class AnOutputMap : public testing::TestWithParam<int> {};

TEST_P(AnOutputMap, FadesWhatIsAssignedElsewhere) {
    using Levels = std::array<float, outputs>;
    Player player{GetParam()};
    player.play(0.1);
    EXPECT_EQ(player.levels, (Levels{1.0f, 0.5f, 0.0f, 0.0f}))
        << "at once where it was placed from the start";
    player.assign({2, 1});
    player.play(0.3);
    EXPECT_EQ(player.levels, (Levels{0.0f, 0.5f, 1.0f, 0.0f}));
    player.assign({1, 2}); // each where the other is
    player.play(0.4);
    EXPECT_EQ(player.levels, (Levels{0.0f, 1.0f, 0.5f, 0.0f}));
    player.assign({-1, 2});
    player.play(0.3);
    EXPECT_EQ(player.levels, (Levels{0.0f, 0.0f, 0.5f, 0.0f}));
    player.assign({1, 2});
    player.play(0.005);
    player.assign({-1, 2}); // before it has come up
    player.play(0.002);
    player.assign({1, 2});
    player.play(0.3);
    EXPECT_EQ(player.levels, (Levels{0.0f, 1.0f, 0.5f, 0.0f}));
    EXPECT_LE(player.largestStep, 1.01f / static_cast<float>(limits::channelRampSeconds * rate));
}

INSTANTIATE_TEST_SUITE_P(Blocks, AnOutputMap, testing::Values(1, 64, 4096));

} // namespace
} // namespace physvib
