// SPDX-License-Identifier: GPL-3.0-or-later
// What a program says while it plays: one bounded queue for standard output and standard error, and one
// thread that writes. Nobody else ever waits for a reader.
#pragma once
#include "System/Process.h"
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

namespace physvib {

/// Any thread but R.
class OutputWriter {
public:
    static constexpr std::size_t mostBytes = 1 << 18;         ///< that wait, on each of the two
    static constexpr std::chrono::milliseconds patience{250}; ///< at the end, for each of them
    /// As writeSome.
    using Sink = std::function<std::optional<std::size_t>(Standard, std::string_view)>;

    explicit OutputWriter(Sink sink = writeSome);
    /// What waits still is given up. A thread that a reader holds up is left behind.
    ~OutputWriter();

    /// Puts one line into the queue. If there is no room, it is dropped and counted; standard error says so
    /// when there is room again.
    void say(Standard standard, std::string line);

    /// How many lines were dropped so far.
    std::uint64_t dropped(Standard standard) const;

    /// Waits at most `patience` until all that was said is written. Empty, or why it is not.
    std::string finish(Standard standard);

private:
    struct State;
    std::shared_ptr<State> state_;
    std::thread thread_;
};

} // namespace physvib
