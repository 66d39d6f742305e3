// SPDX-License-Identifier: GPL-3.0-or-later
// Session, driver, device and recorder for the length of a call.
#include "CommandLine/PlayCommand.h"
#include "CommandLine/NumberList.h"
#include "CommandLine/RenderJob.h"
#include "Files/AtomicFile.h"
#include "Host/AudioOutput.h"
#include "Host/PlayedRecorder.h"
#include "Host/SimulationDriver.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <iomanip>
#include <optional>

namespace physvib {

namespace {

constexpr double lowestCeilingDecibels = -60.0; // lower is a mute by another name

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// "1,2,3" to {0, 1, 2}; empty means an empty map. False if it is anything else.
bool parseMap(const std::string& text, std::vector<int>& map) {
    if (text.empty()) return true;
    if (!parseNumbers(text, map) || *std::min_element(map.begin(), map.end()) < 1) return false;
    for (int& output : map) --output;
    return true;
}

float gainOf(double decibels) { return static_cast<float>(std::pow(10.0, decibels / 20.0)); }

/// "-6" for all channels, or "-6,-12,-6,-6", one each; false if it is anything else.
bool parseCeilings(const std::string& text, int channels, std::array<float, limits::maxEnchanters>& ceilings) {
    std::vector<double> decibels;
    if (!parseNumbers(text, decibels)) return false;
    if (decibels.size() == 1) decibels.resize(static_cast<std::size_t>(channels), decibels[0]);
    const auto isCeiling = [](double dB) { return dB >= lowestCeilingDecibels && dB <= 0.0; };
    if (decibels.size() != static_cast<std::size_t>(channels) || !std::all_of(decibels.begin(), decibels.end(), isCeiling)) return false;
    std::transform(decibels.begin(), decibels.end(), ceilings.begin(), gainOf);
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
    if (o.losses > 0) std::cerr << "physvib: warning: the device had to be opened again: " << o.losses << " times\n";
}

std::string play(const PlayOptions& o, const RenderJob& job, const SessionSetup& setup, const AudioOutputSettings& settings) {
    const juce::ScopedJuceInitialiser_GUI juce; // the message loop
    Session session{setup};
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
    command.add_option("--ceiling", o.ceilings, "drive ceiling in dB of full scale, before the master level: one for all, or one per enchanter")
        ->type_name("DB[,DB...]")->capture_default_str();
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
    AudioOutputSettings settings{o.device, {}, 0, o.blockFrames, gainOf(o.levelDb)};
    if (!parseMap(o.map, settings.channelMap)) return leave(exitUsage, "--map: expected outputs like 1,2,3,4, found \"" + o.map + "\"");
    SessionSetup setup = setupOf(o, job);
    if (!parseCeilings(o.ceilings, setup.channels, setup.ceilings))
        return leave(exitUsage, "--ceiling: expected one number of dB from -60 to 0, or one per enchanter (" + std::to_string(setup.channels) + "), found \"" +
                                    o.ceilings + "\"");
    const std::string error = play(o, job, setup, settings);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

int runDevices() {
    const juce::ScopedJuceInitialiser_GUI juce;
    for (const auto& device : listAudioDevices()) std::cout << device.type << ':' << device.name << "  " << device.channels << " outputs\n";
    return exitDone;
}

} // namespace physvib
