// SPDX-License-Identifier: GPL-3.0-or-later
// A thread for calls of a driver that may take for ever: whoever waits for one waits for a limited time.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

namespace physvib {

/// One call at a time. M, but for threadsLeft().
class DeviceThread {
public:
    DeviceThread() = default;
    /// A call that is not over is left to its thread.
    ~DeviceThread() { leave(); }
    DeviceThread(const DeviceThread&) = delete;
    DeviceThread& operator=(const DeviceThread&) = delete;

    /// Begins `call`, which owns or shares all that it uses; the one before is over.
    void begin(std::function<void()> call);

    using Clock = std::chrono::steady_clock;
    /// Whether the call is over, after waiting until `end` at most, or until `hurry`, if there is one, is
    /// true.
    bool isOver(Clock::time_point end = {}, const std::atomic<bool>* hurry = nullptr);

    /// Another call may begin. One that is not over is left to its thread.
    void leave();

    /// Calls of this process that were left and are not over. While there are any, a program ends without
    /// destructors of static objects, which the thread may still use (endProgram). Any thread.
    static int threadsLeft() noexcept;

private:
    struct Call;
    std::shared_ptr<Call> call_;
    std::thread thread_;
};

} // namespace physvib
