// SPDX-License-Identifier: GPL-3.0-or-later
// One call of `physvib play`: the live session with its inputs, its summary at the end, and sound files.
#include "CommandLine/Play/LivePlay.h"
#include "Calls/RenderJob.h"
#include "CommandLine/Play/InputListener.h"
#include "Core/Samples.h"
#include "Core/Units.h"
#include "Host/Osc/OscPort.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NumberText.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Rig/Rig.h"
#include "System/Process.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <utility>

namespace physvib {

namespace {

std::string countsText(const OscCounts& c) {
    std::ostringstream text;
    text << c.packets << " packets, " << c.malformed << " bad, " << c.lost << " lost; " << c.messages
         << " messages, " << c.refused << " refused, " << c.late << " late, " << c.heldBack
         << " replies held back";
    return text.str();
}

/// Prints the listening address on stderr, and if the requested port is in use. Any thread.
void printPort(const OscSettings& settings, const std::string& address) {
    const std::string port = std::to_string(*settings.port);
    const bool isRequested = *settings.port == 0 || address.substr(address.rfind(':') + 1) == port;
    printMessage("OSC: listening at " + address + (isRequested ? "" : "; " + port + " is another program's"));
}

/// Prints a summary on stdout at the end. Any thread.
void printOscSummary(const OscStatus& osc) {
    if (!osc.address.empty()) std::cout << "OSC at " << osc.address << ": " << countsText(osc.counts) << '\n';
    if (osc.sent + osc.unsent > 0)
        std::cout << "OSC out: " << osc.sent << " sent, " << osc.unsent << " not taken\n";
}

/// Reports errors of an OSC port during the session. One thread at a time.
class OscReport {
public:
    /// Prints new errors since the last call on stderr.
    void printNewErrors(const OscCounts& counts) {
        const std::uint64_t errors = counts.failures() + counts.late + counts.lost + counts.heldBack;
        if (std::exchange(reportedErrors_, errors) == errors) return;
        printMessage("OSC: " + countsText(counts) + (counts.lastError.empty() ? "" : "; the last error: ") +
                     counts.lastError);
    }

private:
    std::uint64_t reportedErrors_ = 0;
};

std::uint64_t countDrops(const Session& session, const RenderStatus& status) {
    return session.world().drops() + status.unsent + session.pulse().dropped();
}

// Work of the message thread during the session: steps the world, empties queues, maintains device and
// journal, prints errors, and ends the call.
class PlayLoop {
public:
    PlayLoop(Rig& rig, OscPort* osc, const InputListener* listener, double seconds)
        : rig_{rig}
        , osc_{osc}
        , listener_{listener}
        , endNs_{std::llround(seconds * 1e9)} {}

    void run() {
        repeatEvery(std::chrono::milliseconds{tickMs}, [this] { return tick(); });
    }

    /// Stops playback; returns the number of events that were played.
    std::uint64_t stop() {
        if (!interrupted && !rig_.output().status().isRunning) deviceError_ = rig_.errorText();
        rig_.stop([this](const PlayedEvent&) { ++playedCount_; });
        return playedCount_;
    }

    /// Empty, or the error of a device that was lost before the end. Valid after stop().
    const std::string& deviceError() const noexcept { return deviceError_; }

private:
    static constexpr int tickMs = 10; // well below messageTimerGapSeconds

    bool tick() {
        rig_.step();
        rig_.drainPlayed([this](const PlayedEvent&) { ++playedCount_; });
        const SessionStatus status = rig_.session().status();
        if (++ticks_ % (1000 / tickMs) == 0) reportEverySecond(status);
        const bool hasEnded = listener_ && listener_->hasEnded();
        return !(interrupted || hasEnded || status.sessionNs >= endNs_ || hasDeviceStalled());
    }

    /// True if the duration is over by the system clock and session time has not advanced for long, i.e. the
    /// device requests no blocks.
    bool hasDeviceStalled() const noexcept {
        constexpr int maxStallSeconds = 10; // an audio server took seven to restart
        return stalledSeconds_ >= maxStallSeconds && std::int64_t{ticks_} * tickMs * 1'000'000 >= endNs_;
    }

    void reportEverySecond(const SessionStatus& status) {
        stalledSeconds_ = status.sessionNs == lastSessionNs_ ? stalledSeconds_ + 1 : 0;
        lastSessionNs_ = status.sessionNs;
        rig_.maintain();
        if (!interrupted) reportError(rig_.errorText()); // an interrupted wait for the device is not an error
        if (osc_) oscReport_.printNewErrors(osc_->status().counts);
        printDroppedOutput();
        static const bool isTerminal = isErrorTerminal();
        if (isTerminal) printStatus(status);
    }

    void printStatus(const SessionStatus& status) {
        const AudioOutputStatus o = rig_.output().status();
        const double rate = rig_.output().sampleRateHz() / 1e3;
        const auto margin = status.minMarginFrames == noMargin ? 0 : status.minMarginFrames;
        char line[200];
        std::snprintf(line, sizeof line,
                      "\r%.0f s  load %.1f %% (worst %.1f)  L %.1f ms  margin %.1f ms  %d modes  %llu late  "
                      "%llu dropped%s   ",
                      static_cast<double>(status.sessionNs) * 1e-9, 100.0 * o.load, 100.0 * o.worstLoad,
                      static_cast<double>(rig_.session().timeline().outputLatencyFrames()) / rate,
                      static_cast<double>(margin) / rate, status.render.liveModes,
                      static_cast<unsigned long long>(status.render.late),
                      static_cast<unsigned long long>(countDrops(rig_.session(), status.render)),
                      o.guardGain < 1.0f ? "  guard acts" : "");
        std::cerr << line << std::flush;
    }

    void printDroppedOutput() {
        const std::uint64_t dropped = droppedLines(StdStream::output);
        if (std::exchange(droppedCount_, dropped) != dropped)
            printMessage("standard output: lines that were dropped, as nobody read them: " +
                         std::to_string(dropped));
    }

    void reportError(const std::string& error) {
        if (!error.empty() && error != lastError_) printMessage(error);
        lastError_ = error;
    }

    Rig& rig_;
    OscPort* osc_;
    const InputListener* listener_;
    std::int64_t endNs_;
    OscReport oscReport_;
    std::uint64_t playedCount_ = 0, droppedCount_ = 0;
    int ticks_ = 0, stalledSeconds_ = 0;
    std::int64_t lastSessionNs_ = -1;
    std::string lastError_, deviceError_;
};

void printSummary(Rig& rig, std::uint64_t playedCount) {
    Session& session = rig.session();
    AudioOutput& output = rig.output();
    const SessionStatus status = session.status();
    const RenderStatus& render = status.render;
    const AudioOutputStatus o = output.status();
    const double framesPerMs = output.sampleRateHz() / 1e3;
    std::cout << std::fixed << std::setprecision(1) << "output latency "
              << static_cast<double>(session.timeline().outputLatencyFrames()) / framesPerMs << " ms; "
              << playedCount << " events left, " << render.late << " late, " << countDrops(session, render)
              << " dropped, " << render.rejected << " refused; "
              << static_cast<double>(session.world().stalledNs()) * 1e-6 << " ms of stalls; ";
    if (status.minMarginFrames != noMargin)
        std::cout << "least margin " << static_cast<double>(status.minMarginFrames) / framesPerMs << " ms; ";
    std::cout << "worst load " << 100 * o.worstLoad << " %, "
              << (o.deviceXruns < 0 ? "xruns not counted by" : std::to_string(o.deviceXruns) + " xruns of")
              << " the device\n";
    std::cout << "at the outputs: peaks" << std::setprecision(3);
    double seconds = 0.0;
    for (int j = 0; j < session.channels(); ++j) {
        const Receipts::Total total = output.outputTotal(j);
        seconds = std::max(seconds, total.seconds);
        total.seconds > 0.0 ? std::cout << ' ' << total.peak : std::cout << " -";
    }
    std::cout << std::setprecision(1) << " of full scale, " << seconds << " s\n";
    if (render.withoutPart > 0)
        std::cout << render.withoutPart
                  << " of a part of the body that no actuator is on, felt by their place on all\n";
    if (session.timeline().inputLeadNs() > 0)
        std::cout << "messages were felt " << 1e3 * session.timeline().directSeconds()
                  << " ms after they came\n";
    if (session.rendered().marks())
        std::cout << "marked: " << markSummary(*session.rendered().marks()) << '\n';
    warnIfAny(o.guardEpisodes, "actuators were turned down, as they would have got nearly direct current",
              " times");
    warnIfAny(session.pulse().dropped(), "no device ran when they came, so they were dropped", " events");
    warnIfAny(o.losses, "the device had to be opened again", " times");
}

void printRecordingSummary(const PlayedRecorder& recording, const std::string& path) {
    if (!recording.isRateUnchanged())
        printMessage("warning: the recording ends where the device changed its rate");
    warnIfAny(recording.framesLost(), "frames missing in the recording");
    if (recording.startSeconds() && recording.error().empty())
        std::cout << path << "  begins at session time " << fixedNumber(*recording.startSeconds(), 6)
                  << " s\n";
}

std::unique_ptr<OscPort> makeOsc(const LivePlaySettings& settings, Rig& rig, MessageRouter& messages,
                                 const ClipFolder& clips) {
    if (!settings.osc.port && settings.osc.receiver.empty()) return nullptr;
    const auto apply = [&rig](const LineInput& input, const OscOrigin&) {
        return applyInput(input, rig.session(), rig.output(), MuteRequester::osc);
    };
    auto osc = std::make_unique<OscPort>(settings.osc, rig.session(), messages, rig.output(),
                                         OscHooks{apply, {}, clips});
    if (osc->error().empty() && osc->port() != 0) printPort(settings.osc, osc->status().address);
    return osc;
}

} // namespace

std::string playLive(LivePlaySettings settings) {
    installInterruptHandlers();
    beginNonBlockingOutput();
    Rig rig{settings.rig, withNullDevice(systemAudioDrivers), &interrupted};
    if (auto error = rig.open(); !error.empty()) return interrupted ? "" : error;
    MessageRouter messages{rig.session()};
    if (settings.sound)
        if (auto error = startSound(settings, rig.session(), messages); !error.empty()) return error;
    std::uint64_t playedCount = 0, beatCount = 0;
    std::optional<OscStatus> oscStatus;
    std::string deviceError;
    {
        rig.start();
        std::optional<LiveBeats> liveBeats;
        if (settings.beats)
            liveBeats.emplace(rig.session(), *rig.inputs(), *settings.beats, settings.beatSensitivity);
        std::optional<InputListener> listener;
        const ClipFolder clips{settings.clips};
        if (settings.readsInput)
            listener.emplace(rig.session(), rig.output(), messages, clips, settings.keepsPlaying);
        const auto osc = makeOsc(settings, rig, messages, clips);
        if (osc && !osc->error().empty()) return "OSC: " + osc->error();
        {
            PlayLoop loop{rig, osc.get(), listener ? &*listener : nullptr, settings.seconds};
            loop.run();
            playedCount = loop.stop();
            deviceError = loop.deviceError();
        }
        if (osc) oscStatus = osc->status();
        if (liveBeats) beatCount = liveBeats->count();
    } // inputs end here, so that a sender that continues does not delay the end
    const std::string saveError = rig.finish(interrupted);
    if (oscStatus) printOscSummary(*oscStatus);
    printSummary(rig, playedCount);
    if (rig.inputs()) {
        std::cout << beatCount << " beats heard\n";
        warnIfAny(rig.inputs()->chunksLost(), "sound was lost on its way to the beats", " times");
    }
    std::string error;
    std::cout << rig.summary(error);
    if (rig.recording()) printRecordingSummary(*rig.recording(), settings.rig.recordPath);
    rig.close();
    if (!deviceError.empty()) return deviceError;
    return !saveError.empty() ? saveError : error;
}

namespace {

std::string channelCountText(const LoadedClip& sound) {
    return std::to_string(sound.channels.size()) + " channels";
}

/// True if channel j belongs to actuator j; otherwise there is one channel, or the file gives places.
bool hasOwnChannels(const LoadedClip& sound) { return sound.channels.size() > 1 && sound.places.empty(); }

} // namespace

bool isSoundFile(std::string_view file) {
    const std::string lower = lowerCase(std::string{file});
    return findClipFormat(file) ||
           std::ranges::any_of(soundFileExtensions, [&](auto ending) { return lower.ends_with(ending); });
}

Result<LoadedClip> loadSound(RenderJob& options, std::string_view device, LoadedRender& job) {
    auto sound = loadWholeClip(options.scene);
    if (!sound) return sound;
    const auto count = static_cast<int>(sound.value.channels.size());
    const ContactRecording& first = sound.value.channels.front();
    if (!options.isGiven("--layout") && hasOwnChannels(sound.value)) {
        ActuatorLayout layout;
        options.layout = layoutPresetFor(count, device);
        if (layoutPreset(options.layout, layout) && layout.count != count)
            return Failure{options.scene + ": " + channelCountText(sound.value) +
                           ": expected --layout with a file of as many actuators (Docs/render.md)"};
    }
    if (!options.isGiven("--seconds"))
        options.seconds = static_cast<double>(first.samples.size()) / first.sampleRateHz;
    Scene& scene = job.scene.emplace();
    scene.name = std::filesystem::path{options.scene}.filename().string();
    scene.fieldWidthMetres = scene.fieldHeightMetres = 1.0;
    if (!first.note.empty()) printMessage(first.note);
    float peak = 0.0f;
    for (const ContactRecording& channel : sound.value.channels)
        peak = std::max(peak, peakOf(channel.samples));
    if (const double db = toDecibels(peak); db >= 0.1)
        printMessage(options.scene + ": exceeds full scale by " + fixedNumber(db, 1) +
                     " dB, by which its peaks are limited at level 0 dB");
    return sound;
}

std::string soundError(const LoadedClip& sound, const LoadedRender& job) {
    if (!hasOwnChannels(sound) || std::ssize(sound.channels) == job.channels()) return {};
    return job.options.scene + ": expected a channel for each of " + std::to_string(job.channels()) +
           " actuators (--layout), or one channel, found " + channelCountText(sound);
}

std::string startSound(LivePlaySettings& settings, const Session& session, MessageRouter& messages) {
    PlainMessage message{"clip", {{"file", settings.rig.setup.scene.name}}};
    if (hasOwnChannels(*settings.sound)) message.values.push_back({"law", "alone"});
    const auto takeSound = [&](const std::string&) { return Result<LoadedClip>{std::move(*settings.sound)}; };
    const auto reply = messages.handle(message, nullptr, takeSound);
    settings.seconds += session.timeline().outputLatencySeconds();
    return reply.error;
}

} // namespace physvib
