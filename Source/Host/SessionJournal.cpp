// SPDX-License-Identifier: GPL-3.0-or-later
// The session is written anew, atomically; events are appended.
#include "Host/SessionJournal.h"
#include "Files/AtomicFile.h"
#include <algorithm>
#include <cerrno>
#include <cstring>

namespace physvib {

SessionJournal::SessionJournal(std::filesystem::path path, const Session& session, const SessionSetup& setup, const Provenance& provenance)
    : path_{std::move(path)}
    , eventsPath_{std::filesystem::path{path_}.replace_extension(".events.csv")}
    , session_{session}
    , saved_{setup.run(), setup.panner, setup.channels, setup.limiterEnabled, setup.ceilings, 0, {}, {}, setup.equalised, setup.shaping}
    , events_{std::fopen(eventsPath_.c_str(), "wb")} {
    if (!events_) {
        error_ = eventsPath_.string() + ": " + std::strerror(errno);
        return;
    }
    rows_ = eventsCsvHead(provenance);
    keep(0);
}

// A late event was played after others; where it stands in the list must not come before theirs.
void SessionJournal::take(const PlayedEvent& played) {
    CollisionEvent event = played.event;
    event.timeNs = lastNs_ = std::max(lastNs_, event.timeNs);
    appendEventRow(rows_, event);
}

void SessionJournal::keep(std::int64_t sessionNs) {
    if (!error_.empty()) return;
    session_.readLog(saved_.log);
    saved_.lengthNs = sessionNs;
    error_ = writeFile(path_, sessionJson(saved_, std::filesystem::absolute(path_).parent_path()));
    const bool isWritten = std::fwrite(rows_.data(), 1, rows_.size(), events_.get()) == rows_.size() && std::fflush(events_.get()) == 0;
    if (!isWritten && error_.empty()) error_ = eventsPath_.string() + ": " + std::strerror(errno);
    rows_.clear();
}

} // namespace physvib
