// SPDX-License-Identifier: GPL-3.0-or-later
// After a stop nothing sounds, whatever was sounding or held and however full the queues are; what the knobs
// make of a note can always be played; and where no music came in, none is felt.
#include "MidiMap.h"
#include "MusicInput.h"
#include "PluginTesting.h"
#include <map>

namespace physvib::stops { // these files are compiled together, and some names are short
namespace {

using namespace test;
using Message = juce::MidiMessage;

constexpr int rate = 48000, block = 480;

PluginState instrument(bool isHeld) {
    PluginState state = emptyBox();
    for (Material& material : state.scene.materials)
        if (material.frequencyHz > 0.0) material.decayPerSecond = 0.5; // rings for seconds
    state.voice.pitch = isHeld ? NotePitch::note : state.voice.pitch;
    state.voice.isHeld = isHeld;
    return state;
}

struct Stopped {
    explicit Stopped(PluginState state)
        : host{state} {
        host.playHead.isThere = host.playHead.isPlaying = true;
        host.prepare(rate, block);
    }
    void send(const juce::MidiBuffer& midi) { host.block(block, midi); }
    float peakFor(double seconds) {
        return peakOf(host.played(static_cast<std::int64_t>(seconds * rate) / block * block));
    }
    double latency() const { return host.plugin->getLatencySamples() / static_cast<double>(rate) + 0.01; }
    TestHost host;
};

struct State {
    const char* name;
    bool isHeld;
    int firstKey, lastKey;  // that are struck
    bool isByPedal = false; // the keys are let go, and it is down
};
constexpr State states[]{{"a note that rings", false, 60, 60},
                         {"many notes that ring", false, 30, 89},
                         {"a key that is down", true, 45, 45},
                         {"all keys are down", true, 30, 69},
                         {"the pedal holds", true, 45, 45, true}};

Message on(int note) { return Message::noteOn(1, note, juce::uint8{127}); }

TEST(PluginStops, EndEverythingFromEveryState) {
    for (const State& state : states)
        for (const std::string_view how : {"the transport stops", "all sound off", "a take begins"}) {
            auto played = instrument(state.isHeld);
            if (how == "a take begins") played.transport = TransportMode::restartOnPlay;
            Stopped stopped{played};
            juce::MidiBuffer midi;
            for (int note = state.firstKey; note <= state.lastKey; ++note)
                midi.addEvent(on(note), state.isHeld ? 0 : note);
            if (state.isByPedal) {
                midi.addEvent(Message::controllerEvent(1, 64, 127), 1);
                midi.addEvent(Message::noteOff(1, state.firstKey), 2);
            }
            stopped.send(midi);
            EXPECT_GT(stopped.peakFor(stopped.latency() + 0.2), 0.01f) << state.name;
            stopped.host.playHead.isPlaying = how != "the transport stops";
            if (how == "a take begins") stopped.host.playHead.frame += 1'000'000;
            stopped.send(how == "all sound off" ? oneMessage(Message::allSoundOff(1)) : juce::MidiBuffer{});
            stopped.peakFor(stopped.latency() + 0.1);
            EXPECT_LT(stopped.peakFor(0.5), 1.0e-4f) << state.name << ", " << how;
            if (!state.isHeld) continue;
            stopped.send(oneMessage(on(50)));
            stopped.send(oneMessage(Message::noteOff(1, 50)));
            stopped.peakFor(stopped.latency() + 0.5);
            EXPECT_LT(stopped.peakFor(0.2), 1.0e-4f) << how << ", and no pedal holds what comes next";
        }
}

/// So many stops in one block that the queue has no room for the last, which is told again in the next.
TEST(PluginStops, AreNotLostWhereTheQueueIsFull) {
    for (const auto& [before, isLast] :
         {std::pair{0, true}, {0, false}, {1, true}, {127, true}, {128, true}, {1000, true}}) {
        Stopped stopped{instrument(false)};
        juce::MidiBuffer flood;
        for (int i = 0; i < before; ++i) flood.addEvent(Message::allSoundOff(1), 0);
        flood.addEvent(on(60), 470);
        if (isLast) flood.addEvent(Message::allSoundOff(1), 475);
        stopped.send(flood);
        stopped.peakFor(stopped.latency() + 0.1);
        const float peak = stopped.peakFor(0.3);
        EXPECT_TRUE(isLast ? peak < 1.0e-4f : peak > 0.01f) << before << " stops before it, peak " << peak;
    }
}

TEST(PluginNotes, CanBePlayedWhereverTheKnobsStand) {
    for (const double decay : {0.0, 1.0, 0.999 * limits::maxDecayPerSecond, limits::maxDecayPerSecond}) {
        PluginState state = instrument(false);
        for (Material& material : state.scene.materials)
            if (material.frequencyHz > 0.0) material.decayPerSecond = std::max(decay, 0.1);
        const MidiTable table{state};
        for (const float position : {0.0f, 0.001f, 0.25f, 0.5f, 0.75f, 1.0f}) {
            NoteKnobs knobs{.decay = denormalised(rowOf(Parameter::decay), position)};
            for (; knobs.material < static_cast<int>(parameterTable::noteMaterialNames.size());
                 ++knobs.material)
                for (int note = 0; note < 128; note += 7) {
                    CollisionEvent event = table.strikeOf(note, knobs, state.layout.geometry);
                    if (event.frequencyHz <= 0.0) continue;
                    event.amplitude = 0.5;
                    EXPECT_TRUE(isPlayable(event)) << "decay " << decay << ", knob " << knobs.decay
                                                   << ", note " << note << ": " << event.decayPerSecond;
                }
        }
    }
}

/// The ring is used again and again: what was not written is silence, never what was there a turn ago.
TEST(DelayedMusic, IsSilentWhereNoneCame) {
    for (const std::int64_t longest : {500, 1000, 1777}) {
        MusicDelay delay{presetLayout("phone1").geometry, 1, rate, longest};
        test::Random random{static_cast<std::uint32_t>(longest)};
        std::map<std::int64_t, float> written;
        std::int64_t end = 0, read = 0;
        for (int turn = 0; turn < 400; ++turn) {
            end += random.below(3) == 0 ? random.below(static_cast<int>(longest) / 3) : 0; // a gap
            const int frames = 1 + random.below(static_cast<int>(longest) / 3);
            std::vector<float> music(static_cast<std::size_t>(frames));
            for (int i = 0; i < frames; ++i)
                written[end + i] = music[static_cast<std::size_t>(i)] =
                    0.25f + 0.001f * static_cast<float>(random.below(500));
            delay.write(end, music.data(), music.data(), frames);
            end += frames;
            while (read < end) {
                const int part = static_cast<int>(std::min<std::int64_t>(end - read, limits::tileFrames));
                const float* const* out = delay.samplesFrom(read, part);
                for (int i = 0; i < part; ++i) {
                    const auto found = written.find(read + i);
                    const float expected = found == written.end() ? 0.0f : found->second;
                    ASSERT_FLOAT_EQ(out ? out[0][i] : 0.0f, expected)
                        << "turn " << turn << ", frame " << read + i;
                }
                read += part;
            }
            written.clear();
        }
    }
}

/// A silence of music lasts until its end, or as long as a pause that is felt, and no longer.
TEST(DelayedMusic, IsSilentForAPauseThatIsFelt) {
    constexpr auto shortest = static_cast<std::int64_t>(MusicDelay::minPauseSeconds * rate);
    constexpr auto ramp = static_cast<std::int64_t>(limits::channelRampSeconds * rate) + 2;
    const std::vector<float> music(12'000, 0.5f);
    for (const std::int64_t length :
         {std::int64_t{0}, std::int64_t{1}, shortest - 1, shortest, std::int64_t{6000}}) {
        MusicDelay delay{presetLayout("phone1").geometry, 1, rate, 12'000};
        delay.write(0, music.data(), music.data(), 12'000);
        constexpr std::int64_t from = 1000;
        delay.silence(from, from + length);
        const std::int64_t until = from + std::max(length, shortest);
        for (std::int64_t frame = 0; frame < 12'000; frame += limits::tileFrames) {
            const int part = static_cast<int>(std::min<std::int64_t>(limits::tileFrames, 12'000 - frame));
            const float* const* out = delay.samplesFrom(frame, part);
            for (std::int64_t n = frame; n < frame + part; ++n) {
                const float sample = out ? out[0][n - frame] : 0.0f;
                if (n < from || n >= until + ramp) ASSERT_FLOAT_EQ(sample, 0.5f) << length << " at " << n;
                if (n >= from + ramp && n < until) ASSERT_EQ(sample, 0.0f) << length << " at " << n;
            }
        }
    }
}

} // namespace
} // namespace physvib::stops
