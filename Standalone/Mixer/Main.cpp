// SPDX-License-Identifier: GPL-3.0-or-later
// Main program of `physvib-mixer`: reads the command line, opens the window, and quits in order.
#include "Host/Devices/HostDrivers.h"
#include "Live/Devices/AudioDevice.h"
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Window/MixerWindow.h"
#include "Options/OptionTable.h"
#include "System/Process.h"
#include <iostream>

namespace physvib {

namespace {

constexpr int exitFailed = 1;
constexpr const char* usage =
    R"(physvib-mixer [SESSION.json | SCENE.json | LAYOUT.json] [--device TYPE:NAME] [--summary]
    --summary: at the end, what the last session played, late and dropped
physvib-mixer --study PROTOCOL [--participant CODE] [--number N] [--out FOLDER]
    opens the tab Studies with these, for a person who answers
physvib-mixer --help | --version
)";

/// The command-line argument after `option`; empty if there is none.
juce::String readOption(const juce::ArgumentList& arguments, juce::StringRef option) {
    const int index = arguments.indexOfOption(option);
    return index < 0 ? juce::String{} : arguments[index + 1].text;
}

StudySelection readStudyCall(const juce::ArgumentList& arguments) {
    return {readOption(arguments, "--study"), readOption(arguments, "--participant"),
            readOption(arguments, "--number").getIntValue(), readOption(arguments, "--out")};
}

/// The argument that is neither an option nor an option's value.
juce::File toFile(const juce::ArgumentList& arguments) {
    static const juce::StringArray valueOptions{"--device", "--study", "--participant", "--number", "--out"};
    juce::File file;
    for (int k = 0; k < arguments.size(); ++k)
        if (!arguments[k].isOption() && (k == 0 || !valueOptions.contains(arguments[k - 1].text)))
            file = juce::File::getCurrentWorkingDirectory().getChildFile(arguments[k].text);
    return file;
}

/// Handles options that need no window. Returns an exit code, or nullopt to open the window.
std::optional<int> runWithoutWindow(const juce::ArgumentList& arguments) {
    if (arguments.containsOption("--help|-h")) return std::cout << usage, 0;
    if (arguments.containsOption("--version")) return std::cout << "physvib-mixer " PHYSVIB_VERSION "\n", 0;
    if (const auto folder = readOption(arguments, referenceWord); folder.isNotEmpty()) {
        OptionTable program{"physvib-mixer", "see a world, feel it, and mix what each actuator plays"};
        addUsage(program, usage);
        const std::string error = writeReference(program, folder.toStdString());
        return error.empty() ? 0 : (std::cerr << "physvib-mixer: " << error << '\n', exitFailed);
    }
    return {};
}

void summarise(MixerModel& model) {
    const auto snapshot = model.poll();
    const auto& counts = snapshot.session.render;
    std::cout << "session of " << number(1e-9 * static_cast<double>(snapshot.session.sessionNs), 1)
              << " s: " << counts.played << " collisions rendered, " << counts.late << " late, "
              << model.session().world().drops() + counts.unsent << " dropped, "
              << number(1e-6 * static_cast<double>(model.session().world().stalledNs()), 0)
              << " ms of stalls; worst load " << number(100.0 * snapshot.device.worstLoad, 1) << " %"
              << std::endl;
}

// Application object. On a signal it quits in order without asking: a recording is completed, and the
// session's recovery copy stays.
class MixerApplication final : public juce::JUCEApplication, private juce::Timer {
public:
    const juce::String getApplicationName() override { return "PhysVib mixer"; }
    const juce::String getApplicationVersion() override { return PHYSVIB_VERSION; }
    bool moreThanOneInstanceAllowed() override { return true; }

    void initialise(const juce::String&) override {
        const juce::ArgumentList arguments{"physvib-mixer", getCommandLineParameterArray()};
        const auto device = readOption(arguments, "--device");
        printsSummary_ = arguments.containsOption("--summary");
        window_ = std::make_unique<MixerWindow>(withNullDevice(hostAudioDrivers), device, toFile(arguments));
        if (arguments.containsOption("--study")) window_->view().chooseStudy(readStudyCall(arguments));
        installInterruptHandlers();
        startTimer(signalCheckMs);
    }
    void shutdown() override {
        stopTimer();
        if (printsSummary_) summarise(window_->model());
        window_.reset();
    }
    void systemRequestedQuit() override { window_->requestQuit(); }

private:
    static constexpr int signalCheckMs = 200; // how often signals are checked

    void timerCallback() override {
        if (interrupted) quit();
    }

    std::unique_ptr<MixerWindow> window_;
    bool printsSummary_ = false;
};

juce::JUCEApplicationBase* makeApplication() { return new MixerApplication; }

} // namespace
} // namespace physvib

int main(int argc, char* argv[]) {
    physvib::beginProcess();
    {
        const juce::ArgumentList arguments{argc, argv};
        const juce::ScopedJuceInitialiser_GUI juce;
        if (const auto code = physvib::runWithoutWindow(arguments)) {
            const std::string error = physvib::outputError();
            if (error.empty() || *code != 0) return *code;
            return std::cerr << "physvib-mixer: " << error << '\n', physvib::exitFailed;
        }
    }
    juce::JUCEApplicationBase::createInstance = physvib::makeApplication;
    const int code = juce::JUCEApplicationBase::main(argc, const_cast<const char**>(argv));
    if (physvib::DeviceThread::abandonedThreads() > 0) physvib::exitImmediately(code);
    return code;
}
