// SPDX-License-Identifier: MIT
// What Box2D 2.4 knows and does not say: how far its step has taken a body, and a world's destruction
// listener.
#pragma once
#include <box2d/box2d.h>

namespace physvib {

namespace boxPrivates {

struct Sweep {
    using Member = b2Sweep b2Body::*;
    friend Member member(Sweep);
};
struct Listener {
    using Member = b2DestructionListener* b2World::*;
    friend Member member(Listener);
};
template <class Of, typename Of::Member Pointer>
struct Reveal {
    friend typename Of::Member member(Of) { return Pointer; }
};
// The names in an explicit instantiation are exempt from access control (C++20 [temp.spec]): no cast, no
// guess.
template struct Reveal<Sweep, &b2Body::m_sweep>;
template struct Reveal<Listener, &b2World::m_destructionListener>;

} // namespace boxPrivates

/// 0 to 1, where Box2D's time-of-impact pass has moved the body the last time it did; it stays until that
/// pass begins again. The world's thread.
inline float advancedPartOf(const b2Body& body) noexcept {
    return (body.*member(boxPrivates::Sweep{})).alpha0;
}

/// nullptr if there is none. The world's thread.
inline b2DestructionListener* destructionListenerOf(b2World& world) noexcept {
    return world.*member(boxPrivates::Listener{});
}

} // namespace physvib
