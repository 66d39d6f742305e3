// SPDX-License-Identifier: MIT
// What `play --save` leaves, whatever disk and targets do.
#include "Live/Session/SessionJournal.h"
#include "FakeHost.h"
#include "Io/Disk/ReadFile.h"
#include "Live/Documents/SessionFile.h"
#include "Support/FileTesting.h"
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace physvib::session_journal_test {

using namespace test;

class SessionJournals : public FolderTest {
protected:
    void SetUp() override {
        FolderTest::SetUp();
        setup = shakeTheBoxSetup(0.02);
        setup.log = LogUse::stream;
    }
    std::string text(const char* name) const { return readFile(folder / name, 100'000'000).value; }

    /// Plays on with an input per block, and gives what is played to the journal.
    void play(Session& session, SessionJournal& journal, int blocks) {
        session.advance();
        for (int i = 0; i < blocks; ++i, ++inputs) {
            EXPECT_EQ(session.submit({TiltAction{0.001 * (inputs % 1000)}}).error, "");
            session.render(block.at.data(), 480, RenderMode::realtime);
            session.advance();
            for (PlayedEvent e; session.played().pop(e); ++events)
                journal.onPlayed(e, session.timeline().sampleRateHz());
        }
    }
    std::size_t rows() const {
        const auto read = readEventsCsv(text("monday.events.csv"), "events");
        EXPECT_EQ(read.error, "");
        EXPECT_EQ(read.value.field, fieldOf(setup.panner));
        return read.value.events.size();
    }

    SessionSetup setup;
    Block block;
    std::size_t inputs = 0, events = 0;
};

TEST_F(SessionJournals, BecomeOrdinarySessionFiles) {
    Session session{setup};
    session.prepare(hostRate, 480);
    SessionJournal journal{folder / "monday.json", session, setup, {}};
    ASSERT_EQ(journal.error(), "");
    play(session, journal, 500);
    journal.end(session.status().sessionNs);
    EXPECT_TRUE(isJournal(text("monday.json"))) << "as a kill would leave it";
    const auto cut = loadSession(folder / "monday.json");
    ASSERT_EQ(cut.error, "");
    ASSERT_EQ(journal.finish(), "");
    EXPECT_EQ(journal.currentError(), "");
    const std::string json = text("monday.json");
    EXPECT_FALSE(isJournal(json));
    EXPECT_EQ(sessionJson(cut.value), json);
    const auto saved = readSession(json, "monday.json");
    ASSERT_EQ(saved.error, "");
    EXPECT_EQ(saved.value.lengthNs, 5'000'000'000);
    EXPECT_EQ(saved.value.log.runs[0].inputs.size(), inputs);
    EXPECT_GT(events, 20u);
    EXPECT_EQ(rows(), events);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder}, {}), 2);
}

TEST_F(SessionJournals, StayWhatTheyAreWhereNobodyCanWaitAndAreReadAlike) {
    Session session{setup};
    session.prepare(hostRate, 480);
    SessionJournal journal{folder / "monday.json", session, setup, {}};
    play(session, journal, 100);
    journal.end(session.status().sessionNs);
    const std::string kept = text("monday.json");
    ASSERT_EQ(journal.finish(kept.size() - 1), "");
    EXPECT_EQ(text("monday.json"), kept);
    EXPECT_EQ(loadSession(folder / "monday.json").value.log.runs[0].inputs.size(), inputs);
    ASSERT_EQ(journal.finish(kept.size()), "");
    EXPECT_FALSE(isJournal(text("monday.json")));
}

TEST_F(SessionJournals, WaitForADiskThatIsFullAndMissNothing) {
    Session session{setup};
    session.prepare(hostRate, 480);
    SessionJournal journal{folder / "monday.json", session, setup, {}};
    play(session, journal, 200);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{std::filesystem::file_size(folder / "monday.json") + 1000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    play(session, journal, 500);
    std::string news;
    for (int i = 0; i < 300 && news.empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
        news = journal.currentError();
    }
    const auto cut = loadSession(folder / "monday.json");
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(news, (folder / "monday.json").string() + ": cannot be written: File too large");
    EXPECT_EQ(cut.error, "") << "it never ends inside a line";
    play(session, journal, 100);
    journal.end(session.status().sessionNs);
    EXPECT_EQ(journal.currentError(),
              (folder / "monday.json").string() + ": can be written again, and nothing is missing");
    ASSERT_EQ(journal.finish(), "");
    const auto saved = loadSession(folder / "monday.json");
    ASSERT_EQ(saved.error, "");
    EXPECT_EQ(saved.value.lengthNs, 8'000'000'000);
    EXPECT_EQ(saved.value.log.runs[0].inputs.size(), inputs);
    EXPECT_EQ(rows(), events);
}

TEST_F(SessionJournals, SayThatTheyAreFull) {
    Session session{setup};
    session.prepare(hostRate, 480);
    SessionJournal journal{folder / "monday.json", session, setup, {}};
    play(session, journal, 10);
    journal.end(limits::maxSessionNs + 1);
    EXPECT_EQ(journal.currentError().rfind((folder / "monday.json").string() + ": is full (", 0), 0U)
        << journal.currentError();
}

TEST_F(SessionJournals, SayWhatOthersDidToTheirFiles) {
    const auto file = folder / "monday.json", list = folder / "monday.events.csv";
    const std::string
        gone = ": cannot be written: it was removed, moved or replaced while it was being written",
        cut = ": cannot be written: another program changed its length while it was being written";
    const auto after = [&](auto act) {
        Session session{setup};
        session.prepare(hostRate, 480);
        SessionJournal journal{file, session, setup, {}};
        EXPECT_EQ(journal.error(), "");
        play(session, journal, 100);
        act();
        play(session, journal, 100);
        journal.end(session.status().sessionNs);
        return journal.finish();
    };
    EXPECT_EQ(after([] {}), "");
    EXPECT_EQ(after([&] { std::filesystem::remove(file); }), file.string() + gone);
    EXPECT_EQ(after([&] { std::filesystem::resize_file(file, 10); }), file.string() + cut);
    EXPECT_EQ(after([&] { std::filesystem::remove(list); }), list.string() + gone);
    EXPECT_EQ(loadSession(file).error, "") << "the other is whole";
    EXPECT_EQ(after([&] { std::filesystem::resize_file(list, 3); }), list.string() + cut);
    EXPECT_EQ(
        after([&] { std::filesystem::rename(list, folder / "kept.csv"), std::ofstream{list} << "mine"; }),
        list.string() + gone);
    EXPECT_EQ(text("monday.events.csv"), "mine");
    EXPECT_EQ(
        after([&] { std::filesystem::rename(file, folder / "kept.json"), std::ofstream{file} << "mine"; }),
        file.string() + gone);
    EXPECT_EQ(text("monday.json"), "mine");
}

TEST_F(SessionJournals, TouchNeitherFileIfOneCannotBe) {
    Session session{setup};
    session.prepare(hostRate, 480);
    const auto refuses = [&](const char* kept) {
        std::ofstream{folder / kept} << "kept";
        const SessionJournal journal{folder / "monday.json", session, setup, {}};
        EXPECT_NE(journal.error().find(
                      ": cannot be written: expected a regular file, found a folder, a device or a pipe"),
                  std::string::npos)
            << journal.error();
        EXPECT_EQ(text(kept), "kept");
        std::filesystem::remove(folder / kept);
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder}, {}), 1);
    };
    std::filesystem::create_directory(folder / "monday.json");
    refuses("monday.events.csv");
    std::filesystem::remove(folder / "monday.json");
    std::filesystem::create_directory(folder / "monday.events.csv");
    refuses("monday.json");
    std::filesystem::remove(folder / "monday.events.csv");
    ASSERT_EQ(mkfifo((folder / "monday.events.csv").c_str(), 0600), 0);
    refuses("monday.json"); // and does not wait for a reader
}

} // namespace physvib::session_journal_test
