// SPDX-License-Identifier: MIT
// Thread for calls of an audio driver that may hang; the caller waits for a limited time only.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

namespace physvib {

/// One call at a time. M, except threadsLeft().
class DeviceThread {
public:
    DeviceThread() = default;
    /// A call that has not finished is abandoned to its thread.
    ~DeviceThread() { leave(); }
    DeviceThread(const DeviceThread&) = delete;
    DeviceThread& operator=(const DeviceThread&) = delete;

    /// Starts `call`, which must own or share everything it uses; the call before has finished.
    void begin(std::function<void()> call);

    using Clock = std::chrono::steady_clock;
    /// Whether the call has finished; waits until `end`, or until `hurry` (may be null) is true.
    bool isOver(Clock::time_point end = {}, const std::atomic<bool>* hurry = nullptr);

    /// Allows another call to start; one that has not finished is abandoned to its thread.
    void leave();

    /// Number of abandoned calls of this process that are still running. While there are any, a program exits
    /// without destructors of static objects, which such a thread may still use (endProgram). Any thread.
    static int threadsLeft() noexcept;

private:
    struct Call;
    std::shared_ptr<Call> call_;
    std::thread thread_;
};

} // namespace physvib
