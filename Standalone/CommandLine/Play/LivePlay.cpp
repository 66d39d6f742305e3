// SPDX-License-Identifier: GPL-3.0-or-later
// Creates the rig and its inputs for one call of `physvib play`.
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

std::string summary(const OscCounts& c) {
    std::ostringstream words;
    words << c.packets << " packets, " << c.bad << " bad, " << c.lost << " lost; " << c.messages
          << " messages, " << c.refused << " refused, " << c.late << " late, " << c.held
          << " replies held back";
    return words.str();
}

/// Prints the listening address on stderr, and if the requested port is in use. Any thread.
void tellPort(const OscSettings& wanted, const std::string& address) {
    const std::string port = std::to_string(*wanted.port);
    const bool isWanted = *wanted.port == 0 || address.substr(address.rfind(':') + 1) == port;
    tell("OSC: listening at " + address + (isWanted ? "" : "; " + port + " is another program's"));
}

/// Prints a summary on stdout at the end. Any thread.
void summariseOsc(const OscStatus& osc) {
    if (!osc.address.empty()) std::cout << "OSC at " << osc.address << ": " << summary(osc.counts) << '\n';
    if (osc.sent + osc.unsent > 0)
        std::cout << "OSC out: " << osc.sent << " sent, " << osc.unsent << " not taken\n";
}

/// What goes wrong at an OSC port, while it plays. One thread at a time.
class OscReport {
public:
    /// Prints new errors since the last call on stderr.
    void tellWrong(const OscCounts& counts) {
        const std::uint64_t wrong = counts.wrong() + counts.late + counts.lost + counts.held;
        if (std::exchange(told_, wrong) == wrong) return;
        tell("OSC: " + summary(counts) + (counts.fault.empty() ? "" : "; the last error: ") + counts.fault);
    }

private:
    std::uint64_t told_ = 0;
};

std::uint64_t dropsOf(const Session& session, const RenderStatus& status) {
    return session.world().drops() + status.untold + session.pulse().dropped();
}

// Work of the message thread during the session: steps the world, empties queues, maintains device and
// journal, and ends the call.
class Watch {
public:
    Watch(Rig& rig, OscPort* osc, const InputListener* listener, double seconds)
        : rig_{rig}
        , osc_{osc}
        , listener_{listener}
        , endNs_{std::llround(seconds * 1e9)} {}

    void run() {
        repeatEvery(std::chrono::milliseconds{milliseconds}, [this] { return tick(); });
    }

    /// Stops playback; returns the number of events that left.
    std::uint64_t stop() {
        if (!interrupted && !rig_.output().status().isRunning) lost_ = rig_.trouble();
        rig_.stop([this](const PlayedEvent&) { ++played_; });
        return played_;
    }

    /// Empty, or why the rest was not played: the device had gone for good. After stop().
    const std::string& lost() const noexcept { return lost_; }

private:
    static constexpr int milliseconds = 10; // well below messageTimerGapSeconds

    bool tick() {
        rig_.step();
        rig_.takePlayed([this](const PlayedEvent&) { ++played_; });
        const SessionStatus status = rig_.session().status();
        if (++ticks_ % (1000 / milliseconds) == 0) everySecond(status);
        const bool hasEnded = listener_ && listener_->hasEnded();
        return !(interrupted || hasEnded || status.sessionNs >= endNs_ || isLeft());
    }

    /// True if the duration is over by the system clock and session time has not advanced for long, i.e. the
    /// device requests no blocks.
    bool isLeft() const noexcept {
        constexpr int longestReturn = 10; // in seconds; an audio server took seven to restart
        return stillSeconds_ >= longestReturn && std::int64_t{ticks_} * milliseconds * 1'000'000 >= endNs_;
    }

    void everySecond(const SessionStatus& status) {
        stillSeconds_ = status.sessionNs == lastNs_ ? stillSeconds_ + 1 : 0;
        lastNs_ = status.sessionNs;
        rig_.maintain();
        if (!interrupted) report(rig_.trouble()); // an interrupted wait for the device is not an error
        if (osc_) oscReport_.tellWrong(osc_->status().counts);
        tellUnread();
        static const bool isTerminal = isErrorTerminal();
        if (isTerminal) show(status);
    }

    void show(const SessionStatus& status) {
        const AudioOutputStatus o = rig_.output().status();
        const double rate = rig_.output().sampleRateHz() / 1e3;
        const auto margin = status.leastMarginFrames == noMargin ? 0 : status.leastMarginFrames;
        char words[200];
        std::snprintf(words, sizeof words,
                      "\r%.0f s  load %.1f %% (worst %.1f)  L %.1f ms  margin %.1f ms  %d modes  %llu late  "
                      "%llu dropped%s   ",
                      static_cast<double>(status.sessionNs) * 1e-9, 100.0 * o.load, 100.0 * o.worstLoad,
                      static_cast<double>(rig_.session().timeline().outputLatencyFrames()) / rate,
                      static_cast<double>(margin) / rate, status.render.liveModes,
                      static_cast<unsigned long long>(status.render.late),
                      static_cast<unsigned long long>(dropsOf(rig_.session(), status.render)),
                      o.guardGain < 1.0f ? "  guard acts" : "");
        std::cerr << words << std::flush;
    }

    void tellUnread() {
        const std::uint64_t dropped = droppedLines(Standard::output);
        if (std::exchange(unread_, dropped) != dropped)
            tell("standard output: lines that were dropped, as nobody read them: " + std::to_string(dropped));
    }

    void report(const std::string& trouble) {
        if (!trouble.empty() && trouble != lastTrouble_) tell(trouble);
        lastTrouble_ = trouble;
    }

    Rig& rig_;
    OscPort* osc_;
    const InputListener* listener_;
    std::int64_t endNs_;
    OscReport oscReport_;
    std::uint64_t played_ = 0, unread_ = 0;
    int ticks_ = 0, stillSeconds_ = 0;
    std::int64_t lastNs_ = -1;
    std::string lastTrouble_, lost_;
};

void summarise(Rig& rig, std::uint64_t played) {
    Session& session = rig.session();
    AudioOutput& output = rig.output();
    const SessionStatus status = session.status();
    const RenderStatus& r = status.render;
    const AudioOutputStatus o = output.status();
    const double framesPerMs = output.sampleRateHz() / 1e3;
    std::cout << std::fixed << std::setprecision(1) << "output latency "
              << static_cast<double>(session.timeline().outputLatencyFrames()) / framesPerMs << " ms; "
              << played << " events left, " << r.late << " late, " << dropsOf(session, r) << " dropped, "
              << r.rejected << " refused; " << static_cast<double>(session.world().slippedNs()) * 1e-6
              << " ms of stalls; ";
    if (status.leastMarginFrames != noMargin)
        std::cout << "least margin " << static_cast<double>(status.leastMarginFrames) / framesPerMs
                  << " ms; ";
    std::cout << "worst load " << 100 * o.worstLoad << " %, "
              << (o.deviceXruns < 0 ? "xruns not counted by" : std::to_string(o.deviceXruns) + " xruns of")
              << " the device\n";
    std::cout << "at the outputs: peaks" << std::setprecision(3);
    double seconds = 0.0;
    for (int j = 0; j < session.channels(); ++j) {
        const Receipts::Total left = output.leftInAll(j);
        seconds = std::max(seconds, left.seconds);
        left.seconds > 0.0 ? std::cout << ' ' << left.peak : std::cout << " -";
    }
    std::cout << std::setprecision(1) << " of full scale, " << seconds << " s\n";
    if (r.withoutPart > 0)
        std::cout << r.withoutPart
                  << " of a part of the body that no actuator is on, felt by their place on all\n";
    if (session.timeline().toldAheadNs() > 0)
        std::cout << "messages were felt " << 1e3 * session.timeline().directSeconds()
                  << " ms after they came\n";
    if (session.rendered().marks()) std::cout << "marked: " << markWords(*session.rendered().marks()) << '\n';
    warnOf(o.guarded, "actuators were turned down, as they would have got nearly direct current", " times");
    warnOf(session.pulse().dropped(), "no device ran when they came, so they were dropped", " events");
    warnOf(o.losses, "the device had to be opened again", " times");
}

void summariseRecording(const PlayedRecorder& recording, const std::string& path) {
    if (!recording.isWhole()) tell("warning: the recording ends where the device changed its rate");
    warnOf(recording.framesLost(), "frames missing in the recording");
    if (recording.beginsSeconds() && recording.error().empty())
        std::cout << path << "  begins at session time " << fixedNumber(*recording.beginsSeconds(), 6)
                  << " s\n";
}

std::unique_ptr<OscPort> makeOsc(const LivePlay& wanted, Rig& rig, MessageRouter& messages,
                                 const ClipFolder& clips) {
    if (!wanted.osc.port && wanted.osc.receiver.empty()) return nullptr;
    const auto act = [&rig](const LineInput& input, const OscOrigin&) {
        return actOn(input, rig.session(), rig.output(), MuteRequester::osc);
    };
    auto osc = std::make_unique<OscPort>(wanted.osc, rig.session(), messages, rig.output(),
                                         OscHooks{act, {}, clips});
    if (osc->error().empty() && osc->port() != 0) tellPort(wanted.osc, osc->status().address);
    return osc;
}

} // namespace

std::string playLive(LivePlay wanted) {
    heedInterrupts();
    sayWithoutWaiting();
    Rig rig{wanted.rig, withNoDevice(systemAudioDrivers), &interrupted};
    if (auto error = rig.open(); !error.empty()) return interrupted ? "" : error;
    MessageRouter messages{rig.session()};
    if (wanted.sound)
        if (auto error = beginSound(wanted, rig.session(), messages); !error.empty()) return error;
    std::uint64_t played = 0, beats = 0;
    std::optional<OscStatus> told;
    std::string lost;
    {
        rig.start();
        std::optional<LiveBeats> heard;
        if (wanted.beats) heard.emplace(rig.session(), *rig.inputs(), *wanted.beats, wanted.beatSensitivity);
        std::optional<InputListener> listener;
        const ClipFolder clips{wanted.clips};
        if (wanted.listens)
            listener.emplace(rig.session(), rig.output(), messages, clips, wanted.keepsPlaying);
        const auto osc = makeOsc(wanted, rig, messages, clips);
        if (osc && !osc->error().empty()) return "OSC: " + osc->error();
        {
            Watch watch{rig, osc.get(), listener ? &*listener : nullptr, wanted.seconds};
            watch.run();
            played = watch.stop();
            lost = watch.lost();
        }
        if (osc) told = osc->status();
        if (heard) beats = heard->beats();
    } // a sender that continues does not delay the end
    const std::string unsaved = rig.finish(interrupted);
    if (told) summariseOsc(*told);
    summarise(rig, played);
    if (rig.inputs()) {
        std::cout << beats << " beats heard\n";
        warnOf(rig.inputs()->piecesLost(), "sound was lost on its way to the beats", " times");
    }
    std::string trouble;
    std::cout << rig.summary(trouble);
    if (rig.recording()) summariseRecording(*rig.recording(), wanted.rig.recordPath);
    rig.close();
    if (!lost.empty()) return lost;
    return !unsaved.empty() ? unsaved : trouble;
}

namespace {

std::string channelsOf(const LoadedClip& sound) {
    return std::to_string(sound.channels.size()) + " channels";
}

/// True if channel j belongs to actuator j; otherwise there is one channel, or the file gives places.
bool hasOneEach(const LoadedClip& sound) { return sound.channels.size() > 1 && sound.shares.empty(); }

} // namespace

bool namesSound(std::string_view file) {
    const std::string small = lowerCase(std::string{file});
    return clipFormatOf(file) ||
           std::ranges::any_of(soundEndings, [&](auto ending) { return small.ends_with(ending); });
}

Result<LoadedClip> takeSound(RenderJob& options, std::string_view device, LoadedRender& job) {
    auto sound = loadWholeClip(options.scene);
    if (!sound) return sound;
    const auto count = static_cast<int>(sound.value.channels.size());
    const ContactRecording& first = sound.value.channels.front();
    if (!options.isGiven("--layout") && hasOneEach(sound.value)) {
        ActuatorLayout layout;
        options.layout = layoutFor(count, device);
        if (layoutPreset(options.layout, layout) && layout.count != count)
            return Failure{options.scene + ": " + channelsOf(sound.value) +
                           ": expected --layout with a file of as many actuators (Docs/render.md)"};
    }
    if (!options.isGiven("--seconds"))
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
