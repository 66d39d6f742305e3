// SPDX-License-Identifier: MIT
// C functions of controllers' motors: queue events, pull the command for the next frame.
#include "Api/C/Convert.h"
#include "Api/C/Objects.h"
#include "Scene/PadFile.h"

using namespace physvib;
using namespace physvib::api;

namespace {

constexpr int maxPads = 64;

/// Calls `call(Pads&)` with the controllers of that handle, under their mutex; returns its code or count.
template <class Call>
auto withPads(physvib_pads name, Call call) noexcept -> decltype(call(std::declval<Pads&>())) {
    return guarded([&]() -> decltype(call(std::declval<Pads&>())) {
        const auto pads = use(name);
        if (!pads) return unknownHandle();
        const std::lock_guard lock{pads->mutex};
        return call(*pads);
    });
}

int noSuchPad() noexcept { return nothingThere("pad: expected one of those created, from 0 on"); }
bool isFieldSize(double metres) noexcept { return metres > 0.0 && metres <= 1.0e9; } // not NaN

} // namespace

int physvib_pads_create(int count, double fieldWidth, double fieldHeight, const char* profile,
                        physvib_pads* pads) {
    return guarded([&] {
        if (pads == nullptr) return nothingThere("pads: expected a place for them, found NULL");
        *pads = nullptr;
        if (count < 1 || count > maxPads) return nothingThere("pads: expected 1 to 64");
        if (!isFieldSize(fieldWidth) || !isFieldSize(fieldHeight))
            return nothingThere("field: expected more than 0 m, to 10^9 m");
        const auto found = profile == nullptr ? builtInPads().front() : findPad(profile);
        if (!found) return fail(PHYSVIB_ERROR_FILE, found.error);
        auto made = std::make_unique<Pads>();
        made->pads.assign(static_cast<std::size_t>(count), Pad{found.value.law, fieldWidth, fieldHeight});
        const std::uintptr_t name = allPads().add(std::move(made));
        if (name == 0) return fail(PHYSVIB_ERROR_FULL, "pads: expected at most 256 handles");
        *pads = reinterpret_cast<physvib_pads>(name);
        return PHYSVIB_OK;
    });
}

int physvib_pads_free(physvib_pads pads) {
    return allPads().remove(reinterpret_cast<std::uintptr_t>(pads)) ? PHYSVIB_OK : unknownHandle();
}

int physvib_pads_strike(physvib_pads name, int pad, const physvib_event* event) {
    return withPads(name, [&](Pads& pads) {
        if (!pads.has(pad)) return noSuchPad();
        if (event == nullptr) return nothingThere("event: expected one, found NULL");
        if (const auto fault = faultOf({event, 1}); !fault.empty()) return nothingThere(fault);
        return pads.at(pad).strike(eventOf(*event))
                   ? PHYSVIB_OK
                   : fail(PHYSVIB_ERROR_FULL, "events: expected at most 256 that wait for a pad");
    });
}

physvib_int64 physvib_pads_send(physvib_pads name, int pad, physvib_world world, physvib_int64 laterNs,
                                int atOnce) {
    return withPads(name, [&](Pads& pads) -> physvib_int64 {
        if (!pads.has(pad)) return noSuchPad();
        if (laterNs < -limits::maxTimeNs / 4 || laterNs > limits::maxTimeNs / 4)
            return nothingThere("delay: expected at most 2.5 * 10^16 ns from 0");
        std::array<physvib_event, 128> part;
        for (physvib_int64 sent = 0;;) {
            const physvib_int64 count = physvib_world_take(world, part.data(), part.size(), atOnce);
            if (count < 0) return count; // its text is that of physvib_world_take
            for (CollisionEvent event; const physvib_event& taken : std::span{part}.first(count)) {
                event = eventOf(taken);
                event.timeNs += laterNs;
                sent += pads.at(pad).strike(event) ? 1 : 0;
            }
            if (count < static_cast<physvib_int64>(part.size())) return sent;
        }
    });
}

int physvib_pads_pull(physvib_pads name, physvib_int64 untilNs, physvib_motors* motors, int capacity) {
    return withPads(name, [&](Pads& pads) {
        const int count = static_cast<int>(pads.pads.size());
        if (motors == nullptr || capacity < count)
            return nothingThere("motors: expected a place for those of each pad");
        if (untilNs < 0 || untilNs > limits::maxTimeNs) return nothingThere("time: expected 0 to 10^17 ns");
        if (untilNs < pads.pads.front().pulledNs())
            return fail(PHYSVIB_ERROR_ORDER,
                        "time: expected none before the last pull's (physvib_pads_stop begins again)");
        for (int j = 0; j < count; ++j) {
            const PadCommand command = pads.at(j).pull(untilNs, pads.level);
            motors[j] = {command.low, command.high};
        }
        return count;
    });
}

int physvib_pads_stop(physvib_pads name) {
    return withPads(name, [&](Pads& pads) {
        for (Pad& pad : pads.pads) pad.reset();
        return PHYSVIB_OK;
    });
}

int physvib_pads_set_level(physvib_pads name, double gain) {
    return withPads(name, [&](Pads& pads) {
        if (!(gain >= 0.0 && gain <= 10000.0)) return nothingThere("gain: expected 0 to 10000");
        pads.level = gain;
        return PHYSVIB_OK;
    });
}
