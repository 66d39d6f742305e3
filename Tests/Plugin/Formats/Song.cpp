// SPDX-License-Identifier: GPL-3.0-or-later
// A song for hosts from outside, and what the plug-in makes of it in blocks of that size, without a host:
// notes on channel 1, notes with bend, slide and pressure on channels of their own (MPE), steps of
// automation, music at the side chain. The folder gets song.mid, music.wav, automation.txt (id, frame,
// value, value from 0 to 1), the state as state.lv2 and state.vstpreset, what is played as
// song-1.raw to song-4.raw.
// With a third word as Ardour 7.3 plays it: notes come earlier by the latency that is reported, which makes
// up for it; what is at the side chain, and automation, do not. As an LV2 it tells a value of automation at
// the beginning of the next block. As a VST3 it tells a parameter's value at the beginning of each block,
// its points, and its value at the end, which by VST3's rules are lines, of stepped automation too; and its
// transport starts where the first note may come.
// Usage: physvib-plugin-song BLOCK_FRAMES FOLDER [lv2|vst3]
#include "Io/Wav/WavSink.h"
#include "Plugin/Formats/HostStates.h"
#include "PluginSettings.h"
#include "Support/BeatSong.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace physvib;

constexpr int rateHz = 48000, channels = 4, seconds = 12;
constexpr int ticksPerBeat = 1920, ticks = 2 * ticksPerBeat * (seconds - 1); // at 120 beats a minute
constexpr std::int64_t frameOf(int tick) { return 25LL * tick / 2; }         // ticks are even

struct TimedMessage {
    int tick;
    juce::MidiMessage message;
};

struct Point {
    Parameter parameter;
    std::int64_t frame;
    double value;
};

std::vector<TimedMessage> messages() {
    std::vector<TimedMessage> all;
    const auto add = [&all](int tick, const juce::MidiMessage& message) { all.push_back({tick, message}); };
    for (int k = 0; 200 + 386 * k < ticks - 4 * ticksPerBeat; ++k) {
        const int at = 200 + 386 * k, note = 48 + k * 7 % 24;
        add(at, juce::MidiMessage::noteOn(1, note, static_cast<juce::uint8>(127 - k * 37 % 100)));
        add(at + 300, juce::MidiMessage::noteOff(1, note));
    }
    for (int m = 0; m < 14; ++m) { // a point of each controller a channel: hosts draw lines between several
        const int at = 400 + 2400 * m, channel = m + 2, note = 40 + 3 * m;
        add(at - 40, juce::MidiMessage::pitchWheel(channel, 8192 + 500 * (m - 7)));
        add(at - 20, juce::MidiMessage::controllerEvent(channel, 74, 10 + 8 * m));
        add(at, juce::MidiMessage::noteOn(channel, note, juce::uint8{60}));
        add(at + 300, juce::MidiMessage::channelPressureChange(channel, 100));
        add(at + 1000, juce::MidiMessage::noteOff(channel, note));
    }
    std::ranges::stable_sort(all, {}, &TimedMessage::tick);
    return all;
}

// On a MIDI track hosts keep automation by beats, so at even ticks; and away from the beginnings of blocks,
// whose points depend on rounding. The first of each stands at 0: before it hosts use its value.
std::vector<Point> automation() {
    std::vector<Point> all;
    const auto addEvery = [&all](int step, Parameter which, auto value) {
        for (int k = 0; step * k < ticks; ++k)
            all.push_back({which, frameOf(step * k + (k > 0 ? 20 : 0)), value(k)});
    };
    addEvery(1024, Parameter::level, [](int k) { return -18.0 + k * 5 % 13; });
    addEvery(2048, Parameter::strikeX, [](int k) { return -30.0 + 4.0 * (k * 7 % 16); });
    addEvery(3072, Parameter::music, [](int k) { return k % 2 == 0 ? -12.0 : -24.0; });
    std::ranges::stable_sort(all, {}, &Point::frame);
    return all;
}

double normalOf(const Point& point) { return normalised(rowOf(point.parameter), point.value); }

bool writeMidi(const std::vector<TimedMessage>& all, const juce::File& path) {
    juce::MidiMessageSequence track;
    track.addEvent(juce::MidiMessage::tempoMetaEvent(500'000));
    for (const auto& one : all) track.addEvent(one.message, one.tick);
    juce::MidiFile file;
    file.setTicksPerQuarterNote(ticksPerBeat);
    file.addTrack(track);
    juce::MemoryOutputStream bytes;
    return file.writeTo(bytes, 0) && path.replaceWithData(bytes.getData(), bytes.getDataSize());
}

bool writeAutomation(const std::vector<Point>& all, const juce::File& path) {
    juce::String text;
    for (const auto& point : all)
        text << rowOf(point.parameter).id.data() << ' ' << point.frame << ' ' << point.value << ' '
             << juce::String{normalOf(point), 17} << '\n';
    return test::writeText(path, text);
}

PluginState songState() {
    PluginState state = newPluginState();
    const auto& names = presetNames();
    applyBuiltInPreset(state, static_cast<int>(std::ranges::find(names, "MPE pad") - names.begin()));
    state.transport = TransportMode::restartOnPlay;
    return state;
}

/// Steps as Ardour tells them to a VST3.
class LinesOfSteps final : public PointSource {
public:
    /// The block that begins at that frame of the song.
    void begin(const std::vector<Point>& points, std::int64_t frame, int frames) {
        for (auto& queue : queues_) queue.clear();
        for (const Point& point : points) {
            auto& queue = queues_[static_cast<std::size_t>(point.parameter)];
            const auto normal = static_cast<float>(normalOf(point));
            const ParameterPoint told{static_cast<int>(point.frame - frame), normal};
            if (queue.empty() || told.frame <= 0)
                queue.assign(1, {0, told.normal});
            else if (told.frame <= frames)
                queue.push_back(told);
        }
        for (auto& queue : queues_)
            if (!queue.empty() && queue.back().frame < frames) queue.push_back({frames, queue.back().normal});
        next_.fill(0);
    }
    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        if (next_[parameter] == queues_[parameter].size()) return false;
        point = queues_[parameter][next_[parameter]++];
        return true;
    }
    int lastPointFrame(std::size_t parameter) noexcept override {
        return queues_[parameter].empty() ? -1 : queues_[parameter].back().frame;
    }

private:
    std::array<std::vector<ParameterPoint>, parameterCount> queues_;
    std::array<std::size_t, parameterCount> next_{};
};

enum class As { render, lv2, vst3 };

/// Block after block, cut where a parameter moves.
class Host {
public:
    /// By how many frames notes come early; 0: in time, as automation is then.
    Host(int block, As as, std::int64_t early)
        : block_{block}
        , as_{as}
        , early_{as == As::render ? 0 : early}
        , buffer_{channels, block} {
        if (as == As::vst3) transport_.frame = -(early + block - 1) / block * block;
        for (Point& point : points_)
            if (as == As::lv2) point.frame = (point.frame + block - 1) / block * block;
    }

    /// Until `music` ends, which is as it comes in.
    bool play(PluginProcessor& plugin, const std::vector<float>& music, const juce::File& folder) {
        std::vector<float> played;
        plugin.setPlayHead(&transport_);
        for (const auto end = static_cast<std::int64_t>(music.size()); transport_.frame < end;) {
            const int frames = nextBlock(plugin, end);
            for (int c = 0; c < 2; ++c)
                if (transport_.frame < 0)
                    buffer_.clear(c, 0, frames);
                else
                    buffer_.copyFrom(c, 0, music.data() + transport_.frame, frames);
            juce::AudioBuffer<float> part{buffer_.getArrayOfWritePointers(), channels, frames};
            auto midi = midiOf(frames);
            plugin.processBlock(part, midi);
            for (int n = 0; n < frames && transport_.frame >= 0; ++n)
                for (int c = 0; c < channels; ++c) played.push_back(part.getSample(c, n));
            transport_.frame += frames;
        }
        plugin.setPlayHead(nullptr);
        return write(played, folder);
    }

private:
    int nextBlock(PluginProcessor& plugin, std::int64_t end) {
        const std::int64_t now = transport_.frame;
        if (as_ == As::vst3) {
            const int frames = static_cast<int>(std::min<std::int64_t>(end - now, block_));
            lines_.begin(points_, now, frames);
            plugin.setPointSource(lines_);
            return frames;
        }
        for (; point_ < points_.size() && points_[point_].frame <= now; ++point_) {
            const auto normal = static_cast<float>(normalOf(points_[point_]));
            plugin.parameter(points_[point_].parameter).setValue(normal);
        }
        const std::int64_t next = point_ < points_.size() ? points_[point_].frame : end;
        return static_cast<int>(std::min({next, end, now / block_ * block_ + block_}) - now);
    }
    juce::MidiBuffer midiOf(int frames) {
        juce::MidiBuffer midi;
        for (; message_ < messages_.size(); ++message_) {
            const auto& [tick, message] = messages_[message_];
            const std::int64_t at = frameOf(tick) - early_ - transport_.frame;
            if (at >= frames) break;
            midi.addEvent(message, static_cast<int>(at));
        }
        return midi;
    }
    static bool write(const std::vector<float>& played, const juce::File& folder) {
        std::array<std::vector<float>, channels> each;
        for (std::size_t i = 0; i < played.size(); ++i) each[i % channels].push_back(played[i]);
        bool isWritten = true;
        for (int c = 0; c < channels; ++c) {
            const auto& samples = each[static_cast<std::size_t>(c)];
            isWritten = folder.getChildFile("song-" + juce::String{c + 1} + ".raw")
                            .replaceWithData(samples.data(), samples.size() * sizeof(float)) &&
                        isWritten;
        }
        return isWritten;
    }

    const int block_;
    const As as_;
    const std::int64_t early_;
    juce::AudioBuffer<float> buffer_;
    test::Rolling transport_;
    const std::vector<TimedMessage> messages_ = messages();
    std::vector<Point> points_ = automation();
    LinesOfSteps lines_;
    std::size_t message_ = 0, point_ = 0;
};

} // namespace

int main(int argc, char** argv) {
    if (argc < 3 || argc > 4) return 2;
    const int block = std::atoi(argv[1]);
    const juce::File folder{argv[2]};
    const juce::ScopedJuceInitialiser_GUI juce;
    test::BeatSong music{seconds, rateHz, 7};
    std::fill_n(music.samples.begin(), rateHz, 0.0f); // hosts fade in where their transport starts
    WavSink wav{folder.getChildFile("music.wav").getFullPathName().toStdString(), 1, rateHz};
    const float* const samples = music.samples.data();
    if (!wav.write(&samples, static_cast<int>(music.samples.size())) || !wav.finish().empty()) return 1;
    if (!writeMidi(messages(), folder.getChildFile("song.mid"))) return 1;
    if (!writeAutomation(automation(), folder.getChildFile("automation.txt"))) return 1;
    PluginProcessor plugin{"PhysVib Music", {BusPlan::Kind::oneBus, channels, true}};
    if (!plugin.apply(songState())) return 1;
    juce::MemoryBlock chunk;
    plugin.getStateInformation(chunk);
    // values as texts have them
    plugin.setStateInformation(chunk.getData(), static_cast<int>(chunk.getSize()));
    if (!test::writeLv2Preset(chunk, "urn:physvib:plugin:music", folder.getChildFile("state.lv2"))) return 1;
    if (!test::writeVst3Preset(chunk, "Phys", folder.getChildFile("state.vstpreset"))) return 1;
    plugin.setNonRealtime(true);
    plugin.setRateAndBufferSizeDetails(rateHz, block);
    plugin.prepareToPlay(rateHz, block);
    const juce::String word{argc == 4 ? argv[3] : ""};
    const As as = word == "vst3" ? As::vst3 : word == "lv2" ? As::lv2 : As::render;
    if (!Host{block, as, plugin.getLatencySamples()}.play(plugin, music.samples, folder)) return 1;
    std::printf("latency %d frames\n", plugin.getLatencySamples());
    return 0;
}
