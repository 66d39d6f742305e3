// SPDX-License-Identifier: MIT
// What counts is on the disk: every fsync of this program is seen here, with what stood at the file's place
// at that moment.
#include "Io/Disk/AtomicFile.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/StudyRun.h"
#include "Support/FailingDisk.h"
#include <sys/stat.h>

namespace physvib::sync_posix_test {

namespace fs = std::filesystem;

class SyncTest : public FolderTest {
protected:
    void TearDown() override {
        test::syncWatcher = nullptr;
        FolderTest::TearDown();
    }
    /// From now on: "folder" or "N bytes", and what `path` was then.
    void watch(const fs::path& path) {
        test::syncWatcher = [this, path](int descriptor) {
            struct stat synced {
            }, there{};
            EXPECT_EQ(fstat(descriptor, &synced), 0);
            const bool isThere = stat(path.c_str(), &there) == 0, isFolder = S_ISDIR(synced.st_mode);
            if (isFolder) EXPECT_TRUE(fs::equivalent(folder, path.parent_path()));
            seen.push_back((isFolder ? std::string{"folder"} : std::to_string(synced.st_size) + " bytes") +
                           ", there " + (isThere ? std::to_string(there.st_size) : "nothing"));
            return 0;
        };
    }
    std::vector<std::string> seen;
};

TEST_F(SyncTest, AFileIsOnTheDiskBeforeItHasItsNameAndThenTheNameIs) {
    watch(folder / "out.csv");
    EXPECT_EQ(writeFile(folder / "out.csv", "four"), "");
    EXPECT_EQ(seen, (std::vector<std::string>{"4 bytes, there nothing", "folder, there 4"}));
    seen.clear();
    EXPECT_EQ(writeFile(folder / "out.csv", "eight..."), "");
    EXPECT_EQ(seen, (std::vector<std::string>{"8 bytes, there 4", "folder, there 8"}));
}

TEST_F(SyncTest, WhatCannotReachTheDiskDoesNotGetItsName) {
    put(folder / "out.csv", "old");
    test::syncWatcher = [](int) { return errno = EIO, -1; };
    EXPECT_EQ(writeFile(folder / "out.csv", "new"),
              (folder / "out.csv").string() + ": cannot be written: Input/output error");
    EXPECT_EQ(contentOf(folder / "out.csv"), "old");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(SyncTest, ATrialsRowIsOnTheDiskBeforeItCounts) {
    const Protocol protocol = findProtocol("magnitudes").value;
    const Participant participant{"P01", 1};
    const fs::path path = folder / "magnitudes-P01.csv";
    watch(path);
    TrialLogFile log{path, protocol, participant, "1"};
    ASSERT_EQ(log.error(), "");
    const auto head = std::to_string(fs::file_size(path));
    EXPECT_EQ(seen, (std::vector{head + " bytes, there " + head, "folder, there " + head}));
    Experiment experiment{protocol, participant};
    const SimulatedObserver observer{*observerNamed("simulated"), protocol, participant};
    for (int i = 0; i < 3; ++i) {
        seen.clear();
        EXPECT_TRUE(log.append(experiment.acceptAnswer(observer.answer(experiment))));
        const auto size = std::to_string(fs::file_size(path));
        EXPECT_EQ(seen, (std::vector{size + " bytes, there " + size}));
    }
    seen.clear();
    TrialLogFile simulated{folder / "magnitudes-P02.csv", protocol, {"P02", 1, "simulated"}, "1"};
    seen.clear();
    Experiment again{protocol, {"P02", 1, "simulated"}};
    EXPECT_TRUE(simulated.append(again.acceptAnswer(observer.answer(again))));
    EXPECT_TRUE(seen.empty()) << "who answers the same again";
    EXPECT_TRUE(simulated.sync());
    EXPECT_EQ(seen.size(), 1u);
    test::syncWatcher = [](int) { return errno = EIO, -1; };
    EXPECT_FALSE(log.append(experiment.acceptAnswer(observer.answer(experiment))));
    EXPECT_EQ(log.error(), path.string() + ": cannot be written: Input/output error");
}

class FailingStudies : public FolderTest {};

TEST_F(FailingStudies, AreToldByTheFileOfTimesAndTheComment) {
    const StudyRun run{findProtocol("magnitudes").value, {"P01", 1}, folder};
    const auto prepare = [&] { ASSERT_EQ(StudyInProgress{run}.logStart({}), ""); };
    const auto afterwards = [&](auto act) {
        return [&run, act] {
            StudyInProgress study{run};
            return study.error().empty() ? act(study) : study.error();
        };
    };
    // moments differ: the files are not the same from run to run
    test::expectToldByEachFault(
        folder, prepare,
        afterwards([](StudyInProgress& study) { return study.logEvent(studyEvents::breakStart); }), true);
    test::expectToldByEachFault(
        folder, prepare, afterwards([](StudyInProgress& study) { return study.saveComment("words"); }), true);
}

TEST_F(FailingStudies, AreToldByATrialAndKeepThoseBefore) {
    const StudyRun run{findProtocol("magnitudes").value, {"P01", 1}, folder};
    const SimulatedObserver observer{*observerNamed("simulated"), run.protocol, run.participant};
    test::expectToldByEachFault(
        folder,
        [&] {
            StudyInProgress study{run};
            ASSERT_TRUE(study.acceptAnswer(observer.answer(study.experiment())));
        },
        [&] {
            std::string error;
            {
                StudyInProgress study{run};
                if (study.error().empty()) study.acceptAnswer(observer.answer(study.experiment()));
                error = study.error();
            }
            test::disk.call = {};
            EXPECT_GE(StudyInProgress{run}.resumedTrials(), 1);
            return error;
        },
        true);
}

/// Rows of who is simulated are not each on the disk, but the end is.
TEST_F(FailingStudies, AreToldAtTheEndOfASimulatedOne) {
    const StudyRun run{findProtocol("magnitudes").value, {"P01", 1, "simulated"}, folder};
    const SimulatedObserver observer{*observerNamed("simulated"), run.protocol, run.participant};
    StudyInProgress study{run};
    test::syncWatcher = [](int) { return errno = EIO, -1; };
    bool isTaken = true;
    while (isTaken && !study.experiment().isDone()) {
        isTaken = study.acceptAnswer(observer.answer(study.experiment()));
        EXPECT_EQ(isTaken, !study.experiment().isDone());
    }
    test::syncWatcher = nullptr;
    EXPECT_NE(study.error(), "");
}

} // namespace physvib::sync_posix_test
