// SPDX-License-Identifier: MIT
// Rate limit for error reports per cause, so that many faulty messages do not flood a log or an input's reply
// line.
#pragma once
#include "Core/NameNumbers.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace physvib {

/// At most one report per cause in `everyNs`, and at most `mostCauses` causes in that time; the others are
/// counted. The caller supplies the clock. One thread at a time.
class ErrorRateLimit {
public:
    static constexpr std::size_t mostCauses = 16;

    explicit ErrorRateLimit(std::int64_t everyNs) noexcept
        : everyNs_{everyNs} {}

    /// True if this error is to be reported.
    bool take(std::string_view reason, std::int64_t nowNs) noexcept {
        const std::uint64_t cause = causeOf(reason);
        Said* place = nullptr; // entry of this cause, or a free one
        for (Said& one : said_) {
            const bool isFree = one.untilNs <= nowNs;
            if (!isFree && one.cause == cause) return ++leftOut_, false;
            if (isFree) place = &one;
        }
        if (place == nullptr) return ++leftOut_, false;
        *place = {cause, nowNs + everyNs_};
        return true;
    }

    /// How many were suppressed since the last call.
    std::uint64_t takeLeftOut() noexcept { return std::exchange(leftOut_, 0); }

    /// Equal for errors that differ only in what was found, in numbers and in quoted words. Any thread.
    static constexpr std::uint64_t causeOf(std::string_view reason) noexcept {
        std::uint64_t hash = fnv1a({});
        bool isQuoted = false;
        for (const char c : reason.substr(0, reason.find(", found "))) {
            if (c == '"')
                isQuoted = !isQuoted;
            else if (!isQuoted && (c < '0' || c > '9'))
                hash = fnv1a({&c, 1}, hash);
        }
        return hash;
    }

private:
    struct Said {
        std::uint64_t cause = 0;
        std::int64_t untilNs = INT64_MIN;
    };
    std::int64_t everyNs_;
    std::array<Said, mostCauses> said_{};
    std::uint64_t leftOut_ = 0;
};

} // namespace physvib
