// SPDX-License-Identifier: MIT
// Which destruction listener a b2World has: Box2D 2.4 can be told one, but not asked for it.
#pragma once
#include <box2d/box2d.h>

namespace physvib {

namespace installedListener {

struct Access {
    friend b2DestructionListener* b2World::*member(Access);
};
template <b2DestructionListener* b2World::*Member>
struct Reveal {
    friend b2DestructionListener* b2World::*member(Access) { return Member; }
};
// The names in an explicit instantiation are exempt from access control (C++20 [temp.spec]): no cast, no
// guess.
template struct Reveal<&b2World::m_destructionListener>;

} // namespace installedListener

/// nullptr if there is none. The world's thread.
inline b2DestructionListener* destructionListenerOf(b2World& world) noexcept {
    return world.*member(installedListener::Access{});
}

} // namespace physvib
