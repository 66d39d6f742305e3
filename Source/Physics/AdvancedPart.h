// SPDX-License-Identifier: MIT
// How much of its step Box2D has taken a body through: it knows, and does not say.
#pragma once
#include <box2d/box2d.h>

namespace physvib {

namespace advancedPart {

struct Access {
    friend b2Sweep b2Body::*member(Access);
};
template <b2Sweep b2Body::*Member>
struct Reveal {
    friend b2Sweep b2Body::*member(Access) { return Member; }
};
template struct Reveal<&b2Body::m_sweep>; // see InstalledListener.h

} // namespace advancedPart

/// 0 to 1, where Box2D's time-of-impact pass has moved the body the last time it did; it stays until that pass begins again. The
/// world's thread.
inline float advancedPartOf(const b2Body& body) noexcept { return (body.*member(advancedPart::Access{})).alpha0; }

} // namespace physvib
