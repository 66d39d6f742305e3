// SPDX-License-Identifier: GPL-3.0-or-later
// Exchanges two mixer states and matches their levels.
#include "Mixer/Desk/DeskCompare.h"
#include "Live/Documents/Mix.h"
#include "Mixer/Desk/Desk.h"
#include <cmath>
#include <vector>

namespace physvib {
namespace {

constexpr const char* compareStep = "Compare A and B";

/// The contacts played last; before there are any, one at each of 15 places.
std::vector<CollisionEvent> contactsOf(const Desk& desk) {
    std::vector<CollisionEvent> events;
    for (const RecentContact& contact : desk.recent().newestFirst()) events.push_back(contact.event);
    if (!events.empty()) return events;
    const Scene& scene = desk.world().scene();
    for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (const double y : {0.2, 0.5, 0.8}) {
            CollisionEvent event;
            event.x = x * scene.fieldWidthMetres;
            event.y = y * scene.fieldHeightMetres;
            event.amplitude = 1.0;
            events.push_back(event);
        }
    return events;
}

/// All but the world: what is compared.
Mix withWorldOf(Mix mix, const Mix& now) {
    mix.scene = now.scene;
    mix.seed = now.seed;
    mix.dragNewtonSecondsPerScreenMetre = now.dragNewtonSecondsPerScreenMetre;
    return mix;
}

} // namespace

double feltEnergy(const Mix& mix, std::span<const CollisionEvent> events) {
    const auto strips = feltStrips(mix);
    const PhantomPanner panner = mix.panner();
    double sum = 0.0;
    for (const CollisionEvent& event : events) {
        PhantomPanner::Gains gains{};
        panner.gainsOf(event, Spread::layout, gains);
        for (std::size_t j = 0; j < strips.size(); ++j) {
            if (strips[j].output < 0 || isSilent(strips, j)) continue;
            const double g = std::abs(event.amplitude) * static_cast<double>(gains[j]) *
                             static_cast<double>(channelGain(strips[j])) *
                             mix.layout.enchanters[j].fullScaleG;
            sum += g * g;
        }
    }
    return sum * static_cast<double>(masterGain(mix)) * static_cast<double>(masterGain(mix));
}

bool DeskCompare::isOn() const { return other_ && desk_.undoManager().getRedoDescription() != compareStep; }

// A level that the user has set meanwhile is meant as it is.
Mix DeskCompare::own() const {
    Mix mix = desk_.mix();
    if (mix.levelDb == setDb_) mix.levelDb = std::min(0.0, mix.levelDb + loweredDb_);
    return mix;
}

void DeskCompare::toggle() {
    if (!isOn()) {
        end();
        setDb_ = desk_.mix().levelDb;
        other_ = desk_.mix();
    }
    const Mix before = own();
    Mix next = withWorldOf(*other_, desk_.mix());
    const auto events = contactsOf(desk_);
    const double here = feltEnergy(before, events), there = feltEnergy(next, events);
    loweredDb_ = here > 0.0 && there > here ? 10.0 * std::log10(there / here) : 0.0;
    if (next.levelDb > leastStripDb) next.levelDb = std::max(leastStripDb, next.levelDb - loweredDb_);
    setDb_ = next.levelDb;
    isB_ = !isB_;
    other_ = before;
    desk_.edit(compareStep, next, true); // changes back and forth are one step
}

void DeskCompare::end() {
    other_.reset();
    isB_ = false;
    loweredDb_ = 0.0;
}

} // namespace physvib
