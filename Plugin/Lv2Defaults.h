// SPDX-License-Identifier: GPL-3.0-or-later
// Defaults for LV2 hosts that support only the core specification. They lack what JUCE's LV2 wrapper
// requires: a map of URIs to numbers, the largest block length, and a buffer for the events that the plug-in
// sends.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <lv2/atom/atom.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/core/lv2.h>
#include <lv2/options/options.h>
#include <lv2/urid/urid.h>
#include <mutex>
#include <string>
#include <vector>

namespace physvib {

/// The data of a host's feature; null: the host has none. Any thread.
inline const void* feature(const LV2_Feature* const* features, const char* uri) noexcept {
    for (; features && *features; ++features)
        if (std::strcmp((*features)->URI, uri) == 0) return (*features)->data;
    return nullptr;
}

/// A map of URIs to numbers from 1, common to all instances, for hosts that have none. Any thread.
inline LV2_URID_Map& fallbackUridMap() {
    static LV2_URID_Map map{nullptr, [](LV2_URID_Map_Handle, const char* uri) {
                                static std::mutex mutex;
                                static std::vector<std::string> known;
                                const std::lock_guard lock{mutex};
                                auto found = std::ranges::find(known, uri);
                                if (found == known.end()) found = known.insert(known.end(), uri);
                                return static_cast<LV2_URID>(found - known.begin() + 1);
                            }};
    return map;
}

/// A host's features, with ours in place of those that it lacks. Valid while the host's list and this object
/// exist; instantiate copies what it keeps.
class Lv2Features {
public:
    explicit Lv2Features(const LV2_Feature* const* hosts) {
        for (auto one = hosts; one && *one; ++one) all_.push_back(*one);
        if (!feature(hosts, LV2_URID__map)) all_.push_back(&map_);
        all_.push_back(&bounded_); // the processor takes longer blocks in parts
        if (!feature(hosts, LV2_OPTIONS__options)) all_.push_back(&options_);
        all_.push_back(nullptr);
        const auto& map = *static_cast<const LV2_URID_Map*>(feature(all_.data(), LV2_URID__map));
        option_[0] = {LV2_OPTIONS_INSTANCE,
                      0,
                      map.map(map.handle, LV2_BUF_SIZE__maxBlockLength),
                      sizeof longest_,
                      map.map(map.handle, LV2_ATOM__Int),
                      &longest_};
    }
    Lv2Features(const Lv2Features&) = delete;
    Lv2Features& operator=(const Lv2Features&) = delete;
    const LV2_Feature* const* all() const noexcept { return all_.data(); }

private:
    const std::int32_t longest_ = limits::maxBlockFrames;
    std::array<LV2_Options_Option, 2> option_{};
    LV2_Feature map_{LV2_URID__map, &fallbackUridMap()}, bounded_{LV2_BUF_SIZE__boundedBlockLength, nullptr},
        options_{LV2_OPTIONS__options, option_.data()};
    std::vector<const LV2_Feature*> all_;
};

/// Buffer for the events that the plug-in sends, for a host that does not connect their port.
class UnconnectedEvents {
public:
    /// The buffer, emptied; to be called before each block. R, wait-free.
    LV2_Atom_Sequence* empty() noexcept {
        sequence_.atom.size = sizeof room_;
        return &sequence_;
    }

private:
    LV2_Atom_Sequence sequence_{};
    [[maybe_unused]] std::array<std::uint64_t, 1024> room_{}; // for events, right behind the sequence's head
};

} // namespace physvib
