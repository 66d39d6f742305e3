// SPDX-License-Identifier: MIT
// The one road of messages, whichever door they come by: checked against the table, timed, and handed to the session.
#pragma once
#include "Files/Result.h"
#include "Files/Text/PlainMessage.h"
#include "Session/Messages/MessageTable.h"
#include "Session/Session.h"
#include <cstdint>
#include <mutex>
#include <vector>

namespace physvib {

class MessageValues;

/// For any number of doors at once. Any thread but R.
class MessageRouter {
public:
    /// `session` outlives it.
    explicit MessageRouter(Session& session) noexcept : session_{session} {}

    /// Does what the message says, all of it or nothing. The answer of a query (without a name: nothing to tell), or one line.
    Result<PlainMessage> take(const PlainMessage& message);

private:
    std::int64_t timeOf(const MessageValues& values) const;
    void strike(std::vector<CollisionEvent> strikes, const MessageValues& values);
    void stop(const MessageValues& values);
    PlainMessage answer(MessageKind query) const;
    std::int64_t nowNs() const;

    Session& session_;
    std::mutex mutex_; // guards what follows
    std::int64_t latestNs_ = 0; // of what was asked for "now": a stop comes after it, and the next one not before
};

} // namespace physvib
