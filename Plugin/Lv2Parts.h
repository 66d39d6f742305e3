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

/// Parts of the live instance that the host knows by this handle. Any thread.
Lv2Parts findLv2Parts(void* instance) noexcept;

/// The control ports. A port sets its parameter only if its value differs from that in the block before or,
/// after a state was restored, from that saved with it. So the last change counts, whether by the port, the
/// window, a controller or an event, and whether or not a host restores its ports with a state.
class Lv2Controls {
public:
    /// There is a port for each parameter, and after them `lv2:enabled`, the inverse of bypass.
    static constexpr std::size_t enabled = parameterCount, portCount = parameterCount + 1;

    Lv2Controls() {
        for (std::size_t p = 0; p < portCount; ++p) lastRead_[p] = normalOf(p, initialOf(p));
        saved_.fill(noValue);
    }

    /// Sets a port's data, which is in the parameter's unit; null: not connected.
    void connect(std::size_t port, const void* data) noexcept {
        ports_[port] = static_cast<const float*>(data);
    }

    /// Applies changed ports; called before each block. R, wait-free.
    void read(PluginProcessor& processor) noexcept {
        const bool isRestored = isRestored_.exchange(false, std::memory_order_acquire);
        for (std::size_t p = 0; p < portCount; ++p) {
            if (!ports_[p] || !std::isfinite(*ports_[p])) continue;
            const float now = normalOf(p, *ports_[p]);
            if (isSame(now, lastRead_[p])) continue;
            auto& parameter = processor.parameter(portParameter(p));
            const bool isUndone = isRestored && isSame(now, saved_[p]);
            if (!isUndone && !isSame(now, parameter.getValue())) parameter.setByController(now);
            lastRead_[p] = now; // last, because valueToWrite() compares with it
        }
        wasRead_.store(true, std::memory_order_release);
    }

    /// The value that the window has to write to the port so that the host shows the parameter's value; none
    /// if the port has it already, and before the first block. M, wait-free.
    std::optional<float> valueToWrite(std::size_t p, PluginProcessor& processor) const noexcept {
        if (!wasRead_.load(std::memory_order_acquire)) return std::nullopt;
        const float lastRead = lastRead_[p]; // before the value: read() may change both meanwhile
        const float now = processor.parameter(portParameter(p)).getValue();
        if (isSame(now, lastRead)) return std::nullopt;
        return p == enabled ? (now > 0.5f ? 0.0f : 1.0f)
                            : static_cast<float>(denormalised(allParameters()[p], now));
    }

    /// The ports' values in the last block as text for a state; and reading that of a restored one. Not R.
    std::string text() const {
        std::string all;
        for (const auto& lastRead : lastRead_) {
            std::array<char, 32> digits{};
            const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), lastRead.load()).ptr;
            all.append(digits.data(), end);
            all += ' ';
        }
        return all;
    }
    void restore(std::string_view text) noexcept {
        const char* start = text.data();
        const char* const end = start + text.size();
        for (float& saved : saved_) {
            saved = noValue;
            const auto [next, error] = std::from_chars(start, end, saved);
            start = next == end ? end : next + 1;
        }
        isRestored_.store(true, std::memory_order_release);
    }

private:
    static constexpr float noValue = std::numeric_limits<float>::quiet_NaN();
    static constexpr float tolerance = 1e-6f; // hosts keep values with six digits
    static bool isSame(float a, float b) noexcept { return std::abs(a - b) < tolerance; }
    static Parameter portParameter(std::size_t port) noexcept {
        return port == enabled ? Parameter::bypass : static_cast<Parameter>(port);
    }
    static float initialOf(std::size_t port) noexcept {
        return port == enabled ? 1.0f : static_cast<float>(allParameters()[port].initial);
    }
    /// A port's value as its parameter's 0 to 1.
    static float normalOf(std::size_t port, float value) noexcept {
        if (port == enabled) return value > 0.5f ? 0.0f : 1.0f;
        return static_cast<float>(normalised(allParameters()[port], static_cast<double>(value)));
    }

    std::array<const float*, portCount> ports_{};
    std::array<std::atomic<float>, portCount> lastRead_{}; // 0 to 1
    std::array<float, portCount> saved_{};
    std::atomic<bool> isRestored_{false}, wasRead_{false};
};

} // namespace physvib
