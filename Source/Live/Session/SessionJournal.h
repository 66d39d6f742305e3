// SPDX-License-Identifier: MIT
// Journal of a live session on disk: what is needed to render it again, and the events played.
//
// The journal's own thread appends to both files (GrowingFile) twice a second. The cost does not grow with
// the session, and after a crash everything up to the last second is there. At the end the journal becomes an
// ordinary session file; one that was cut off is readable too.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/SystemFile.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Session/Session.h"
#include "Scene/EventsCsv.h"
#include "Scene/SceneLimits.h"
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace physvib {

// A log file that grows by whole lines while a session plays, and tolerates temporary disk errors.

/// Lines that cannot be written stay pending, so that the file never ends inside a line; the next append()
/// writes them. One thread at a time.
class GrowingFile {
public:
    /// Continues at the end of the file, and locks it against other writers.
    void open(const std::filesystem::path& path);

    /// Adds whole lines, after the pending ones.
    void append(std::string_view lines);

    /// Flushes to disk; a failure sets error(). False if others have removed, replaced or cut the file.
    bool sync();

    /// Empty, or one line: why lines are pending, or that maxPendingBytes were exceeded; after that the file
    /// grows no more.
    const std::string& error() const noexcept { return error_; }

    static constexpr std::size_t maxPendingBytes = 32'000'000; // twenty minutes of a lively session

private:
    void fail(const std::string& reason) { error_ = path_.string() + ": cannot be written: " + reason; }

    std::filesystem::path path_;
    SystemFile file_;
    std::string pendingLines_, error_;
    std::int64_t bytes_ = 0; // of the file after the last append()
    bool isFull_ = false;
};

/// A sink that writes a session's journal and its event list. All methods: message thread (M) only.
class SessionJournal final : public Sink {
public:
    /// Saves `session` as `path` (.json), and the events played beside it as .events.csv. The session must
    /// outlive this object, and its log must have no other reader. `setup`: the session's; `provenance` is
    /// written into the event list.
    SessionJournal(std::filesystem::path path, Session& session, const SessionSetup& setup,
                   const Provenance& provenance);
    ~SessionJournal() override;

    /// Empty, or why a file cannot be created; then neither has been changed.
    const std::string& error() const noexcept { return error_; }

    void onPlayed(const PlayedEvent& played, int sampleRateHz) override;
    SinkState state() const override {
        return {.name = "session file", .isReady = true, .error = currentError()};
    }

    /// The latest message: empty, or one line why a file cannot grow at present or has stopped growing.
    std::string currentError() const;

    /// Adds everything up to now, session time `sessionNs`, and stops the journal.
    void end(std::int64_t sessionNs);

    /// After end(): converts the journal to an ordinary session file, in a time that grows with the session.
    /// A journal of more than `maxBytes` is not converted, but is readable too. Empty, or why not everything
    /// is on disk.
    std::string finish(std::size_t maxBytes = limits::maxSessionFileBytes);

    static constexpr std::size_t maxQuickBytes = 1'000'000; ///< for callers that must not block: 0.1 s

    const std::filesystem::path& eventsPath() const noexcept { return eventsPath_; }

private:
    void createFiles(FieldSize field, const Provenance& provenance);
    void run();
    void write(std::optional<std::int64_t> endNs);
    void publishError();
    const std::string& fileError() const { return file_.error().empty() ? events_.error() : file_.error(); }

    std::filesystem::path path_, eventsPath_;
    Session& session_;
    std::string error_;
    std::optional<AtomicFile> finalFile_; // the final session file; keeps the name from other writers

    // Used by the journal's thread; by M after that has ended.
    JournalLines journalLines_;
    SessionLog log_;
    GrowingFile file_, events_;
    std::int64_t lastRowNs_ = 0;
    std::size_t rowCount_ = 0;
    SoundNames soundNames_;
    bool wasDelayed_ = false;

    mutable std::mutex mutex_; // guards the following members
    std::condition_variable endSignal_;
    bool isEnding_ = false;
    std::vector<CollisionEvent> playedEvents_;
    std::string currentError_;

    std::thread thread_;
};

} // namespace physvib
