// SPDX-License-Identifier: MIT
// Writes a journal's two files with GrowingFile, and converts the first to a session file at the end.
#include "Live/Session/SessionJournal.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

constexpr std::chrono::milliseconds writeInterval{500}; // half of the second that a killed process may lose

SavedSession sessionHead(const SessionSetup& setup) {
    return {setup.run(), setup.panner, setup.channels,  setup.limiterEnabled, setup.ceilings, 0,
            {},          {},           setup.equalised, setup.shaping,        setup.layout};
}

} // namespace

SessionJournal::SessionJournal(std::filesystem::path path, Session& session, const SessionSetup& setup,
                               const Provenance& provenance)
    : path_{std::move(path)}
    , eventsPath_{std::filesystem::path{path_}.replace_extension(".events.csv")}
    , session_{session}
    , journalLines_{sessionHead(setup), std::filesystem::absolute(path_).parent_path()} {
    createFiles(fieldOf(setup.panner), provenance);
    if (!error_.empty()) return;
    write({});
    thread_ = std::thread{[this] { run(); }};
    session_.sinks().attach(*this);
}

SessionJournal::~SessionJournal() {
    session_.sinks().detach(*this);
    if (thread_.joinable()) end(session_.status().sessionNs);
}

// Creates both files before it replaces an old one.
void SessionJournal::createFiles(FieldSize field, const Provenance& provenance) {
    AtomicFile session{path_}, events{eventsPath_};
    session.write(journalLines_.head());
    events.write(eventsCsvHead(provenance, field, everyColumn));
    for (AtomicFile* file : {&session, &events})
        if (error_.empty()) error_ = file->error();
    for (AtomicFile* file : {&events, &session})
        if (error_.empty()) error_ = file->commit();
    if (!error_.empty()) return;
    file_.open(path_);
    events_.open(eventsPath_);
    finalFile_.emplace(path_);
    for (const std::string& error : {file_.error(), events_.error(), finalFile_->error()})
        if (error_.empty()) error_ = error;
}

void SessionJournal::onPlayed(const PlayedEvent& played, int) {
    const std::lock_guard lock{mutex_};
    playedEvents_.push_back(played.event);
}

std::string SessionJournal::currentError() const {
    const std::lock_guard lock{mutex_};
    return currentError_;
}

void SessionJournal::run() {
    std::unique_lock lock{mutex_};
    while (!endSignal_.wait_for(lock, writeInterval, [this] { return isEnding_; })) {
        lock.unlock();
        write({});
        lock.lock();
    }
}

void SessionJournal::write(std::optional<std::int64_t> endNs) {
    std::vector<CollisionEvent> playedEvents;
    {
        const std::lock_guard lock{mutex_};
        playedEvents.swap(playedEvents_);
    }
    const std::int64_t completeNs = session_.readLog(log_);
    for (const SceneRun& run : log_.runs)
        if (run.scene) soundNames_.addScene(*run.scene);
    file_.append(journalLines_.nextLines(log_, endNs.value_or(completeNs)));
    std::string rows;
    for (CollisionEvent event : playedEvents) {
        if (rowCount_++ >= limits::maxEventRows) break;
        // a late event was played after others, but rows must be in time order
        event.timeNs = lastRowNs_ = std::max(lastRowNs_, event.timeNs);
        appendEventRow(rows, event, everyColumn, soundNames_);
    }
    events_.append(rows);
    publishError();
}

void SessionJournal::publishError() {
    std::string line;
    for (const GrowingFile* file : {&file_, &events_})
        if (line.empty()) line = file->error();
    const bool isDelayed = !line.empty();
    if (line.empty() && wasDelayed_) line = path_.string() + ": can be written again, and nothing is missing";
    wasDelayed_ = isDelayed;
    if (line.empty() && !journalLines_.limitError().empty())
        line = path_.string() + ": is full (" + journalLines_.limitError() + "): the session is kept up to " +
               std::to_string(journalLines_.completeNs() / 1'000'000'000) + " s, and plays on";
    if (line.empty() && rowCount_ > limits::maxEventRows)
        line = eventsPath_.string() + ": is full (" + std::to_string(limits::maxEventRows) +
               " rows), and the session plays on";
    if (line.empty()) return;
    const std::lock_guard lock{mutex_};
    currentError_ = std::move(line);
}

void SessionJournal::end(std::int64_t sessionNs) {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock{mutex_};
        isEnding_ = true;
    }
    endSignal_.notify_one();
    thread_.join();
    write(sessionNs);
}

std::string SessionJournal::finish(std::size_t maxBytes) {
    events_.sync();
    std::error_code ignored;
    if (!file_.sync() || std::filesystem::file_size(path_, ignored) > maxBytes) return fileError();
    const auto text = readFile(path_, limits::maxSessionFileBytes);
    if (!text) return text.error;
    const auto session = readSession(text.value, path_.string());
    if (!session) return session.error;
    finalFile_->write(sessionJson(session.value));
    if (const std::string& error = finalFile_->commit(); !error.empty())
        return error + "; the session is there as it was kept while it played, and renders";
    return fileError();
}

void GrowingFile::open(const std::filesystem::path& path) {
    path_ = path;
    file_ = SystemFile::openForAppending(path);
    if (file_.error() != 0)
        fail(file_.reason());
    else if (file_.lock() == SystemFile::Lock::heldByOthers)
        fail("it is being written already");
    bytes_ = file_.size();
}

bool GrowingFile::sync() {
    if (!error_.empty()) return true;
    if (!file_.sync()) fail(file_.reason());
    const auto change = file_.externalChange(path_, bytes_);
    if (!change.empty()) fail(change);
    return change.empty();
}

void GrowingFile::append(std::string_view lines) {
    if (isFull_) return;
    pendingLines_ += lines;
    file_.clearError();
    if (file_.append(pendingLines_)) {
        bytes_ += static_cast<std::int64_t>(pendingLines_.size());
        pendingLines_.clear();
        return error_.clear();
    }
    fail(file_.reason());
    if (pendingLines_.size() <= maxPendingBytes) return;
    isFull_ = true;
    pendingLines_ = {};
    error_ += "; too much would have to wait, so it ends here";
}

} // namespace physvib
