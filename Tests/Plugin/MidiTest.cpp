// SPDX-License-Identifier: GPL-3.0-or-later
// MIDI: strikes at their frame, in the log, moved by bends; controllers; notes off.
#include "PluginTesting.h"

namespace physvib::midi_test {

using namespace test;
using Message = juce::MidiMessage;

/// An instance whose world makes no sound of its own.
struct QuietHost : TestHost {
    QuietHost() {
        auto state = emptyBox();
        state.limiterEnabled = false;
        EXPECT_TRUE(plugin->apply(state));
        prepare(48000, 480);
        latency = plugin->getLatencySamples();
    }
    void send(const Message& message, int frame = 0) { midi.addEvent(message, frame); }
    Samples playOn(int frames) {
        Samples signal;
        juce::MidiBuffer first;
        first.swapWith(midi);
        append(signal, block(480, first));
        play(frames - 480, signal);
        return signal;
    }
    std::vector<CollisionEvent> log() {
        std::vector<CollisionEvent> events;
        for (const auto& event : plugin->runs().drainLog()) events.push_back(event.played.event);
        return events;
    }
    juce::MidiBuffer midi;
    int latency = 0;
};

std::int64_t onsetOf(const std::vector<float>& channel) {
    const auto at = std::find_if(channel.begin(), channel.end(), [](float x) { return std::abs(x) > 1e-6f; });
    return at == channel.end() ? -1 : at - channel.begin() - 1; // a sine begins with 0
}

TEST(Midi, StrikesAreAtTheirFrameAndInTheLog) {
    QuietHost host;
    host.send(Message::noteOn(1, 48, juce::uint8{127}), 77);
    const auto signal = host.playOn(48000);
    EXPECT_NEAR(static_cast<double>(onsetOf(signal[0])), host.latency + 77, 1.0);
    const auto log = host.log();
    ASSERT_EQ(log.size(), 1u);
    EXPECT_EQ(FrameClock{48000}.at(log[0].timeNs).frame, 77);
    EXPECT_NEAR(log[0].amplitude, gainFromLevelDb(-6.0), 1e-6);
}

TEST(Midi, TheDefaultMapGoesFromLeftToRightAndThroughTheMaterials) {
    QuietHost host;
    for (const int note : {36, 41, 47, 48}) host.send(Message::noteOn(1, note, juce::uint8{64}), note);
    host.playOn(9600);
    const auto log = host.log();
    ASSERT_EQ(log.size(), 4u);
    EXPECT_EQ(log[0].x, 0.0);
    EXPECT_GT(log[1].x, 0.0);
    EXPECT_EQ(log[2].x, host.plugin->state().scene.fieldWidthMetres);
    EXPECT_EQ(log[0].frequencyHz, log[2].frequencyHz);
    EXPECT_NE(log[3].frequencyHz, log[2].frequencyHz);
}

TEST(Midi, BendSlideAndParametersMoveThePhantom) {
    QuietHost host;
    const double width = host.plugin->state().scene.fieldWidthMetres,
                 height = host.plugin->state().scene.fieldHeightMetres;
    host.send(Message::pitchWheel(2, 16383), 0);
    host.send(Message::controllerEvent(2, 74, 0), 0);
    host.send(Message::noteOn(2, 36, juce::uint8{64}), 1);
    host.send(Message::noteOn(3, 36, juce::uint8{64}), 2); // another MPE channel is not bent
    host.playOn(9600);
    host.setNormal(Parameter::strikeX, 1.0f);
    host.send(Message::noteOn(3, 36, juce::uint8{64}), 2);
    host.playOn(9600);
    const auto log = host.log();
    ASSERT_EQ(log.size(), 3u);
    EXPECT_NEAR(log[0].x, 0.5 * width, 1e-3);
    EXPECT_NEAR(log[0].y, 0.0, 1e-3);
    EXPECT_NEAR(log[1].x, 0.0, 1e-9);
    EXPECT_NEAR(log[1].y, 0.5 * height, 1e-9);
    EXPECT_NEAR(log[2].x, width, 1e-3);
}

TEST(Midi, ControllersMoveParametersAndTheHostIsTold) {
    QuietHost host;
    auto state = host.plugin->state();
    state.controllers = {{7, "level"}};
    ASSERT_TRUE(host.plugin->apply(state));
    struct Told final : juce::AudioProcessorParameter::Listener {
        void parameterValueChanged(int, float value) override { told = value; }
        void parameterGestureChanged(int, bool) override {}
        float told = -1;
    } told;
    auto& level = host.plugin->parameter(Parameter::level);
    level.addListener(&told);
    host.send(Message::controllerEvent(1, 7, 127), 0);
    host.playOn(480);
    EXPECT_EQ(level.getValue(), 1.0f);
    EXPECT_EQ(told.told, -1.0f) << "not by the render call";
    for (int i = 0; i < 100 && told.told < 0.0f; ++i) runFor(0.05);
    EXPECT_EQ(told.told, 1.0f);
    level.removeListener(&told);
}

TEST(Midi, NoControllerMovesANewInstance) {
    TestHost host; // with the safe level of a new instance
    host.setToDefault(Parameter::level);
    host.prepare(48000, 480);
    const auto before = host.plugin->state();
    juce::MidiBuffer midi;
    for (int controller = 0; controller < 120; ++controller)
        for (const int value : {0, 127})
            midi.addEvent(Message::controllerEvent(1, controller, value), controller);
    host.block(480, midi);
    EXPECT_EQ(host.plugin->state().parameters, before.parameters);
    EXPECT_TRUE(before.controllers.empty());
}

TEST(Midi, AllNotesOffLetsTheWorldGoOn) {
    Samples undisturbed, told;
    for (auto* signal : {&undisturbed, &told}) {
        TestHost host{shakenBox(), 480};
        host.play(48000, *signal);
        juce::MidiBuffer midi;
        if (signal == &told)
            // those that imply it as well
            for (int mode = 123; mode < 128; ++mode) midi.addEvent(Message::controllerEvent(1, mode, 0), 100);
        append(*signal, host.block(480, midi));
        host.play(48000, *signal);
    }
    EXPECT_GT(peakOf(later(told, 48000)), 0.01f);
    EXPECT_TRUE(told == undisturbed);
}

TEST(Midi, AllSoundOffAndAStoppedTransportSilence) {
    for (const int how : {1, 2}) {
        QuietHost host;
        host.playHead.isThere = host.playHead.isPlaying = true;
        host.send(Message::noteOn(1, 60, juce::uint8{127}), 0);
        const auto sound = host.playOn(host.latency + 960);
        EXPECT_GT(peakOf(later(sound, host.latency)), 0.01f);
        if (how == 1) host.send(Message::allSoundOff(1), 0);
        if (how == 2) host.playHead.isPlaying = false;
        const auto rest = host.playOn(host.latency + 9600);
        EXPECT_EQ(peakOf(later(rest, host.latency + 4800)), 0.0f) << how;
    }
}

TEST(Midi, AllSoundOffIsSilenceAtOnceAndForWhatWasBefore) {
    for (const int size : {64, 480, 4096}) {
        QuietHost host, other;
        for (auto* h : {&host, &other}) h->prepare(48000, size);
        const int latency = host.plugin->getLatencySamples();
        const int notes = (latency + 4800) / size; // ring, and wait
        for (int i = 0; i < notes; ++i) host.block(size, oneNote(48 + i % 12, 100, i % size));
        Samples after, alone; // what came later is whole
        juce::MidiBuffer off;
        off.addEvent(Message::noteOn(1, 50, juce::uint8{100}), 10);
        off.addEvent(Message::allSoundOff(1), 20);
        off.addEvent(Message::noteOn(1, 60, juce::uint8{127}), 30);
        const auto& out = host.block(size, off);
        append(after, out);
        EXPECT_GT(std::abs(out.getMagnitude(0, 20)), 0.0f);
        host.play(latency + 4800, after);
        float loudest = 0.0f;
        for (const auto& channel : after)
            for (std::size_t n = 20 + 480; n < static_cast<std::size_t>(latency + 29); ++n)
                loudest = std::max(loudest, std::abs(channel[n]));
        EXPECT_EQ(loudest, 0.0f) << size << ": 10 ms after it, until what came later is felt";
        append(alone, other.block(size, oneNote(60, 127, 30)));
        other.play(latency + 4800, alone);
        for (auto n = static_cast<std::size_t>(std::max(latency + 30, 20 + 480)); n < alone[0].size(); ++n)
            ASSERT_NEAR(after[0][n], alone[0][n], 1e-5f) << size << ' ' << n;
        EXPECT_GT(peakOf(alone), 0.01f);
    }
}

TEST(Midi, NotesStrikeWhileTheTransportStands) {
    QuietHost host;
    host.playHead.isThere = true;
    host.playOn(960);
    host.send(Message::noteOn(1, 60, juce::uint8{127}), 0);
    EXPECT_GT(peakOf(host.playOn(host.latency + 960)), 0.01f);
}

TEST(Midi, WithRestartOnPlayNotesOfAStandingTransportAreLost) {
    QuietHost host;
    auto state = host.plugin->state();
    state.transport = TransportMode::restartOnPlay;
    ASSERT_TRUE(host.plugin->apply(state));
    host.playHead.isThere = host.playHead.isPlaying = true;
    host.playOn(9600);
    host.send(Message::noteOn(1, 60, juce::uint8{127}), 0);
    host.playOn(480);
    host.playHead.isPlaying = false; // the note is owed, another is not
    host.send(Message::noteOn(1, 48, juce::uint8{127}), 0);
    EXPECT_GT(peakOf(host.playOn(host.latency + 960)), 0.01f);
    EXPECT_EQ(peakOf(host.playOn(48000)), 0.0f);
    host.playHead.isPlaying = true;
    EXPECT_EQ(peakOf(host.playOn(9600)), 0.0f) << "it does not wait for the next take";
    EXPECT_EQ(host.log().size(), 1u);
}

TEST(Midi, ATakeBeginsAtItsLevel) {
    Samples loud, quiet;
    for (auto* signal : {&loud, &quiet}) {
        QuietHost host;
        if (signal == &quiet) host.setToDefault(Parameter::level);
        host.send(Message::noteOn(1, 60, juce::uint8{127}), 0);
        *signal = host.playOn(9600);
    }
    const auto gain = static_cast<float>(gainFromLevelDb(-12.0));
    for (std::size_t n = 0; n < loud[0].size(); ++n) ASSERT_NEAR(quiet[0][n], gain * loud[0][n], 1e-6f) << n;
}

TEST(Midi, NonsenseIsIgnored) {
    QuietHost host;
    const juce::uint8 bytes[]{0xf0, 1, 2, 3, 4, 5, 6, 7, 0xf7, 0xc0, 5, 0xfe, 0xff, 0x51, 3, 0, 0, 0};
    host.midi.addEvent(bytes, 9, 0);
    host.midi.addEvent(bytes + 9, 2, 1);
    host.midi.addEvent(bytes + 11, 1, 2);
    host.send(Message::noteOn(1, 60, juce::uint8{0}), 3);
    host.send(Message::noteOff(1, 60), 3);
    host.send(Message::pitchWheel(1, 8192), 479);
    EXPECT_EQ(peakOf(host.playOn(9600)), 0.0f);
    EXPECT_TRUE(host.log().empty());
}

/// Of one block.
struct SaidOfNotes final : NoteSource {
    std::vector<NoteEvent> events;
    std::size_t at = 0;
    bool next(NoteEvent& event) noexcept override {
        return at < events.size() && (event = events[at++], true);
    }
    void note(int id, juce::uint8 status, int number, juce::uint8 velocity = 100, double semitones = 0.0) {
        events.push_back(
            {.midi = {status, static_cast<juce::uint8>(number), velocity}, .id = id, .value = semitones});
    }
    void tell(int id, NoteEvent::Kind kind, double value) {
        events.push_back({.kind = kind, .id = id, .value = value});
    }
};

/// Notes by their own pitch, in the middle, for as long as they are held, or decaying.
void prepareVoice(QuietHost& host, bool isHeld) {
    auto state = host.plugin->state();
    state.notes.clear();
    state.voice = {.pitch = NotePitch::note, .placement = NotePlacement::middle, .isHeld = isHeld};
    ASSERT_TRUE(host.plugin->apply(state));
    host.prepare(48000, 480);
}

/// What was struck in the last of some blocks, of which the first has those events.
std::vector<CollisionEvent> struckBy(QuietHost& host, SaidOfNotes said, int blocks = 4) {
    host.plugin->setNoteSource(said);
    std::vector<CollisionEvent> struck;
    for (int b = 0; b < blocks + 10; ++b) { // and what is known later
        host.block(480);
        std::ranges::copy(host.log(), std::back_inserter(struck));
    }
    return struck;
}

TEST(Midi, WhatIsSaidOfANoteIsTrueOfItAlone) {
    QuietHost host;
    prepareVoice(host, true);
    using enum NoteEvent::Kind;
    SaidOfNotes all;
    for (const int id : {1, 2, 3}) all.note(id, 0x90, 57); // one key, as three notes
    const auto before = struckBy(host, all);
    ASSERT_GT(before.size(), 4u);
    for (const auto& event : before) EXPECT_NEAR(event.frequencyHz, 220.0, 1e-6);
    SaidOfNotes first;
    first.tell(1, tuning, 12.0);
    const auto apart = struckBy(host, first);
    for (const double hz : {220.0, 440.0})
        EXPECT_GT(std::ranges::count(apart, hz, [](const auto& e) { return std::round(e.frequencyHz); }), 2)
            << hz;
    SaidOfNotes second;
    second.tell(1, off, 0.0), second.note(3, 0x80, 57), second.tell(2, tuning, 7.0), second.tell(2, pan, 1.0);
    second.tell(2, brightness, 0.25), second.tell(2, volume, 0.5), second.tell(2, pressure, 1.0);
    const auto after = struckBy(host, second);
    ASSERT_GT(after.size(), 2u) << "the second sounds on";
    const auto& now = after.back();
    EXPECT_NEAR(now.frequencyHz, 220.0 * std::exp2(7.0 / 12.0), 1e-6);
    EXPECT_EQ(now.x, host.plugin->state().scene.fieldWidthMetres);
    EXPECT_NEAR(now.y, before.back().y + 0.25 * host.plugin->state().scene.fieldHeightMetres, 1e-9);
    EXPECT_NEAR(now.amplitude, 0.5 * gainFromLevelDb(-6.0), 1e-6) << "half of what a pressed key has";
    SaidOfNotes wild;
    for (const auto kind : {tuning, volume, pan, brightness, pressure})
        wild.tell(-1, kind, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(struckBy(host, wild).back().frequencyHz, now.frequencyHz);
    SaidOfNotes end;
    end.note(2, 0x80, 57);
    struckBy(host, end);
    EXPECT_TRUE(struckBy(host, {}).empty());
}

TEST(Midi, ADecayingNoteHasWhatIsSaidAtItsOnset) {
    QuietHost host;
    prepareVoice(host, false);
    SaidOfNotes said;
    said.note(5, 0x90, 57, 127, 1.0);
    said.tell(5, NoteEvent::Kind::pan, -1.0), said.tell(5, NoteEvent::Kind::volume, 0.5);
    said.note(6, 0x90, 57, 127);
    const auto struck = struckBy(host, said);
    ASSERT_EQ(struck.size(), 2u);
    EXPECT_NEAR(struck[0].frequencyHz, 220.0 * std::exp2(1.0 / 12.0), 1e-6) << "the note's own tuning";
    EXPECT_EQ(struck[0].x, 0.0);
    EXPECT_NEAR(struck[0].amplitude, 0.5 * struck[1].amplitude, 1e-9);
    EXPECT_NEAR(struck[1].frequencyHz, 220.0, 1e-6);
}

TEST(Midi, ABlockOfNoFramesIsHeard) {
    QuietHost host;
    prepareVoice(host, true);
    SaidOfNotes on;
    on.note(-1, 0x90, 57);
    EXPECT_GT(struckBy(host, on).size(), 2u);
    host.block(0, oneMessage(Message::noteOff(1, 57)));
    struckBy(host, {});
    EXPECT_TRUE(struckBy(host, {}).empty()) << "the key was let go while nothing was rendered";
}

TEST(Midi, AProgramChangeChoosesThatPreset) {
    TestHost host{shakenBox(), 480, false};
    const int last = host.plugin->getNumPrograms() - 1;
    for (const int program : {last, 127, 9}) {
        host.block(480, oneMessage(Message::programChange(1, program)));
        const int expected = program == 127 ? last : program;
        for (int i = 0; i < 150 && (i < 10 || host.plugin->getCurrentProgram() != expected); ++i) {
            host.block(480); // who renders nothing is looked after every two seconds
            runFor(0.02);
        }
        EXPECT_EQ(host.plugin->getCurrentProgram(), expected) << program;
    }
    EXPECT_TRUE(host.plugin->canStep(PluginProcessor::Direction::undo));
}

// Whether hosts send it as MIDI, or in a list of their own.
TEST(Midi, AProgramChangeOfABounceActsAtItsFrameInAnyBlocks) {
    const auto note = Message::noteOn(1, 60, juce::uint8{127}), bank = Message::controllerEvent(1, 0, 0),
               program = Message::programChange(1, presetPlace("Bass"));
    for (const bool isListed : {false, true})
        for (const int block : {64, 480, 4096}) {
            TestHost host{presetNamed("Keys"), block};
            for (int first = 0; first < 8192; first += block) {
                SaidOfNotes said;
                juce::MidiBuffer midi;
                for (const auto& [at, message] :
                     {std::pair{699, note}, {700, bank}, {700, program}, {700, note}}) {
                    if (at < first || at >= first + block) continue;
                    midi.addEvent(message, at - first);
                    said.events.push_back({.frame = at - first});
                    std::copy_n(message.getRawData(), message.getRawDataSize(),
                                said.events.back().midi.data());
                }
                if (isListed) host.plugin->setNoteSource(said), midi.clear();
                host.block(block, midi);
            }
            std::vector<std::pair<std::int64_t, double>> struck; // frame in its run, decay
            for (const auto& [run, played, index, generation] : host.plugin->runs().drainLog())
                struck.emplace_back(FrameClock{48000}.at(played.event.timeNs).frame,
                                    played.event.decayPerSecond);
            EXPECT_EQ(struck, (decltype(struck){{699, 12.0}, {0, 4.0}})) << block << isListed;
            EXPECT_EQ(host.plugin->getCurrentProgram(), presetPlace("Bass"));
            auto& knob = host.plugin->parameter(Parameter::strikeLevel);
            knob.setValueNotifyingHost(0.25f);
            host.block(block, oneMessage(program));
            EXPECT_EQ(knob.getValue(), 0.25f) << "a song may say it at each start";
        }
}

} // namespace physvib::midi_test
