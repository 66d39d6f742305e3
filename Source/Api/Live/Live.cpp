// SPDX-License-Identifier: GPL-3.0-or-later
// The message thread: JUCE's, and so the device's, from its beginning to its end.
#include "Api/Live/Live.h"
#include "Host/Devices/NoDevice.h"
#include "Host/Devices/SimulationDriver.h"
#include "Live/Session/SessionJournal.h"
#include <physvib/Version.h>
#include <utility>

namespace physvib::api {

// Empties what the session tells, keeps the device, ends the loop.
class Live::Watch final : private juce::Timer {
public:
    Watch(Live& live, SessionJournal* journal)
        : live_{live}
        , journal_{journal} {
        timerCallback();
        startTimer(milliseconds);
    }
    ~Watch() override {
        stopTimer();
        drain();
        if (journal_) journal_->end(live_.session_.status().sessionNs);
    }

private:
    static constexpr int milliseconds = 20;

    void timerCallback() override {
        drain();
        LiveStatus now{live_.output_->status(),
                       live_.session_.status().render,
                       live_.output_->sampleRateHz(),
                       live_.output_->blockFrames(),
                       {},
                       {}};
        for (const auto& sink : live_.settings_.sinks) now.sinks.push_back(sink->state());
        if (ticks_++ % (1000 / milliseconds) == 0) trouble_ = troubleNow();
        now.trouble = trouble_;
        const std::lock_guard lock{live_.statusMutex_};
        live_.status_ = std::move(now);
        if (live_.isEnding_) juce::MessageManager::getInstance()->stopDispatchLoop();
    }

    std::string troubleNow() {
        std::string trouble = live_.output_->maintain();
        for (const SinkState& sink : live_.session_.sinks().states())
            if (trouble.empty()) trouble = sink.trouble;
        return trouble;
    }

    void drain() {
        for (PlayedEvent event; live_.session_.played().pop(event);)
            live_.session_.sinks().played(event, live_.output_->sampleRateHz());
    }

    Live& live_;
    SessionJournal* journal_;
    int ticks_ = 0;
    std::string trouble_;
};

Live::Live(LiveSettings settings)
    : settings_{std::move(settings)}
    , session_{settings_.setup} {
    for (const auto& sink : settings_.sinks) session_.sinks().attach(*sink);
}

std::string Live::open() {
    std::promise<std::string> opened;
    auto told = opened.get_future();
    messages_ = std::thread{[this, opened = std::move(opened)]() mutable { run(std::move(opened)); }};
    return told.get();
}

std::string Live::end() {
    isEnding_ = true;
    if (messages_.joinable()) messages_.join();
    return unsaved_;
}

LiveStatus Live::status() const {
    const std::lock_guard lock{statusMutex_};
    return status_;
}

void Live::run(std::promise<std::string> opened) {
    const juce::ScopedJuceInitialiser_GUI juce;
    output_.emplace(session_, audioDeviceTypesAndNone);
    play(opened);
    output_.reset(); // before JUCE
}

void Live::play(std::promise<std::string>& opened) {
    std::string error = output_->open(settings_.output);
    std::optional<SessionJournal> journal;
    if (error.empty() && !settings_.savePath.empty()) {
        journal.emplace(settings_.savePath, session_, settings_.setup,
                        Provenance{PHYSVIB_VERSION, {{"session", settings_.savePath}}});
        error = journal->error();
    }
    const bool isOpen = error.empty();
    if (isOpen) {
        const Following together{session_.sinks(), *output_};
        const ThreadDriver driver{session_, settings_.setup.stepsPerSecond};
        const Watch watch{*this, journal ? &*journal : nullptr};
        opened.set_value({});
        juce::MessageManager::getInstance()->runDispatchLoop();
    } else {
        opened.set_value(std::move(error));
    }
    output_->stop();
    if (isOpen && journal) unsaved_ = journal->finish(); // before what may hang
    output_->close();
}

} // namespace physvib::api
