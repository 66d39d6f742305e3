// SPDX-License-Identifier: GPL-3.0-or-later
// Every point of every parameter acts at its frame, however the host cuts its blocks.
#include "PluginTesting.h"
#include <array>

namespace physvib::automation_test {

using namespace test;

/// What a host sends: per parameter, points at frames of the song.
class PointSong final : public PointSource {
public:
    void add(Parameter which, std::int64_t frame, double normal) {
        points_[static_cast<std::size_t>(which)].push_back({frame, normal});
    }

    /// The block that begins at frame `at`.
    void begin(std::int64_t at, int frames) {
        first_ = at;
        end_ = at + frames;
        for (std::size_t p = 0; p < parameterCount; ++p)
            while (next_[p] < points_[p].size() && points_[p][next_[p]].first < at) ++next_[p];
    }
    bool next(std::size_t p, ParameterPoint& point) noexcept override {
        if (next_[p] >= points_[p].size() || points_[p][next_[p]].first >= end_) return false;
        point = {static_cast<int>(points_[p][next_[p]].first - first_), points_[p][next_[p]].second};
        ++next_[p];
        return true;
    }
    int lastPointFrame(std::size_t p) noexcept override {
        const auto behind = std::ranges::lower_bound(points_[p], std::pair{end_, 0.0}); // also if it was read
        return behind == points_[p].begin() ? -1 : static_cast<int>(std::prev(behind)->first - first_);
    }

private:
    std::array<std::vector<std::pair<std::int64_t, double>>, parameterCount> points_;
    std::array<std::size_t, parameterCount> next_{};
    std::int64_t first_ = 0, end_ = 0;
};

struct TimedNote {
    std::int64_t frame;
    int number;
};

/// Blocks of these sizes, in turn, for so long.
Samples playedTo(TestHost& host, PointSong song, const std::vector<TimedNote>& notes,
                 const std::vector<int>& blocks, std::int64_t frames) {
    Samples signal;
    std::size_t note = 0;
    for (std::int64_t at = 0, b = 0; at < frames; ++b) {
        const int size = blocks[static_cast<std::size_t>(b) % blocks.size()];
        song.begin(at, size);
        host.plugin->setPointSource(song);
        juce::MidiBuffer midi;
        for (; note < notes.size() && notes[note].frame < at + size; ++note)
            midi.addEvent(juce::MidiMessage::noteOn(1, notes[note].number, juce::uint8{100}),
                          static_cast<int>(notes[note].frame - at));
        append(signal, host.block(size, midi));
        at += size;
    }
    return later(signal, host.plugin->getLatencySamples());
}

/// All parameters but SILENCE, which is at once, each `every` frames; 0: at random frames, but for last ones
/// of blocks of multiples of 8, where they would be the ends of lines.
struct Automated {
    PointSong song;
    std::vector<TimedNote> notes;
};

Automated takeOf(std::int64_t frames, std::uint32_t seed, int every) {
    Automated take;
    Random random{seed};
    for (const auto& row : allParameters()) {
        if (row.parameter == Parameter::bypass || row.parameter == Parameter::material ||
            row.parameter == Parameter::timing) // which is the latency of all
            continue;
        double value = random.below(1000) * 1e-3;
        for (std::int64_t at = 0; at<frames; at += every> 0 ? every : 1 + random.below(400)) {
            value = std::clamp(value + (random.below(201) - 100) * 1e-3, 0.0, 1.0);
            if (every > 0 || at % 8 != 7) take.song.add(row.parameter, at, value);
        }
    }
    for (std::int64_t at = 0; at < frames; at += 4800 + random.below(4800))
        take.song.add(Parameter::material, at, random.below(9) / 8.0);
    for (std::int64_t at = 0; at < frames; at += 500 + random.below(3000))
        take.notes.push_back({at, 36 + random.below(48)});
    return take;
}

Samples bounceOf(const Automated& take, const PluginState& state, const std::vector<int>& blocks,
                 std::int64_t frames) {
    TestHost host{state, *std::ranges::max_element(blocks)};
    return playedTo(host, take.song, take.notes, blocks, frames + host.plugin->getLatencySamples());
}

void expectEqual(const Samples& a, const Samples& b, std::int64_t frames, const std::string& what) {
    for (std::size_t c = 0; c < a.size(); ++c) {
        const auto end = a[c].begin() + frames;
        const auto differs = std::mismatch(a[c].begin(), end, b[c].begin()).first;
        EXPECT_EQ(differs - a[c].begin(), frames) << what << ", channel " << c;
    }
}

void expectTheSameInBlocks(const Automated& take, const PluginState& state, std::int64_t frames,
                           const std::vector<std::vector<int>>& all) {
    const auto expected = bounceOf(take, state, {512}, frames);
    EXPECT_GT(peakOf(expected), 0.02f);
    for (const auto& blocks : all)
        expectEqual(expected, bounceOf(take, state, blocks, frames), frames,
                    "blocks of " + std::to_string(blocks.front()));
}

const std::vector<std::vector<int>> manyBlocks{{32}, {64}, {480}, {1000}, {4096}, {8, 4096, 16, 32, 904}};

TEST(Automation, PointsEvery32FramesAreTheSameSamplesInBlocksOfAnySize) {
    expectTheSameInBlocks(takeOf(72000, 3, 32), shakenBox(), 72000, manyBlocks);
}

TEST(Automation, PointsAtAnyFramesAreTheSameSamplesInBlocksOfAnySize) {
    for (const std::uint32_t seed : {1u, 2u})
        expectTheSameInBlocks(takeOf(48000, seed, 0), shakenBox(), 48000, manyBlocks);
}

TEST(Automation, InBlocksOfOneFrameAndOddOnesAsWell) {
    expectTheSameInBlocks(takeOf(12000, 5, 32), shakenBox(), 12000, {{1}, {2}, {3}, {31, 33, 7, 1}});
}

TEST(Automation, WhereNotesAreDirectTooInBlocksOfOneSize) {
    auto state = strikeAt(0, 4); // no world, which moves by the difference of the blocks
    state.notes.clear();
    state.isDirect = true;
    expectTheSameInBlocks(takeOf(48000, 4, 32), state, 48000, manyBlocks);
}

// For hand and nightly runs: a minute each.
TEST(Automation, DISABLED_TenMinutes) {
    expectTheSameInBlocks(takeOf(600 * 48000, 6, 32), shakenBox(), 600 * 48000, {{32}, {64}, {1000}, {4096}});
}

TEST(Automation, ANoteHasTheLevelOfItsFrame) {
    auto state = strikeAt(0, 1);
    state.limiterEnabled = false;
    TestHost host{state};
    PointSong song;
    for (const auto& [frame, normal] : {std::pair{0, 0.0}, {1000, 1.0}, {1001, 0.0}})
        song.add(Parameter::strikeLevel, frame, normal);
    for (const auto& [frame, isFelt] : {std::pair{999, false}, {1000, true}, {1001, false}}) {
        host.prepare(48000, 4096);
        const auto signal =
            playedTo(host, song, {{frame, 60}}, {4096}, 3 * 4096 + host.plugin->getLatencySamples());
        EXPECT_EQ(peakOf(signal) > 0.0f, isFelt) << frame;
    }
}

TEST(Automation, SilenceClosesAtItsFrame) {
    TestHost host{shakenBox(), 4096};
    const auto open = playedTo(host, {}, {}, {4096}, 48000);
    PointSong song;
    const int latency = host.plugin->getLatencySamples(), from = 30000 + latency;
    song.add(Parameter::bypass, from, 1.0);
    host.prepare(48000, 4096);
    const auto shut = playedTo(host, song, {}, {4096}, 48000);
    expectEqual(open, shut, 30000, "before");
    EXPECT_EQ(peakOf(later(shut, 30480)), 0.0f);
    EXPECT_GT(peakOf(later(open, 30480)), 0.0f) << "there was something to silence";
}

PluginState heldTone() {
    auto state = strikeAt(0, 1);
    state.scene.materials[3].decayPerSecond = 0.05;
    state.limiterEnabled = false;
    return state;
}

/// A sine of the level that a host draws: a block's first and last frame, as VST3 lets it; or, of a line that
/// goes on, its last frame alone.
Samples drawn(int block, std::int64_t frames, bool hasFirstFrames = true) {
    TestHost host{heldTone(), block};
    PointSong song;
    const auto levelAt = [](std::int64_t at) {
        return 0.8 + 0.1 * std::sin(2.0 * 3.14159265358979 * 2.0 * static_cast<double>(at) / 48000.0);
    };
    for (std::int64_t at = 0; at < frames + 40000; at += block) {
        if (at == 0 || hasFirstFrames) song.add(Parameter::level, at, levelAt(at));
        song.add(Parameter::level, at + block - 1, levelAt(at + block - 1));
    }
    Samples signal = playedTo(host, song, {{0, 60}}, {block}, frames + host.plugin->getLatencySamples());
    for (auto& c : signal) c.resize(static_cast<std::size_t>(frames));
    return signal;
}

double differenceDb(const Samples& a, const Samples& b) {
    double error = 0.0, power = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c)
        for (std::size_t n = 0; n < a[c].size(); ++n) {
            error += std::pow(static_cast<double>(a[c][n]) - b[c][n], 2);
            power += std::pow(static_cast<double>(a[c][n]), 2);
        }
    return 10.0 * std::log10(error / power + 1e-30);
}

TEST(Automation, ALineThatAHostDrawsIsFollowedInLargeBlocksAsInSmallOnes) {
    const auto fine = drawn(64, 96000);
    // the last: chords of a 2 Hz sine, 43 ms long
    for (const auto& [block, mostDb] : {std::pair{128, -50.0}, {512, -45.0}, {1024, -45.0}, {2048, -35.0}}) {
        const double db = differenceDb(fine, drawn(block, 96000));
        RecordProperty("block" + std::to_string(block), std::to_string(db));
        EXPECT_LT(db, mostDb) << block;
        EXPECT_LT(differenceDb(fine, drawn(block, 96000, false)), mostDb) << block << ", the line goes on";
    }
}

/// A level on straight lines, as Ardour tells it: at a block's first frame, and one behind it.
class RisingAndFalling final : public PointSource {
public:
    static constexpr std::int64_t period = 1 << 16; // values on lines are binary fractions: none is rounded
    RisingAndFalling(std::int64_t at, int frames)
        : at_{at}
        , frames_{frames} {}
    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        if (parameter != static_cast<std::size_t>(Parameter::level) || told_ == 2) return false;
        const int frame = told_++ == 0 ? 0 : frames_;
        const auto phase = (at_ + frame) % period;
        point = {frame, 0.5 + static_cast<double>(std::min(phase, period - phase)) / (2.0 * period)};
        return true;
    }
    int lastPointFrame(std::size_t) noexcept override { return frames_; }

private:
    std::int64_t at_;
    int frames_, told_ = 0;
};

Samples risingAndFalling(int block, std::int64_t frames) {
    TestHost host{heldTone(), 4096}; // one latency for all
    Samples signal(1);
    for (std::int64_t at = 0; at < frames; at += block) {
        RisingAndFalling line{at, block};
        host.plugin->setPointSource(line);
        append(signal, host.block(block, at == 0 ? oneNote(60, 100) : juce::MidiBuffer{}));
    }
    return signal;
}

TEST(Automation, ALineToOneFrameBehindTheBlockIsTheSameInBlocksOfAnySize) {
    const std::int64_t frames = 3 * RisingAndFalling::period;
    const auto expected = risingAndFalling(512, frames);
    EXPECT_GT(peakOf(expected), 0.02f);
    for (const int block : {64, 128, 1024, 4096})
        expectEqual(expected, risingAndFalling(block, frames), frames, "blocks of " + std::to_string(block));
}

TEST(Automation, AMessageBehindTheBlocksEndIsPlayedAtItsLastFrameAndCounted) {
    const auto struckAt = [](int frame) {
        TestHost host{strikeAt(0, 1), 256};
        host.block(256, oneNote(60, 100, frame));
        return std::pair{host.played(9600), host.plugin->displacedMessages()};
    };
    const auto [behind, displaced] = struckAt(256);
    EXPECT_TRUE(struckAt(255) == std::pair(behind, std::uint64_t{0}));
    EXPECT_GT(peakOf(behind), 0.05f);
    EXPECT_EQ(displaced, 1u);
}

// What automation says last is felt: however much there is, and however far blocks are from those announced.

using Message = juce::MidiMessage;

/// Enchanters in a line, in blocks much smaller than announced: L is long, controls are many.
struct AutomatedHost : TestHost {
    AutomatedHost(int channels, double rate, int size)
        : frames{size} {
        auto state = strikeAt(0, channels);
        state.notes.front().x = 0.25 / (channels - 1);
        state.controllers = {{7, "level"}};
        EXPECT_TRUE(plugin->apply(state));
        prepare(rate, 8192);
        latency = plugin->getLatencySamples();
    }
    void automate(Parameter which, int blocks) {
        for (int i = 0; i < blocks; ++i) {
            setNormal(which, 0.3f + 0.5f * static_cast<float>(i % 101) / 101.0f);
            block(frames);
        }
    }
    void strike() { block(frames, oneNote(60)); }
    /// The loudest sample of the next `count` frames.
    float peakOfNext(std::int64_t count) {
        float peak = 0.0f;
        for (std::int64_t done = 0; done < count; done += frames)
            peak = std::max(peak, block(frames).getMagnitude(0, frames));
        return peak;
    }
    /// The loudest sample of what is struck now, L later.
    float peakOfStrike() {
        peakOfNext(latency + static_cast<std::int64_t>(getRate() / 50)); // what was before is over, and ramps
        strike();
        peakOfNext(latency - 2 * frames);
        return peakOfNext(static_cast<std::int64_t>(getRate() / 10));
    }
    double getRate() const { return plugin->getSampleRate(); }
    int frames, latency = 0;
};

struct AutomationCase {
    int channels, frames, blocks;
    double rate;
};

class LevelAutomation : public testing::TestWithParam<AutomationCase> {};

TEST_P(LevelAutomation, EndsAtItsLastValue) {
    const auto [channels, frames, blocks, rate] = GetParam();
    AutomatedHost host{channels, rate, frames};
    host.automate(Parameter::level, blocks);
    host.setNormal(Parameter::level, 0.0f);
    EXPECT_EQ(host.peakOfStrike(), 0.0f);
    host.automate(Parameter::level, blocks);
    host.setNormal(Parameter::level, 1.0f);
    EXPECT_GT(host.peakOfStrike(), 0.1f);
}

INSTANTIATE_TEST_SUITE_P(Hosts, LevelAutomation,
                         testing::Values(AutomationCase{4, 64, 400, 48000.0},
                                         AutomationCase{64, 64, 400, 48000.0},
                                         AutomationCase{4, 1, 12000, 48000.0},
                                         AutomationCase{4, 64, 10 * 60 * 8000 / 64, 8000.0}), // ten minutes
                         [](const auto& info) {
                             return std::to_string(info.param.channels) + "x" +
                                    std::to_string(info.param.blocks) + "of" +
                                    std::to_string(info.param.frames);
                         });

TEST(Controls, ALawThatIsAutomatedEndsAtItsLastValue) {
    AutomatedHost host{2, 48000.0, 16};
    host.automate(Parameter::exponent, 1500);
    host.setNormal(Parameter::exponent, 0.0f);
    const float low = host.peakOfStrike();
    AutomatedHost plain{2, 48000.0, 16};
    plain.setNormal(Parameter::exponent, 0.0f);
    EXPECT_NEAR(low, plain.peakOfStrike(), 1e-6f);
    plain.setNormal(Parameter::exponent, 1.0f);
    EXPECT_GT(std::abs(low - plain.peakOfStrike()), 1e-3f);
}

TEST(Controls, AControllerThatMovesAtEveryFrameEndsAtItsLastValueWithinTheBlock) {
    AutomatedHost host{4, 48000.0, 8192};
    juce::MidiBuffer midi;
    for (int n = 0; n < 4000; ++n) midi.addEvent(Message::controllerEvent(1, 7, n % 127 + 1), n);
    midi.addEvent(Message::controllerEvent(1, 7, 0), 4000);
    midi.addEvent(Message::noteOn(1, 60, juce::uint8{127}), 5000);
    host.block(8192, midi);
    EXPECT_EQ(host.peakOfNext(host.latency + 8192), 0.0f);
}

TEST(Controls, AllSoundOffBehindMuchAutomationIsNotLost) {
    AutomatedHost host{64, 48000.0, 64};
    host.peakOfNext(host.latency);
    host.strike();
    host.automate(Parameter::level, 100);
    host.block(64, oneMessage(Message::allSoundOff(1)));
    host.automate(Parameter::level, host.latency / 64);
    host.peakOfNext(480);
    EXPECT_EQ(host.peakOfNext(4800), 0.0f);
}

} // namespace physvib::automation_test
