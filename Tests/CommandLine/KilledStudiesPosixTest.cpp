// SPDX-License-Identifier: GPL-3.0-or-later
// Every built-in study, killed (SIGKILL) in each of its phases: nothing that was answered is lost, settings
// that changed meanwhile are refused in words, and the file ends as that of a study that was never killed,
// byte by byte.
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/StudyRun.h"
#include "Support/Has.h"
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/wait.h>
#include <unistd.h>

namespace physvib::killed_studies_posix_test {

class KilledStudies : public ::testing::TestWithParam<std::size_t> {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "physvib-test-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        for (const char* name : {"whole", "killed"}) std::filesystem::create_directory(folder_ / name);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    StudyRun run(const std::string& name) const {
        return {builtInProtocols()[GetParam()], {"P01", 1, "person"}, folder_ / name};
    }
    static Apparatus usual() { return {"1.0", "JACK:system", -6.0, -30.0}; }

    /// The next answer, as a person gives it who felt it with that apparatus; false at the study's end.
    static bool takeOne(StudyInProgress& study, const SimulatedObserver& observer) {
        const Experiment& experiment = study.experiment();
        if (!experiment.isDone() && experiment.mayEnd()) study.endSession();
        if (experiment.isDone()) return false;
        Answer answer = observer.answer(experiment);
        answer.apparatus = usual();
        return study.acceptAnswer(std::move(answer));
    }
    /// After which numbers of trials another session or condition begins; then the number of all.
    std::vector<int> phasesOfTheWhole() const {
        const StudyRun whole = run("whole");
        StudyInProgress study{whole};
        const SimulatedObserver observer{{}, whole.protocol, whole.participant};
        std::vector<int> phases;
        int session = 0;
        while (!study.experiment().isDone()) {
            if (const int now = study.experiment().sessionNumber(); std::exchange(session, now) != now)
                phases.push_back(study.experiment().answeredTrials());
            if (!takeOne(study, observer)) break;
        }
        EXPECT_EQ(study.error(), "");
        phases.push_back(study.experiment().answeredTrials());
        return phases;
    }
    /// In a process of its own: goes on with the study until so many trials are taken, and is killed.
    void takeAndBeKilled(int trials) const {
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            const StudyRun killed = run("killed");
            StudyInProgress study{killed};
            const SimulatedObserver observer{{}, killed.protocol, killed.participant};
            if (!study.error().empty() || !study.apparatusError(usual()).empty()) _exit(3);
            while (study.experiment().answeredTrials() < trials)
                if (!takeOne(study, observer)) break;
            std::raise(SIGKILL);
        }
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
            << "after " << trials << " trials: " << status;
    }
    std::string bytes(const std::string& name) const {
        std::ifstream file{run(name).trialFile(), std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    void expectChangesRefused() const {
        const auto faultOf = [&](const auto& change) {
            Apparatus changed = usual();
            change(changed);
            const StudyInProgress study{run("killed")};
            EXPECT_EQ(study.error(), "");
            return study.apparatusError(changed);
        };
        EXPECT_EQ(faultOf([](Apparatus&) {}), "");
        EXPECT_EQ(faultOf([](Apparatus& a) { a.version = "2.0"; }), "") << "rows say which";
        EXPECT_TRUE(
            has(faultOf([](Apparatus& a) { a.device = "ALSA:other"; }),
                "expected the device as in the trials before, \"JACK:system\", found \"ALSA:other\""));
        EXPECT_TRUE(has(faultOf([](Apparatus& a) { a.masterDb = -18.0; }),
                        "expected the master level as in the trials before, -6 dB, found -18 dB"));
        EXPECT_TRUE(has(faultOf([](Apparatus& a) { a.noiseDb = -40.0; }),
                        "expected the pink noise as in the trials before, -30 dB, found -40 dB"));
        EXPECT_TRUE(has(faultOf([](Apparatus& a) { a.noiseDb.reset(); }), "found off"));
        StudyRun other = run("killed");
        other.protocol.exposureLimit = 1.0;
        EXPECT_TRUE(has(StudyInProgress{other}.error(), "was begun with another version of the protocol"));
        other = run("killed");
        other.participant.number = 2;
        EXPECT_TRUE(has(StudyInProgress{other}.error(), "expected trials of number 2, found 1"));
    }

    std::filesystem::path folder_;
};

TEST_P(KilledStudies, GoOnInEveryPhaseWithTheSameSettingsOnly) {
    const auto phases = phasesOfTheWhole();
    ASSERT_GE(phases.size(), 2u);
    takeAndBeKilled(0); // before anything was asked
    std::size_t kills = 1;
    for (std::size_t i = 0; i < phases.size(); ++i)
        for (const int trials : {phases[i], phases[i] + 1}) { // in the break between two, and within the next
            if (trials == 0 || trials > phases.back()) continue;
            takeAndBeKilled(trials);
            if (HasFatalFailure()) return;
            // the disk got no more of the next one
            if (++kills % 2 == 0)
                std::ofstream{run("killed").trialFile(), std::ios::app} << "P01,person,half a r";
            if (kills < 5) expectChangesRefused();
        }
    const StudyRun killed = run("killed");
    {
        StudyInProgress study{killed};
        EXPECT_EQ(study.error(), "");
        const SimulatedObserver observer{{}, killed.protocol, killed.participant};
        while (takeOne(study, observer)) {
        }
        EXPECT_TRUE(study.experiment().isDone());
    }
    EXPECT_EQ(bytes("killed"), bytes("whole")) << killed.protocol.name << " after " << kills << " kills";
    RecordProperty("kills", static_cast<int>(kills));
}

INSTANTIATE_TEST_SUITE_P(OfEveryStudy, KilledStudies, ::testing::Range(std::size_t{0}, std::size_t{8}),
                         [](const auto& info) {
                             std::string name = builtInProtocols()[info.param].name;
                             std::erase(name, '-');
                             return name;
                         });

} // namespace physvib::killed_studies_posix_test
