// SPDX-License-Identifier: MIT
// Access to private members of Box2D 2.4 that have no getter: how far a step has advanced a body, and a
// world's destruction listener.
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
// Names in an explicit instantiation are exempt from access control (C++20 [temp.spec]): no cast, no assumed
// layout.
template struct Reveal<Sweep, &b2Body::m_sweep>;
template struct Reveal<Listener, &b2World::m_destructionListener>;

} // namespace boxPrivates

/// 0 to 1: how far Box2D's time-of-impact solver last advanced the body; valid until that solver starts
/// again. World thread (M).
inline float advancedPartOf(const b2Body& body) noexcept {
    return (body.*member(boxPrivates::Sweep{})).alpha0;
}

/// nullptr if there is none. World thread (M).
inline b2DestructionListener* destructionListenerOf(b2World& world) noexcept {
    return world.*member(boxPrivates::Listener{});
}

} // namespace physvib
