// SPDX-License-Identifier: GPL-3.0-or-later
// A device fails, or somebody silences it, at 20 moments of a trial, in six ways, in four kinds of tasks:
// rows, samples that the device got and report agree, and nothing that waited is felt later. What the test
// asserts holds however slow the machine is: a pause of the test is one more pause of the device. The ways
// take turns over the moments; with PHYSVIB_FAULT=0..5 it is that one at all of them (every-fault.sh).
#include "Host/FakeAudioDevice.h"
#include "Live/Devices/AudioDevice.h"
#include "Participant.h"
#include <cmath>
#include <cstdlib>

namespace physvib::device_faults_test {

constexpr double levelG = 0.2, seconds = 0.05;

enum class Fault { kill, stop, unplug, period, rate, silence };
constexpr Fault faults[] = {Fault::kill,   Fault::stop, Fault::unplug,
                            Fault::period, Fault::rate, Fault::silence};
constexpr const char* faultNames[] = {"kill", "stop", "unplug", "period", "rate", "silence"};

/// What left in one piece.
struct Burst {
    double peak = 0.0, seconds = 0.0;
};

struct Task {
    const char* name;
    const char* session;
    const char* stimuli;
    std::vector<double> peaks; ///< of the parts; empty: not planned
    std::function<void(test::Participant&)> answer;
};

void press(test::Participant& p, int code, juce::juce_wchar character) {
    p.screen()->keyPressed(juce::KeyPress{code, {}, character});
}

const std::vector<Task>& tasks() {
    static const char* tone =
        R"("layout": "phone1", "level_g": 0.2, "stimuli": "grid", "columns": 1, "rows": 1, "seconds": 0.05)";
    const auto choose = [](test::Participant& p) { press(p, '1', '1'); };
    static const std::vector<Task> all{
        {"a number",
         R"({"name": "main", "task": "estimate", "repetitions": 20})",
         tone,
         {levelG},
         [](test::Participant& p) { p.write("Number", "7"); }},
        {"a pair by one press",
         R"({"name": "main", "task": "choose", "repetitions": 20, "interval_s": 0.01, "order": "given", "alternatives": [{"name": "a"}, {"name": "b", "level_db": -6}]})",
         tone,
         {levelG, 0.5 * levelG},
         choose},
        {"a staircase, one by one",
         R"({"name": "main", "task": "choose", "alternatives": [{"name": "a"}, {"name": "b"}], "staircase": {"alternative": "b", "start_db": 6, "most_db": 8, "reversals": 40, "most_trials": 20, "down": 1}})",
         tone,
         {},
         choose},
        {"a fall that is seen",
         R"({"name": "main", "task": "choose", "repetitions": 20, "alternatives": [{"name": "AV-FV-DRV"}, {"name": "AV-FF-DRV"}]})",
         R"("layout": "phone1", "stimuli": "world", "call": "render drop --set falls=once --seconds 1.2 --layout phone1 --level-db -12 --method {alternative}")",
         {},
         choose},
    };
    return all;
}

class DeviceFaults : public test::StudyTest, public testing::WithParamInterface<int> {
protected:
    DeviceFaults() {
        hands.isReal = true;
        hands.outputs = 2;
        p = std::make_unique<test::Participant>(withNullDevice(test::fakeDrivers({&hands})), "Fake:hands");
        p->model.change("Level", [](Mix& mix) { mix.levelDb = 0.0; });
        p->model.change("One", [](Mix& mix) {
            mix.layout = presetLayout("phone1");
            mix.resizeStrips();
            mix.strips[0].output = 0;
        });
        run(64);
    }

    /// The device asks for so many blocks, and the window looks between them.
    void run(int blocks) {
        for (int b = 0; b < blocks; ++b) {
            if (isPaced) // as fast as a device, at most
                juce::Thread::sleep(
                    std::max(0, static_cast<int>(dueMs_ - juce::Time::getMillisecondCounterHiRes())));
            dueMs_ =
                std::max(dueMs_, juce::Time::getMillisecondCounterHiRes()) + 1e3 * hands.block / hands.rate;
            isWhole = isWhole && p->model.output().isPlaying();
            const auto out = hands.play(hands.block);
            if (!out.empty()) take(out[0]);
            if (b % 4 == 0) p->view.refresh();
        }
        p->view.refresh();
        while (juce::dispatchNextMessageOnSystemQueue(true)) {
        }
    }
    void take(const std::vector<float>& samples) {
        for (const float sample : samples) {
            const double size = std::abs(static_cast<double>(sample));
            silent_ = size > 1e-6 ? 0 : silent_ + 1;
            if (silent_ > hands.rate / 200) isOn_ = false;
            if (silent_ == 0 && !std::exchange(isOn_, true)) bursts.push_back({});
            if (!isOn_) continue;
            bursts.back().peak = std::max(bursts.back().peak, size);
            if (silent_ == 0) bursts.back().seconds += 1.0 / hands.rate;
        }
    }
    void cut() { isOn_ = false, silent_ = 0; }

    void fail(Fault fault) {
        using namespace std::chrono_literals;
        auto& output = p->model.output();
        const auto now = AudioOutput::Clock::now();
        switch (fault) {
        case Fault::kill:
            hands.unplug(true);
            p->view.refresh();
            hands.isPlugged = true;
            output.maintain(now);
            break;
        case Fault::stop:
            juce::Thread::sleep(130);
            p->view.refresh();
            break;
        case Fault::unplug:
            hands.unplug(false);
            for (const auto later : {0s, 1s, 2s, 4s}) output.maintain(now + later);
            p->view.refresh();
            hands.isPlugged = true;
            output.maintain(now + 5s);
            break;
        case Fault::period:
            hands.block = hands.block == 64 ? 256 : 64;
            output.maintain(now);
            break;
        case Fault::rate:
            hands.rate = hands.rate == 48000 ? 44100 : 48000;
            output.maintain(now);
            break;
        case Fault::silence:
            p->model.setSilent(true);
            run(16);
            p->model.setSilent(false);
            break;
        }
        if (fault != Fault::period) cut(); // which goes on
    }

    test::FakeInterface hands;
    std::unique_ptr<test::Participant> p;
    std::vector<Burst> bursts;
    bool isPaced = false, isWhole = true; ///< isWhole: the test has not paused

private:
    double dueMs_ = 0.0;
    bool isOn_ = false;
    int silent_ = 0;
};

TEST_P(DeviceFaults, AtAnyMomentRowsSamplesAndReportAgree) {
    const Task& task = tasks()[static_cast<std::size_t>(GetParam())];
    SCOPED_TRACE(task.name);
    ASSERT_EQ(choose(*p, test::shortProtocol(task.stimuli, task.session)), "");
    std::string fault = "not begun";
    for (int tries = 0; !fault.empty() && tries < 100; ++tries)
        run(2), fault = p->tab().begin(); // after a pause
    ASSERT_EQ(fault, "");
    run(4);
    press(*p, juce::KeyPress::returnKey, '\r');
    const int trials = 20;
    const char* const only = std::getenv("PHYSVIB_FAULT");
    const bool isWorld = GetParam() == 3 && only == nullptr; // falls behind a device faster than time: rows
    isPaced = GetParam() == 3 && !isWorld;
    const bool isPeriod = only != nullptr && faults[std::atoi(only)] == Fault::period; // all samples leave
    int again = 0, left = 0, parted = 0;
    double loudest = 0.0, farthest = 0.0; // of what left; of a row's level from the samples
    for (int n = 0; n < trials; ++n) {
        SCOPED_TRACE(n);
        ASSERT_EQ(p->screen()->page(), StudyScreen::Page::trial);
        ASSERT_EQ(p->experiment().answeredTrials(), n);
        const Trial trial = p->experiment().trial();
        const std::size_t parts = std::max<std::size_t>(1, trial.parts.size());
        bursts.clear();
        isWhole = true;
        const int starts = hands.timesStarted;
        // 64 frames each, after the press: within and after
        const int moment = 1 + n * (isPaced ? 48 : task.peaks.size() > 1 ? 12 : 6);
        bool hasFailed = false;
        int blocks = 0, played = 0; // in all, and since the first press that was heard
        for (bool isOpen = false; !isOpen && blocks < 80'000; ++blocks) {
            run(1);
            ASSERT_EQ(p->screen()->page(), StudyScreen::Page::trial) << p->words();
            if (p->screen()->plays() > 0) played += hands.block / 64;
            if (!hasFailed && played >= moment)
                hasFailed = true, fail(faults[only != nullptr ? std::atoi(only) : n % 6]);
            const bool isStimulusPlaying = p->screen()->isStimulusPlaying();
            const bool isFree = task.peaks.size() != 2 || p->find("Feel number 1")->isEnabled(); // no
                                                                                                 // sequence
            isOpen = hasFailed && p->screen()->answers()->isEnabled() && !isStimulusPlaying;
            if (!isOpen && isFree && !isStimulusPlaying && (hasFailed || played == 0 || played < moment))
                press(*p, juce::KeyPress::spaceKey, ' ');
        }
        ASSERT_LT(blocks, 80'000);
        for (const Burst& burst : bursts) {
            EXPECT_LT(burst.peak, 0.6) << "nothing is heaped up";
            loudest = std::max(loudest, burst.peak);
        }
        ASSERT_FALSE(bursts.empty() && !isWorld);
        if (task.peaks.size() == 1) EXPECT_NEAR(bursts.back().peak, task.peaks[0], 0.02);
        if (!task.peaks.empty()) EXPECT_NEAR(bursts.back().seconds, seconds, 0.1 * seconds);
        for (int tries = 0; tries < 200 && !p->experiment().isDone() && p->experiment().answeredTrials() == n;
             ++tries) {
            task.answer(*p);
            run(2);
            press(*p, juce::KeyPress::returnKey, '\r');
            run(2);
        }
        ASSERT_EQ(p->experiment().answeredTrials(), n + 1);
        const auto table = rows();
        const auto cell = [&](const char* name) { return table.rows.back().cells[*table.column(name)]; };
        ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(n + 1));
        EXPECT_EQ(cell("left"), "1");
        left += cell("left") == "1";
        again += std::stoi(cell("again"));
        if (isPeriod && isWhole && hands.timesStarted == starts)
            EXPECT_EQ(cell("again"), "0") << "all samples left";
        std::istringstream peaks{cell("peak_g")};
        std::size_t part = 0;
        for (std::string peak; std::getline(peaks, peak, '|'); ++part) {
            if (isWorld) continue;
            EXPECT_GT(std::stod(peak), 0.0);
            double apart = 1.0;
            for (const Burst& burst : bursts) apart = std::min(apart, std::abs(burst.peak - std::stod(peak)));
            EXPECT_LT(apart, 0.005) << "the row's " << peak << " g was not recorded";
            farthest = std::max(farthest, apart);
            ++parted;
            const bool isSoft =
                part < trial.parts.size() && trial.parts[part] == "b" && task.peaks.size() == 2;
            if (!task.peaks.empty()) EXPECT_NEAR(std::stod(peak), task.peaks[isSoft ? 1 : 0], 0.02);
        }
        EXPECT_EQ(part, parts);
    }
    if (!isPeriod) EXPECT_GT(again, 0) << "some of the faults were within a part";
    EXPECT_EQ(p->screen()->page(), StudyScreen::Page::done);
    call("report short-P01.csv --out r --protocol short.json >/dev/null 2>&1 "
         "&& grep -q '^.\\?Fake:hands.*,20,20,' r/apparatus.csv");
    if (only != nullptr)
        std::printf("| %s | %s | %d of %d | %d | %.3f | %.4f of %d | %s |\n", task.name,
                    faultNames[std::atoi(only)], left, trials, again, loudest, farthest, parted,
                    !HasFailure() ? "yes" : "NO");
}

INSTANTIATE_TEST_SUITE_P(Tasks, DeviceFaults, testing::Range(0, 4));

TEST_F(DeviceFaults, NothingBeginsWithoutAnOutputForEachActuator) {
    ASSERT_EQ(choose(*p, test::shortProtocol(R"("layout": "phone4", "stimuli": "patterns", "enchanters": 4)",
                                             R"({"name": "main", "task": "identify"})")),
              "");
    EXPECT_EQ(p->tab().begin(), "phone4 needs 4 actuators, the mixer has 1: choose a preset under Actuators");
    p->model.change("Four", [](Mix& mix) {
        mix.layout = presetLayout("phone4");
        mix.resizeStrips();
        for (std::size_t j = 0; j < 4; ++j) mix.strips[j].output = j < 2 ? static_cast<int>(j) : -1;
    });
    run(8);
    EXPECT_EQ(p->tab().begin(), "2 of 4 actuators have no output: C, D");
    EXPECT_EQ(p->screen(), nullptr);
    EXPECT_FALSE(folder.getChildFile("short-P01.csv").exists());
}

} // namespace physvib::device_faults_test
