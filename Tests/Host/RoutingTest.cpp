// SPDX-License-Identifier: GPL-3.0-or-later
// No output has two masters: of any random wishes, those are refused in which an actuator would get noise,
// contact sounds or marks, and after all others each source plays where it was asked to and nowhere else.
#include "FakeAudioDevice.h"
#include "Live/Devices/DeviceSession.h"
#include "Live/Devices/OutputMap.h"
#include "Live/Documents/Mix.h"
#include "Live/Recordings/HitExport.h"
#include "Scene/ActuatorFile.h"
#include "Stimuli/SeededRandom.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace physvib::routing_test {

bool has(const std::vector<int>& list, int value) { return std::ranges::find(list, value) != list.end(); }

/// What a map may not be; apart from counts.
bool isAllowed(const std::vector<int>& felt, const ListeningOutputs& heard) {
    for (std::size_t i = 0; i < felt.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (felt[i] >= 0 && felt[i] == felt[j]) return false;
    for (const auto& source : heard) {
        if (source.size() > static_cast<std::size_t>(OutputMap::maxListeningOutputs)) return false;
        for (const int output : source)
            if (output >= 0 && has(felt, output)) return false;
    }
    for (const int output : heard[static_cast<std::size_t>(ListeningSource::marks)])
        if (has(heard[static_cast<std::size_t>(ListeningSource::noise)], output) ||
            has(heard[static_cast<std::size_t>(ListeningSource::contacts)], output))
            return false;
    return true;
}

TEST(Routing, NoActuatorGetsWhatIsMeantForEarsOrMeters) {
    SeededRandom random{115};
    int taken = 0, refused = 0;
    std::array<int, listeningSourceCount> refusedFor{};
    for (int round = 0; round < 10'000; ++round) {
        const int actuators = 1 + static_cast<int>(random.below(6)), outputs = 16;
        std::vector<int> felt(static_cast<std::size_t>(actuators));
        for (int& output : felt) output = static_cast<int>(random.below(outputs + 1)) - 1;
        ListeningOutputs heard;
        for (auto& source : heard) {
            const std::size_t most = random.chance(0.05) ? 11 : 3;
            for (std::size_t n = random.below(most); n > 0; --n)
                source.push_back(static_cast<int>(random.below(outputs)));
        }
        OutputMap map;
        ASSERT_EQ(map.request(actuators, {}, 0), ""); // before: each on its own
        const bool isTaken = map.request(actuators, felt, 0, heard).empty();
        ASSERT_EQ(isTaken, isAllowed(felt, heard)) << "round " << round;
        (isTaken ? taken : refused)++;
        for (std::size_t kind = 0; kind < listeningSourceCount && !isTaken; ++kind) {
            ListeningOutputs alone;
            alone[kind] = heard[kind];
            refusedFor[kind] += !isAllowed(felt, alone);
        }
        ChannelSet active;
        const int offered = 1 + static_cast<int>(random.below(outputs));
        for (int k = 0; k < offered; ++k) active.insert(k);
        map.applyRequest(active);
        map.finishFades(48000);
        std::set<int> driven;
        for (int j = 0; j < actuators; ++j) {
            float sample = 1.0f;
            const int wanted = isTaken ? felt[static_cast<std::size_t>(j)] : j;
            const int at = map.play(j, &sample, 1);
            ASSERT_EQ(at, wanted < offered ? wanted : -1) << "round " << round << ", actuator " << j;
            if (at >= 0) ASSERT_TRUE(driven.insert(at).second);
        }
        for (const ListeningSource source :
             {ListeningSource::noise, ListeningSource::contacts, ListeningSource::marks})
            for (int i = 0; i < OutputMap::maxListeningOutputs; ++i) {
                const auto& wanted = heard[static_cast<std::size_t>(source)];
                const int at = map.listeningChannel(source, i);
                ASSERT_FALSE(driven.contains(at)) << "round " << round;
                const bool isWanted = isTaken && i < std::ssize(wanted);
                ASSERT_EQ(at, isWanted && wanted[static_cast<std::size_t>(i)] < offered
                                  ? wanted[static_cast<std::size_t>(i)]
                                  : -1);
            }
    }
    EXPECT_GT(taken, 1000);
    EXPECT_GT(refused, 1000);
    for (const int count : refusedFor) EXPECT_GT(count, 100) << "each kind is refused for itself";
}

TEST(Routing, AFreeOutputIsTheLowestThatNobodyHas) {
    SeededRandom random{68};
    for (int round = 0; round < 5000; ++round) {
        std::vector<Strip> strips(random.below(6));
        for (Strip& strip : strips) strip.output = static_cast<int>(random.below(7)) - 1;
        std::vector<int> inUse(random.below(4));
        for (int& output : inUse) output = static_cast<int>(random.below(7)) - 1;
        const int outputs = static_cast<int>(random.below(8));
        int expected = -1;
        for (int k = outputs - 1; k >= 0; --k)
            if (!has(inUse, k) && std::ranges::find(strips, k, &Strip::output) == strips.end()) expected = k;
        ASSERT_EQ(freeOutput(strips, inUse, outputs), expected);
        if (strips.empty()) continue;
        const auto before = strips;
        const std::size_t strip = random.below(strips.size());
        const int wanted = static_cast<int>(random.below(7)) - 1;
        removeSharedOutputs(strips);
        for (std::size_t i = 0; i < strips.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                ASSERT_TRUE(strips[i].output < 0 || strips[i].output != strips[j].output);
        assignOutput(strips, strip, wanted);
        ASSERT_EQ(strips[strip].output, wanted);
        for (std::size_t i = 0; i < strips.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                ASSERT_TRUE(strips[i].output < 0 || strips[i].output != strips[j].output);
    }
}

TEST(Routing, ADeviceLacksWhatItDoesNotHave) {
    for (const int has : {0, 1, 2, 8})
        for (const int wanted : {-1, 0, 1, 2, 7, 8, 9}) {
            test::FakeInterface thing;
            thing.inputs = thing.outputs = has;
            test::FakeDevice device{thing};
            DeviceRequest inputs{.name = "thing"}, outputs{.name = "thing"};
            if (wanted >= 0) inputs.inputs = {wanted};
            outputs.highestListeningOutput = wanted;
            EXPECT_EQ(inputs.errorFor(device).empty(), wanted < has || wanted < 0) << wanted << " of " << has;
            EXPECT_EQ(outputs.errorFor(device).empty(), wanted < has) << wanted << " of " << has;
        }
}

/// One file for each channel in which something is, under names that differ, and no other.
TEST(ExportedParts, AreOfTheChannelsThatAreNotEmpty) {
    for (const ClipFormat format : {ClipFormat::ahap, ClipFormat::haptic})
        for (unsigned mask = 0; mask < 16; ++mask) {
            Clip clip;
            clip.channels.resize(4);
            std::size_t filled = 0;
            for (std::size_t j = 0; j < 4; ++j) {
                clip.channels[j].label = std::string(1, static_cast<char>('A' + j));
                if ((mask >> j & 1U) == 0) continue;
                clip.channels[j].transients = {{0.1, 0.5, 100.0}};
                ++filled;
            }
            const auto parts = splitClip(clip, "/tmp/hits.x", format);
            EXPECT_EQ(parts.size(), filled) << mask;
            std::set<std::string> paths;
            for (const ClipPart& part : parts) {
                EXPECT_NE(part.path, "/tmp/hits.x");
                EXPECT_GT(part.clip.seconds(), 0.0);
                EXPECT_EQ(part.clip.channels.size(), 1U);
                EXPECT_NE(part.path.find("-" + part.clip.channels[0].label + "."), std::string::npos);
                paths.insert(part.path);
            }
            EXPECT_EQ(paths.size(), parts.size());
        }
}

TEST(ExportedHits, HaveTheActuatorsOfTheLayoutOrTheOneThatIsChosen) {
    const std::array<std::string, 4> own{"piezo-230", "haptuator-mark-2", "none", "lra-205"};
    LayoutDescription layout = presetLayout("phone4");
    for (std::size_t j = 0; j < own.size(); ++j) {
        layout.actuators[j].actuator = own[j];
        layout.actuators[j].fullScaleG = 1.0 + static_cast<double>(j);
    }
    const CollisionEvent hit{.frequencyHz = 200, .decayPerSecond = 30, .amplitude = 0.5};
    const auto clipOf = [&](const std::string& chosen) {
        return makeHitClip({"hits", "title", {&hit, 1}, layout, "phone4", chosen},
                           {.channels = own.size(), .gains = [](auto&, auto& gains) { gains.fill(0.5); }});
    };
    for (const std::string chosen : {"", "none", "haptuator-mark-2", "piezo-230"}) {
        const auto clip = clipOf(chosen);
        ASSERT_EQ(clip.error, "");
        for (std::size_t j = 0; j < own.size(); ++j) {
            const std::string& name = chosen.empty() ? own[j] : chosen;
            const ActuatorProfile profile = name == "none" ? ActuatorProfile{} : findActuator(name).value;
            const FrequencyBand band = profile.bandOrUnknown();
            const ClipDevice expected{band.lowHz, band.highHz, profile.resonanceHz.value_or(0.0),
                                      layout.actuators[j].fullScaleG};
            EXPECT_EQ(clip.value.channels[j].device, expected) << chosen << ' ' << j;
        }
    }
    EXPECT_NE(clipOf("no such actuator").error, "");
    CollisionEvent late = hit;
    late.timeNs = 600'000'000'000;
    const PhantomPanner panner{layout.geometry, PanningLaw::linear, 1.0, 1.0, 1.0};
    EXPECT_EQ(
        writeHitsWav({"hits", "title", {&late, 1}, layout, "phone4", ""}, panner, 8000, "/no/hits.wav", ""),
        "hits: expected at most 600 seconds, found 601");
}

// An enchanter that rings while it gets another output is never cut off, and never heard with another one.

constexpr int rate = 48000, outputs = 4;

/// Two enchanters that play a constant, which shows every step, in blocks of `frames`.
class Player {
public:
    explicit Player(int frames)
        : frames_{frames} {
        for (int k = 0; k < outputs; ++k) everything_.insert(k);
        EXPECT_EQ(map_.request(2, {0, 1}), "");
        map_.applyRequest(everything_);
        map_.finishFades(rate);
    }
    void assign(const std::vector<int>& to) {
        EXPECT_EQ(map_.request(2, to), "");
        map_.applyRequest(everything_);
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
    player.assign({-1, 2});
    player.play(0.3);
    player.assign({2, -1}); // of who plays, to who is silent
    player.play(0.3);
    EXPECT_EQ(player.levels, (Levels{0.0f, 0.0f, 1.0f, 0.0f}));
    EXPECT_LE(player.largestStep, 1.01f / static_cast<float>(limits::channelRampSeconds * rate));
}

INSTANTIATE_TEST_SUITE_P(Blocks, AnOutputMap, testing::Values(1, 64, 4096));

} // namespace physvib::routing_test
