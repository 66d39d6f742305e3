// SPDX-License-Identifier: GPL-3.0-or-later
// Notes as an instrument: nothing moves until one is played, then at the level, place and pitch that the
// voice says, for as long as its key is held.
#include "PluginTesting.h"

namespace physvib::voice_test {

using namespace test;
using Message = juce::MidiMessage;

struct TimedMessage {
    std::int64_t frame;
    Message message;
};

/// What is felt of that in blocks of one size, L taken out.
Samples playedBy(const PluginState& state, const std::vector<TimedMessage>& messages, std::int64_t frames) {
    constexpr int block = 512;
    TestHost host{state};
    host.setNormal(Parameter::strikeLevel, 60.0f / 72.0f); // 0 dB
    host.prepare(48000, block);
    Samples signal(4);
    const auto all = frames + host.plugin->getLatencySamples();
    std::size_t next = 0;
    for (std::int64_t at = 0; at < all; at += block) {
        juce::MidiBuffer midi;
        for (; next < messages.size() && messages[next].frame < at + block; ++next)
            midi.addEvent(messages[next].message, static_cast<int>(messages[next].frame - at));
        append(signal, host.block(block, midi));
    }
    signal = later(signal, host.plugin->getLatencySamples());
    for (auto& c : signal) c.resize(static_cast<std::size_t>(frames));
    return signal;
}

Message on(int note, int velocity = 127, int channel = 1) {
    return Message::noteOn(channel, note, static_cast<juce::uint8>(velocity));
}
Message off(int note, int channel = 1) { return Message::noteOff(channel, note); }

PluginState heldVoice(NotePlacement places = NotePlacement::middle) {
    auto state = emptyBox();
    state.limiterEnabled = false;
    state.voice = {.pitch = NotePitch::note, .placement = places, .isHeld = true, .levelsPeak = true};
    return state;
}

float peakBetween(const Samples& signal, std::int64_t from, std::int64_t to, std::size_t channel = 0) {
    return peakOf(Samples{{signal[channel].begin() + from, signal[channel].begin() + to}});
}

/// Upward zero crossings per second.
double pitchOf(const Samples& signal, std::int64_t from, std::int64_t to) {
    int crossings = 0;
    for (auto n = from + 1; n < to; ++n)
        crossings += signal[0][static_cast<std::size_t>(n - 1)] < 0.0f &&
                     signal[0][static_cast<std::size_t>(n)] >= 0.0f;
    return crossings * 48000.0 / static_cast<double>(to - from);
}

TEST(Voice, ANewInstanceIsSilentUntilANoteWhichIsAtMinusSixDecibels) {
    PluginProcessor plugin{"PhysVib", {}};
    plugin.setNonRealtime(true);
    auto buffer = prepareBlocks(plugin, 512);
    float before = 0.0f, after = 0.0f;
    for (int b = 0; b < 400; ++b) {
        auto midi = b == 300 ? oneNote(60) : juce::MidiBuffer{};
        plugin.processBlock(buffer, midi);
        float& peak = b < 300 ? before : after;
        peak = std::max(peak, buffer.getMagnitude(0, 512));
    }
    EXPECT_EQ(before, 0.0f);
    EXPECT_NEAR(juce::Decibels::gainToDecibels(after), -6.0f, 1.0f);
}

TEST(Voice, EveryPitchHasItsFrequencyAndTheLoudestActuatorItsLevel) {
    struct Held {
        int note, velocity;
        double hz;
    };
    // A note of 20 Hz at full scale is what the output's guard turns down.
    for (const auto& [note, velocity, hz] : {Held{33, 127, 55.0},
                                             {45, 127, 110.0},
                                             {57, 127, 220.0},
                                             {69, 127, 440.0},
                                             {81, 127, 440.0},
                                             {4, 64, 20.6}}) {
        const auto signal = playedBy(heldVoice(), {{0, on(note, velocity)}}, 48000);
        EXPECT_NEAR(pitchOf(signal, 0, 48000), hz, 1.1) << note;
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(peakBetween(signal, 0, 48000, c), static_cast<float>(velocity) / 127.0f, 1e-3f)
                << note;
    }
}

TEST(Voice, AHeldNoteIsOneSineUntilItsKeyIsLetGo) {
    auto state = heldVoice();
    state.voice.releaseSeconds = 0.1;
    const auto signal = playedBy(state, {{1000, on(45)}, {49000, off(45)}}, 72000);
    for (std::int64_t n = 1000; n < 48900; ++n)
        ASSERT_NEAR(signal[0][static_cast<std::size_t>(n)],
                    std::sin(2.0 * 3.14159265358979 * 110.0 * static_cast<double>(n - 1000) / 48000.0), 2e-5)
            << n;
    EXPECT_GT(peakBetween(signal, 49500, 50000), 0.1f);
    EXPECT_LT(peakBetween(signal, 49000 + 6000, 72000), 0.001f) << "released";
}

TEST(Voice, TheSustainPedalHoldsWhatTheKeyHasLetGo) {
    auto state = heldVoice();
    state.voice.releaseSeconds = 0.05;
    std::vector<Message> ends{Message::controllerEvent(1, 64, 0)};
    for (int mode = 123; mode < 128; ++mode) ends.push_back(Message::controllerEvent(1, mode, 0));
    for (const auto& end : ends) {
        SCOPED_TRACE(end.getDescription());
        const auto signal = playedBy(state,
                                     {{0, on(45)},
                                      {100, Message::controllerEvent(1, 64, 127)},
                                      {200, off(45)},
                                      {24000, end},
                                      {36000, on(45)},
                                      {36100, off(45)}},
                                     50000);
        EXPECT_NEAR(peakBetween(signal, 20000, 24000), 1.0f, 1e-3f);
        EXPECT_LT(peakBetween(signal, 28000, 36000), 0.001f);
        EXPECT_EQ(peakBetween(signal, 44000, 50000) > 0.5f, &end != ends.data()) << "the foot is still down";
    }
}

// Of its own channel, and of channel 1, whose pedal holds all others.
TEST(Voice, AfterAResetOfAllControllersANoteIsAsItWasPlayedAndEndsWithItsKey) {
    auto state = heldVoice();
    state.voice.bendSemitones = 12.0;
    state.voice.releaseSeconds = 0.05;
    for (const int channel : {1, 2}) {
        SCOPED_TRACE(channel);
        const auto signal = playedBy(state,
                                     {{0, on(45, 64, channel)},
                                      {4000, Message::pitchWheel(channel, 16383)},
                                      {4000, Message::channelPressureChange(channel, 127)},
                                      {4000, Message::controllerEvent(channel, 74, 127)},
                                      {4000, Message::controllerEvent(channel, 64, 127)},
                                      {8000, Message::controllerEvent(channel, 121, 0)},
                                      {24000, off(45, channel)}},
                                     36000);
        EXPECT_NEAR(pitchOf(signal, 12000, 24000), 110.0, 5.0);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(peakBetween(signal, 12000, 24000, c), 64.0f / 127.0f, 1e-3f) << c;
        EXPECT_LT(peakBetween(signal, 28000, 36000), 0.001f) << "the pedal is up";
    }
}

TEST(Voice, OneKeyOnTwoChannelsIsTwoNotes) {
    auto state = heldVoice();
    state.voice.releaseSeconds = 0.05;
    const Message other = Message::noteOn(2, 45, juce::uint8{127});
    const auto signal = playedBy(state, {{0, on(45)}, {100, other}, {4800, off(45)}}, 36000);
    EXPECT_NEAR(peakBetween(signal, 30000, 36000), 1.0f, 0.01f) << "the one that is still held";
}

TEST(Voice, BendPressureAndSlideMoveWhatSounds) {
    auto state = heldVoice();
    state.voice.bendSemitones = 12.0;
    const auto signal = playedBy(state,
                                 {{0, on(45, 64, 2)},
                                  {24000, Message::pitchWheel(2, 16383)},
                                  {48000, Message::channelPressureChange(2, 127)},
                                  {72000, Message::controllerEvent(2, 74, 127)}},
                                 96000);
    EXPECT_NEAR(pitchOf(signal, 0, 24000), 110.0, 3.0);
    EXPECT_NEAR(pitchOf(signal, 26000, 46000), 220.0, 5.0);
    EXPECT_NEAR(peakBetween(signal, 26000, 46000), 64.0f / 127.0f, 1e-3f);
    EXPECT_NEAR(peakBetween(signal, 50000, 70000), 1.0f, 1e-3f);
    EXPECT_NEAR(peakBetween(signal, 74000, 96000, 0), 1.0f, 2e-2f) << "up";
    EXPECT_LT(peakBetween(signal, 74000, 96000, 2), 0.05f) << "away from below";
    EXPECT_LT(largestStep(signal[0]), 1.05 * 2.0 * 3.1416 * 220.0 / 48000.0) << "nothing clicks";
}

/// Makes channel 1 the master of so many.
std::vector<TimedMessage> zoneOf(int members) {
    return {{0, Message::controllerEvent(1, 101, 0)},
            {0, Message::controllerEvent(1, 100, 6)},
            {0, Message::controllerEvent(1, 6, members)}};
}

void say(ChannelExpression& channels, std::initializer_list<std::pair<int, int>> controllers,
         int channel = 1) {
    for (const auto& [number, value] : controllers) channels.handleController(channel, number, value);
}
// As JUCE writes it, the low half of a parameter's number comes first.
void say(ChannelExpression& channels, const juce::MPEZoneLayout& layout) {
    for (const auto event : juce::MPEMessages::setZoneLayout(layout))
        if (const auto message = event.getMessage(); message.isController())
            say(channels, {{message.getControllerNumber(), message.getControllerValue()}},
                message.getChannel());
}

// MPE 1.1: a lower zone of n has channels 2 to 1 + n, an upper one 15 down to 16 - n; where they would
// overlap, the older shrinks, and it stays so small when the newer ends.
TEST(Voice, TwoMpeZonesNeverShareAChannelAndTheOlderGivesWay) {
    for (const int newer : {1, 16})
        for (int first = 1; first <= 14; ++first)
            for (int second = 1; second <= 14; ++second) {
                ChannelExpression zones;
                std::array<int, 17> masters{}; // 0: of no zone
                const auto configure = [&](int master, int members) {
                    say(zones, {{101, 0}, {100, 6}, {6, members}}, master);
                    std::ranges::replace(masters, master, 0);
                    for (int k = 1; k <= members; ++k)
                        masters[static_cast<std::size_t>(master == 1 ? 1 + k : 16 - k)] = master;
                    masters[1] = masters[16] = 0; // it would lead itself
                    for (int channel = 1; channel <= 16; ++channel)
                        ASSERT_EQ(zones.findMaster(channel), masters[static_cast<std::size_t>(channel)])
                            << channel << ": " << first << ", then " << second << " of " << newer;
                };
                configure(17 - newer, first);
                configure(newer, second);
                configure(newer, 0);
            }
}

TEST(Voice, AZoneIsConfiguredByItsParameterAloneInEitherOrder) {
    ChannelExpression zones;
    const auto members = [&zones](int master) {
        int count = 0;
        for (int channel = 1; channel <= 16; ++channel) count += zones.findMaster(channel) == master;
        return count;
    };
    juce::MPEZoneLayout layout;
    layout.setLowerZone(5);
    layout.setUpperZone(4);
    say(zones, layout);
    EXPECT_EQ(members(1), 5);
    EXPECT_EQ(members(16), 4);
    say(zones, {{101, 0}, {100, 6}, {6, 7}});
    EXPECT_EQ(members(1), 7);
    say(zones, {{101, 0}, {100, 6}, {99, 0}, {98, 6}, {6, 3}});
    EXPECT_EQ(members(1), 7) << "a parameter that is not registered";
    say(zones, {{101, 0}, {100, 6}});
    zones.reset(1);
    say(zones, {{6, 3}});
    EXPECT_EQ(members(1), 7) << "none is selected after a reset";
    say(zones, {{101, 1}, {100, 6}, {6, 3}});
    EXPECT_EQ(members(1), 7) << "another";
}

TEST(Voice, ABendRangeIsToldToAChannelOrToAllMembersOfAZone) {
    ChannelExpression channels;
    const auto semitones = [&channels](int channel) { // of full bends, where 12 are those of the preset
        for (int c = 1; c <= 16; ++c) channels.setBend(c, 0.5f);
        return channels.bendSemitones(channel, 12.0);
    };
    say(channels, {{6, 5}, {38, 5}}, 3);
    say(channels, {{101, 0}, {100, 1}, {6, 5}}, 3);
    EXPECT_EQ(semitones(3), 12.0) << "of no parameter, and of another";
    say(channels, {{101, 0}, {100, 0}, {38, 25}}, 3);
    EXPECT_EQ(semitones(3), 12.0) << "cents of nothing";
    say(channels, {{6, 7}, {38, 50}}, 3);
    channels.reset(3);
    EXPECT_EQ(semitones(3), 7.5) << "CC 121 leaves it";
    EXPECT_EQ(semitones(4), 12.0) << "another channel";
    juce::MPEZoneLayout layout;
    layout.setLowerZone(5, 24, 3);
    say(channels, layout);
    EXPECT_EQ(semitones(1), 3.0);
    for (const int member : {2, 3, 6}) EXPECT_EQ(semitones(member), 24.0 + 3.0) << member;
    EXPECT_EQ(semitones(7), 12.0);
    say(channels, {{101, 0}, {100, 6}, {6, 5}});
    EXPECT_EQ(semitones(2), 12.0 + 2.0) << "another controller's zone";
}

TEST(Voice, AllNotesOffIsOfItsChannelOrOfTheZoneThatItLeads) {
    auto state = heldVoice();
    state.voice.releaseSeconds = 0.05;
    const auto isHeld = [&state](std::vector<TimedMessage> messages, int off, int channel) {
        messages.push_back({0, on(45, 127, channel)});
        messages.push_back({4800, Message::controllerEvent(off, 123, 0)});
        return peakBetween(playedBy(state, messages, 24000), 20000, 24000) > 0.5f;
    };
    for (const int channel : {1, 2, 6, 7, 16})
        for (const int off : {1, 2, 16}) {
            EXPECT_EQ(isHeld({}, off, channel), off != channel) << off << ' ' << channel;
            EXPECT_EQ(isHeld(zoneOf(5), off, channel), off != channel && (off != 1 || channel > 6))
                << off << ' ' << channel;
        }
    juce::AudioProcessor::setTypeOfNextNewPlugin(juce::AudioProcessor::wrapperType_VST3);
    EXPECT_FALSE(isHeld({}, 1, 5)) << "VST3 does not say the channel";
    juce::AudioProcessor::setTypeOfNextNewPlugin(juce::AudioProcessor::wrapperType_Undefined);
}

TEST(Voice, AMastersPedalHoldsTheNotesOfItsZone) {
    auto state = heldVoice();
    state.voice.releaseSeconds = 0.05;
    const auto held = [&state](int pedal, int channel) {
        std::vector<TimedMessage> messages = zoneOf(5); // channels 2 to 6; 15 to 12
        for (const auto& [number, value] : {std::pair{101, 0}, {100, 6}, {6, 4}})
            messages.push_back({0, Message::controllerEvent(16, number, value)});
        messages.insert(messages.end(), {{0, Message::controllerEvent(pedal, 64, 127)},
                                         {0, on(45, 127, channel)},
                                         {100, off(45, channel)}});
        return peakBetween(playedBy(state, messages, 30000), 24000, 30000) > 0.5f;
    };
    for (const int channel : {1, 2, 6, 9}) EXPECT_TRUE(held(1, channel) && !held(16, channel)) << channel;
    for (const int channel : {12, 15, 16}) EXPECT_TRUE(held(16, channel)) << channel;
    for (const int channel : {12, 15}) EXPECT_FALSE(held(1, channel)) << channel;
}

TEST(Voice, PressureIsOfItsKeyAndMpesMasterLeadsItsMembers) {
    const auto louder = [](const std::vector<TimedMessage>& more, int channel = 1) {
        std::vector<TimedMessage> all = zoneOf(5); // channels 2 to 6
        all.push_back({0, on(45, 64, channel)});
        all.insert(all.end(), more.begin(), more.end());
        return peakBetween(playedBy(heldVoice(), all, 30000), 20000, 30000);
    };
    const float struck = 64.0f / 127.0f;
    EXPECT_NEAR(louder({}), struck, 1e-3f);
    const float byKey = louder({{9000, Message::aftertouchChange(1, 45, 127)}});
    const float byMaster = louder({{9000, Message::channelPressureChange(1, 127)}}, 6);
    std::printf("peak of a held note: %.3f, by its key's pressure %.3f, by its zone's master %.3f\n",
                static_cast<double>(louder({})), static_cast<double>(byKey), static_cast<double>(byMaster));
    EXPECT_NEAR(byKey, 1.0f, 1e-3f);
    EXPECT_NEAR(louder({{9000, Message::aftertouchChange(1, 46, 127)}}), struck, 1e-3f) << "another key";
    EXPECT_NEAR(byMaster, 1.0f, 1e-3f) << "a member";
    EXPECT_NEAR(louder({{9000, Message::channelPressureChange(1, 127)}}, 7), struck, 1e-3f) << "none";
    EXPECT_GT(louder({{9000, Message::channelPressureChange(1, 127)}, {12000, on(57, 1)}}), 0.99f)
        << "a new key leaves the pressure of those that are held";
}

TEST(Voice, AMasterBendsByTwoSemitonesAndControllersAreSetBackAtOnce) {
    auto state = heldVoice();
    state.voice.bendSemitones = 12.0;
    const auto pitch = [&](std::vector<TimedMessage> messages, int channel) {
        messages.push_back({100, on(45, 127, channel)});
        return pitchOf(playedBy(state, messages, 30000), 5000, 30000);
    };
    std::vector<TimedMessage> zone = zoneOf(15);
    zone.push_back({0, Message::pitchWheel(1, 16383)});
    EXPECT_NEAR(pitch(zone, 2), 110.0 * std::exp2(2.0 / 12.0), 1.5);
    EXPECT_NEAR(pitch({{0, Message::pitchWheel(1, 16383)}}, 2), 110.0, 1.5) << "no zone";
    zone = zoneOf(5);
    for (const auto& [number, value] : {std::pair{100, 0}, {6, 7}}) // registered parameter 0
        zone.push_back({0, Message::controllerEvent(1, number, value)});
    zone.push_back({0, Message::pitchWheel(1, 16383)});
    EXPECT_NEAR(pitch(zone, 2), 110.0 * std::exp2(7.0 / 12.0), 1.5) << "by as many as were told";
    const double bent = pitch({{0, Message::pitchWheel(2, 16383)}}, 2);
    const double back =
        pitch({{0, Message::pitchWheel(2, 16383)}, {50, Message::controllerEvent(2, 121, 0)}}, 2);
    std::printf("pitch of a note: bent up %.1f Hz, after CC 121 %.1f Hz\n", bent, back);
    EXPECT_NEAR(bent, 220.0, 3.0);
    EXPECT_NEAR(back, 110.0, 1.5);
}

TEST(Voice, MoreNotesThanRoomReplaceTheOldest) {
    std::vector<TimedMessage> messages;
    for (int n = 0; n < 40; ++n) messages.push_back({n * 100, on(30 + n, 20)});
    const auto signal = playedBy(heldVoice(), messages, 24000);
    EXPECT_GT(peakOf(signal), 0.1f);
    std::vector<TimedMessage> silenced = messages;
    silenced.push_back({12000, Message::allSoundOff(1)});
    EXPECT_EQ(peakBetween(playedBy(heldVoice(), silenced, 36000), 24000, 36000), 0.0f);
}

TEST(Voice, StatesWithoutOneSoundAsTheyDid) {
    auto state = strikeAt(0, 4);
    state.notes.clear();
    EXPECT_EQ(state.voice, NoteVoice{});
    auto text = pluginStateJson(state);
    const auto from = text.find("\"voice\""), to = text.find("\"notes\"");
    text.replace(text.find("\"physvib_plugin_state\": 5"), 25, "\"physvib_plugin_state\": 4");
    text.erase(from, to - from);
    const auto read = readPluginState(text, "state");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.voice, NoteVoice{});
    const auto signal = playedBy(state, {{0, on(60)}}, 24000);
    EXPECT_TRUE(playedBy(read.value, {{0, on(60)}}, 24000) == signal);
    EXPECT_GT(peakOf(signal), 0.1f);
}

TEST(Voice, AVoiceIsReadBackAndABadOneIsRefusedInALine) {
    auto state = heldVoice(NotePlacement::actuators);
    state.voice.releaseSeconds = 1.25;
    const auto text = pluginStateJson(state);
    const auto read = readPluginState(text, "state");
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.voice, state.voice);
    auto bad = text;
    bad.replace(bad.find("\"release_s\": 1.25"), 17, "\"release_s\": -1.0");
    const auto refused = readPluginState(bad, "state");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error, "state: voice.release_s: expected 0.005 to 10, found -1");
}

TEST(Voice, TheBeltOfEightPlaysANoteOnOneActuatorAndAPlaceBetweenTwoOnThese) {
    const auto state = presetNamed("Belt of eight", 0);
    const ActuatorLayout& belt = state.layout.geometry;
    ASSERT_EQ(belt.count, 8);
    const PhantomPanner panner = makePanner(state, PanningLaw::linear, 1.0);
    const auto gainsAt = [&](double xMetres, double yMetres) {
        PhantomPanner::Gains gains{};
        panner.gainsAt(xMetres / belt.extentWidthMetres * state.scene.fieldWidthMetres,
                       yMetres / belt.extentHeightMetres * state.scene.fieldHeightMetres, gains);
        return gains;
    };
    for (std::size_t j = 0; j < 8; ++j) {
        const std::size_t next = (j + 1) % 8; // of the last the first
        const auto &a = belt.places[j], &b = belt.places[next];
        const auto on = gainsAt(a.xMetres, a.yMetres);
        const double towardsX = a.xMetres + b.xMetres - 2.0, towardsY = a.yMetres + b.yMetres - 2.0;
        const double reach = std::hypot(towardsX, towardsY);
        const auto between = gainsAt(1.0 + towardsX / reach, 1.0 + towardsY / reach); // on the belt, half-way
        EXPECT_NEAR(between[j], between[next], 1e-9);
        for (std::size_t k = 0; k < 8; ++k) {
            EXPECT_NEAR(on[k], k == j ? 1.0 : 0.0, 1e-9) << j << ' ' << k;
            if (k != j && k != next) EXPECT_LT(between[k], 0.126 * between[j]) << j << ' ' << k; // 18 dB
        }
    }
}

TEST(Voice, EveryInstrumentIsSilentUntilANoteAndFeltThen) {
    TestHost names;
    const int worlds = static_cast<int>(builtInScenes().size());
    ASSERT_GE(names.plugin->getNumPrograms() - worlds, 12);
    for (int program = worlds; program < names.plugin->getNumPrograms(); ++program) {
        TestHost host;
        host.plugin->setCurrentProgram(program);
        const auto name = host.plugin->getProgramName(program);
        EXPECT_EQ(host.plugin->getCurrentProgram(), program) << name;
        const auto strikeDb = static_cast<float>(host.plugin->parameter(Parameter::strikeLevel).value());
        EXPECT_TRUE(strikeDb > -0.1f && strikeDb < 12.1f) << name;
        host.setNormal(Parameter::level, 0.8f); // -12 dB
        host.prepare(48000, 512);
        EXPECT_EQ(peakOf(host.played(48000)), 0.0f) << name;
        const auto notes = host.plugin->state().notes;
        Samples felt; // 64: of eight actuators the first
        append(felt, host.block(512, oneNote(notes.empty() ? 64 : notes.front().note)));
        host.play(24000, felt);
        EXPECT_NEAR(juce::Decibels::gainToDecibels(peakOf(felt)), strikeDb - 12.0f, 1.5f) << name;
    }
}

} // namespace physvib::voice_test
