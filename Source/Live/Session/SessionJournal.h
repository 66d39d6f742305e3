// SPDX-License-Identifier: MIT
// A live session on disk while it plays: what it takes to render it again, and what was played.
//
// A thread of the journal's own adds to both files what is new, twice a second: the cost does not grow with
// the session, and whatever ends the program, what was played is there up to a second before. At the end the
// journal becomes an ordinary session file; one that was cut off is read as it is.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/SessionJournalText.h"
#include "Live/Session/GrowingFile.h"
#include "Live/Session/Session.h"
#include "Scene/EventsCsv.h"
#include "Scene/SceneFileLimits.h"
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

/// All methods: M only.
class SessionJournal final : public Sink {
public:
    /// Saves `session`, which outlives this object and has its log read by nobody else, as `path` (.json),
    /// and the events played beside it as .events.csv. `setup` is what the session was made with,
    /// `provenance` stands in the list of events.
    SessionJournal(std::filesystem::path path, Session& session, const SessionSetup& setup,
                   const Provenance& provenance);
    ~SessionJournal() override;

    /// Empty, or why one of the files cannot be made; then neither has been touched.
    const std::string& error() const noexcept { return error_; }

    void played(const PlayedEvent& played, int sampleRateHz) override;
    SinkState state() const override { return {.name = "session file", .isReady = true, .trouble = news()}; }

    /// Empty, or one line: what keeps a file from growing now, or that it grows no more; the last one stands
    /// until there is another.
    std::string news() const;

    /// Adds all until now, which is session time `sessionNs`; nothing is added after that.
    void end(std::int64_t sessionNs);

    /// Makes the journal, which has ended, an ordinary session file, which takes as long as the session is;
    /// one of more bytes stays as it is, and is read alike. Empty, or why not all that was played is on disk.
    std::string finish(std::size_t mostBytes = limits::maxSessionFileBytes);

    static constexpr std::size_t quickBytes = 1'000'000; ///< for whoever cannot wait: a tenth of a second

    const std::filesystem::path& eventsPath() const noexcept { return eventsPath_; }

private:
    void begin(FieldSize field, const Provenance& provenance);
    void run();
    void write(std::optional<std::int64_t> endNs);
    void tell();
    const std::string& fault() const { return file_.error().empty() ? events_.error() : file_.error(); }

    std::filesystem::path path_, eventsPath_;
    Session& session_;
    std::string error_;
    const bool hasKinds_;             // of the list
    std::optional<AtomicFile> whole_; // the session file to be; nobody else writes one of that name until
                                      // then

    // The thread's; M's once that has ended.
    JournalLines lines_;
    SessionLog log_;
    GrowingFile file_, events_;
    std::int64_t lastNs_ = 0;
    std::size_t rows_ = 0;
    bool wasHeldUp_ = false;

    mutable std::mutex mutex_; // guards what follows
    std::condition_variable ends_;
    bool isEnding_ = false;
    std::vector<CollisionEvent> played_;
    std::string news_;

    std::thread thread_;
};

} // namespace physvib
