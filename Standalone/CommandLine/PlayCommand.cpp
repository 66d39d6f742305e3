// SPDX-License-Identifier: GPL-3.0-or-later
// Session, driver, device and recorder for the length of a call.
#include "CommandLine/PlayCommand.h"
#include "CommandLine/RenderJob.h"
#include "Files/AtomicFile.h"
#include "Host/AudioOutput.h"
#include "Host/PlayedRecorder.h"
#include "Host/SimulationDriver.h"
#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <iomanip>
#include <optional>

namespace physvib {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// "1,2,3" to {0, 1, 2}; false if it is anything else.
bool parseMap(const std::string& text, std::vector<int>& map) {
    for (const char *at = text.data(), *end = at + text.size(); at < end; ++at) {
        int output = 0;
        const auto [stop, error] = std::from_chars(at, end, output);
        if (error != std::errc{} || output < 1 || (stop != end && (*stop != ',' || stop + 1 == end))) return false;
        map.push_back(output - 1);
        at = stop;
    }
    return true;
}

std::unique_ptr<SimulationDriver> makeDriver(const std::string& name, Session& session, int stepsPerSecond) {
    if (name == "thread") return std::make_unique<ThreadDriver>(session, stepsPerSecond);
    return std::make_unique<MessageTimerDriver>(session);
}

SessionSetup setupOf(const PlayOptions& o, const RenderJob& job) {
    SessionSetup setup;
    setup.scene = *job.scene;
    const SceneRun run = job.run();
    setup.seed = run.seed;
    setup.stepsPerSecond = run.stepsPerSecond;
    setup.timing = run.timing;
    setup.location = run.location;
    setup.channels = job.channels();
    setup.panner = job.panner();
    setup.limiterEnabled = o.scene.limiter == "on";
    setup.longestGapSeconds = o.driver == "thread" ? driverThreadGapSeconds : messageTimerGapSeconds;
    return setup;
}

// What the message thread does while the session plays: empties the queues, keeps the device, ends the call.
class Watch final : private juce::Timer {
public:
    Watch(Session& session, AudioOutput& output, PlayedRecorder* recorder, double seconds)
        : session_{session}, output_{output}, recorder_{recorder}, endNs_{std::llround(seconds * 1e9)} {
        startTimer(20);
    }
    ~Watch() override { stopTimer(); }
    std::uint64_t played = 0;

private:
    void timerCallback() override {
        for (PlayedEvent e; session_.played().pop(e);) ++played;
        if (recorder_) recorder_->drain();
        if (++ticks_ % 50 == 0) report(output_.maintain());
        if (interrupted || session_.status().sessionNs >= endNs_) juce::MessageManager::getInstance()->stopDispatchLoop();
    }
    void report(const std::string& trouble) {
        if (!trouble.empty() && trouble != lastTrouble_) std::cerr << "physvib: " << trouble << '\n';
        lastTrouble_ = trouble;
    }

    Session& session_;
    AudioOutput& output_;
    PlayedRecorder* recorder_;
    std::int64_t endNs_;
    int ticks_ = 0;
    std::string lastTrouble_;
};

void summarise(Session& session, AudioOutput& output, std::uint64_t played) {
    const RenderStatus r = session.status().render;
    const AudioOutputStatus o = output.status();
    std::cout << std::fixed << std::setprecision(1) << "felt " << 1e3 * static_cast<double>(session.playOutFrames()) / output.sampleRateHz()
              << " ms after the contact; " << played << " collisions played, " << r.late << " late, " << session.drops() + r.untold
              << " dropped, " << r.rejected << " refused; " << static_cast<double>(session.slippedNs()) * 1e-6 << " ms of stalls; worst load "
              << 100 * o.worstLoad << " %, " << o.deviceXruns << " xruns of the device\n";
}

std::string play(const PlayOptions& o, const RenderJob& job, const AudioOutputSettings& settings) {
    const juce::ScopedJuceInitialiser_GUI juce; // the message loop
    Session session{setupOf(o, job)};
    std::unique_ptr<PlayedRecorder> recorder; // outlives the output, whose callback fills it
    AudioOutput output{session};
    if (auto error = output.open(settings); !error.empty()) return error;
    std::optional<AtomicFile> file;
    if (!o.recordPath.empty()) {
        file.emplace(o.recordPath);
        if (!file->error().empty()) return file->error();
        recorder = std::make_unique<PlayedRecorder>(file->temporaryPath().string(), job.channels(), output.sampleRateHz());
        output.record(recorder.get());
    }
    std::signal(SIGINT, interrupt);
    std::signal(SIGTERM, interrupt);
    std::uint64_t played = 0;
    {
        const auto driver = makeDriver(o.driver, session, o.scene.stepsPerSecond);
        Watch watch{session, output, recorder.get(), o.scene.seconds};
        juce::MessageManager::getInstance()->runDispatchLoop();
        played = watch.played;
    }
    summarise(session, output, played);
    if (recorder && !output.isRecording()) std::cerr << "physvib: warning: the recording ends where the device changed its rate\n";
    output.close();
    if (!recorder) return {};
    if (recorder->framesLost() > 0) std::cerr << "physvib: warning: frames missing in the recording: " << recorder->framesLost() << '\n';
    const std::string error = recorder->finish();
    return error.empty() ? file->commit() : error;
}

} // namespace

void declarePlayOptions(CLI::App& command, PlayOptions& o) {
    declareSceneOptions(command, o.scene);
    command.add_option("--device", o.device, "output device (see physvib devices)")->required();
    command.add_option("--map", o.map, "device outputs of the enchanters, from 1")->type_name("1,2,3,4");
    command.add_option("--driver", o.driver, "who steps the world: message or thread")->check(CLI::IsMember({"message", "thread"}))->capture_default_str();
    command.add_option("--level", o.levelDb, "master level in dB")->check(CLI::Range(-90.0, 0.0))->capture_default_str();
    command.add_option("--block", o.blockFrames, "frames per block; 0: as the device stands")->check(CLI::Range(0, limits::maxBlockFrames));
    command.add_option("--record", o.recordPath, "WAV of what was played, before the master level")->type_name("FILE.wav");
}

int runPlay(PlayOptions& o) {
    if (auto refusal = checkSceneOptions(o.scene); !refusal.empty()) return leave(exitUsage, refusal);
    RenderJob job{o.scene, {}, {}, {}};
    if (const int code = takeScene(job); code != exitDone) return code;
    if (o.driver == "thread" && o.scene.stepsPerSecond > 1000) return leave(exitUsage, "--driver thread: at most 1000 steps per second");
    auto layout = layoutNamed(o.scene.layout);
    if (!layout) return leave(exitFailed, layout.error);
    job.layout = std::move(layout.value);
    AudioOutputSettings settings{o.device, {}, 0, o.blockFrames, static_cast<float>(std::pow(10.0, o.levelDb / 20.0))};
    if (!parseMap(o.map, settings.channelMap)) return leave(exitUsage, "--map: expected outputs like 1,2,3,4, found \"" + o.map + "\"");
    const std::string error = play(o, job, settings);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

int runDevices() {
    const juce::ScopedJuceInitialiser_GUI juce;
    for (const auto& device : listAudioDevices()) std::cout << device.type << ':' << device.name << "  " << device.channels << " outputs\n";
    return exitDone;
}

} // namespace physvib
