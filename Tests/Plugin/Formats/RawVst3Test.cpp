// SPDX-License-Identifier: GPL-3.0-or-later
// VST3 in a host that does only what the standard demands: every arrangement, none, states, suspensions.
#include "RawVst3.h"
#include "Plugin/PluginTesting.h"
#include "Support/BeatSong.h"
#include "Support/HeapBytes.h"
#include <atomic>
#include <cmath>
#include <set>

namespace physvib::raw_vst3_test {

using namespace test;
namespace arr = Steinberg::Vst::SpeakerArr;

// another build of them
const std::string folder =
    std::getenv("PHYSVIB_PLUGINS_FOLDER") ? std::getenv("PHYSVIB_PLUGINS_FOLDER") : PHYSVIB_PLUGINS;
const std::string oneBus = folder + "/PhysVib.vst3", pairs = folder + "/PhysVib-Pairs.vst3";

struct ModuleWith : RawVst3 {
    explicit ModuleWith(const PluginState& state)
        : RawVst3{oneBus, "PhysVib"} {
        take(state);
    }
    void take(const PluginState& state) { EXPECT_TRUE(setState(pluginStateJson(state))); }
};

/// Which no number that is none is.
bool isWithinFullScale(const Samples& signal) {
    return std::ranges::all_of(signal, [](const auto& channel) {
        return std::ranges::all_of(channel, [](float x) { return std::abs(x) <= 1.0f; });
    });
}

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
    RawVst3 host{oneBus, "PhysVib"};
    for (int n = 1; n <= 16; ++n) EXPECT_TRUE(host.arrange({(vst::SpeakerArrangement{1} << n) - 1})) << n;
    for (const auto more : {(vst::SpeakerArrangement{1} << 17) - 1, arr::k71_4})
        EXPECT_FALSE(host.arrange({more}));
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
    std::array<Samples, 2> takes;
    for (auto& take : takes) { // suspended and resumed in between
        host.start(256);
        for (int b = 0; b < 400; ++b) {
            host.process();
            take.insert(take.end(), host.channels[0].begin(), host.channels[0].end());
        }
        host.stop();
    }
    EXPECT_TRUE(takes[0] == takes[1]);
    EXPECT_GT(peakOf(takes[0]), 0.001f);
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
        ModuleWith host{state};
        ASSERT_TRUE(host.hear(channels, 512));
        TestHost processor{state};
        ASSERT_TRUE(setSideChain(*processor.plugin, static_cast<int>(channels)));
        processor.set(Parameter::beats, 50.0);
        processor.set(Parameter::music, -6.0);
        processor.set(Parameter::musicSides, 1.0);
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

/// What is felt in so many frames of a host that goes by blocks of `size(i)` frames, and calls `say(at,
/// frames)` before each; L is taken out.
template <class Size, class Say>
Samples felt(RawVst3& host, std::int64_t length, Size size, Say say) {
    const std::int64_t latency = host.processor->getLatencySamples();
    Samples signal(host.channels[0].size());
    for (std::int64_t at = 0, i = 0; at < length + latency; ++i) {
        const int frames = size(static_cast<int>(i));
        say(at, frames);
        EXPECT_TRUE(host.process(frames));
        for (std::size_t c = 0; c < signal.size(); ++c)
            signal[c].insert(signal[c].end(), host.channels[0][c].begin(),
                             host.channels[0][c].begin() + frames);
        at += frames;
    }
    host.stop();
    signal = later(signal, latency);
    for (auto& c : signal) c.resize(static_cast<std::size_t>(length));
    return signal;
}

constexpr auto blocksOf = [](int frames) { return [frames](int) { return frames; }; };

/// Another key every 5,000 frames, held for 3,000.
void playKeys(RawVst3& host, std::int64_t at, int frames) {
    for (auto n = at; n < at + frames; ++n) {
        if (n % 5000 != 7 && n % 5000 != 3007) continue;
        host.note(48 + static_cast<int>(n / 5000 % 24), static_cast<int>(n - at));
        if (n % 5000 == 3007) host.letGo();
    }
}

/// Ten parameters every 8 frames, and keys: 10,240 points in a block of 8,192.
Samples automated(int block, std::int64_t frames) {
    ModuleWith host{shakenBox()};
    host.start(block);
    return felt(host, frames, blocksOf(block), [&](std::int64_t at, int) {
        for (std::int64_t f = (at + 7) / 8 * 8; f < at + block; f += 8)
            for (const auto which : automatedTogether)
                host.point(static_cast<std::size_t>(which), static_cast<int>(f - at),
                           0.6 +
                               0.3 * std::sin(1e-4 * static_cast<double>(f * (1 + static_cast<int>(which)))));
        playKeys(host, at, block);
    });
}

TEST(RawVst3, PointsOfParametersActAtTheirFramesInBlocksOfAnySize) {
    const auto expected = automated(512, 48000);
    EXPECT_GT(peakOf(expected), 0.02f);
    for (const int block : {1, 32, 500, 1000, 8192})
        EXPECT_TRUE(automated(block, 48000) == expected) << block;
}

TEST(RawVst3, StandInsOfControllersAreFewAndEachControllerOfEachChannelHasOne) {
    RawVst3 host{oneBus, "PhysVib"};
    ASSERT_TRUE(host.isLoaded());
    const auto others = static_cast<std::ptrdiff_t>(parameterCount) + 1; // the program
    EXPECT_LE(std::ssize(host.names), others + vst::kCountCtrlNumber + 15 * 4);
    std::set<std::u16string> titles;
    for (std::size_t p = 0; p < parameterCount; ++p)
        EXPECT_TRUE(titles.insert(host.shortNames[p]).second) << "a short title is another's: " << p;
    for (const auto& channel : host.standIns) {
        ASSERT_EQ(std::ssize(channel), static_cast<std::ptrdiff_t>(vst::kCountCtrlNumber));
        EXPECT_EQ(std::ranges::count(channel, vst::ParamID{0}), 0);
    }
    for (const auto own : {static_cast<std::size_t>(vst::kAfterTouch),
                           static_cast<std::size_t>(vst::kPitchBend), std::size_t{74}, std::size_t{64}})
        EXPECT_NE(host.standIns[0][own], host.standIns[9][own]) << own;
    EXPECT_EQ(host.standIns[0][1], host.standIns[9][1]) << "the modulation wheel of any channel is the same";
}

// The last two are worlds with a mix, of which "live" is live.
TEST(RawVst3, AnyPresetIsTheSameInAnyBlocksHoweverAHostCallsAndWhateverItSaysOfThat) {
    const auto any = [](int i) { return i % 5 < 2 ? i % 5 : i % 8 == 2 ? 8192 : 1 + i * 7919 % 4096; };
    constexpr Steinberg::int32 live = vst::kRealtime, ahead = vst::kPrefetch, bounce = vst::kOffline;
    std::vector<PluginState> states;
    for (const auto& name : presetNames()) states.push_back(presetNamed(name));
    for (const bool isDirect : {false, true}) {
        auto& state = states.emplace_back(shakenBox());
        state.isDirect = isDirect;
        state.strips.resize(4);
        state.strips[1].gainDb = 6.0, state.strips[2].delayMs = 2.5, state.strips[3].ceilingDb = -30.0;
        state.equalised[2] = EqualisedActuator{{100.0, 8.0}, {50.0, 300.0}};
    }
    for (const auto& state : states) {
        ModuleWith host{state};
        Samples expected;
        for (const auto& [setUp, even, odd] : {std::tuple{bounce, bounce, bounce},
                                               {live, live, live},
                                               {live, bounce, live},
                                               {bounce, ahead, live}})
            for (const bool isAny : {false, !state.isDirect}) {
                host.mode = setUp;
                host.start(isAny ? 8192 : 512);
                const auto signal = felt(
                    host, 30000, [&](int i) { return isAny ? any(i) : 512; },
                    [&, block = 0](std::int64_t at, int frames) mutable {
                        host.mode = block++ % 2 == 0 ? even : odd;
                        playKeys(host, at, frames);
                        if (&state >= &states[presetNames().size()] && even == live)
                            std::this_thread::sleep_for(std::chrono::microseconds{frames * 21});
                    });
                if (expected.empty()) expected = signal;
                EXPECT_TRUE(signal == expected) << state.scene.name << ' ' << setUp << even << odd << isAny;
            }
        EXPECT_GT(peakOf(expected), 0.1f) << state.scene.name;
        EXPECT_TRUE(isWithinFullScale(expected)) << state.scene.name;
    }
}

TEST(RawVst3, WhereASongStandsMovesNothingThatRunsFreeAndIsNeverTooMuch) {
    constexpr auto least = std::numeric_limits<std::int64_t>::min(), most = -1 - least;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    RawVst3 host{oneBus, "PhysVib"};
    for (const auto transport : {TransportMode::free, TransportMode::restartOnPlay, TransportMode::inTempo}) {
        auto state = shakenBox();
        state.transport = transport;
        ASSERT_TRUE(host.setState(pluginStateJson(state)));
        Samples expected;
        for (const double tempo : {120.0, 0.0, none, 1e300})
            for (const std::int64_t from : {std::int64_t{0}, std::int64_t{-9000}, least, most})
                for (const std::int64_t speed : {1, 0, -1, 7919}) {
                    host.hasContext = speed != 0 || from != most; // or none is told
                    host.start(512);
                    const auto signal = felt(host, 12000, blocksOf(512), [&](std::int64_t at, int frames) {
                        auto& context = host.context;
                        context.state |=
                            vst::ProcessContext::kTempoValid | vst::ProcessContext::kProjectTimeMusicValid;
                        context.tempo = tempo;
                        context.projectTimeMusic = tempo * static_cast<double>(at * speed);
                        context.projectTimeSamples = static_cast<std::int64_t>(
                            static_cast<std::uint64_t>(from) + static_cast<std::uint64_t>(at * speed));
                        playKeys(host, at, frames);
                    });
                    if (expected.empty()) expected = signal;
                    if (transport == TransportMode::free)
                        EXPECT_TRUE(signal == expected) << tempo << ' ' << from << ' ' << speed;
                    EXPECT_TRUE(isWithinFullScale(signal)) << tempo << ' ' << from << ' ' << speed;
                }
        EXPECT_GT(peakOf(expected), 0.02f);
    }
}

TEST(RawVst3, AShortLoopWithRestartOnPlayIsTheSameEachTimeInBlocksOfAnySize) {
    auto state = shakenBox();
    state.transport = TransportMode::restartOnPlay;
    ModuleWith host{state};
    for (const int loop : {4800, 480}) {
        Samples expected;
        for (const int block : {96, 32, 240}) {
            host.start(block);
            const auto signal = felt(host, 30 * loop, blocksOf(block), [&](std::int64_t at, int) {
                host.context.projectTimeSamples = at % loop;
                if (at % loop == 0) host.note(60);
            });
            if (expected.empty()) expected = signal;
            EXPECT_TRUE(signal == expected) << loop << ' ' << block;
            for (const auto& c : signal)
                EXPECT_TRUE(std::equal(c.begin() + 20 * loop, c.end() - loop, c.begin() + 21 * loop))
                    << loop << ' ' << block;
        }
        EXPECT_GT(peakOf(expected), 0.02f) << loop;
    }
}

TEST(RawVst3, SixtyFourInstancesOnTwelveThreadsInBlocksOfTheirOwnAreOne) {
    std::vector<std::unique_ptr<RawVst3>> hosts;
    std::vector<Samples> signals(64);
    for (std::size_t i = 0; i < signals.size(); ++i) {
        hosts.push_back(std::make_unique<RawVst3>(oneBus, "PhysVib"));
        EXPECT_TRUE(hosts[i]->setState(pluginStateJson(shakenBox())));
        hosts[i]->mode = i % 2 == 0 ? vst::kRealtime : vst::kOffline;
        hosts[i]->start(64 << i % 6);
    }
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 12; ++t)
        threads.emplace_back([&, t] {
            for (std::size_t i = t; i < signals.size(); i += 12)
                signals[i] = felt(*hosts[i], 24000, blocksOf(64 << i % 6),
                                  [&](std::int64_t at, int frames) { playKeys(*hosts[i], at, frames); });
        });
    for (auto& thread : threads) thread.join();
    EXPECT_GT(peakOf(signals[0]), 0.02f);
    for (const auto& signal : signals) EXPECT_TRUE(signal == signals[0]) << &signal - signals.data();
}

TEST(RawVst3, AStateSavedAmongNotesDisturbsNoneAndIsWholeElsewhere) {
    for (const char* const name : {"Strings", "shake-the-box"}) {
        std::string saved;
        const auto played = [&](const std::string& state, bool isSaved) {
            RawVst3 host{oneBus, "PhysVib"};
            host.setState(state);
            host.start(512);
            return felt(host, 48000, blocksOf(512), [&](std::int64_t at, int frames) {
                playKeys(host, at, frames);
                if (isSaved) saved = host.state();
            });
        };
        const auto state = pluginStateJson(presetNamed(name));
        const auto expected = played(state, false);
        EXPECT_TRUE(played(state, true) == expected) << name;
        EXPECT_TRUE(played(saved, false) == expected) << name;
    }
}

TEST(RawVst3, StatesComeAndGoOnAnotherThreadWhileItPlays) {
    RawVst3 host{oneBus, "PhysVib"};
    std::vector<std::string> states;
    for (const auto& name : presetNames()) {
        EXPECT_TRUE(host.setState(pluginStateJson(presetNamed(name))));
        states.push_back(host.state());
    }
    host.mode = vst::kRealtime;
    host.start(256);
    std::atomic<bool> isOver{false};
    std::thread other{[&] {
        for (std::size_t i = 0; !isOver || i < 40; ++i) {
            EXPECT_TRUE(host.setState(states[i % states.size()]));
            EXPECT_EQ(host.state(), states[i % states.size()]);
        }
    }};
    for (int b = 0; b < 1500; ++b) {
        playKeys(host, b * 256, 256);
        ASSERT_TRUE(host.process());
        ASSERT_TRUE(isWithinFullScale(host.channels[0])) << b;
    }
    isOver = true;
    other.join();
    host.stop();
}

TEST(RawVst3, ANoteIsFeltAtItsFrameInSixHundredActivationsWhichLeaveNothingBehind) {
    for (const bool hasWorld : {false, true}) {
        ModuleWith host{hasWorld ? shakenBox() : strikeAt(0, 4)};
        std::size_t before = 0;
        for (int i = 0; i < 600; ++i) {
            if (i == 100) before = heapBytes();
            host.start(512);
            EXPECT_EQ(host.processor->getLatencySamples(), hasWorld ? 1999u : 47u);
            host.note(60, i % 512);
            const auto signal = felt(host, 1024, blocksOf(512), [](std::int64_t, int) {});
            const auto first = std::ranges::find_if(signal[0], [](float x) { return x != 0.0f; });
            const auto late = first - signal[0].begin() - i % 512;
            if (!hasWorld) EXPECT_TRUE(late == 0 || late == 1) << late << ", frame " << i % 512;
        }
        const auto grown = static_cast<double>(heapBytes()) - static_cast<double>(before);
        std::printf("VST3, %s: %.0f bytes more after 500 activations\n", hasWorld ? "a world" : "notes",
                    grown);
        EXPECT_LT(grown, 4.0e5) << "more than the log of what was felt";
    }
}

/// The loudest of each channel, of blocks of which the first has what `say` adds.
template <class Say>
std::vector<float> peaksAfter(RawVst3& host, Say say) {
    say();
    std::vector<float> peaks(host.channels.front().size());
    for (int b = 0; b < 40; ++b) {
        EXPECT_TRUE(host.process());
        for (std::size_t c = 0; c < peaks.size(); ++c)
            peaks[c] = std::max(peaks[c], peakOf(Samples{host.channels.front()[c]}));
    }
    return peaks;
}

TEST(RawVst3, FloodsAndNonsenseAreFiniteHangNowhereAndTheNextNoteIsRight) {
    const std::vector<Steinberg::uint8> sysex(70'000, 1);
    const float none = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [name, isStill] :
         {std::pair{"Keys", true}, {"Strings", true}, {"shake-the-box", false}}) {
        ModuleWith host{presetNamed(name)};
        const auto play = [&host](int blocks) {
            float peak = 0.0f;
            for (int b = 0; b < blocks; ++b) {
                EXPECT_TRUE(host.process());
                EXPECT_TRUE(isWithinFullScale(host.channels[0]));
                peak = std::max(peak, peakOf(host.channels[0]));
            }
            return peak;
        };
        const auto next = [&] { // when all keys have been let go
            for (int n = 0; n < 2048; ++n) host.note(n % 128), host.letGo(15 - n / 128);
            play(1000);
            if (isStill) EXPECT_LT(play(10), 1e-4f) << name;
            host.note(60);
            return play(20);
        };
        host.start(512);
        const float expected = next();
        for (const auto& [count, keys, frames] :
             {std::tuple{16'000, 128, 8}, {2'000, 128, 512}, {20'000, 5, 512}}) {
            for (int n = 0; n < count; ++n) host.note((60 + n % keys) % 128, n % frames);
            play(2);
        }
        for (const int type : {0, 1, 2, 3, 4, 5, 6, 99, 65535})
            for (const int channel : {-1, 3, 255})
                for (const int pitch : {-1, 60, 128, 32767})
                    for (const float velocity : {none, -1.0f, 1e30f}) {
                        host.note(pitch, 100 * pitch);
                        auto& event = host.event();
                        event.noteOn.channel = static_cast<Steinberg::int16>(channel);
                        event.noteOn.velocity = event.noteOn.tuning = velocity;
                        event.type = static_cast<Steinberg::uint16>(type);
                        if (type == vst::Event::kDataEvent) event.data = {70'000, 0, sysex.data()};
                    }
        play(2);
        if (const float now = next(); isStill) EXPECT_NEAR(now, expected, 1e-3f) << name;
        host.stop();
    }
}

void tell(RawVst3& host, vst::NoteExpressionTypeID kind, int id, double value) {
    host.note(57, 0);
    host.event().type = vst::Event::kNoteExpressionValueEvent;
    host.event().noteExpressionValue = {kind, id, value};
}

// VST3's scales: a quarter of the volume's is 0 dB; the middle of the brightness is the note's own.
TEST(RawVst3, VolumeAndBrightnessOfANoteAreItsLevelAndItsHeight) {
    auto state = emptyBox();
    state.limiterEnabled = false;
    state.voice = {.pitch = NotePitch::note, .placement = NotePlacement::middle, .isHeld = true};
    state.parameters = {{"level", 0.0}, {"strike_level", -20.0}};
    ModuleWith host{state};
    host.start(512);
    host.note(57, 0), host.event().noteOn.noteId = 7, host.event().noteOn.velocity = 1.0f;
    peaksAfter(host, [] {});
    const auto middle = peaksAfter(host, [] {});
    const auto expectAfter = [&](vst::NoteExpressionTypeID kind, int id, double value, float above,
                                 float below) {
        peaksAfter(host, [&] { tell(host, kind, id, value); });
        const auto now = peaksAfter(host, [] {});
        for (const std::size_t c : {0u, 1u, 2u, 3u})
            EXPECT_NEAR(now[c], (c < 2 ? above : below) * middle[c], 0.01f * middle[c])
                << kind << ' ' << id << ' ' << value << ' ' << c;
    };
    EXPECT_NEAR(middle[0] + middle[1] + middle[2] + middle[3], 0.1f, 1e-3f);
    for (const auto& [value, gain] : {std::pair{0.5, 2.0f}, {1.0, 4.0f}, {0.0, 0.0f}, {0.25, 1.0f}}) {
        expectAfter(vst::kVolumeTypeID, 7, value, gain, gain);
        expectAfter(vst::kVolumeTypeID, 8, 0.75, gain, gain);
    }
    expectAfter(vst::kBrightnessTypeID, 7, 1.0, 2.0f, 0.0f);
    expectAfter(vst::kBrightnessTypeID, 8, 0.5, 2.0f, 0.0f);
    expectAfter(vst::kBrightnessTypeID, 7, 0.0, 0.0f, 2.0f);
    expectAfter(vst::kBrightnessTypeID, 7, 0.5, 1.0f, 1.0f);
    host.stop();
}

TEST(RawVst3, ExpressionOfANoteIsHeardAndUnsortedEventsAreSorted) {
    RawVst3 host{oneBus, "PhysVib"};
    EXPECT_EQ(host.expressions,
              (std::vector<vst::NoteExpressionTypeID>{vst::kVolumeTypeID, vst::kPanTypeID, vst::kTuningTypeID,
                                                      vst::kBrightnessTypeID}));
    auto state = strikeAt(0, 2);
    state.notes.clear();
    state.voice = {.pitch = NotePitch::note, .placement = NotePlacement::middle, .isHeld = true};
    ASSERT_TRUE(host.setState(pluginStateJson(state)));
    host.start(512);
    const auto strike = [&](int id, int frame) {
        host.note(57, frame);
        host.event().noteOn.noteId = id;
    };
    const auto middle = peaksAfter(host, [&] { strike(7, 0); });
    EXPECT_NEAR(middle[0], middle[1], 1e-3f);
    EXPECT_GT(middle[0], 0.01f);
    tell(host, vst::kPanTypeID, 7, 0.0), host.process();
    for (int b = 0; b < 20; ++b) host.process();
    const auto left = peaksAfter(host, [&] { tell(host, vst::kPanTypeID, 8, 1.0); });
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

} // namespace physvib::raw_vst3_test
