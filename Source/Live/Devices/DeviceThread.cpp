// SPDX-License-Identifier: MIT
// Runs each driver call on a thread of its own and counts the calls that were abandoned.
#include "Live/Devices/DeviceThread.h"
#include "Live/Session/ThisThread.h"
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace physvib {

namespace {

std::atomic<int> left{0};

} // namespace

struct DeviceThread::Call {
    std::mutex mutex;
    std::condition_variable changed;
    bool isOver = false, isLeft = false;
};

void DeviceThread::begin(std::function<void()> call) {
    leave();
    if (areDriversBoundToTheirThread()) return call();
    call_ = std::make_shared<Call>();
    thread_ = std::thread{[state = call_, call = std::move(call)]() mutable {
        call();
        call = nullptr; // and everything it holds
        const std::lock_guard lock{state->mutex};
        state->isOver = true;
        if (state->isLeft) --left;
        state->changed.notify_all();
    }};
}

bool DeviceThread::isOver(Clock::time_point end, const std::atomic<bool>* hurry) {
    if (!call_) return true;
    {
        std::unique_lock lock{call_->mutex};
        while (!call_->isOver && Clock::now() < end && !(hurry && *hurry))
            call_->changed.wait_until(lock, std::min(end, Clock::now() + std::chrono::milliseconds{10}));
        if (!call_->isOver) return false;
    }
    thread_.join();
    call_.reset();
    return true;
}

void DeviceThread::leave() {
    if (isOver()) return;
    {
        const std::lock_guard lock{call_->mutex};
        call_->isLeft = true;
        if (!call_->isOver) ++left;
    }
    thread_.detach();
    call_.reset();
}

int DeviceThread::threadsLeft() noexcept { return left; }

} // namespace physvib
