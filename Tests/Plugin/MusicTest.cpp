// SPDX-License-Identifier: GPL-3.0-or-later
// The side chain's own low frequencies on the actuators: which, where, how loud, in blocks of any size.
#include "Host/Music/BeatDetector.h"
#include "MusicInput.h"
#include "PluginTesting.h"
#include "Support/BeatSong.h"
#include <atomic>
#include <cmath>
#include <numbers>

// A host that has a song at the side chain.
namespace physvib::test {

constexpr int songRateHz = 48000;

struct SongBlocks {
    int frames = 64;
    bool isLive = false;
    bool vary = false; ///< up to twice what was announced
};

inline PluginState quietState(bool isDirect = false) {
    auto quiet = strikeAt(0, 4);
    quiet.stepsPerSecond = 1000; // two steps are shorter than the detector's delay
    quiet.isDirect = isDirect;
    return quiet;
}

/// A song at the side chain of an instance.
class SongHost : public TestHost {
public:
    using TestHost::TestHost;

    void turnOn(int channels = 2) { ASSERT_TRUE(setSideChain(*plugin, channels)); }
    void listen(float readiness = 0.5f) { setNormal(Parameter::beats, readiness); }

    /// One block of it, from frame `at` on; what is played is appended to `signal`.
    void feed(const BeatSong& song, int at, int frames, Samples& signal) {
        signal.resize(4);
        buffer.setSize(4, frames, false, false, true);
        // whatever stands in a host's buffer
        for (int c = 0; c < 4; ++c)
            buffer.copyFrom(c, 0, (c == 1 && right ? right->samples : song.samples).data() + at, frames);
        auto midi = notes(at, frames);
        plugin->processBlock(buffer, midi);
        append(signal, buffer);
    }

    /// What is played of all of it.
    Samples play(const BeatSong& song, SongBlocks blocks) {
        if (blocks.isLive) plugin->runs().useManualStepping();
        prepare(songRateHz, blocks.frames, !blocks.isLive);
        Samples signal;
        Random random{3};
        const int length = static_cast<int>(song.samples.size());
        for (int at = 0; at < length;) {
            const int frames =
                std::min(blocks.vary ? 1 + random.below(2 * blocks.frames) : blocks.frames, length - at);
            feed(song, at, frames, signal);
            at += frames;
            if (!blocks.isLive) continue;
            plugin->runs().tick();
        }
        return signal;
    }

    /// The same as it is felt beside the song, for so many frames.
    Samples felt(const BeatSong& song, SongBlocks blocks, std::size_t frames = 130'000) {
        const Samples signal = play(song, blocks); // before the latency is asked for
        Samples beside = later(signal, plugin->getLatencySamples());
        for (auto& channel : beside) channel.resize(std::min(frames, channel.size()));
        return beside;
    }

    const BeatSong* right = nullptr; ///< of the second channel, if it is another; as long
    bool hasNotes = false;           ///< and a controller that moves what beats are struck with

private:
    juce::MidiBuffer notes(int at, int frames) const {
        juce::MidiBuffer midi;
        for (int i = 0; i < frames && hasNotes; ++i) {
            if ((at + i) % 4999 == 0) midi.addEvent(juce::MidiMessage::noteOn(1, 60, juce::uint8{100}), i);
            if ((at + i) % 7001 == 0)
                midi.addEvent(juce::MidiMessage::controllerEvent(1, 1, (at + i) / 7001 % 30 + 90), i);
        }
        return midi;
    }
};

} // namespace physvib::test

namespace physvib {
namespace {

using namespace test;

constexpr std::size_t toneFrames = 48000;

BeatSong tone(double hz, float amplitude) {
    BeatSong song{1.0, songRateHz, 7};
    for (std::size_t i = 0; i < toneFrames; ++i)
        song.samples[i] =
            amplitude *
            static_cast<float>(std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(i) / songRateHz));
    return song;
}

/// Nothing but music, at this level in dB, on four actuators in a line.
class MusicHost : public SongHost {
public:
    explicit MusicHost(double levelDb = 0.0, const PluginState& state = quietState())
        : SongHost{state} {
        turnOn();
        set(Parameter::music, levelDb);
    }
    Samples feel(const BeatSong& song, SongBlocks blocks = {256}) { return felt(song, blocks, toneFrames); }
};

/// The largest of a channel's second half second: ramps and filters are over.
float settled(const std::vector<float>& channel) { return peakOf(later({channel}, 24'000)); }

TEST(Music, IsSilentUntilItIsTurnedUp) {
    MusicHost host{-60.0};
    EXPECT_EQ(rowOf(Parameter::music).initial, rowOf(Parameter::music).minimum);
    EXPECT_EQ(peakOf(host.feel(tone(100.0, 0.5f))), 0.0f);
}

TEST(Music, LowFrequenciesAreFeltInTimeAtTheirLevelAndHighOnesAreNot) {
    const BeatSong low = tone(100.0, 0.5f);
    MusicHost host;
    const Samples felt = host.feel(low);
    std::vector<float> wanted{low.samples.begin(), low.samples.end()};
    BandPass{MusicInput::band, songRateHz}.process(wanted);
    for (const auto& channel : felt)
        // what the host takes out is all that it is late by
        for (std::size_t i = 4'800; i < channel.size(); ++i) ASSERT_NEAR(channel[i], wanted[i], 2e-6) << i;
    for (const double hz : {4.0, 2000.0})
        EXPECT_LT(settled(MusicHost{}.feel(tone(hz, 0.5f))[0]), 0.005f) << hz;
    EXPECT_NEAR(settled(MusicHost{-12.0}.feel(low)[2]), 0.5 * std::pow(10.0, -0.6), 0.01);
}

TEST(Music, SidesGoToTheActuatorsOnTheirSides) {
    const BeatSong left = tone(100.0, 0.4f), silence = tone(0.0, 0.0f);
    const auto peaks = [&](double sides) {
        MusicHost host;
        host.set(Parameter::musicSides, sides);
        host.right = &silence;
        std::vector<float> all;
        for (const auto& channel : host.feel(left)) all.push_back(settled(channel));
        return all;
    };
    const auto summed = peaks(0.0), apart = peaks(1.0);
    for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_NEAR(summed[j], 0.2, 0.005) << j;
        EXPECT_NEAR(apart[j], 0.4 * (1.0 - static_cast<double>(j) / 3.0), 0.005) << j; // four in a line
    }
}

TEST(Music, IsTheSameLiveAndBouncedInBlocksOfAnySizeWhileItsLevelMoves) {
    const BeatSong song{2.0, songRateHz, 7}, right{2.0, songRateHz, 8};
    for (const bool isDirect : {false, true}) {
        auto state = quietState(isDirect);
        state.controllers = {{1, "music"}};
        const auto feltIn = [&](SongBlocks blocks) {
            MusicHost host{-12.0, state};
            host.set(Parameter::musicSides, 1.0);
            host.right = &right;
            host.hasNotes = true;
            return host.felt(song, blocks, 80'000);
        };
        const Samples once = feltIn({64});
        EXPECT_GT(peakOf(once), 0.05f);
        for (const SongBlocks blocks :
             {SongBlocks{64, true}, {1}, {480, true}, {480, false, true}, {1000}, {4096}, {4096, true}})
            EXPECT_TRUE(feltIn(blocks) == once) << blocks.frames << blocks.isLive << blocks.vary << isDirect;
    }
}

TEST(Music, PassesTheEqualiserTheStripsAndTheLimiter) {
    auto state = quietState();
    state.strips.resize(4);
    state.strips[1].isMuted = true;
    state.strips[2].gainDb = -6.0;
    state.strips[3].ceilingDb = -20.0;
    state.equalised[0] = EqualisedActuator{{100.0, 8.0}, {50.0, 300.0}};
    MusicHost host{0.0, state};
    const Samples felt = host.feel(tone(160.0, 0.05f));
    EXPECT_GT(std::abs(settled(felt[0]) - 0.05f), 0.01f)
        << "the equaliser drives an actuator otherwise beside its resonance";
    EXPECT_EQ(settled(felt[1]), 0.0f);
    EXPECT_NEAR(settled(felt[2]), 0.05 * std::pow(10.0, -0.3), 1e-3);
    MusicHost loud{12.0, state};
    for (const Samples beyond = loud.feel(tone(100.0, 0.9f)); const float x : beyond[3])
        ASSERT_LE(std::abs(x), 0.1f + 1e-6f);
}

TEST(Music, ATakeBeginsWithSilenceAndEqualMusicFeelsEqual) {
    auto state = quietState();
    state.transport = TransportMode::restartOnPlay;
    MusicHost host{0.0, state};
    host.playHead.isThere = host.playHead.isPlaying = true;
    host.prepare(songRateHz, 480);
    const BeatSong song = tone(130.0, 0.5f);
    Samples all;
    constexpr int loop = 24'000, loops = 4;
    for (int at = 0; at < loop * loops; at += 480) {
        host.playHead.frame = at % loop;
        host.feed(song, at % loop, 480, all);
    }
    const auto latency = static_cast<std::size_t>(host.plugin->getLatencySamples());
    const auto& one = all[1];
    std::size_t unequal = 0;
    // the first 10 ms have the end of the take before
    for (std::size_t i = 600; i < loop; ++i)
        unequal += one[latency + loop + i] == one[latency + 2 * loop + i] ? 0 : 1;
    EXPECT_EQ(unequal, 0u);
    // the tone itself moves by 0.0085 a frame
    EXPECT_LT(largestStep(std::span{one}.subspan(latency)), 0.02f)
        << "no click where one take ends and the next begins";
}

/// The first channel of half a second of a tone, All Sound Off, and another half: where in time it is felt.
std::vector<float> stoppedInTheMiddle(bool isDirect) {
    MusicHost host{0.0, quietState(isDirect)};
    host.prepare(songRateHz, 480);
    const BeatSong song = tone(130.0, 0.5f);
    Samples all;
    for (int at = 0; at < 24'000; at += 480) host.feed(song, at, 480, all);
    auto midi = oneMessage(juce::MidiMessage::allSoundOff(1));
    for (int c = 0; c < 4; ++c) host.buffer.copyFrom(c, 0, song.samples.data() + 24'000, 480);
    host.plugin->processBlock(host.buffer, midi);
    append(all, host.buffer);
    for (int at = 24'480; at < 47'000; at += 480) host.feed(song, at, 480, all);
    return all[0];
}

TEST(Music, AllSoundOffIsAPauseWithDirectAndWithoutAndWhatComesLaterIsFelt) {
    constexpr int pause = 2'400, ramp = 480;
    for (const bool isDirect : {false, true}) {
        SCOPED_TRACE(isDirect);
        const auto felt = stoppedInTheMiddle(isDirect);
        const auto peak = [&](int from, int to) {
            return peakOf(Samples{{felt.begin() + from, felt.begin() + to}});
        };
        EXPECT_GT(peak(23'000, 24'000), 0.4f);
        EXPECT_EQ(peak(24'000 + 47 + ramp, 24'000 + pause - 10), 0.0f);
        EXPECT_GT(peak(24'000 + pause + 47 + ramp, 24'000 + pause + 2'000), 0.4f);
        EXPECT_LT(largestStep(std::span{felt}.subspan(22'999, 5'001)), 0.02f) << "no click";
    }
}

// Music at the side chain strikes, at its times; live and bounced, in blocks of any size, the same.

const BeatSong& song() {
    static const BeatSong made{3.0, songRateHz, 7};
    return made;
}

Samples feltIn(const PluginState& state, SongBlocks blocks, bool hasNotes) {
    SongHost host{state};
    host.turnOn();
    host.listen();
    host.hasNotes = hasNotes;
    const Samples signal = host.felt(song(), blocks);
    EXPECT_EQ(host.plugin->runs().status().late, 0u) << blocks.frames;
    EXPECT_GT(peakOf(signal), 0.05f);
    return signal;
}

TEST(SideChain, IsOffInANewInstanceAndInOldProjects) {
    SongHost host{quietState()};
    ASSERT_EQ(host.plugin->getBusCount(true), 1);
    EXPECT_FALSE(host.plugin->getBus(true, 0)->isEnabled());
    EXPECT_EQ(host.plugin->getTotalNumInputChannels(), 0);
    host.listen();
    EXPECT_EQ(peakOf(host.play(song(), {512})), 0.0f);
    host.turnOn();
    host.listen(0.0f);
    EXPECT_EQ(peakOf(host.play(song(), {512})), 0.0f) << "nor does what comes in go out";
    EXPECT_FALSE(hasSideChain({}, juce::AudioProcessor::wrapperType_LV2));
}

TEST(SideChain, EachBeatIsFeltLAfterItOrDirectlyWhenItIsSureToBeKnown) {
    for (const bool isDirect : {false, true}) {
        SongHost host{quietState(isDirect)};
        host.turnOn(1);
        host.listen();
        const Samples signal = host.felt(song(), {64}, song().samples.size());
        // beyond what the host takes out
        const std::int64_t delay = isDirect ? BeatDetector{songRateHz}.delayFrames() : 0;
        const auto status = host.plugin->runs().status();
        EXPECT_EQ(status.late, 0u);
        EXPECT_GT(status.session.render.played, song().hits.size() / 2);
        std::size_t hats = 0, found = 0;
        for (const auto& hit : song().hits) {
            if (hit.drum == Drum::kick || hit.seconds > 2.5) continue;
            ++hats;
            const auto from = signal[3].begin() +
                              static_cast<std::int64_t>((hit.seconds - 0.02) * songRateHz) + delay,
                       to = from + songRateHz * 40 / 1000;
            // the last enchanter is silent between high beats
            const auto first = std::find_if(from, to, [](float x) { return std::abs(x) > 2e-3f; });
            const auto at = static_cast<double>(first - signal[3].begin() - delay) / songRateHz;
            found += first != to && std::abs(at - hit.seconds) <= 0.01 ? 1 : 0;
        }
        EXPECT_GE(found * 100, hats * 95) << isDirect;
    }
}

TEST(SideChain, StrikesAreTheSameLiveAndBouncedInBlocksOfAnySize) {
    for (const bool isDirect : {false, true}) {
        auto state = quietState(isDirect);
        state.controllers = {{1, "strike_level"}};
        const Samples once = feltIn(state, {64}, true);
        for (const SongBlocks blocks : {SongBlocks{64, true},
                                        {480},
                                        {480, true},
                                        {480, false, true},
                                        {1000},
                                        {1000, true},
                                        {4096},
                                        {4096, true}})
            EXPECT_TRUE(feltIn(state, blocks, true) == once)
                << blocks.frames << blocks.isLive << blocks.vary << isDirect;
    }
}

TEST(SideChain, SoIsAWorldBesideThem) {
    const Samples once = feltIn(shakenBox(), {480}, false);
    for (const int frames : {64, 1000, 4096})
        for (const bool isLive : {false, true})
            EXPECT_TRUE(feltIn(shakenBox(), {frames, isLive}, false) == once) << frames << isLive;
}

TEST(SideChain, AutomationOfBeatsMovesNoHop) {
    const auto playAfter = [](int quietFrames) {
        SongHost host{quietState()};
        host.turnOn();
        host.listen(0.0f);
        host.prepare(songRateHz, 1000);
        Samples signal;
        host.feed(song(), 0, quietFrames, signal);
        host.listen();
        for (int at = quietFrames; at + 1000 <= 60'000; at += 1000) host.feed(song(), at, 1000, signal);
        for (auto& channel : signal) channel.resize(55'000);
        return later(signal, 10'000);
    };
    EXPECT_TRUE(playAfter(77) == playAfter(130)); // either way before the first beat
}

TEST(SideChain, LHasRoomForTheDetectorOnlyWhereItListensAndStrikesAreNotDirect) {
    const auto latencyOf = [](SongHost& host) {
        host.prepare(songRateHz, 64);
        return static_cast<int>(host.plugin->runs().outputLatencyFrames());
    };
    auto still = quietState(), moving = shakenBox();
    moving.stepsPerSecond = still.stepsPerSecond;
    SongHost alone{still};
    const int limiter = HapticRenderer::latencyFramesAt(songRateHz);
    EXPECT_EQ(latencyOf(alone), limiter) << "without a world";
    alone.turnOn(1);
    EXPECT_EQ(latencyOf(alone), BeatDetector{songRateHz}.delayFrames() + limiter);
    SongHost host{moving}, direct{quietState(true)};
    const int without = latencyOf(host), ofDirect = latencyOf(direct);
    host.turnOn(1);
    direct.turnOn(1);
    EXPECT_EQ(latencyOf(host), without + 512); // 18.7 ms less two steps of 1 ms, instead of a gap of 6 ms
    EXPECT_EQ(latencyOf(direct), ofDirect);
    auto slow = shakenBox(); // whose steps leave room for it
    ASSERT_TRUE(host.plugin->apply(slow));
    const int listening = host.plugin->getLatencySamples();
    host.turnOn(0);
    EXPECT_EQ(latencyOf(host), listening);
}

TEST(SideChain, AStateWithoutItsParameterLeavesItAtRestAndTimingSafe) {
    for (const int version : {1, 2, 3}) {
        SongHost host{quietState()};
        auto old = host.plugin->state();
        std::erase_if(old.parameters,
                      [](const auto& p) { return p.first == "beats" || p.first == "timing"; });
        host.listen();
        host.setNormal(Parameter::timing, 1.0f);
        std::string text = pluginStateJson(old);
        const std::string now = "\"physvib_plugin_state\": ";
        text.replace(text.find(now), now.size() + 1, now + std::to_string(version));
        restore(*host.plugin, text);
        EXPECT_EQ(host.plugin->errorText(), "");
        EXPECT_EQ(host.plugin->parameter(Parameter::beats).value(), 0.0);
        EXPECT_EQ(host.plugin->parameter(Parameter::timing).value(), 0.0) << "safe";
    }
}

} // namespace
} // namespace physvib
