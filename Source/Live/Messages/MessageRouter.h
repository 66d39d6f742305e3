// SPDX-License-Identifier: MIT
// Common entry of all messages, whichever input they come from: checks them against the table, gives them a
// time, and passes them to the session.
#pragma once
#include "Core/EnchanterLayout.h"
#include "Io/Result.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageTable.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/Session.h"
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

// Callback by which an input of messages supplies clips. This module reads no files: each input (lines, OSC)
// reads them from its own folder.

struct LoadedClip {
    std::vector<ContactRecording> channels; ///< one or more, of one file, equal in rate and length; their
                                            ///< `file` has path and hash
    std::vector<EnchanterPlace> shares; ///< places as shares of the field, 0 to 1, one per channel; empty:
                                        ///< the file has no places
};

/// Loads the clip of the name in a message, or returns a one-line error. Called on the input's thread.
using ClipSource = std::function<Result<LoadedClip>(const std::string& name)>;

class MessageValues;

/// The time tag with which a message arrived at an input.
struct MessageTag {
    std::int64_t sessionNs = 0;
    bool isLate = false; ///< set by the router: the time had passed, so the message acted at once
};

/// For any number of inputs at once. Any thread but the render thread (R).
class MessageRouter {
public:
    /// `session` outlives it.
    explicit MessageRouter(Session& session) noexcept
        : session_{session} {}

    /// Does what the message says, completely or not at all; with a tag at its time, as with `at`. Returns
    /// the answer of a query, a note (an empty name: none), or a one-line error. `clips` loads this input's
    /// clips; empty: it accepts no clips.
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
    std::mutex mutex_;          // guards the following member
    std::int64_t latestNs_ = 0; // time of the newest event that was requested for "now": a stop comes after
                                // it, and the next such event not before
};

} // namespace physvib
