// SPDX-License-Identifier: GPL-3.0-or-later
// VST3 in a host that does only what the standard makes it do: every arrangement, none at all, states,
// suspensions.
#include "RawVst3.h"
#include "Plugin/PluginTesting.h"
#include "Support/BeatSong.h"
#include <cmath>
#include <set>

namespace physvib {
namespace {

using namespace test;
namespace arr = Steinberg::Vst::SpeakerArr;

// another build of them
const std::string folder =
    std::getenv("PHYSVIB_PLUGINS_FOLDER") ? std::getenv("PHYSVIB_PLUGINS_FOLDER") : PHYSVIB_PLUGINS;
const std::string oneBus = folder + "/PhysVib.vst3", pairs = folder + "/PhysVib-Pairs.vst3";

/// The channel, counted over all buses, that carries a strike at enchanter j of n; -1: none.
int channelOf(RawVst3& host, int j, int n) {
    auto state = strikeAt(j, n);
    state.parameters = {{"level", 0.0}, {"exponent", 4.0}, {"strike_level", -6.0}};
    EXPECT_TRUE(host.setState(pluginStateJson(state)));
    host.start(512);
    host.note(60);
    int loudest = -1;
    float peak = 0.35f; // a strike is 0.5 where it is, and less than half of that at its neighbours
    for (int b = 0; b < 48; ++b) {
        EXPECT_TRUE(host.process());
        int at = 0;
        for (const auto& bus : host.channels)
            for (const auto& channel : bus) {
                for (const float x : channel)
                    if (std::abs(x) > peak) peak = std::abs(x), loudest = at;
                ++at;
            }
    }
    host.stop();
    return loudest;
}

void expectChannelJIsEnchanterJ(RawVst3& host, int channels) {
    for (int j = 0; j < channels; ++j) EXPECT_EQ(channelOf(host, j, channels), j) << "of " << channels;
    if (channels < 4) EXPECT_EQ(channelOf(host, 3, 4), -1) << "more enchanters than channels";
}

TEST(RawVst3, WithoutAnyArrangement) {
    RawVst3 host{oneBus, "PhysVib"};
    ASSERT_TRUE(host.isLoaded());
    ASSERT_EQ(host.buses(), 1);
    EXPECT_EQ(host.channelsOf(0), 4);
    expectChannelJIsEnchanterJ(host, 4);
}

TEST(RawVst3, TheFirstNSpeakers) {
    for (int n = 1; n <= 16; n += n < 5 ? 1 : 3) {
        RawVst3 host{oneBus, "PhysVib"};
        const bool taken = host.arrange({n == 1 ? arr::kMono : (vst::SpeakerArrangement{1} << n) - 1});
        EXPECT_TRUE(taken) << n;
        ASSERT_EQ(host.channelsOf(0), n);
        expectChannelJIsEnchanterJ(host, n);
    }
}

TEST(RawVst3, SurroundArrangementsKeepTheirOrderOrAreRefused) {
    for (const auto arrangement :
         {arr::kStereo, arr::k40Music, arr::k50, arr::k51, arr::k60Music, arr::k71Cine, arr::k71Music,
          arr::k70Music, arr::k71_4, arr::kAmbi3rdOrderACN}) {
        RawVst3 host{oneBus, "PhysVib"};
        const bool taken = host.arrange({arrangement});
        if (taken) EXPECT_EQ(host.channelsOf(0), arr::getChannelCount(arrangement));
        expectChannelJIsEnchanterJ(host, host.channelsOf(0));
    }
}

TEST(RawVst3, Pairs) {
    RawVst3 host{pairs, "PhysVib-Pairs"};
    ASSERT_TRUE(host.isLoaded());
    ASSERT_EQ(host.buses(), 15);
    for (const int j : {0, 1, 2, 19, 29}) EXPECT_EQ(channelOf(host, j, 30), j);
}

TEST(RawVst3, MonoBuses) {
    RawVst3 host{pairs, "PhysVib-Pairs"};
    ASSERT_TRUE(host.arrange(std::vector<vst::SpeakerArrangement>(15, arr::kMono)));
    for (const int j : {0, 1, 2, 14}) EXPECT_EQ(channelOf(host, j, 15), j);
}

TEST(RawVst3, StateComesBackAndSuspensionRepeatsTheTake) {
    RawVst3 host{oneBus, "PhysVib"};
    const std::string fresh = host.state();
    EXPECT_TRUE(host.setState("nonsense"));
    EXPECT_TRUE(host.state().starts_with("nonsense"))
        << "a chunk that cannot be read is what the next save gives back";
    auto state = shakenBox();
    state.seed = 42;
    EXPECT_TRUE(host.setState(pluginStateJson(state)));
    const std::string chunk = host.state();
    EXPECT_NE(chunk, fresh);
    std::vector<float> takes[2];
    for (auto& take : takes) { // suspended and resumed in between
        host.start(256);
        for (int b = 0; b < 400; ++b) {
            host.process();
            for (const auto& channel : host.channels[0])
                take.insert(take.end(), channel.begin(), channel.end());
        }
        host.stop();
    }
    EXPECT_TRUE(takes[0] == takes[1]);
    EXPECT_GT(*std::max_element(takes[0].begin(), takes[0].end()), 0.001f);
    EXPECT_EQ(host.state(), chunk);
    EXPECT_EQ(host.processor->getLatencySamples(), 256u + 480 + 960 + 47);
    EXPECT_EQ(host.processor->getTailSamples(), vst::kInfiniteTail);
}

TEST(RawVst3, TheSideChainIsAnAuxiliaryBusThatIsOff) {
    for (const auto& [bundle, name] : {std::pair{oneBus, "PhysVib"}, {pairs, "PhysVib-Pairs"}}) {
        RawVst3 host{bundle, name};
        ASSERT_EQ(host.component->getBusCount(vst::kAudio, vst::kInput), 1);
        vst::BusInfo info;
        ASSERT_EQ(host.component->getBusInfo(vst::kAudio, vst::kInput, 0, info), kResultOk);
        EXPECT_EQ(info.busType, vst::kAux);
        EXPECT_EQ(info.flags & vst::BusInfo::kDefaultActive, 0u);
        EXPECT_EQ(info.channelCount, 2);
        EXPECT_FALSE(host.arrange({}, {arr::k40Music}));
    }
}

TEST(RawVst3, WhatComesInByOneChannelOrTwoStrikesAndIsFeltAsInTheProcessor) {
    const BeatSong song{2.0, 48000, 7};
    auto state = strikeAt(0, 4);
    state.parameters = {{"level", 0.0},
                        {"beats", 50.0},
                        {"strike_level", -6.0},
                        {"music", -6.0},
                        {"music_sides", "left and right"}};
    for (const std::size_t channels : {1u, 2u}) {
        RawVst3 host{oneBus, "PhysVib"};
        ASSERT_TRUE(host.setState(pluginStateJson(state)));
        ASSERT_TRUE(host.hear(channels, 512));
        TestHost processor;
        auto layout = processor.plugin->getBusesLayout();
        layout.inputBuses.getReference(0) =
            channels == 1 ? juce::AudioChannelSet::mono() : juce::AudioChannelSet::stereo();
        ASSERT_TRUE(processor.plugin->setBusesLayout(layout));
        ASSERT_TRUE(processor.plugin->apply(state));
        processor.plugin->parameter(Parameter::beats).setValue(0.5f);
        processor.plugin->parameter(Parameter::music)
            .setValue(static_cast<float>(normalised(rowOf(Parameter::music), -6.0)));
        processor.plugin->parameter(Parameter::musicSides).setValue(1.0f);
        processor.prepare(48000, 512);
        host.start(512);
        float peak = 0.0f;
        for (std::size_t at = 0; at + 512 <= song.samples.size(); at += 512) {
            for (std::size_t c = 0; c < channels; ++c) { // their mean is heard
                const float share = channels == 1 ? 1.0f : c == 0 ? 1.5f : 0.5f;
                std::transform(song.samples.begin() + static_cast<std::ptrdiff_t>(at),
                               song.samples.begin() + static_cast<std::ptrdiff_t>(at) + 512,
                               host.music[c].begin(), [share](float x) { return share * x; });
                processor.buffer.copyFrom(static_cast<int>(c), 0, host.music[c].data(), 512);
            }
            ASSERT_TRUE(host.process());
            const auto& expected = processor.block(512);
            for (int c = 0; c < 4; ++c) {
                ASSERT_TRUE(std::equal(host.channels[0][static_cast<std::size_t>(c)].begin(),
                                       host.channels[0][static_cast<std::size_t>(c)].end(),
                                       expected.getReadPointer(c)))
                    << at;
                peak = std::max(peak, expected.getMagnitude(c, 0, 512));
            }
        }
        EXPECT_GT(peak, 0.05f);
        host.stop();
    }
}

/// Level, tilt and strike level every 32 frames, and a note now and then, in blocks of that size; what is
/// played L later.
std::vector<std::vector<float>> automated(int block, std::int64_t frames) {
    RawVst3 host{oneBus, "PhysVib"};
    EXPECT_TRUE(host.setState(pluginStateJson(shakenBox())));
    host.start(block);
    std::vector<std::vector<float>> signal(4);
    const auto latency = static_cast<std::int64_t>(host.processor->getLatencySamples());
    for (std::int64_t at = 0; at < frames + latency; at += block) {
        for (std::int64_t f = (at + 31) / 32 * 32; f < at + block; f += 32)
            for (const std::size_t parameter : {std::size_t(Parameter::level), std::size_t(Parameter::tilt),
                                                std::size_t(Parameter::strikeLevel)})
                host.point(
                    parameter, static_cast<int>(f - at),
                    0.6 + 0.3 * std::sin(1e-4 * static_cast<double>(f) * static_cast<double>(parameter + 1)));
        for (std::int64_t f = (at + 4999) / 5000 * 5000; f < at + block; f += 5000)
            host.note(60, static_cast<int>(f - at));
        EXPECT_TRUE(host.process());
        for (std::size_t c = 0; c < 4; ++c)
            signal[c].insert(signal[c].end(), host.channels[0][c].begin(), host.channels[0][c].end());
    }
    host.stop();
    for (auto& c : signal) c = {c.begin() + latency, c.begin() + latency + frames};
    return signal;
}

TEST(RawVst3, PointsOfParametersActAtTheirFramesInBlocksOfAnySize) {
    const auto expected = automated(512, 48000);
    EXPECT_GT(*std::max_element(expected[0].begin(), expected[0].end()), 0.02f);
    for (const int block : {32, 64, 1000, 4096}) EXPECT_TRUE(automated(block, 48000) == expected) << block;
}

TEST(RawVst3, StandInsOfControllersAreFewAndEachControllerOfEachChannelHasOne) {
    RawVst3 host{oneBus, "PhysVib"};
    ASSERT_TRUE(host.isLoaded());
    const auto others = static_cast<std::ptrdiff_t>(parameterCount) + 1; // the program
    EXPECT_LE(std::ssize(host.names), others + vst::kCountCtrlNumber + 15 * 4);
    for (const auto& channel : host.standIns) {
        ASSERT_EQ(std::ssize(channel), static_cast<std::ptrdiff_t>(vst::kCountCtrlNumber));
        EXPECT_EQ(std::ranges::count(channel, vst::ParamID{0}), 0);
    }
    for (const auto own : {static_cast<std::size_t>(vst::kAfterTouch),
                           static_cast<std::size_t>(vst::kPitchBend), std::size_t{74}, std::size_t{64}})
        EXPECT_NE(host.standIns[0][own], host.standIns[9][own]) << own;
    EXPECT_EQ(host.standIns[0][1], host.standIns[9][1]) << "the modulation wheel of any channel is the same";
}

TEST(RawVst3, ShortTitlesDiffer) {
    RawVst3 host{oneBus, "PhysVib"};
    ASSERT_TRUE(host.isLoaded());
    std::set<std::u16string> titles;
    for (std::size_t p = 0; p < parameterCount; ++p)
        EXPECT_TRUE(titles.insert(host.shortNames[p]).second) << p;
}

TEST(RawVst3, TwentyInstances) {
    std::vector<std::unique_ptr<RawVst3>> hosts;
    for (int i = 0; i < 20; ++i) hosts.push_back(std::make_unique<RawVst3>(oneBus, "PhysVib"));
    for (auto& host : hosts) {
        EXPECT_TRUE(host->setState(pluginStateJson(shakenBox())));
        host->start(512);
    }
    for (int b = 0; b < 200; ++b)
        for (auto& host : hosts) host->process();
    for (auto& host : hosts) EXPECT_TRUE(host->channels == hosts[0]->channels);
    for (auto& host : hosts) host->stop();
}

/// The loudest of each channel, of blocks of which the first has what `say` adds.
template <class Say>
std::vector<float> peaksAfter(RawVst3& host, Say say) {
    say();
    std::vector<float> peaks(host.channels.front().size());
    for (int b = 0; b < 40; ++b) {
        EXPECT_TRUE(host.process());
        for (std::size_t c = 0; c < peaks.size(); ++c)
            for (const float x : host.channels.front()[c]) peaks[c] = std::max(peaks[c], std::abs(x));
    }
    return peaks;
}

TEST(RawVst3, ExpressionOfANoteIsHeardAndUnsortedEventsAreSorted) {
    RawVst3 host{oneBus, "PhysVib"};
    EXPECT_EQ(host.expressions,
              (std::vector<vst::NoteExpressionTypeID>{vst::kVolumeTypeID, vst::kPanTypeID, vst::kTuningTypeID,
                                                      vst::kBrightnessTypeID}));
    auto state = strikeAt(0, 2);
    state.notes.clear();
    state.voice = {.pitch = NotePitch::note, .places = NotePlaces::middle, .isHeld = true};
    ASSERT_TRUE(host.setState(pluginStateJson(state)));
    host.start(512);
    const auto strike = [&](int id, int frame) {
        host.note(57, frame);
        host.event().noteOn.noteId = id;
    };
    const auto middle = peaksAfter(host, [&] { strike(7, 0); });
    EXPECT_NEAR(middle[0], middle[1], 1e-3f);
    EXPECT_GT(middle[0], 0.01f);
    const auto pan = [&](int id, double to, int frame) {
        host.note(57, frame);
        host.event().type = vst::Event::kNoteExpressionValueEvent;
        host.event().noteExpressionValue = {vst::kPanTypeID, id, to};
    };
    pan(7, 0.0, 0), host.process();
    for (int b = 0; b < 20; ++b) host.process();
    const auto left = peaksAfter(host, [&] { pan(8, 1.0, 0); });
    std::printf("VST3, a note's pan: left %.3f, right %.3f; before %.3f, %.3f\n",
                static_cast<double>(left[0]), static_cast<double>(left[1]), static_cast<double>(middle[0]),
                static_cast<double>(middle[1]));
    EXPECT_GT(left[0], 10.0f * left[1]) << "another note's pan moves nothing";
    const auto off = peaksAfter(host, [&] { // the off comes later, and is said first
        host.note(57, 300), host.event().type = vst::Event::kNoteOffEvent;
        host.event().noteOff.noteId = 9;
        strike(9, 100);
        host.note(57, 0), host.event().type = vst::Event::kNoteOffEvent;
        host.event().noteOff.noteId = 7;
    });
    EXPECT_GT(off[1], 0.01f) << "the new note is felt in the middle";
    for (int b = 0; b < 200; ++b) host.process();
    const auto silent = peaksAfter(host, [] {});
    EXPECT_LT(silent[0] + silent[1], 1e-4f) << "nothing hangs";
    host.stop();
}

} // namespace
} // namespace physvib
