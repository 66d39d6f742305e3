// SPDX-License-Identifier: MIT
// Writes the two growing files of a session's journal, and converts the first to a session file at the end.
#include "Live/Session/SessionJournal.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

constexpr std::chrono::milliseconds period{500}; // at most half of what a killed process may lose

SavedSession headOf(const SessionSetup& setup) {
    return {setup.run(), setup.panner, setup.channels,  setup.limiterEnabled, setup.ceilings, 0,
            {},          {},           setup.equalised, setup.shaping,        setup.layout};
}

// Chooses the columns before any event is known: depths and parts if the layout has them.
OptionalColumns columnsFor(const SessionSetup& setup) {
    const ActuatorLayout& layout = setup.panner.layout();
    return {isAnyRough(setup.scene.materials), true, !isFlat(layout), hasParts(layout)};
}

} // namespace

SessionJournal::SessionJournal(std::filesystem::path path, Session& session, const SessionSetup& setup,
                               const Provenance& provenance)
    : path_{std::move(path)}
    , eventsPath_{std::filesystem::path{path_}.replace_extension(".events.csv")}
    , session_{session}
    , columns_{columnsFor(setup)}
    , lines_{headOf(setup), std::filesystem::absolute(path_).parent_path()} {
    begin(fieldOf(setup.panner), provenance);
    if (!error_.empty()) return;
    write({});
    thread_ = std::thread{[this] { run(); }};
    session_.sinks().attach(*this);
}

SessionJournal::~SessionJournal() {
    session_.sinks().detach(*this);
    if (thread_.joinable()) end(session_.status().sessionNs);
}

// Creates both files before it replaces either.
void SessionJournal::begin(FieldSize field, const Provenance& provenance) {
    AtomicFile session{path_}, events{eventsPath_};
    session.write(lines_.head());
    events.write(eventsCsvHead(provenance, field, columns_));
    for (AtomicFile* file : {&session, &events})
        if (error_.empty()) error_ = file->error();
    for (AtomicFile* file : {&events, &session})
        if (error_.empty()) error_ = file->commit();
    if (!error_.empty()) return;
    file_.open(path_);
    events_.open(eventsPath_);
    whole_.emplace(path_);
    for (const std::string& error : {file_.error(), events_.error(), whole_->error()})
        if (error_.empty()) error_ = error;
}

void SessionJournal::played(const PlayedEvent& played, int) {
    const std::lock_guard lock{mutex_};
    played_.push_back(played.event);
}

std::string SessionJournal::news() const {
    const std::lock_guard lock{mutex_};
    return news_;
}

void SessionJournal::run() {
    std::unique_lock lock{mutex_};
    while (!ends_.wait_for(lock, period, [this] { return isEnding_; })) {
        lock.unlock();
        write({});
        lock.lock();
    }
}

void SessionJournal::write(std::optional<std::int64_t> endNs) {
    std::vector<CollisionEvent> played;
    {
        const std::lock_guard lock{mutex_};
        played.swap(played_);
    }
    const std::int64_t toldNs = session_.readLog(log_);
    for (const SceneRun& take : log_.takes)
        if (take.scene) names_.addScene(*take.scene);
    file_.append(lines_.take(log_, endNs.value_or(toldNs)));
    std::string rows;
    for (CollisionEvent event : played) {
        if (rows_++ >= limits::maxEventRows) break;
        // a late event was played after others, but rows must be in time order
        event.timeNs = lastNs_ = std::max(lastNs_, event.timeNs);
        appendEventRow(rows, event, columns_, names_);
    }
    events_.append(rows);
    tell();
}

void SessionJournal::tell() {
    std::string news;
    for (const GrowingFile* file : {&file_, &events_})
        if (news.empty()) news = file->error();
    const bool isHeldUp = !news.empty();
    if (news.empty() && wasHeldUp_) news = path_.string() + ": can be written again, and nothing is missing";
    wasHeldUp_ = isHeldUp;
    if (news.empty() && !lines_.full().empty())
        news = path_.string() + ": is full (" + lines_.full() + "): the session is kept up to " +
               std::to_string(lines_.toldNs() / 1'000'000'000) + " s, and plays on";
    if (news.empty() && rows_ > limits::maxEventRows)
        news = eventsPath_.string() + ": is full (" + std::to_string(limits::maxEventRows) +
               " rows), and the session plays on";
    if (news.empty()) return;
    const std::lock_guard lock{mutex_};
    news_ = std::move(news);
}

void SessionJournal::end(std::int64_t sessionNs) {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock{mutex_};
        isEnding_ = true;
    }
    ends_.notify_one();
    thread_.join();
    write(sessionNs);
}

std::string SessionJournal::finish(std::size_t mostBytes) {
    events_.sync();
    std::error_code gone;
    if (!file_.sync() || std::filesystem::file_size(path_, gone) > mostBytes) return fault();
    const auto text = readFile(path_, limits::maxSessionFileBytes);
    if (!text) return text.error;
    const auto session = readSession(text.value, path_.string());
    if (!session) return session.error;
    whole_->write(sessionJson(session.value));
    if (const std::string& error = whole_->commit(); !error.empty())
        return error + "; the session is there as it was kept while it played, and renders";
    return fault();
}

void GrowingFile::open(const std::filesystem::path& path) {
    path_ = path;
    file_ = SystemFile::grow(path);
    if (file_.error() != 0)
        fail(file_.reason());
    else if (file_.lock() == SystemFile::Lock::others)
        fail("it is being written already");
    bytes_ = file_.size();
}

bool GrowingFile::sync() {
    if (!error_.empty()) return true;
    if (!file_.sync()) fail(file_.reason());
    const auto change = file_.changeByOthers(path_, bytes_);
    if (!change.empty()) fail(change);
    return change.empty();
}

void GrowingFile::append(std::string_view lines) {
    if (isOver_) return;
    if (waiting_.size() + lines.size() > maxWaitingBytes) {
        isOver_ = true;
        waiting_ = {};
        error_ += "; too much would have to wait, so it ends here";
        return;
    }
    waiting_ += lines;
    file_.forgetError();
    if (!file_.append(waiting_)) return fail(file_.reason());
    bytes_ += static_cast<std::int64_t>(waiting_.size());
    waiting_.clear();
    error_.clear();
}

} // namespace physvib
