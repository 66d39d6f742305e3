// SPDX-License-Identifier: GPL-3.0-or-later
// The LV2 module in a bare host: what JUCE's wrapper leaves out of LV2, and what it must not do.
#include "Plugin/Formats/RawLv2.h"
#include "Plugin/PluginTesting.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <lv2/midi/midi.h>
#include <lv2/time/time.h>
#include <regex>
#include <string>
#include <thread>
#include <tuple>

namespace physvib::raw_lv2_test {

using namespace test;

constexpr int block = 512, latencyOf512 = 1999; // a block, 10 ms of gap, two steps, the limiter

struct PlayingLv2 : RawLv2 {
    PlayingLv2()
        : RawLv2{block, block} {
        EXPECT_TRUE(isLoaded());
        activate();
    }
    ~PlayingLv2() { deactivate(); }
};

TEST(RawLv2, TheLatencyIsThatOfTheUsualBlockNotOfTheLargest) {
    for (const auto& [largest, nominal, latency] : {std::tuple{8192, block, latencyOf512},
                                                    {block, 0, latencyOf512},
                                                    {block, 8192, latencyOf512},
                                                    {8192, 0, latencyOf512 + 8192 - block}}) {
        RawLv2 host{largest, nominal};
        ASSERT_TRUE(host.isLoaded());
        host.activate();
        host.run(block);
        EXPECT_EQ(host.latency, latency) << largest << ' ' << nominal;
        host.deactivate();
    }
}

TEST(RawLv2, NothingIsToldFromTheRenderCallWhenTheHostBypasses) {
    PlayingLv2 host;
    host.run(block);
    for (int b = 0; b < 20; ++b) {
        host.enabled = b % 2 == 0 ? 0.0f : 1.0f;
        EXPECT_EQ(host.run(block), 0u) << b;
    }
}

TEST(RawLv2, TheHostsSwitchSilencesWithinABlockAndItsRamp) {
    PlayingLv2 host;
    host.play(100, block);
    host.enabled = 0.0f;
    const auto shut = host.play(100, block);
    EXPECT_TRUE(std::all_of(shut.begin() + 4 * block, shut.end(), [](float x) { return x == 0.0f; }));
    host.enabled = 1.0f;
    EXPECT_GT(std::ranges::max(host.play(300, block)), 0.001f);
}

float loudestOf(const std::vector<float>& signal) { return peakOf(Samples{signal}); }

constexpr std::array widths{"", "-2", "-8", "-16", "-Music"};

/// What a module of that width says of itself.
std::string descriptionOf(const std::string& width, const char* file = "dsp.ttl") {
    std::ifstream in{PHYSVIB_PLUGINS "/PhysVib" + width + ".lv2/" + file};
    return {std::istreambuf_iterator<char>{in}, {}};
}

/// What all enchanters together play in blocks of `size(i)` frames, each with what `say(at, frames)` adds.
template <class Size, class Say>
std::vector<float> together(RawLv2& host, std::int64_t length, Size size, Say say) {
    std::vector<float> signal;
    host.activate();
    for (std::int64_t at = 0, i = 0; at < length; ++i) {
        const int frames = size(static_cast<int>(i));
        say(at, frames);
        host.run(frames);
        for (std::size_t n = 0; n < static_cast<std::size_t>(frames); ++n)
            signal.push_back(host.out[0][n] + host.out[1][n] + host.out[2][n] + host.out[3][n]);
        at += frames;
    }
    host.deactivate();
    signal.resize(static_cast<std::size_t>(length));
    return signal;
}
constexpr auto usual = [](int) { return block; };
constexpr auto nothing = [](std::int64_t, int) {};

/// Ten parameters every 8 frames, 10,240 in a block of 8,192; what is played L later.
std::vector<float> automated(int frames, std::int64_t length) {
    RawLv2 host{8192, frames};
    const auto signal = together(
        host, length + 8192 + latencyOf512, [=](int) { return frames; },
        [&](std::int64_t at, int) {
            for (std::int64_t f = (at + 7) / 8 * 8; f < at + frames; f += 8)
                for (const auto which : automatedTogether) {
                    const auto& row = rowOf(which);
                    const auto p = static_cast<float>(which);
                    const float normal = 0.6f + 0.3f * std::sin(1e-4f * static_cast<float>(f) * (p + 1.0f));
                    host.points.push_back({static_cast<int>(f - at), std::string{row.id},
                                           static_cast<float>(denormalised(row, normal))});
                }
        });
    const auto latency = static_cast<std::ptrdiff_t>(host.latency);
    return {signal.begin() + latency, signal.begin() + latency + length};
}

TEST(RawLv2, WhatSetsAParameterActsAtItsFrameInBlocksOfAnySize) {
    const auto expected = automated(512, 48000);
    EXPECT_GT(*std::ranges::max_element(expected), 0.02f);
    for (const int frames : {64, 100, 1000, 8192})
        EXPECT_TRUE(automated(frames, 48000) == expected) << frames;
}

TEST(RawLv2, BlocksFarLargerThanAnnouncedAndPortsThatMoveChangeNoSampleNorDoesActivatingAgain) {
    RawLv2 host{block, block};
    const auto expected = together(host, 300'000, usual, nothing);
    EXPECT_GT(*std::ranges::max_element(expected), 0.02f);
    for (const float offline : {1.0f, 0.0f}) {
        host.offline = offline;
        EXPECT_TRUE(together(
                        host, 300'000, [](int i) { return i % 6 == 1 ? 100'000 : i * 7919 % 4099; },
                        [&](std::int64_t, int frames) { host.move(frames); }) == expected);
        EXPECT_EQ(host.latency, latencyOf512);
    }
}

TEST(RawLv2, MalformedEventsMoveNothing) {
    RawLv2 host{block, block}, other{block, block};
    const auto expected = together(host, 48000, usual, nothing);
    const auto id = [&](const char* uri) { return other.idOf(uri); };
    const std::vector<std::uint8_t> sysex(70'000, 0xf0);
    const auto signal = together(other, 48000, usual, [&](std::int64_t, int) {
        other.say = [&](LV2_Atom_Forge& forge) {
            for (const char* const key : {LV2_TIME__frame, LV2_TIME__bar, LV2_TIME__beat, LV2_TIME__beatUnit,
                                          LV2_TIME__beatsPerBar, LV2_TIME__beatsPerMinute, LV2_TIME__speed})
                for (int kind = 0; kind < 7; ++kind) {
                    LV2_Atom_Forge_Frame position;
                    lv2_atom_forge_frame_time(&forge, kind);
                    lv2_atom_forge_object(&forge, &position, 0, id(LV2_TIME__Position));
                    lv2_atom_forge_key(&forge, id(LV2_TIME__speed)); // of two the first counts
                    lv2_atom_forge_float(&forge, 1.0f);
                    if (kind < 6) lv2_atom_forge_key(&forge, id(key));
                    if (kind == 0) lv2_atom_forge_long(&forge, std::numeric_limits<std::int64_t>::min());
                    if (kind == 1) lv2_atom_forge_long(&forge, std::numeric_limits<std::int64_t>::max());
                    if (kind == 2) lv2_atom_forge_double(&forge, std::numeric_limits<double>::quiet_NaN());
                    if (kind == 3) lv2_atom_forge_float(&forge, std::numeric_limits<float>::infinity());
                    if (kind == 4) lv2_atom_forge_string(&forge, "x", 1);
                    if (kind == 5) lv2_atom_forge_bool(&forge, false);
                    lv2_atom_forge_pop(&forge, &position);
                }
            for (const char* const type :
                 {LV2_MIDI__MidiEvent, LV2_ATOM__Object, LV2_ATOM__Chunk, "urn:unknown"})
                for (const std::uint32_t size : {0u, 1u, 70'000u}) {
                    if (size < 16 && id(type) == id(LV2_ATOM__Object)) continue;
                    lv2_atom_forge_frame_time(&forge, 7);
                    lv2_atom_forge_atom(&forge, size, id(type));
                    lv2_atom_forge_write(&forge, sysex.data(), size);
                }
        };
    });
    EXPECT_TRUE(signal == expected);
}

TEST(RawLv2, AVelocityBeyondMidisIsNoLouder) {
    const auto peakOf = [](std::uint8_t velocity) {
        RawLv2 host{block, block};
        host.choose(static_cast<std::int32_t>(builtInScenes().size()));
        return std::ranges::max(together(host, 9600, usual, [&](std::int64_t at, int) {
            if (at > 0) return;
            host.say = [&host, velocity](LV2_Atom_Forge& forge) {
                const std::uint8_t note[]{0x90, 60, velocity};
                lv2_atom_forge_frame_time(&forge, 0);
                lv2_atom_forge_atom(&forge, sizeof note, host.idOf(LV2_MIDI__MidiEvent));
                lv2_atom_forge_write(&forge, note, sizeof note);
            };
        }));
    };
    EXPECT_GT(peakOf(127), 0.02f);
    EXPECT_LE(peakOf(255), peakOf(127));
}

TEST(RawLv2, StatesAreSavedAndRestoredOnAnotherThreadWhileItPlays) {
    PlayingLv2 host;
    host.offline = 0.0f;
    std::vector<RawLv2::State> states;
    for (const std::int32_t program : {9, 0}) {
        host.choose(program);
        host.run(block);
        states.push_back(host.save());
    }
    std::atomic<bool> isOver{false};
    std::thread other{[&] {
        const std::string key = "urn:physvib:plugin:StateString";
        for (std::size_t i = 0; i < 800; ++i) {
            host.restore(states[i % 2]);
            EXPECT_EQ(host.save().at(key).bytes, states[i % 2].at(key).bytes) << i;
        }
        isOver = true;
    }};
    for (int b = 0; !isOver || b < 200; ++b) EXPECT_LE(loudestOf(host.play(1, block)), 1.0f);
    other.join();
}

constexpr std::size_t control(Parameter which) { return static_cast<std::size_t>(which); }

/// What the plug-in itself has, as it would save it now.
double valueOf(RawLv2& host, std::string_view id) {
    juce::MemoryBlock json;
    json.fromBase64Encoding(host.save().at("urn:physvib:plugin:StateString").bytes.data());
    const auto state = readPluginState(json.toString().toStdString(), "state");
    EXPECT_TRUE(state) << state.error;
    for (const auto& [name, value] : state.value.parameters)
        if (name == id) return std::get<double>(value);
    return std::numeric_limits<double>::quiet_NaN();
}

TEST(RawLv2, AControlPortMovesItsParameterAtTheNextBlock) {
    PlayingLv2 host;
    EXPECT_GT(loudestOf(host.play(300, block)), 0.001f);
    host.controls[control(Parameter::level)] = -60.0f; // silence
    host.play(20, block);
    EXPECT_EQ(loudestOf(host.play(100, block)), 0.0f);
    host.points.push_back({0, "level", -12.0f}); // came last
    host.play(20, block);
    EXPECT_GT(loudestOf(host.play(300, block)), 0.001f);
    host.controls[control(Parameter::bypass)] = 1.0f;
    host.play(2, block);
    EXPECT_EQ(loudestOf(host.play(100, block)), 0.0f);
    host.controls[control(Parameter::bypass)] = 0.0f;
    host.play(2, block);
    EXPECT_GT(loudestOf(host.play(300, block)), 0.001f);
}

/// A host's session: the state, and the ports beside it, by text of six digits.
struct SavedSession {
    explicit SavedSession(RawLv2& host)
        : state{host.save()}
        , controls{host.controls} {
        for (float& value : controls) value = std::stof(std::to_string(value));
    }
    RawLv2::State state;
    std::array<float, parameterCount> controls;
};

TEST(RawLv2, WhatWasSetLastByThePortOrBesideItStaysAfterSavingAndLoading) {
    for (const bool byPort : {true, false})
        for (const bool arePortsKept : {true, false})
            for (const bool isRestoredFirst : {true, false}) {
                SCOPED_TRACE(testing::Message{} << byPort << arePortsKept << isRestoredFirst);
                PlayingLv2 first, second;
                first.controls[control(Parameter::level)] = -7.3333333f;
                first.run(block);
                if (!byPort) first.points.push_back({0, "level", -3.0f});
                first.run(block);
                const SavedSession session{first};
                const auto expected = byPort ? -7.3333333 : -3.0;
                if (!isRestoredFirst && arePortsKept) second.controls = session.controls;
                second.restore(session.state);
                if (isRestoredFirst && arePortsKept) second.controls = session.controls;
                for (int b = 0; b < 5; ++b) EXPECT_EQ(second.run(block), 0u) << "no property is told";
                EXPECT_NEAR(valueOf(second, "level"), expected, 1e-5);
                second.controls[control(Parameter::level)] = -20.0f;
                second.run(block);
                EXPECT_NEAR(valueOf(second, "level"), -20.0, 1e-5) << "the port still moves it";
            }
}

TEST(RawLv2, APortThatIsOtherThanWhenTheStateWasSavedCounts) {
    PlayingLv2 first, second;
    first.controls[control(Parameter::level)] = -30.0f;
    first.run(block);
    second.restore(first.save());
    second.controls[control(Parameter::level)] = -40.0f; // the host has kept a newer one
    second.run(block);
    EXPECT_NEAR(valueOf(second, "level"), -40.0, 1e-5);
}

TEST(RawLv2, APresetThatLeavesThePortsAloneIsNotUndoneByThem) {
    PlayingLv2 first, second;
    first.points.push_back({0, "level", -24.0f});
    first.run(block);
    const auto preset = first.save();
    second.controls[control(Parameter::level)] = -5.0f;
    second.run(block);
    second.restore(preset);
    for (int b = 0; b < 5; ++b) second.run(block);
    EXPECT_NEAR(valueOf(second, "level"), -24.0, 1e-5);
    second.controls[control(Parameter::level)] = -5.5f;
    second.run(block);
    EXPECT_NEAR(valueOf(second, "level"), -5.5, 1e-5);
}

TEST(RawLv2, APortThatHoldsNoNumberIsNoneAndAnAbsurdOneIsTheNearest) {
    PlayingLv2 host;
    constexpr float beyond = std::numeric_limits<float>::infinity();
    for (const float absurd : {std::numeric_limits<float>::quiet_NaN(), beyond, -beyond, 1e30f, -1e30f}) {
        host.controls.fill(absurd);
        host.points.push_back({7, "tilt", absurd});
        const float loudest = loudestOf(host.play(300, block));
        EXPECT_TRUE(std::isnan(absurd) ? loudest > 0.001f : loudest <= 1.0f) << absurd;
        EXPECT_LE(std::abs(valueOf(host, "tilt")), 180.0) << absurd;
    }
}

TEST(RawLv2, DescriptionsHaveAPortForEachParameterBehindJucesOwnAndNoProperty) {
    for (std::size_t w = 0; const int first : {9, 7, 13, 21, 11}) {
        const std::string width = widths[w++], text = descriptionOf(width);
        for (const auto& row : allParameters()) {
            const std::string index = std::to_string(first + static_cast<int>(row.parameter));
            const auto port = "lv2:index " + index + " ;\n\t\tlv2:symbol \"" + std::string{row.id} + "\" ;";
            EXPECT_NE(text.find(port), std::string::npos) << width << ' ' << port;
        }
        const auto behind = "lv2:index " + std::to_string(first + static_cast<int>(parameterCount)) + " ";
        EXPECT_EQ(text.find(behind), std::string::npos) << width << ": they are written once";
        EXPECT_EQ(text.find("patch:writable"), std::string::npos) << width;
        EXPECT_EQ(text.find("a lv2:Parameter"), std::string::npos) << width;
    }
}

TEST(RawLv2, MusicAtItsTwoPortsIsFeltAsInTheProcessor) {
    RawLv2 host{block, block, 48000.0, true};
    ASSERT_TRUE(host.isLoaded());
    TestHost processor{{BusPlan::Kind::oneBus, 4, true}};
    processor.plugin->setCurrentProgram(0);
    for (const auto& row : allParameters()) processor.setToDefault(row.parameter);
    processor.prepare(48000, block);
    host.activate();
    float left = 0.0f, right = 0.0f;
    for (int b = 0; b < 60; ++b) {
        if (b == 1) {
            processor.set(Parameter::music, -3.0);
            processor.set(Parameter::musicSides, 1.0);
            host.points.push_back({0, "music", -3.0f});
            host.points.push_back({0, "music_sides", 1.0f});
        }
        for (int n = 0; n < block; ++n) // the other channel is silent
            host.music[0][static_cast<std::size_t>(n)] =
                0.8f * std::sin(0.013f * static_cast<float>(b * block + n));
        for (int c = 0; c < 2; ++c)
            processor.buffer.copyFrom(c, 0, host.music[static_cast<std::size_t>(c)].data(), block);
        host.run(block);
        const auto& expected = processor.block(block);
        for (int c = 0; c < 4; ++c)
            ASSERT_TRUE(std::equal(host.out[static_cast<std::size_t>(c)].begin(),
                                   host.out[static_cast<std::size_t>(c)].end(), expected.getReadPointer(c)))
                << b << ' ' << c;
        left = std::max(left, loudestOf(host.out[0]));
        right = std::max(right, loudestOf(host.out[1]));
    }
    EXPECT_GT(left, 0.1f);
    EXPECT_LT(right, 0.5f * left) << "the left side is felt on the left";
    host.deactivate();
}

// As lv2apply, ecasound and Audacity: audio and controls, no feature, and nothing else is connected.
TEST(RawLv2, AHostThatKnowsTheCoreAloneNeedsNothingElse) {
    for (const std::string width : widths) {
        const auto text = descriptionOf(width);
        EXPECT_EQ(text.find("requiredFeature"), std::string::npos) << width;
        const bool isEffect = width == "-Music";
        EXPECT_EQ(text.find("a lv2:FilterPlugin") != std::string::npos, isEffect) << width;
        std::size_t events = 0, optional = 0;
        for (std::size_t at = 0; (at = text.find("atom:AtomPort", at)) != std::string::npos; ++at) {
            ++events;
            optional += text.find("lv2:connectionOptional", at) < text.find(']', at) ? 1 : 0;
        }
        EXPECT_EQ(events, 2u) << width;
        if (isEffect) EXPECT_EQ(optional, events);
    }
    const std::string bundle = PHYSVIB_PLUGINS "/PhysVib-Music.lv2/";
    void* const module = dlopen((bundle + "PhysVib-Music.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(module, nullptr);
    const auto* const plugin =
        reinterpret_cast<const LV2_Descriptor* (*)(std::uint32_t)>(dlsym(module, "lv2_descriptor"))(0);
    const LV2_Handle handle = plugin->instantiate(plugin, 48000.0, bundle.c_str(), nullptr);
    ASSERT_NE(handle, nullptr);
    std::array<std::vector<float>, 6> audio;
    for (std::uint32_t port = 0; port < audio.size(); ++port) {
        audio[port].resize(block);
        plugin->connect_port(handle, port, audio[port].data());
    }
    constexpr std::uint32_t events = 6, latency = 8, enabled = 10, first = 11;
    plugin->connect_port(handle, events, nullptr);
    plugin->connect_port(handle, events + 1, nullptr);
    std::array<float, 3> own{0.0f, 0.0f, 1.0f}; // latency, free-wheeling, enabled
    for (std::uint32_t port = latency; port <= enabled; ++port)
        plugin->connect_port(handle, port, &own[port - latency]);
    std::array<float, parameterCount> controls{};
    for (std::uint32_t p = 0; p < parameterCount; ++p) {
        controls[p] = static_cast<float>(allParameters()[p].initial);
        plugin->connect_port(handle, first + p, &controls[p]);
    }
    controls[control(Parameter::music)] = 0.0f;
    if (plugin->activate) plugin->activate(handle);
    std::array<float, 4> peaks{};
    for (int b = 0; b < 100; ++b) {
        for (std::size_t n = 0; n < block; ++n)
            audio[0][n] = audio[1][n] =
                0.5f * std::sin(0.0105f * static_cast<float>(b * block) + 0.0105f * static_cast<float>(n));
        plugin->run(handle, block);
        for (std::size_t c = 0; c < peaks.size(); ++c) peaks[c] = std::max(peaks[c], loudestOf(audio[2 + c]));
    }
    for (const float peak : peaks) EXPECT_GT(peak, 0.05f);
    if (plugin->deactivate) plugin->deactivate(handle);
    plugin->cleanup(handle);
    dlclose(module);
}

TEST(RawLv2, DescriptionsHaveFloatsAndNoEmptyAddresses) {
    for (const std::string width : widths) {
        const auto text = descriptionOf(width);
        ASSERT_FALSE(text.empty()) << width;
        EXPECT_NE(text.find(", doap:Project ;"), std::string::npos) << width << ": what has a maintainer";
        EXPECT_NE(descriptionOf(width, "manifest.ttl").find("rdfs:label \"Program\""), std::string::npos)
            << width << ": what presets set";
        EXPECT_EQ(text.find("<>"), std::string::npos) << width << ": that is the file itself";
        EXPECT_NE(text.find("bufs:nominalBlockLength"), std::string::npos) << width;
        const std::regex number{"(lv2:default|lv2:minimum|lv2:maximum|rdf:value) ([^ \t\n]+)"};
        for (std::sregex_iterator found{text.begin(), text.end(), number}, end; found != end; ++found)
            EXPECT_NE((*found)[2].str().find('.'), std::string::npos) << width << ": " << found->str();
    }
}

} // namespace physvib::raw_lv2_test
