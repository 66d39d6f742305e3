// SPDX-License-Identifier: GPL-3.0-or-later
// Session, driver, device, sinks, recorder, journal and listener for the length of a call.
#include "CommandLine/Play/LivePlay.h"
#include "CommandLine/Play/InputListener.h"
#include "CommandLine/Play/LiveBeats.h"
#include "CommandLine/Play/OscReport.h"
#include "CommandLine/Play/SoundPlay.h"
#include "CommandLine/Render/MarkWords.h"
#include "Host/Devices/NoDevice.h"
#include "Host/Devices/SimulationDriver.h"
#include "Host/Recordings/ClipFolder.h"
#include "Host/Recordings/PlayedRecorder.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/SessionJournal.h"
#include "System/ExitCode.h"
#include "System/Interrupt.h"
#include "System/Process.h"
#include "System/StandardStreams.h"
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

namespace physvib {

namespace {

// What the message thread does while the session plays: empties the queues, keeps device and journal, ends
// the call.
class Watch final : private juce::Timer {
public:
    Watch(Session& session, AudioOutput& output, PlayedRecorder* recorder, OscPort* osc,
          const InputListener* listener, double seconds)
        : session_{session}
        , output_{output}
        , recorder_{recorder}
        , osc_{osc}
        , listener_{listener}
        , endNs_{std::llround(seconds * 1e9)} {
        startTimer(milliseconds);
    }
    ~Watch() override { stopTimer(); }

    /// What has been played and not yet told; how many all in all.
    std::uint64_t drain() {
        for (PlayedEvent e; session_.played().pop(e); ++played_)
            session_.sinks().played(e, output_.sampleRateHz());
        return played_;
    }

private:
    static constexpr int milliseconds = 20;

    void timerCallback() override {
        drain();
        const SessionStatus status = session_.status();
        if (++ticks_ % (1000 / milliseconds) == 0) everySecond(status);
        const bool hasEnded = listener_ && listener_->hasEnded();
        if (interrupted || hasEnded || status.sessionNs >= endNs_ || isLeft())
            juce::MessageManager::getInstance()->stopDispatchLoop();
    }

    /// By the clock the time is over, and session time has stood still for long: no device asks for blocks.
    bool isLeft() const noexcept {
        constexpr int longestReturn = 10; // in seconds: of a server that was stopped, seven were measured
        return stillSeconds_ >= longestReturn && std::int64_t{ticks_} * milliseconds * 1'000'000 >= endNs_;
    }

    void everySecond(const SessionStatus& status) {
        stillSeconds_ = status.sessionNs == lastNs_ ? stillSeconds_ + 1 : 0;
        lastNs_ = status.sessionNs;
        std::string trouble = output_.maintain();
        for (const SinkState& sink : session_.sinks().states())
            if (trouble.empty()) trouble = sink.trouble;
        if (trouble.empty() && recorder_) trouble = recorder_->error();
        if (!interrupted) report(trouble); // else the device was not waited for
        if (osc_) oscReport_.tellWrong(osc_->status().counts);
        tellUnread();
        static const bool isTerminal = isErrorTerminal();
        if (isTerminal) show(status);
    }

    void show(const SessionStatus& status) {
        const AudioOutputStatus o = output_.status();
        const double rate = output_.sampleRateHz() / 1e3;
        const auto margin = status.leastMarginFrames == noMargin ? 0 : status.leastMarginFrames;
        char words[200];
        std::snprintf(words, sizeof words,
                      "\r%.0f s  load %.1f %% (worst %.1f)  L %.1f ms  margin %.1f ms  %d modes  %llu late  "
                      "%llu dropped%s   ",
                      static_cast<double>(status.sessionNs) * 1e-9, 100.0 * o.load, 100.0 * o.worstLoad,
                      static_cast<double>(session_.timeline().playOutFrames()) / rate,
                      static_cast<double>(margin) / rate, status.render.liveModes,
                      static_cast<unsigned long long>(status.render.late),
                      static_cast<unsigned long long>(session_.world().drops() + status.render.untold),
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

    Session& session_;
    AudioOutput& output_;
    PlayedRecorder* recorder_;
    OscPort* osc_;
    const InputListener* listener_;
    std::int64_t endNs_;
    OscReport oscReport_;
    std::uint64_t played_ = 0, unread_ = 0;
    int ticks_ = 0, stillSeconds_ = 0;
    std::int64_t lastNs_ = -1;
    std::string lastTrouble_;
};

void summarise(Session& session, AudioOutput& output, std::uint64_t played) {
    const SessionStatus status = session.status();
    const RenderStatus& r = status.render;
    const AudioOutputStatus o = output.status();
    const double framesPerMs = output.sampleRateHz() / 1e3;
    std::cout << std::fixed << std::setprecision(1) << "felt "
              << static_cast<double>(session.timeline().playOutFrames()) / framesPerMs
              << " ms after the contact; " << played << " collisions played, " << r.late << " late, "
              << session.world().drops() + r.untold << " dropped, " << r.rejected << " refused; "
              << static_cast<double>(session.world().slippedNs()) * 1e-6 << " ms of stalls; ";
    if (status.leastMarginFrames != noMargin)
        std::cout << "least margin " << static_cast<double>(status.leastMarginFrames) / framesPerMs
                  << " ms; ";
    std::cout << "worst load " << 100 * o.worstLoad << " %, "
              << (o.deviceXruns < 0 ? "xruns not counted by" : std::to_string(o.deviceXruns) + " xruns of")
              << " the device\n";
    if (session.timeline().toldAheadNs() > 0)
        std::cout << "messages were felt " << 1e3 * session.timeline().directSeconds()
                  << " ms after they came\n";
    if (session.rendered().marks()) std::cout << "marked: " << markWords(*session.rendered().marks()) << '\n';
    if (o.guarded > 0)
        std::cerr
            << "physvib: warning: actuators were turned down, as they would have got nearly direct current: "
            << o.guarded << " times\n";
    if (o.losses > 0)
        std::cerr << "physvib: warning: the device had to be opened again: " << o.losses << " times\n";
}

/// What each has done, on stdout; empty, or what is wrong with the first that does not play.
std::string summarise(const Sinks& sinks) {
    std::string trouble;
    for (const auto& sink : sinks) {
        std::cout << sink->summary([] { return !interrupted; });
        const SinkState state = sink->state();
        if (trouble.empty() && !state.isReady)
            trouble = state.trouble.empty() ? "the " + state.name + " is gone" : state.trouble;
    }
    return trouble;
}

std::unique_ptr<SimulationDriver> makeDriver(const LivePlay& wanted, Session& session) {
    if (wanted.ownThread)
        return std::make_unique<ThreadDriver>(session, wanted.setup.stepsPerSecond, &interrupted);
    return std::make_unique<MessageTimerDriver>(session, &interrupted);
}

} // namespace

std::string playLive(LivePlay wanted) {
    const juce::ScopedJuceInitialiser_GUI juce; // the message loop
    heedInterrupts();
    sayWithoutWaiting();
    Sinks sinks; // outlive the session
    const auto goesOn = [] { return !interrupted; };
    if (auto error = openSinks(wanted.sinks, wanted.setup.panner, goesOn, sinks); !error.empty())
        return error;
    wanted.setup.log = wanted.savePath.empty() ? LogUse::none : LogUse::stream;
    Session session{wanted.setup};
    for (const auto& sink : sinks) session.sinks().attach(*sink);
    std::optional<PlayedRecorder> recording; // outlives the output, whose callback fills it
    std::optional<SessionJournal> journal;
    const auto inputs = wanted.beats ? std::make_unique<InputTap>() : nullptr; // outlives the output as well
    AudioOutput output{session, audioDeviceTypesAndNone, &interrupted};
    wanted.output.tap = inputs.get();
    if (auto error = output.open(wanted.output); !error.empty()) return interrupted ? "" : error;
    if (!wanted.recordPath.empty()) {
        recording.emplace(wanted.recordPath, wanted.setup.channels, output.sampleRateHz());
        if (!recording->error().empty()) return recording->error();
        recording->tellBeginning(session.timeline().playOutFrames());
        session.sinks().attach(*recording);
    }
    if (!wanted.savePath.empty()) {
        const Provenance provenance{PHYSVIB_VERSION,
                                    {{"scene", wanted.setup.scene.name}, {"session", wanted.savePath}}};
        journal.emplace(wanted.savePath, session, wanted.setup, provenance);
        if (!journal->error().empty()) return journal->error();
    }
    std::uint64_t played = 0, beats = 0;
    std::optional<OscStatus> told;
    std::string saved, recorded; // each, whatever becomes of the other
    bool isWhole = true;
    MessageRouter messages{session};
    if (wanted.sound)
        if (auto error = beginSound(wanted, session, messages); !error.empty()) return error;
    {
        const Following together{session.sinks(), output};
        const auto driver = makeDriver(wanted, session);
        std::optional<LiveBeats> heard;
        if (wanted.beats) heard.emplace(session, *inputs, *wanted.beats, wanted.beatSensitivity);
        std::optional<InputListener> listener;
        const ClipFolder clips{wanted.clips};
        if (wanted.listens) listener.emplace(session, output, messages, clips, wanted.keepsPlaying);
        std::optional<OscPort> osc;
        if (wanted.osc.port || !wanted.osc.receiver.empty()) {
            osc.emplace(wanted.osc, session, messages, output,
                        OscHooks{[&](const LineInput& input, const OscOrigin&) {
                                     return actOn(input, session, output, SilenceHolder::osc);
                                 },
                                 {},
                                 clips});
            if (!osc->error().empty()) return "OSC: " + osc->error();
            if (osc->port() != 0) tellPort(wanted.osc, osc->status().address);
        }
        {
            Watch watch{session,
                        output,
                        recording ? &*recording : nullptr,
                        osc ? &*osc : nullptr,
                        listener ? &*listener : nullptr,
                        wanted.seconds};
            juce::MessageManager::getInstance()->runDispatchLoop();
            isWhole = !recording || recording->isWhole();
            output.stop();
            played = watch.drain();
        }
        // rows that wait, then what may take long or hang
        if (journal) journal->end(session.status().sessionNs);
        if (recording) recorded = recording->finish();
        listener.reset();
        if (osc) told = osc->status();
        osc.reset(); // whoever goes on sending does not hold up the end
        if (journal) saved = interrupted ? journal->finish(SessionJournal::quickBytes) : journal->finish();
        if (!isWhole) std::cerr << "physvib: warning: the recording ends where the device changed its rate\n";
        beats = heard ? heard->beats() : 0;
        if (told) summariseOsc(*told);
    }
    summarise(session, output, played);
    if (inputs) std::cout << beats << " beats heard\n";
    if (inputs && inputs->piecesLost() > 0)
        std::cerr << "physvib: warning: sound was lost on its way to the beats: " << inputs->piecesLost()
                  << " times\n";
    if (recording && recording->framesLost() > 0)
        std::cerr << "physvib: warning: frames missing in the recording: " << recording->framesLost() << '\n';
    const std::string trouble = summarise(sinks);
    if (recording && recording->beginsSeconds())
        std::cout << wanted.recordPath << "  begins at session time "
                  << fixedNumber(*recording->beginsSeconds(), 6) << " s\n";
    output.close();
    return !saved.empty() ? saved : !recorded.empty() ? recorded : trouble;
}

} // namespace physvib
