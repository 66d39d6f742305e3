// SPDX-License-Identifier: MIT
// A client of the JACK server that may go away, and the names of other clients' ports.
#pragma once
#include "Live/Devices/JackLibrary.h"
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

namespace physvib {

/// M: opening and closing wait for the server, and hang as long as it does.
///
/// When a server has gone, JACK's library frees all clients of the process as soon as any of them is opened
/// anew. So nobody calls JACK while a client is being opened, and a client that has lost its server is
/// neither closed nor used any more.
class JackClient {
public:
    /// Never starts a server. JACK appends a number to a name that another client has.
    JackClient(const JackLibrary& jack, const char* name);
    ~JackClient();
    JackClient(const JackClient&) = delete;
    JackClient& operator=(const JackClient&) = delete;

    /// Whether it has a server. Any thread.
    bool isAlive() const noexcept;

    /// JACK may be called for this client while the lock is held. Empty: it has lost its server, or, of
    /// holdSoon(), another client has been in opening for 50 ms.
    using Held = std::shared_lock<std::shared_timed_mutex>;
    Held hold() const;
    Held holdSoon() const;
    jack_client_t* get() const noexcept { return client_; }

    /// Full names ("system:playback_1") of the audio ports that take samples (JackPortIsInput) or give them
    /// (JackPortIsOutput), in the server's order. Held only.
    std::vector<std::string> ports(JackPortFlags direction) const;

    /// Of those, the ones of one client.
    std::vector<std::string> portsOf(const std::string& owner, JackPortFlags direction) const;

    /// Keeps what JACK may still call for a client that has lost its server, until JACK has freed that
    /// client.
    static void keepUntilFreed(std::shared_ptr<void> callbacks);

private:
    const JackLibrary& jack_;
    jack_client_t* client_ = nullptr;
    unsigned int server_ = 0; // which of the servers that the process has seen, from 0
};

} // namespace physvib
