// SPDX-License-Identifier: MIT
// The one road of messages, whichever door they come by: checked against the table, timed, and handed to the
// session.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/PlainMessage.h"
#include "Live/Messages/ClipSource.h"
#include "Live/Messages/MessageTable.h"
#include "Live/Session/Session.h"
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

class MessageValues;

/// When a message is meant that a door has got with a time of its own.
struct MessageTag {
    std::int64_t sessionNs = 0;
    bool isLate = false; ///< told by the router: that time was over, and it was done at once
};

/// For any number of doors at once. Any thread but R.
class MessageRouter {
public:
    /// `session` outlives it.
    explicit MessageRouter(Session& session) noexcept
        : session_{session} {}

    /// Does what the message says, all of it or nothing; at the time of its tag, if it has one, as with `at`.
    /// The answer of a query, or a note on what was done (without a name: nothing to tell), or one line.
    /// `clips` is where this door's clips come from; none: it takes none.
    Result<PlainMessage> take(const PlainMessage& message, MessageTag* tag = nullptr,
                              const ClipSource& clips = {});

private:
    void expectTime(const MessageValues& values, const MessageTag* tag);
    std::vector<CollisionEvent> strikesOf(const MessageDescription& description, const MessageValues& values,
                                          const ClipSource& clips, const PhantomPanner& panner,
                                          std::string& note);
    std::vector<CollisionEvent> clip(const MessageValues& values, const ClipSource& clips,
                                     const PhantomPanner& panner, std::string& note);
    std::int64_t timeOf(const MessageValues& values, MessageTag* tag) const;
    std::int64_t aheadOrFail(const MessageValues& values, std::string_view name, std::int64_t at) const;
    void strike(std::vector<CollisionEvent> strikes, std::int64_t start, bool isNow);
    void stop(std::int64_t at);
    std::int64_t nowNs() const;

    Session& session_;
    std::mutex mutex_;          // guards what follows
    std::int64_t latestNs_ = 0; // of what was asked for "now": a stop comes after it, and the next one not
                                // before
};

} // namespace physvib
