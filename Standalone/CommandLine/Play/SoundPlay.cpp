// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a sound file as a `clip` message, with each channel on its own actuator.
#include "CommandLine/Play/SoundPlay.h"
#include "Core/Samples.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Recordings/ClipFolder.h"
#include "Live/Recordings/ReadRecording.h"
#include <algorithm>
#include <cctype>

namespace physvib {

namespace {

std::string channelsOf(const LoadedClip& sound) {
    return std::to_string(sound.channels.size()) + " channels";
}

/// True if channel j belongs to actuator j; otherwise there is one channel, or the file gives places.
bool hasOneEach(const LoadedClip& sound) { return sound.channels.size() > 1 && sound.shares.empty(); }

} // namespace

bool namesSound(std::string_view file) {
    std::string small{file};
    for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto ends = [&](std::string_view ending) { return small.ends_with(ending); };
    return clipFormatOf(file) || std::ranges::any_of(soundEndings, ends);
}

Result<LoadedClip> takeSound(RenderJob& options, std::string_view device, LoadedRender& job) {
    auto sound = loadWholeClip(options.scene);
    if (!sound) return sound;
    const auto count = static_cast<int>(sound.value.channels.size());
    const ContactRecording& first = sound.value.channels.front();
    if (!options.given.contains("--layout") && hasOneEach(sound.value)) {
        ActuatorLayout layout;
        options.layout = layoutFor(count, device);
        if (layoutPreset(options.layout, layout) && layout.count != count)
            return Failure{options.scene + ": " + channelsOf(sound.value) +
                           ": expected --layout with a file of as many actuators (Docs/render.md)"};
    }
    if (!options.given.contains("--seconds"))
        options.seconds = static_cast<double>(first.samples.size()) / first.sampleRateHz;
    Scene& scene = job.scene.emplace();
    scene.name = std::filesystem::path{options.scene}.filename().string();
    scene.fieldWidthMetres = scene.fieldHeightMetres = 1.0;
    if (!first.note.empty()) tell(first.note);
    float peak = 0.0f;
    for (const ContactRecording& channel : sound.value.channels)
        peak = std::max(peak, peakOf(channel.samples));
    if (const double db = toDecibels(peak); db >= 0.1)
        tell(options.scene + ": exceeds full scale by " + fixedNumber(db, 1) +
             " dB, by which its peaks are limited at level 0 dB");
    return sound;
}

std::string soundFault(const LoadedClip& sound, const LoadedRender& job) {
    if (!hasOneEach(sound) || std::ssize(sound.channels) == job.channels()) return {};
    return job.options.scene + ": expected a channel for each of " + std::to_string(job.channels()) +
           " actuators (--layout), or one channel, found " + channelsOf(sound);
}

std::string beginSound(LivePlay& wanted, const Session& session, MessageRouter& messages) {
    PlainMessage message{"clip", {{"file", wanted.rig.setup.scene.name}}};
    if (hasOneEach(*wanted.sound)) message.values.push_back({"law", "alone"});
    const auto read = [&](const std::string&) { return Result<LoadedClip>{std::move(*wanted.sound)}; };
    const auto begun = messages.take(message, nullptr, read);
    wanted.seconds += session.timeline().outputLatencySeconds();
    return begun.error;
}

} // namespace physvib
