// SPDX-License-Identifier: GPL-3.0-or-later
// Exports played events as MIDI, an event list or haptic files, by the ending of the file's name.
#include "PlayedExport.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/CleanText.h"
#include "Live/Recordings/HitExport.h"
#include "Scene/EventsCsv.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <juce_audio_basics/juce_audio_basics.h>

namespace physvib {

namespace {

constexpr double silenceRatio = 1e-3; // a note ends where its vibration has decayed by 60 dB
constexpr int ticksPerSecond = 24000; // a quarter note of MIDI is a second: at most 15 bits

struct WrittenNote {
    int number = 0, channel = 1;
    std::int64_t onsetNs = 0, endNs = 0;
    double amplitude = 0.0;
};

int nearestMidiNote(double frequencyHz) {
    return std::clamp(static_cast<int>(std::lround(69.0 + 12.0 * std::log2(frequencyHz / 440.0))), 0, 127);
}

std::int64_t computeEndNs(const CollisionEvent& e) {
    if (e.durationNs > 0) return e.timeNs + e.durationNs;
    return e.timeNs + std::llround(1e9 * -std::log(silenceRatio) / e.decayPerSecond);
}

int loudestChannel(const PlayedExport& source, const CollisionEvent& e) {
    PhantomPanner::Gains gains{};
    source.panner.gainsAt(e, gains);
    const auto loudest =
        std::max_element(gains.begin(), gains.begin() + source.panner.channels()) - gains.begin();
    return 1 + static_cast<int>(std::min<std::ptrdiff_t>(loudest, 15));
}

// Turns strikes into MIDI notes. A strike that begins where one of the same note ends prolongs it. One within
// the same note of its channel ends that one, as MIDI cannot overlap them, and lasts until the later end.
std::vector<WrittenNote> makeNotes(const PlayedExport& source) {
    constexpr std::int64_t roundingNs = 2;
    std::vector<WrittenNote> notes;
    std::array<std::size_t, 128> last{}; // by MIDI note: index in `notes` plus 1; 0: none
    std::array<std::array<std::size_t, 128>, 17> byChannel{}; // the same by channel
    for (const CollisionEvent& e : source.events) {
        WrittenNote note{nearestMidiNote(e.frequencyHz), loudestChannel(source, e), e.timeNs, computeEndNs(e),
                         std::abs(e.amplitude)};
        auto& place = last[static_cast<std::size_t>(note.number)];
        auto& same = byChannel[static_cast<std::size_t>(note.channel)][static_cast<std::size_t>(note.number)];
        if (place > 0 && std::abs(notes[place - 1].endNs - note.onsetNs) <= roundingNs) {
            WrittenNote& before = notes[place - 1];
            before.endNs = note.endNs;
            before.amplitude = std::max(before.amplitude, note.amplitude);
            continue;
        }
        if (same > 0 && notes[same - 1].endNs > note.onsetNs) {
            WrittenNote& before = notes[same - 1];
            note.endNs = std::max(note.endNs, before.endNs);
            before.endNs = note.onsetNs;
            if (before.onsetNs == note.onsetNs) {
                note.amplitude = std::max(note.amplitude, before.amplitude);
                before = note;
                place = same;
                continue;
            }
        }
        notes.push_back(note);
        place = same = notes.size();
    }
    return notes;
}

Result<std::string> writeClipFiles(const PlayedExport& source, const std::string& path, ClipFormat format) {
    const HitExport hits{"what was felt", fileNameOf(path), source.events, source.state.layout,
                         source.state.layout.name};
    const auto gains = [&source](const CollisionEvent& e, PhantomPanner::Gains& to) {
        to = {};
        source.panner.gainsAt(e, to);
    };
    const auto clip = makeHitClip(hits, {0.004, static_cast<std::size_t>(source.panner.channels()), gains});
    if (!clip) return Failure{clip.error};
    const auto parts = splitClip(clip.value, path, format);
    if (auto error = replacedPartError(parts, path); !error.empty()) return Failure{std::move(error)};
    return writeParts(parts, format);
}

} // namespace

void PlayedEvents::add(std::uint64_t prepareCount, std::span<const RunEvent> events) {
    for (const auto& [run, played, index, generation] : events) {
        if (prepareCount == prepareCount_ && run < run_) continue; // late events of an earlier run
        if (prepareCount != prepareCount_ || run > run_) events_.clear();
        prepareCount_ = prepareCount;
        run_ = run;
        generation_ = generation;
        totalEvents_ = index + 1;
        events_.push_back(played.event);
    }
    if (events_.size() > maxEvents)
        events_.erase(events_.begin(), events_.end() - static_cast<std::ptrdiff_t>(maxEvents));
}

std::vector<CollisionEvent> PlayedEvents::events(bool fromFirst) const {
    std::vector<CollisionEvent> all;
    std::ranges::copy_if(events_, std::back_inserter(all),
                         [](const CollisionEvent& e) { return isPlayable(e) && e.course.travelNs == 0; });
    std::ranges::stable_sort(all, {}, &CollisionEvent::timeNs);
    const std::int64_t first = fromFirst && !all.empty() ? all.front().timeNs : 0;
    for (CollisionEvent& e : all) e.timeNs -= first;
    return all;
}

std::string midiFileBytes(const PlayedExport& source) {
    const auto notes = makeNotes(source);
    double maxAmplitude = 1e-9; // above 0, if all are silent
    for (const auto& note : notes) maxAmplitude = std::max(maxAmplitude, note.amplitude);
    juce::MidiMessageSequence track;
    track.addEvent(juce::MidiMessage::tempoMetaEvent(1'000'000));
    const auto ticks = [](std::int64_t ns) {
        return std::round(1e-9 * static_cast<double>(ns) * ticksPerSecond);
    };
    for (const auto& note : notes) {
        const auto velocity = static_cast<juce::uint8>(
            std::clamp(std::lround(127.0 * note.amplitude / maxAmplitude), 1l, 127l));
        track.addEvent(juce::MidiMessage::noteOn(note.channel, note.number, velocity), ticks(note.onsetNs));
        track.addEvent(juce::MidiMessage::noteOff(note.channel, note.number), ticks(note.endNs));
    }
    juce::MidiFile file;
    file.setTicksPerQuarterNote(ticksPerSecond);
    file.addTrack(track);
    juce::MemoryOutputStream bytes;
    file.writeTo(bytes, 0);
    return {static_cast<const char*>(bytes.getData()), bytes.getDataSize()};
}

std::vector<std::string_view> playedEndings() {
    std::vector<std::string_view> endings{".mid", ".csv"};
    endings.insert(endings.end(), writableEndings.begin(), writableEndings.end());
    return endings;
}

Result<std::string> exportPlayed(const PlayedExport& source, const std::string& path) {
    if (source.events.empty())
        return Failure{"nothing was felt yet that could be exported: music is not in it, only notes, beats "
                       "and contacts"};
    if (const auto format = findClipFormat(path)) return writeClipFiles(source, path, *format);
    const std::string ending = lowerCase(std::filesystem::path{path}.extension().string());
    if (ending != ".mid" && ending != ".midi" && ending != ".csv")
        return Failure{path + ": expected a name that ends in " + nameList(playedEndings(), " or ")};
    const std::string bytes = ending == ".csv"
                                  ? eventsCsv(source.events, fieldOf(source.panner),
                                              {PHYSVIB_VERSION, {{"scene", source.state.scene.name}}})
                                  : midiFileBytes(source);
    if (const std::string error = writeFile(path, bytes); !error.empty()) return Failure{error};
    return path + ": " + std::to_string(source.events.size()) + " events\n";
}

} // namespace physvib
