// SPDX-License-Identifier: MIT
// What a session keeps while it plays, on a disk that fails: nothing is told as saved that is not, and the
// list of a session is in time order whatever order its events came in.
#include "FakeHost.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Session/SessionJournal.h"
#include "Scene/EventsCsv.h"
#include "Support/FailingDisk.h"
#include <optional>

namespace physvib::failing_disk_posix_test {

using namespace test;

class FailingDisks : public FolderTest {
protected:
    /// A session that has played for a tenth of a second, and its journal, whose thread has ended.
    struct Kept {
        SessionSetup setup = shakeTheBoxSetup(0.02);
        std::optional<Session> session;
        std::optional<SessionJournal> journal;

        explicit Kept(const std::filesystem::path& path, const std::vector<CollisionEvent>& played = {}) {
            setup.log = LogUse::stream;
            session.emplace(setup);
            session->prepare(hostRate, 480);
            journal.emplace(path, *session, setup, Provenance{});
            Block block;
            for (int i = 0; i < 10; ++i) {
                session->advance();
                session->render(block.at.data(), 480, RenderMode::realtime);
            }
            for (const CollisionEvent& event : played) journal->onPlayed({event, 0, false}, hostRate);
            if (journal->error().empty()) journal->end(session->status().sessionNs);
        }
    };
};

TEST_F(FailingDisks, AreToldWhenAJournalBegins) {
    for (const bool isThere : {false, true})
        expectToldByEachFault(
            folder,
            [&] {
                if (!isThere) return;
                put(folder / "a.json", "{}");
                put(folder / "a.events.csv", "old");
            },
            [&] {
                SessionSetup setup = shakeTheBoxSetup(0.02);
                setup.log = LogUse::stream;
                Session session{setup};
                session.prepare(hostRate, 480);
                const SessionJournal journal{folder / "a.json", session, setup, {}};
                disk.call = {}; // what follows is another matter
                return journal.error().empty() ? journal.currentError() : journal.error();
            },
            true);
}

TEST_F(FailingDisks, AreToldWhenAJournalBecomesASession) {
    std::optional<Kept> kept;
    expectToldByEachFault(
        folder,
        [&] {
            kept.reset();
            kept.emplace(folder / "a.json");
            ASSERT_EQ(kept->journal->error(), "");
        },
        [&] { return kept->journal->finish(); });
    kept.reset();
}

TEST_F(FailingDisks, AreToldByAFileThatGrows) {
    GrowingFile file;
    expectToldByEachFault(
        folder,
        [&] {
            file = {};
            put(folder / "a.log", "head\n");
            file.open(folder / "a.log");
        },
        [&] {
            std::string error;
            const auto note = [&] {
                if (error.empty()) error = file.error();
            };
            file.append("one\n"), note();
            file.append("two\n"), note();
            file.sync(), note();
            return error;
        },
        true);
}

TEST_F(FailingDisks, ThatRecoverLoseNoLine) {
    for (int nth = 1; nth <= 3; ++nth) {
        put(folder / "a.log", "0\n");
        GrowingFile file;
        file.open(folder / "a.log");
        for (int i = 1; i <= 3; ++i) {
            disk = {"write", i == nth ? 1 : 99};
            file.append(std::to_string(i) + "\n");
            EXPECT_EQ(file.error().empty(), i != nth);
            disk = {};
        }
        file.append("");
        EXPECT_TRUE(file.sync());
        EXPECT_EQ(contentOf(folder / "a.log"), "0\n1\n2\n3\n") << nth;
    }
}

TEST_F(FailingDisks, ThatRecoverGetAllThatCouldWait) {
    const std::string half(GrowingFile::maxPendingBytes / 2 + 1, 'a');
    const std::string whole = half + half;
    for (const int failures : {0, 1, 2}) {
        put(folder / "a.log", "");
        GrowingFile file;
        file.open(folder / "a.log");
        if (failures == 0) file.append(whole);
        for (int i = 0; i < 2 && failures > 0; ++i) {
            disk = {"write", i < failures ? 1 : 99};
            file.append(half);
            disk = {};
        }
        const std::string why = failures < 2 ? ""
                                             : (folder / "a.log").string() +
                                                   ": cannot be written: No space left on device; too much "
                                                   "would have to wait, so it ends here";
        EXPECT_EQ(file.error(), why) << failures;
        file.append("b");
        EXPECT_EQ(file.error(), why) << failures;
        EXPECT_EQ(std::filesystem::file_size(folder / "a.log"), failures < 2 ? whole.size() + 1 : 0U)
            << failures;
    }
}

TEST_F(FailingDisks, AListKeepsWhatOnlyItsLaterEventsHave) {
    CollisionEvent plain{.timeNs = 1, .frequencyHz = 200, .decayPerSecond = 30, .amplitude = 0.5};
    CollisionEvent grain = plain;
    grain.source.kind = ContactKind::roll;
    grain.source.part = 7;
    grain.sound = 9;
    grain.z = 0.25;
    Kept kept{folder / "a.json", {plain, grain}};
    ASSERT_EQ(kept.journal->finish(), "");
    EXPECT_EQ(readEventsCsv(contentOf(folder / "a.events.csv"), "events").value.events,
              (std::vector{plain, grain}));
}

TEST_F(FailingDisks, AListOfEventsThatCameInAnyOrderIsReadAgainWhole) {
    for (const std::vector<std::int64_t>& times : {std::vector<std::int64_t>{0, 1, 2},
                                                   {5'000'000, 4'999'999, 6'000'000},
                                                   {3, 2, 1, 0},
                                                   {0, 9, 0, 9, 8, 9}}) {
        std::vector<CollisionEvent> events;
        for (const std::int64_t time : times) {
            CollisionEvent event{.timeNs = time, .frequencyHz = 200, .decayPerSecond = 30, .amplitude = 0.5};
            event.x = static_cast<double>(events.size());
            events.push_back(event);
        }
        Kept kept{folder / "a.json", events};
        ASSERT_EQ(kept.journal->finish(), "");
        const auto read = readEventsCsv(contentOf(folder / "a.events.csv"), "events");
        ASSERT_EQ(read.error, "");
        ASSERT_EQ(read.value.events.size(), events.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            EXPECT_EQ(read.value.events[i].x, events[i].x) << "in the order in which they were felt";
            EXPECT_GE(read.value.events[i].timeNs, events[i].timeNs);
        }
    }
}

} // namespace physvib::failing_disk_posix_test
