// SPDX-License-Identifier: GPL-3.0-or-later
// What the LV2 entry and its window share: access to the instance, and the control ports, one per parameter:
// reading them, storing them with a state, and reporting changes by the window to the host.
#pragma once
#include "PluginProcessor.h"
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

class Lv2Controls;

struct Lv2Parts {
    PluginProcessor* processor = nullptr;
    std::shared_ptr<Lv2Controls> controls{};
    std::uint32_t firstControl = 0; ///< the first parameter's port
};

/// By the handle that the host has of an instance that lives. Any thread.
Lv2Parts lv2PartsOf(void* instance) noexcept;

/// A port counts where its value is another than it was: in the block before, or, once a state was restored,
/// when that was saved. So the last change stays, whether the host made it by the port, or the window, a
/// controller or an event: hosts that save ports beside a state restore what they held then, others do not.
class Lv2Controls {
public:
    /// One for each parameter, and behind them `lv2:enabled`, which is bypass the other way round.
    static constexpr std::size_t enabled = parameterCount, count = parameterCount + 1;

    Lv2Controls() {
        for (std::size_t p = 0; p < count; ++p) seen_[p] = normalOf(p, initialOf(p));
        saved_.fill(none);
    }

    /// The host's, in the parameter's unit; null: not connected.
    void connect(std::size_t port, const void* data) noexcept {
        ports_[port] = static_cast<const float*>(data);
    }

    /// Before each block. R, wait-free.
    void read(PluginProcessor& processor) noexcept {
        const bool isRestored = isRestored_.exchange(false, std::memory_order_acquire);
        for (std::size_t p = 0; p < count; ++p) {
            if (!ports_[p] || !std::isfinite(*ports_[p])) continue;
            const float now = normalOf(p, *ports_[p]);
            if (isSame(now, seen_[p])) continue;
            auto& parameter = processor.parameter(parameterOf(p));
            const bool isUndone = isRestored && isSame(now, saved_[p]);
            if (!isUndone && !isSame(now, parameter.getValue())) parameter.setByController(now);
            seen_[p] = now; // last: a window compares
        }
        wasRead_.store(true, std::memory_order_release);
    }

    /// What a window has to write to the port so that the host shows the value that counts; nothing where the
    /// port says so already, or before the first block. Thread of the window, wait-free.
    std::optional<float> owed(std::size_t p, PluginProcessor& processor) const noexcept {
        if (!wasRead_.load(std::memory_order_acquire)) return std::nullopt;
        const float seen = seen_[p]; // before the value: what the port moves meanwhile is no news
        const float now = processor.parameter(parameterOf(p)).getValue();
        if (isSame(now, seen)) return std::nullopt;
        return p == enabled ? (now > 0.5f ? 0.0f : 1.0f)
                            : static_cast<float>(denormalised(allParameters()[p], now));
    }

    /// What the ports held in the last block, as text for a state; and that of a restored one. Not R.
    std::string text() const {
        std::string all;
        for (const auto& seen : seen_) {
            std::array<char, 32> digits{};
            const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), seen.load()).ptr;
            all.append(digits.data(), end);
            all += ' ';
        }
        return all;
    }
    void restore(std::string_view text) noexcept {
        const char* at = text.data();
        const char* const end = at + text.size();
        for (float& saved : saved_) {
            saved = none;
            const auto [next, error] = std::from_chars(at, end, saved);
            at = next == end ? end : next + 1;
        }
        isRestored_.store(true, std::memory_order_release);
    }

private:
    static constexpr float none = std::numeric_limits<float>::quiet_NaN();
    static constexpr float closest = 1e-6f; // hosts keep values with six digits
    static bool isSame(float a, float b) noexcept { return std::abs(a - b) < closest; }
    static Parameter parameterOf(std::size_t port) noexcept {
        return port == enabled ? Parameter::bypass : static_cast<Parameter>(port);
    }
    static float initialOf(std::size_t port) noexcept {
        return port == enabled ? 1.0f : static_cast<float>(allParameters()[port].initial);
    }
    /// What a port holds as its parameter's 0 to 1.
    static float normalOf(std::size_t port, float value) noexcept {
        if (port == enabled) return value > 0.5f ? 0.0f : 1.0f;
        return static_cast<float>(normalised(allParameters()[port], static_cast<double>(value)));
    }

    std::array<const float*, count> ports_{};
    std::array<std::atomic<float>, count> seen_{}; // 0 to 1
    std::array<float, count> saved_{};
    std::atomic<bool> isRestored_{false}, wasRead_{false};
};

} // namespace physvib
