// SPDX-License-Identifier: MIT
// Finds haptic sources that Box2D lets touch nothing. It starts from the world's own lists, because a
// fixture in the table may have been destroyed unseen.
#include "Physics/SourceNotes.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/FixtureTable.h"
#include "Physics/WorldNames.h"
#include <optional>

namespace physvib {

namespace {

// As b2ContactFilter decides.
bool mayTouch(const b2Filter& a, const b2Filter& b) noexcept {
    if (a.groupIndex == b.groupIndex && a.groupIndex != 0) return a.groupIndex > 0;
    return (a.maskBits & b.categoryBits) != 0 && (a.categoryBits & b.maskBits) != 0;
}

bool isFiltered(const b2World& world, const b2Fixture& source) {
    bool hasOthers = false;
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        for (const b2Fixture* f = body->GetFixtureList(); f != nullptr && body != source.GetBody();
             f = f->GetNext()) {
            if (mayTouch(source.GetFilterData(), f->GetFilterData())) return false;
            hasOthers = true;
        }
    return hasOthers;
}

std::optional<EngineNote> noteOf(const b2World& world, const b2Fixture& source) {
    const b2Body& body = *source.GetBody();
    if (!body.IsEnabled()) return EngineNote::disabled;
    if (source.IsSensor()) return EngineNote::sensor;
    if (isFiltered(world, source)) return EngineNote::filtered;
    if (body.GetType() != b2_staticBody && !body.IsAwake()) return EngineNote::asleep;
    return {};
}

} // namespace

void noteSources(const b2World& world, const FixtureTable& fixtures, ContactCounts& counts) {
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext())
            if (const std::int32_t slot = fixtures.find(idOf(*f));
                slot != FixtureTable::none && fixtures.isCamera(slot))
                if (const auto note = noteOf(world, *f)) counts.note(*note, fixtures[slot].id);
}

} // namespace physvib
